"""Where worlds come from: the editor's page, the preview, surprises, and addresses of no world."""

import html
import json
import random
import re
from pathlib import Path
from urllib.parse import quote

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.worlds import presets, service
from app.worlds.address import LONGEST, read_query, write_query
from app.worlds.presets import PRESETS
from app.worlds.schemas import WorldIn
from tests.app.test_pages import island
from tests.factories import make_world

TABLE = Path(__file__).parents[1] / "core" / "world_queries.json"
CASES = json.loads(TABLE.read_text(encoding="utf-8"))
PREVIEW = "/api/v1/worlds/preview"
SAFE = "=&,:-"

IMPOSSIBLE = [
    ("rows=1", "rows", "rows must be a whole number from 2 to 100."),
    ("rows=7.0", "rows", "rows must be a whole number"),
    ("rows=٧", "rows", "rows must be a whole number"),
    ("cols=1_0", "cols", "cols must be a whole number"),
    ("cols=101", "cols", "from 2 to 100"),
    ("seed=-1", "seed", "from 0 to 9007199254740991"),
    ("seed=" + "9" * 5_000, "seed", "seed must be a whole number"),
    ("seed=1&seed=2", "seed", "seed must be given once."),
    ("red_probability=2", "red_probability", "must be a number from 0 to 1"),
    ("red_probability=nan", "red_probability", "must be a number"),
    ("slip=0,3", "slip", "slip must be a number from 0 to 0.9"),
    ("slip=1e999", "slip", "must be a number"),
    ("walls=9-3", "walls", "walls must count upwards: 3-9, not 9-3."),
    ("walls=a", "walls", "walls must name squares by their numbers, such as 3-5,9."),
    ("walls=1-", "walls", "such as 3-5,9"),
    ("walls=-3", "walls", "such as 3-5,9"),
    ("walls=0-9999999", "walls", "such as 3-5,9"),
    ("walls=10000", "walls", "from 0 to 9999; 10000 is in no world"),
    ("walls=" + ",".join(["0-9999"] * 1_000), "walls", "must name at most 9998 squares"),
    ("walls=60", "walls", "whole numbers, 0 to 48, not 60."),
    ("walls=0", "walls", "The start, square 0 (row 1, column 1), cannot be a wall too; open it or move the start."),
    ("walls=48", "walls", "The goal, square 48 (row 7, column 7), cannot be a wall too"),
    ("walls=21-27", "walls", "the walls close the way. Open one of them."),
    ("start=49", "start", "start must be a whole number from 0 to 48, not 49."),
    ("start=48", "start", "The start cannot be the last square, 48: it is the goal, unless goals say otherwise."),
    ("start=10&walls=10", "walls", "The start, square 10 (row 2, column 4), cannot be a wall too"),
    ("goals=6,6", "goals", "goals names a square twice."),
    ("goals=0", "goals", "The start, square 0 (row 1, column 1), cannot be a goal too; move one of them."),
    ("goals=49", "goals", "0 to 48, not 49"),
    ("goals=1-200&rows=20", "goals", "must name at most 100 squares"),
    ("painted=3", "painted", "painted must be squares with their rewards, such as 12-14:-3.5,20:-1."),
    ("painted=3:x", "painted", "such as 12-14:-3.5,20:-1"),
    ("painted=3:-8", "painted", "must pay -7 to 0 on an ordinary square, 0 to 200 on a goal"),
    ("painted=3:2", "painted", "square 3 (row 1, column 4) is no goal and can pay -7 to 0, not 2.0."),
    ("painted=48:-1", "painted", "square 48 (row 7, column 7) is a goal and can pay 0 to 200, not -1.0."),
    ("painted=3:-1,2-4:-2", "painted", "painted must name each square once; 3 is there twice."),
    ("painted=9-3:-1", "painted", "painted must count upwards: 3-9, not 9-3."),
    ("painted=49:-1", "painted", "0 to 48, not 49"),
    ("painted=3:-1&walls=3", "painted", "square 3 (row 1, column 4) is a wall and pays nothing"),
    ("step_limit=11", "step_limit", "must be a whole number from 12 (the shortest way to a goal) to 98, not 11."),
    ("step_limit=99", "step_limit", "to 98, not 99"),
    ("step_limit=0", "step_limit", "from 1 to 20000"),
    ("time_limit_s=4", "time_limit_s", "time_limit_s must be a whole number from 5 to 3600."),
    ("time_limit_s=1.5", "time_limit_s", "from 5 to 3600"),
    ("rank_by=alphabet", "rank_by", "rank_by must be lists, pairwise, magnitude or segments."),
    ("pooled=yes", "pooled", "pooled must be 1 for yes or 0 for no."),
    ("rank_by=lists&rank_by=lists", "rank_by", "rank_by must be given once."),
    ("rows=20&cols=20&red_probability=1", "red_probability", "fewer red squares"),
    ("a=" + "b" * LONGEST, "query", "This address is too long: 60,002 characters, where 60,000 can be read."),
]
IDS = [query[:30] for query, _, _ in IMPOSSIBLE]


