"""A world of one's own, with another start, two goals, walls, paint and limits, on the whole path after the editor."""

import pytest

from app.db import Database
from app.learning import worker
from irl_core import LEARNERS, expected_return, read_demonstration_file
from tests.factories import PLAYABLE_SEED, attempt, make_demonstration, make_ranking, make_world, post_demonstration

UP, RIGHT, DOWN, LEFT = range(4)
OWN = {
    "rows": 5, "cols": 6, "start": 14, "goals": [24, 5], "walls": [8, 21], "step_limit": 40, "time_limit_s": 60,
    "painted": [[5, 4], [9, -6], [24, 20]],
}  # fmt: skip
TO_THE_OTHER_GOAL = [RIGHT, UP, RIGHT, RIGHT, UP]


@pytest.fixture
def run(client, settings):
    """A finished run of every learner, learned in this process."""
    world = make_world(client, **OWN)
    best = make_demonstration(client, world)
    assert (best["states"][0], best["states"][-1], best["outcome"]) == (14, 24, "success")
    again = make_demonstration(client, world)
    worse = play(client, world, TO_THE_OTHER_GOAL, "goal")
    assert (worse["states"][-1], worse["outcome"]) == (5, "failure")
    gave_up = play(client, world, [UP, RIGHT, DOWN], "gave_up")
    make_ranking(client, world, "success", [best["id"], again["id"]])
    make_ranking(client, world, "failure", [worse["id"], gave_up["id"]])
    body = {"learners": list(LEARNERS), "settings": {"iterations": 30}, "seed": 7}
    asked = client.post(f"/api/v1/worlds/{world['id']}/runs", json=body)
    assert asked.status_code == 202, asked.text
    database = Database(settings)
    worker.learn_now(database, asked.json()["id"])
    database.close()
    return client.get(f"/api/v1/runs/{asked.json()['id']}").json()


def play(client, world, actions, ending):
    body = attempt(world, actions=actions, step_ms=[100.0] * len(actions), ending=ending)
    response = post_demonstration(client, world, body)
    assert response.status_code == 201, response.text
    return response.json()


def test_every_learner_learns_there_and_is_compared(client, run):
    assert run["status"] == "done", run["reason"]
    comparison = client.get(f"/api/v1/runs/{run['id']}/comparison").json()
    assert comparison["horizon"] == 40
    entries = {entry["who"]: entry for entry in comparison["entries"]}
    assert set(entries) == {"human", *LEARNERS, "optimal"}
    file = read_demonstration_file(client.get(f"/api/v1/runs/{run['id']}/demonstrations.jsonl").text.splitlines())
    assert (file.world.start, file.world.goals, file.world.time_limit_s) == (14, (24, 5), 60)
    for name, result in run["learners"].items():
        worth = expected_return(file.world, result["policy"])
        assert entries[name]["expected_return"] == pytest.approx(worth, abs=1e-9)
        assert worth <= entries["optimal"]["expected_return"] + 1e-9
    rollouts = client.get(f"/api/v1/runs/{run['id']}/rollouts").json()
    assert {one["states"][0] for shown in rollouts.values() for one in shown} == {14}
    assert all(one["states"][-1] == 24 for one in rollouts["optimal"])


@pytest.mark.parametrize("way", ["lists", "pairwise", "magnitude", "segments"])
def test_a_world_can_say_how_its_attempts_are_ordered(client, way):
    world = make_world(client, rank_by=way)
    assert (world["rank_by"], world["spec"]) == (way, {"seed": PLAYABLE_SEED, "rank_by": way})
    assert client.get(f"/api/v1/worlds/{world['id']}").json() == world
    assert make_world(client, **world["spec"]) == world
    assert client.get(f"/api/v1/worlds/preview?seed={PLAYABLE_SEED}&rank_by={way}").json() == world
    plain = make_world(client)
    assert plain["id"] != world["id"]
    assert plain["rewards"] == world["rewards"]


def test_a_world_keeps_the_id_it_had_before_orders_could_be_given_in_several_ways(client):
    for parameters in ({}, {"rank_by": None}):
        world = make_world(client, **parameters)
        assert world["id"] == "e7937d2d-b4d5-5d72-9015-45b0b6cfe473"
        assert world["rank_by"] is None
        assert world["spec"] == {"seed": PLAYABLE_SEED}
    assert make_world(client, rank_by="pairwise")["id"] == "47df6d3e-53ab-560d-84c0-5e2657e704da"


def test_a_world_can_pool_everybodys_results_and_is_another_then(client):
    world, plain = make_world(client, pooled=True), make_world(client, pooled=False)
    assert (world["pooled"], world["spec"]) == (True, {"seed": PLAYABLE_SEED, "pooled": True})
    assert (plain["pooled"], plain["id"]) == (False, make_world(client)["id"])
    assert world["id"] != plain["id"], "nobody who played the other was told that results are pooled"
    assert world["rewards"] == plain["rewards"]
    assert client.post("/api/v1/worlds", json={"pooled": "yes"}).status_code == 422


@pytest.mark.parametrize("way", ["Lists", "alphabet", "", 1, True, ["lists"], {}])
def test_a_way_that_is_none_is_refused_in_words(client, way):
    response = client.post("/api/v1/worlds", json={"rank_by": way})
    assert response.status_code == 422
    assert "rank_by" in response.json()["error"]["fields"]
    assert "'lists', 'pairwise', 'magnitude' or 'segments'" in response.json()["error"]["message"]


def test_every_page_shows_it(client, run):
    for page in (f"/worlds/{run['world_id']}", f"/worlds/{run['world_id']}/rank", f"/runs/{run['id']}",
                 f"/runs/{run['id']}/comparison"):  # fmt: skip
        assert client.get(page).status_code == 200
