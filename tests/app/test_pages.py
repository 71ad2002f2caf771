"""Pages: what they are given, where they lead, how errors look."""

import dataclasses
import json
import re

import pytest

from app.demonstrations.pages import PlayPage
from app.error_handlers import ErrorPage
from app.pages import PathState, path_state
from app.rankings.pages import RankPage
from app.templating import MissingAssets, Pages, page_data
from app.worlds.pages import EditorPage
from tests.factories import make_demonstration, make_ranking, make_world


def island(page) -> dict:
    found = re.search(r'<script type="application/json" id="page-data"[^>]*>(.*?)</script>', page.text, re.DOTALL)
    assert found, page.text[:200]
    return json.loads(found[1])


def test_the_front_door_is_a_fresh_world_that_is_not_stored(client):
    data = island(client.get("/"))
    assert data["saved"] is False
    assert data["demonstrations"] == []
    assert data["world"]["success_possible"]
    assert client.get(f"/worlds/{data['world']['id']}").status_code == 404
    parameters = {name: data["world"][name] for name in ("rows", "cols", "seed", "red_probability", "slip", "walls")}
    assert make_world(client, **parameters) == data["world"]


def test_a_known_visitor_is_led_to_the_world_played_last(client):
    first, second = make_world(client), make_world(client, seed=6)
    make_demonstration(client, second, failed=True)
    make_demonstration(client, first, failed=True)
    response = client.get("/", follow_redirects=False)
    assert (response.status_code, response.headers["location"]) == (303, f"/worlds/{first['id']}")
    assert island(client.get("/?new"))["saved"] is False


def test_the_address_describes_a_world(client):
    world = island(client.get("/?seed=5&rows=4&cols=6&red_probability=0.5&slip=0.1"))["world"]
    assert world == make_world(client, seed=5, rows=4, cols=6, red_probability=0.5, slip=0.1)
    square = island(client.get("/?rows=5&seed="))["world"]
    assert (square["rows"], square["cols"]) == (5, 5)


@pytest.mark.parametrize("query", ["seed=x", "rows=1", "rows=101", "slip=nan", "red_probability=2", "seed=-1"])
def test_an_address_of_no_world_is_an_error_page_with_a_way_on(client, query):
    response = client.get(f"/?{query}")
    assert response.status_code == 422
    assert response.headers["content-type"].startswith("text/html")
    assert 'href="/' in response.text


def test_the_play_page_knows_what_was_played_here_by_whom(client, other_client):
    world = make_world(client)
    played = make_demonstration(client, world)
    del played["record"]  # no page looks at it
    options = {"show_totals": True, "hold_to_move": False}
    assert island(client.get(f"/worlds/{world['id']}")) == {
        "world": world, "saved": True, "demonstrations": [played], "options": options,
    }  # fmt: skip
    assert island(other_client.get(f"/worlds/{world['id']}"))["demonstrations"] == []


def test_the_rank_page_has_both_orders(client):
    world = make_world(client)
    ids = [make_demonstration(client, world)["id"] for _ in range(3)]
    ranking = make_ranking(client, world, "success", ids)
    data = island(client.get(f"/worlds/{world['id']}/rank"))
    assert data["rankings"] == {"success": ranking, "failure": None}
    assert data["start_order"] == {"success": ranking["start_order"], "failure": []}


def test_the_path_counts_what_is_kept_and_ranked(client):
    world = make_world(client)
    successes = [make_demonstration(client, world)["id"] for _ in range(3)]
    failure = make_demonstration(client, world, failed=True)["id"]
    assert path_of(client, world) == PathState(world_id=world["id"], n_successes=3, n_failures=1, current="rank")
    make_ranking(client, world, "success", successes)
    assert path_of(client, world).ranked  # one failure alone needs no order
    make_demonstration(client, world)
    assert not path_of(client, world).ranked
    client.put(f"/api/v1/demonstrations/{failure}/discard")
    assert path_of(client, world).n_failures == 0


def test_nobody_has_ranked_who_confirmed_no_order(client):
    world = make_world(client)
    alone = make_demonstration(client, world)["id"]
    make_demonstration(client, world, failed=True)
    assert not path_of(client, world).ranked
    make_ranking(client, world, "success", [alone])
    assert path_of(client, world).ranked


def path_of(client, world) -> PathState:
    from app.models import Visitor

    with client.app.state.database.read() as session:
        return path_state(session, session.query(Visitor.id).scalar(), world["id"], "rank")


def test_a_page_that_is_not_there_is_a_page(client):
    response = client.get("/nowhere/<script>")
    assert response.status_code == 404
    assert "There is nothing at this address." in response.text
    assert "nowhere" not in response.text


def test_every_field_of_a_page_explains_itself():
    for page in (PlayPage, EditorPage, RankPage, ErrorPage, PathState):
        assert all(field.metadata.get("help") for field in dataclasses.fields(page)), page


def test_page_data_cannot_leave_its_island():
    hostile = {"name": "</script><!-- & \u2028 \u2029 <script>"}
    text = page_data(hostile)
    assert not set("<>&\u2028\u2029") & set(text)
    assert json.loads(text) == hostile


def test_missing_packages_are_said_at_start(monkeypatch, tmp_path):
    monkeypatch.setattr("app.templating.find_folder", lambda name: tmp_path)
    with pytest.raises(MissingAssets, match=r"python3 dev\.py run"):
        Pages()


def test_the_import_map_names_our_modules_and_the_packages(tmp_path, monkeypatch):
    entry = tmp_path / "vendor" / "thing@1" / "thing.js"
    entry.parent.mkdir(parents=True)
    entry.write_text("export {}")
    package = {"version": "1", "entry": "thing@1/thing.js", "integrity": "sha384-x"}
    (tmp_path / "vendor" / "manifest.json").write_text(json.dumps({"packages": {"thing": package}}))
    monkeypatch.setattr("app.templating.find_folder", lambda name: tmp_path)
    assert json.loads(Pages().import_map) == {
        "imports": {"#js/": "/static/js/", "thing": "/static/vendor/thing@1/thing.js"},
        "integrity": {"/static/vendor/thing@1/thing.js": "sha384-x"},
    }