@pytest.mark.parametrize("case", CASES, ids=[case["query"][:40] for case in CASES])
def test_a_query_and_the_body_it_stands_for_are_one(case):
    read = read_query(case["query"])
    assert (dict(WorldIn(**read.spec)), read.problems) == (dict(WorldIn(**case["spec"])), {})
    assert write_query(case["spec"]) == case["query"]


@pytest.mark.parametrize("case", CASES, ids=[case["query"][:40] for case in CASES])
def test_the_spec_of_a_made_world_is_the_smallest_body_that_makes_it(client, case):
    made = make_world(client, **case["spec"])
    assert made["spec"] == case["spec"]
    assert client.post("/api/v1/worlds", json=made["spec"]).json() == made
    assert client.get(f"{PREVIEW}?{case['query']}").json() == made
    assert client.get(f"/api/v1/worlds/{made['id']}").json() == made
    for name in made["spec"]:
        smaller = {field: value for field, value in made["spec"].items() if field != name}
        assert client.post("/api/v1/worlds", json=smaller).json().get("id") != made["id"]


@given(
    st.fixed_dictionaries(
        {"seed": st.integers(0, 2**53 - 1)},
        optional={
            "rows": st.integers(2, 100),
            "cols": st.integers(2, 100),
            "red_probability": st.floats(0, 1),
            "slip": st.floats(0, 0.9),
            "walls": st.lists(st.integers(0, 9999), max_size=50),
            "start": st.integers(0, 9999),
            "goals": st.lists(st.integers(0, 9999), min_size=1, max_size=100),
            "painted": st.dictionaries(st.integers(0, 9999), st.floats(-7, 200), max_size=50).map(
                lambda painted: [[square, reward] for square, reward in painted.items()]
            ),
            "step_limit": st.integers(1, 20_000),
            "time_limit_s": st.integers(5, 3600),
            "rank_by": st.sampled_from(["lists", "pairwise", "magnitude", "segments"]),
            "pooled": st.booleans(),
        },
    )
)
@settings(max_examples=150, deadline=None)
def test_whatever_body_is_written_into_an_address_is_read_from_it(spec):
    read = read_query(write_query(spec))
    assert not read.problems
    assert read.to_world_in() == WorldIn(**spec)


def test_an_address_may_be_written_as_people_write():
    spec = {"rows": 5, "cols": 5, "slip": 0.5, "walls": [3, 4, 9], "painted": [[7, -2.5]]}
    assert read_query("rows=5&slip=.5&walls=3-4,%209,&painted=7:%E2%88%922.5&seed=&utm=x").spec == spec
    assert read_query("painted=7:-0").spec["painted"] == [[7, 0.0]]
    assert str(read_query("painted=7:-0&red_probability=-0").spec["painted"][0][1]) == "0.0"


def test_squares_named_twice_are_walls_once(client):
    assert client.get(f"{PREVIEW}?walls=5,5-9").json()["walls"] == [5, 6, 7, 8, 9]


@pytest.mark.parametrize(("query", "field", "sentence"), IMPOSSIBLE, ids=IDS)
def test_an_impossible_world_is_said_by_the_preview_the_front_door_and_the_editor(client, query, field, sentence):
    preview = client.get(f"{PREVIEW}?{query}")
    assert preview.status_code == 422, preview.text[:300]
    assert list(preview.json()["error"]["fields"]) == [field]
    assert sentence in preview.json()["error"]["fields"][field]
    front_door = client.get(f"/?{query}")
    assert front_door.status_code == 422
    text = html.unescape(front_door.text)
    assert sentence in text
    assert 'href="/?new"' in text
    to_mend = re.search(r'href="(/worlds/new[^"]*)">Mend it in the editor', text)
    assert to_mend
    assert to_mend[1] == ("/worlds/new" if field == "query" else f"/worlds/new?{quote(query, safe=SAFE)}")
    editor = client.get(f"/worlds/new?{query}")
    assert editor.status_code == 200
    data = island(editor)
    assert (data["world"], list(data["problem"]["fields"])) == (None, [field])
    assert sentence in data["problem"]["message"]


