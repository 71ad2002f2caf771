"""What people bring that is hard to learn from: a sentence that helps, or a run that ends and says how."""

import pytest

from app.db import Database
from app.learning import worker
from irl_core import DEFAULT_LEARNERS, LEARNERS
from tests.app.test_learning import ask, make_failure
from tests.factories import make_demonstration, make_ranking, make_world

QUICK = {"iterations": 5}


@pytest.fixture
def world(client):
    return make_world(client)


def learn(client, server_settings, world, **body):
    """Ask for a run, carry it out, and show it with its comparison."""
    asked = ask(client, world, **({"settings": QUICK} | body))
    assert asked.status_code == 202, asked.text
    run_id = asked.json()["id"]
    database = Database(server_settings)
    worker.learn_now(database, run_id)
    database.close()
    run = client.get(f"/api/v1/runs/{run_id}").json()
    assert run["status"] == "done", run["reason"]
    assert client.get(f"/api/v1/runs/{run_id}/comparison").status_code == 200
    return run


def refusal(client, world, *learners):
    answer = ask(client, world, learners=list(learners))
    assert answer.status_code == 422, answer.text
    return answer.json()["error"]


def test_without_a_success_it_says_who_can_learn(client, settings, world):
    failures = [make_failure(client, world, n) for n in range(2)]
    make_ranking(client, world, "failure", failures)
    for name in ("irlf", "irlfr"):
        error = refusal(client, world, name)
        assert "success" in error["message"]
        able = error["message"].partition("these can learn: ")[2].rstrip(".").split(", ")
        assert LEARNERS["birlfr"].title in able
        assert LEARNERS["irlf"].title not in able
        assert "learners" in error["fields"]
    learn(client, settings, world, learners=["birlfr"])


def test_with_nothing_at_all_it_says_what_to_do(client, world):
    assert refusal(client, world, "meirl")["message"]


def test_one_success_is_enough_for_meirl(client, settings, world):
    make_demonstration(client, world)
    run = learn(client, settings, world, learners=["meirl", "irlr"])
    assert run["n_demonstrations"] == 1


def test_all_ties_and_identical_attempts_end_in_a_comparison(client, settings, world):
    ids = {
        "success": [make_demonstration(client, world)["id"] for _ in range(3)],
        "failure": [make_failure(client, world, 0) for _ in range(3)],
    }
    for outcome, tied in ids.items():
        body = {"order": [tied], "confirmed": True}
        assert client.put(f"/api/v1/worlds/{world['id']}/rankings/{outcome}", json=body).status_code == 200
    run = learn(client, settings, world)
    assert set(run["learners"]) == set(DEFAULT_LEARNERS)
    meirl, irlr = run["learners"]["meirl"], run["learners"]["irlr"]
    assert meirl["reward"] == irlr["reward"], "where all are alike, an order adds nothing"


def test_failures_that_never_reach_the_goal_are_left_out_and_said_so(client, settings, world):
    make_demonstration(client, world)
    make_ranking(client, world, "failure", [make_demonstration(client, world, failed=True)["id"] for _ in range(2)])
    error = refusal(client, world, "irlf")
    assert "goal" in error["message"]
    run = learn(client, settings, world, learners=["meirl", "birlfr"])
    assert run["learners"]["meirl"]["outcome"] is not None
    learn(client, settings, world, learners=["irlf"], settings=QUICK | {"unfinished_failures": "include"})
