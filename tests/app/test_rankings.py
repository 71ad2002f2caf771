"""Rankings through the API: exactly what is kept, every version kept."""

import json
import re
import uuid

import pytest
from pydantic import ValidationError
from sqlalchemy import text

from app.config import WAYS, Settings
from app.main import create_app
from tests.conftest import make_settings, open_client
from tests.factories import make_demonstration, make_ranking, make_world


@pytest.fixture
def world(client):
    return make_world(client)


def put(client, world, order, *, outcome="success", confirmed=True):
    body = {"order": order, "confirmed": confirmed}
    return client.put(f"/api/v1/worlds/{world['id']}/rankings/{outcome}", json=body)


def test_weights_rise_with_the_place_and_ties_share(client, world):
    a, b, c = (make_demonstration(client, world)["id"] for _ in range(3))
    assert put(client, world, [[b], [a], [c]]).json()["weights"] == {b: 3 / 6, a: 2 / 6, c: 1 / 6}
    ranking = put(client, world, [[b], [a, c]]).json()
    assert ranking["weights"] == {b: 3 / 6, a: 1.5 / 6, c: 1.5 / 6}
    assert ranking["version"] == 2
    assert ranking["order"] == [[b], [a, c]]
    assert sorted(ranking["start_order"]) == sorted([a, b, c])


def test_failures_are_ranked_on_their_own(client, world):
    success, failure = make_demonstration(client, world), make_demonstration(client, world, failed=True)
    ranking = make_ranking(client, world, "failure", [failure["id"]])
    shown = client.get(f"/api/v1/worlds/{world['id']}/rankings").json()
    assert shown == {"success": None, "failure": ranking}
    response = put(client, world, [[success["id"], failure["id"]]])
    assert response.status_code == 422
    assert "other outcome" in response.json()["error"]["message"]


def test_every_version_is_kept(client, world):
    a, b = (make_demonstration(client, world)["id"] for _ in range(2))
    orders = [[a, b], [b, a], [b, a]]
    assert [make_ranking(client, world, "success", order)["version"] for order in orders] == [1, 2, 3]
    with client.app.state.database.read() as session:
        assert session.scalar(text("SELECT count(*) FROM ranking")) == 3


def test_the_start_order_stays_and_a_new_attempt_disturbs_no_other(client, world):
    ids = [make_demonstration(client, world)["id"] for _ in range(6)]
    before = make_ranking(client, world, "success", ids)["start_order"]
    new = make_demonstration(client, world)["id"]
    after = make_ranking(client, world, "success", [*ids, new])["start_order"]
    assert [one for one in after if one != new] == before


def test_an_order_of_something_else_is_refused_with_every_reason(client, other_client, world):
    a, b, gone = (make_demonstration(client, world)["id"] for _ in range(3))
    foreign = make_demonstration(other_client, world)["id"]
    client.put(f"/api/v1/demonstrations/{gone}/discard")
    wrong = {
        "missing": [[a]],
        "twice": [[a], [b], [a]],
        "discarded": [[a], [b], [gone]],
        "not yours": [[a], [b], [foreign]],
        "or of another world": [[a], [b], [str(uuid.uuid4())]],
    }
    for word, order in wrong.items():
        response = put(client, world, order)
        assert response.status_code == 422, order
        assert word in response.json()["error"]["message"]
        assert "order" in response.json()["error"]["fields"]
    assert client.get(f"/api/v1/worlds/{world['id']}/rankings").json()["success"] is None


@pytest.mark.parametrize("order", [[], [[]], [["x"]], ["x"], [None], "x", {}, [[1]], [[True]], [[["x"]]], None])
def test_what_is_no_order_is_refused(client, world, order):
    make_demonstration(client, world)
    assert put(client, world, order).status_code == 422


@pytest.mark.parametrize("confirmed", [False, None, 1, "true", []])
def test_an_untouched_list_is_not_an_answer(client, world, confirmed):
    played = make_demonstration(client, world)["id"]
    response = put(client, world, [[played]], confirmed=confirmed)
    assert response.status_code == 422
    assert "confirmed" in response.json()["error"]["fields"]


def test_nothing_to_order_is_said_in_words(client, other_client, world):
    for one in (client, other_client):
        response = put(one, world, [])
        assert response.status_code == 422
        assert "nothing to order" in response.json()["error"]["message"]


def test_more_than_forty_can_be_ranked(client, world):
    ids = [make_demonstration(client, world)["id"] for _ in range(45)]
    assert sum(make_ranking(client, world, "success", ids)["weights"].values()) == pytest.approx(1)


def test_there_are_two_outcomes(client, world):
    assert put(client, world, [], outcome="draw").status_code == 422


def test_every_version_can_be_looked_at_newest_first(client, other_client, world):
    a, b = (make_demonstration(client, world)["id"] for _ in range(2))
    made = [make_ranking(client, world, "success", order) for order in ([a, b], [b, a])]
    url = f"/api/v1/worlds/{world['id']}/rankings/success/versions"
    assert client.get(url).json() == [made[1], made[0] | {"counts": False}]
    assert other_client.get(url).json() == client.get(url.replace("success", "failure")).json() == []


def options_of(client, world):
    page = client.get(f"/worlds/{world['id']}/rank").text
    island = re.search(r'<script type="application/json" id="page-data"[^>]*>(.*?)</script>', page, re.DOTALL)
    assert island
    return json.loads(island[1])["options"]


def test_the_page_says_which_ways_there_are_and_what_is_shown(client, world):
    assert options_of(client, world) == {
        "show_totals": True,
        "show_agreement": True,
        "show_policy": True,
        "ways": list(WAYS),
    }
    fixed = make_world(client, rank_by="segments")
    assert options_of(client, fixed)["ways"] == ["segments"]


def test_a_study_chooses_the_ways_and_whether_agreement_is_shown(settings):
    told = make_settings(settings.data_dir, rank_by=("pairwise", "lists"), show_agreement=False, show_policy=False)
    with open_client(create_app(told)) as client:
        options = options_of(client, make_world(client))
    shown = {"show_totals": True, "show_agreement": False, "show_policy": False}
    assert options == shown | {"ways": ["pairwise", "lists"]}


def test_ways_come_from_the_environment_as_a_list_of_words(monkeypatch):
    for told, ways in {"pairwise": ("pairwise",), " lists, magnitude": ("lists", "magnitude")}.items():
        monkeypatch.setenv("IRLFR_RANK_BY", told)
        assert Settings().rank_by == ways
    for wrong in ("", "lists,lists", "best", "lists,,pairwise"):
        monkeypatch.setenv("IRLFR_RANK_BY", wrong)
        with pytest.raises(ValidationError):
            Settings()