def test_what_could_be_read_is_kept_for_the_editor(client):
    data = island(client.get("/worlds/new?rows=9&cols=x&seed=5&walls=9-3&slip=0.1"))
    assert data["spec"] == {"rows": 9, "seed": 5, "slip": 0.1}
    assert set(data["problem"]["fields"]) == {"cols", "walls"}
    closed = island(client.get("/worlds/new?seed=5&walls=21-27"))
    assert closed["spec"] == {"seed": 5, "walls": [21, 22, 23, 24, 25, 26, 27]}


def test_the_editor_knows_the_world_the_presets_and_the_limits(client):
    data = island(client.get("/worlds/new?seed=5&goals=48,6"))
    assert data["world"] == make_world(client, goals=[48, 6])
    assert data["spec"] == {"seed": 5, "goals": [48, 6]}
    assert [one["name"] for one in data["presets"]] == [
        "paper", "corridor", "cliff", "maze", "open_field", "two_goals",
    ]  # fmt: skip
    assert data["limits"]["rows"] == [2, 100]
    fresh = island(client.get("/worlds/new"))
    assert fresh["world"]["success_possible"]
    assert fresh["spec"] == {"seed": fresh["world"]["seed"]}


def test_looking_at_a_world_stores_nothing(client):
    previewed = client.get(f"{PREVIEW}?seed=5&walls=3").json()
    island(client.get("/worlds/new?seed=5&walls=3"))
    assert client.get(f"/api/v1/worlds/{previewed['id']}").status_code == 404


@given(st.text(max_size=60))
@settings(max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_no_address_breaks_the_editor(client, text):
    assert client.get(f"{PREVIEW}?walls={quote(text)}&painted={quote(text)}&rows={quote(text)}").status_code in (
        200,
        422,
    )
    assert client.get(f"/worlds/new?{quote(text)}={quote(text)}").status_code == 200


def test_everything_that_is_wrong_is_said_at_once(client):
    text = client.get("/?rows=1&walls=9-3").text
    wrong = "rows must be a whole number from 2 to 100; walls must count upwards: 3-9, not 9-3."
    assert f"This address describes no world: {wrong}" in text


def test_markup_in_an_address_stays_text(client):
    page = client.get('/?walls="><script>alert(7)</script>')
    assert page.status_code == 422
    assert "<script>alert" not in page.text


@pytest.mark.parametrize("preset", PRESETS, ids=[preset.name for preset in PRESETS])
def test_in_every_preset_a_short_way_tempts_and_another_succeeds(client, preset):
    world = make_world(client, **preset.spec)
    assert world["success_possible"]
    assert world["spec"] == preset.spec
    assert min(totals_of_shortest_ways(world)) < 0
    assert island(client.get(f"/?{write_query(preset.spec)}"))["world"] == world


def totals_of_shortest_ways(world):
    """The least total with which each goal's shortest ways reach it."""
    rewards = [reward for row in world["rewards"] for reward in row]
    least, edge = {world["start"]: 0.0}, {world["start"]: 0.0}
    while edge:
        reached: dict[int, float] = {}
        for square, total in edge.items():
            for ahead in [] if square in world["goals"] else open_neighbours(world, square):
                if ahead not in least:
                    reached[ahead] = min(reached.get(ahead, total + rewards[ahead]), total + rewards[ahead])
        least |= reached
        edge = reached
    return [least[goal] for goal in world["goals"]]


def open_neighbours(world, square):
    row, col = divmod(square, world["cols"])
    around = [(row - 1, col), (row, col + 1), (row + 1, col), (row, col - 1)]
    inside = [r * world["cols"] + c for r, c in around if 0 <= r < world["rows"] and 0 <= c < world["cols"]]
    return [ahead for ahead in inside if ahead not in world["walls"]]


def test_a_surprise_is_a_world_of_moderate_size_in_which_a_success_is_possible(client):
    seen = set()
    for _ in range(40):
        response = client.get("/worlds/surprise", follow_redirects=False)
        assert response.status_code == 303
        query = response.headers["location"].removeprefix("/?")
        world = client.get(f"{PREVIEW}?{query}").json()
        assert world["success_possible"]
        assert max(world["rows"], world["cols"]) <= 20
        assert write_query(world["spec"]) == query
        seen.add(world["id"])
    assert len(seen) == 40
    assert island(client.get("/worlds/surprise"))["world"]["success_possible"]


def test_where_no_surprise_is_possible_there_is_the_papers_world(monkeypatch):
    monkeypatch.setattr(presets, "surprise", lambda rng: {"walls": [1, 7]})
    assert read_query(service.surprise(random.Random(1))).spec.keys() == {"seed"}
