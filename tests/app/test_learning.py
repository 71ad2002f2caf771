"""Runs through the API, with the worker's own function called in this process: the queue has tests of its own."""

import json
import math

import pytest
from sqlalchemy import func, select

from app.db import Database
from app.learning import steps, worker
from app.models import Run, RunCheckpoint, RunEvent, RunResult
from irl_core import DEFAULT_LEARNERS, LEARNERS
from tests.factories import attempt, losing_path, make_demonstration, make_ranking, make_world, post_demonstration

QUICK = {"iterations": 30}
PAPER = ("meirl", "irlr", "irlf", "irlfr")


@pytest.fixture
def database(settings):
    opened = Database(settings)
    yield opened
    opened.close()


@pytest.fixture
def played(client):
    """A world with three successes and three failures that reach the goal, both in order."""
    world = make_world(client)
    for outcome, failed in (("success", False), ("failure", True)):
        ids = [make_failure(client, world, n) if failed else make_demonstration(client, world)["id"] for n in range(3)]
        make_ranking(client, world, outcome, ids)
    return world


def make_failure(client, world, n):
    """Reach the goal by way of the dearest square, going there and back until the total is lost for good."""
    actions = losing_path(world) if n == 0 else [0] * n + losing_path(world)
    body = attempt(world, actions=actions, step_ms=[100.0] * len(actions), ending="goal")
    response = post_demonstration(client, world, body)
    assert response.status_code == 201, response.text
    assert response.json()["outcome"] == "failure"
    return response.json()["id"]


def ask(client, world, **body):
    return client.post(f"/api/v1/worlds/{world['id']}/runs", json={"settings": QUICK, "seed": 7} | body)


def events(client, run_id, after=0):
    """Read a stream to its end: [(id, kind, data)]."""
    text = client.get(f"/api/v1/runs/{run_id}/events", headers={"Last-Event-ID": str(after)}).text
    found = []
    for block in text.strip().split("\n\n"):
        fields = dict(line.split(": ", 1) for line in block.splitlines() if not line.startswith(":"))
        if fields:
            found.append((int(fields["id"]), fields["event"], json.loads(fields["data"])))
    return found


def test_a_run_goes_from_queued_to_done_with_every_result(client, played, database):
    asked = ask(client, played)
    assert asked.status_code == 202, asked.text
    run = asked.json()
    assert run["status"] == "queued"
    assert run["learners"] == {name: {"outcome": None} for name in DEFAULT_LEARNERS}
    assert set(run["versions"]) == {"irlfr", "numba", "numpy", "python", "scipy"}
    worker.learn_now(database, run["id"])
    done = client.get(f"/api/v1/runs/{run['id']}").json()
    assert done["status"] == "done"
    for name in PAPER:
        assert done["learners"][name]["outcome"] == "iteration_limit"
        assert done["learners"][name]["iterations"] == 30
    for result in done["learners"].values():
        assert [len(row) for row in result["reward"]] == [7] * 7
        assert len(result["policy"]) == 49
        assert all(sum(row) == pytest.approx(1) for row in result["policy"])


def test_every_learner_there_is_ends_in_a_comparison_that_json_can_hold(client, played, database):
    run_id = ask(client, played, learners=list(LEARNERS)).json()["id"]
    worker.learn_now(database, run_id)
    run = client.get(f"/api/v1/runs/{run_id}").json()
    assert run["status"] == "done", run["reason"]
    assert [run["learners"][name]["outcome"] is None for name in LEARNERS] == [False] * len(LEARNERS)
    entries = client.get(f"/api/v1/runs/{run_id}/comparison").json()["entries"]
    assert {entry["who"] for entry in entries} == {"human", *LEARNERS, "optimal"}
    for _, kind, data in events(client, run_id):  # a browser's JSON.parse knows no NaN
        assert kind != "frame" or all(map(math.isfinite, [data["gap"], data["log_likelihood"], *data["reward"]]))


def test_the_comparison_has_the_human_every_learner_and_the_optimum(client, played, database):
    run_id = ask(client, played).json()["id"]
    early = client.get(f"/api/v1/runs/{run_id}/comparison")
    assert early.status_code == 409
    worker.learn_now(database, run_id)
    comparison = client.get(f"/api/v1/runs/{run_id}/comparison").json()
    entries = {entry["who"]: entry for entry in comparison["entries"]}
    assert set(entries) == {"human", *DEFAULT_LEARNERS, "optimal"}
    totals = [one["total"] for one in client.get(f"/api/v1/worlds/{played['id']}/demonstrations").json()]
    assert entries["human"]["mean_return"] == pytest.approx(sum(totals) / 6, abs=1e-12)
    assert entries["optimal"]["place"] == 1
    rollouts = client.get(f"/api/v1/runs/{run_id}/rollouts").json()
    for who in ("meirl", "optimal"):
        assert len(rollouts[who]) == entries[who]["episodes"] == 50
        assert sum(one["total"] for one in rollouts[who]) / 50 == pytest.approx(entries[who]["mean_return"])


def test_the_same_seed_gives_the_same_run(client, played, database):
    first, second = (ask(client, played).json()["id"] for _ in range(2))
    for run_id in (first, second):
        worker.learn_now(database, run_id)
    for path in ("", "/rollouts"):
        one, two = (client.get(f"/api/v1/runs/{run_id}{path}").json() for run_id in (first, second))
        for document in (one, two):
            for name in ("id", "created_at", "started_at", "finished_at", "compute_ms"):
                document.pop(name, None)
        assert one == two


def test_events_are_numbered_and_end_with_done(client, played, database):
    run_id = ask(client, played).json()["id"]
    worker.learn_now(database, run_id)
    found = events(client, run_id)
    assert [number for number, _, _ in found] == list(range(1, len(found) + 1))
    kinds = [kind for _, kind, _ in found]
    assert kinds[-1] == "done"
    assert kinds.count("learner") == len(DEFAULT_LEARNERS)
    assert kinds.count("done") == 1
    for name in PAPER:
        frames = [data for _, kind, data in found if kind == "frame" and data["learner"] == name]
        assert frames[0]["iteration"] == 0, "the first frame shows what it knows before it has learned"
        assert frames[-1]["iteration"] == 30, "the last frame always comes"
        assert len(frames[-1]["reward"]) == 49


def test_a_stream_resumes_after_the_last_event_id(client, played, database):
    run_id = ask(client, played).json()["id"]
    worker.learn_now(database, run_id)
    whole = events(client, run_id)
    assert events(client, run_id, after=3) == whole[3:]
    last = client.get(f"/api/v1/runs/{run_id}/events", headers={"Last-Event-ID": str(len(whole))})
    assert last.status_code == 204, "a browser that has everything stops asking"


@pytest.mark.parametrize("seen", ["-1", "x", "1.5", "99999999999999999999999"])
def test_a_last_event_id_that_is_no_number_is_refused(client, played, seen):
    run_id = ask(client, played).json()["id"]
    response = client.get(f"/api/v1/runs/{run_id}/events", headers={"Last-Event-ID": seen})
    assert response.status_code == 422


def test_a_run_cancelled_in_the_queue_never_starts(client, played, database):
    run_id = ask(client, played).json()["id"]
    cancelled = client.post(f"/api/v1/runs/{run_id}/cancellation")
    assert cancelled.status_code == 202
    assert cancelled.json()["status"] == "cancelled"
    worker.learn_now(database, run_id)
    run = client.get(f"/api/v1/runs/{run_id}").json()
    assert run["status"] == "cancelled"
    assert run["started_at"] is None
    assert events(client, run_id) == [(1, "failed", {"status": "cancelled", "message": "You cancelled this run."})]
    assert client.post(f"/api/v1/runs/{run_id}/cancellation").status_code == 409


def test_a_run_cancelled_midway_stops_at_its_next_step_and_keeps_what_it_showed(client, played, database):
    run_id = ask(client, played).json()["id"]
    run = steps.begin(database, run_id)
    steps.advance(database, run, "meirl")
    client.post(f"/api/v1/runs/{run_id}/cancellation")
    with pytest.raises(steps.NoLongerWanted):
        steps.advance(database, run, "meirl")
    assert [kind for _, kind, _ in events(client, run_id)] == ["frame", "failed"]


def test_a_run_taken_up_by_another_worker_ends_with_the_same_result(client, played, database):
    """Every step once abandoned after it was stored, as if the worker had died before saying so."""
    straight, broken = (ask(client, played).json()["id"] for _ in range(2))
    worker.learn_now(database, straight)
    for learner in DEFAULT_LEARNERS:
        finished = False
        while not finished:
            run = steps.begin(database, broken)  # a new process: nothing remembered but what is stored
            finished = steps.advance(database, run, learner)
            assert steps.advance(database, run, learner) or not finished
    worker.learn_now(database, broken)
    one, two = (client.get(f"/api/v1/runs/{run_id}").json()["learners"] for run_id in (straight, broken))
    assert one == two
    with database.read() as session:
        results = session.scalar(select(func.count()).select_from(RunResult).where(RunResult.run_id == broken))
        assert results == len(DEFAULT_LEARNERS)
        assert session.scalar(select(func.count()).select_from(RunCheckpoint)) == 0, "checkpoints are cleared away"


def test_a_learner_that_breaks_fails_the_run_with_a_reason(client, played, database, monkeypatch):
    run_id = ask(client, played).json()["id"]

    def out_of_memory(*_, **__):
        raise MemoryError

    monkeypatch.setattr(steps, "compare", out_of_memory)
    worker.learn_now(database, run_id)
    run = client.get(f"/api/v1/runs/{run_id}").json()
    assert run["status"] == "failed"
    assert "out of memory" in run["reason"]
    _, kind, data = events(client, run_id)[-1]
    assert (kind, data["status"], data["message"]) == ("failed", "failed", run["reason"])


ABSURD = {
    "no learners": {"learners": []},
    "an unknown learner": {"learners": ["gail"]},
    "a learner twice": {"learners": ["meirl", "meirl"]},
    "learners no list": {"learners": "meirl"},
    "an unknown setting": {"settings": {"gamma": 1}},
    "no iterations": {"settings": {"iterations": 0}},
    "half an iteration": {"settings": {"iterations": 1.5}},
    "a true number of iterations": {"settings": {"iterations": True}},
    "too many iterations": {"settings": {"iterations": 10**9}},
    "a negative learning rate": {"settings": {"learning_rate": -0.1}},
    "lambda zero": {"settings": {"lambda_min": 0}},
    "lambda above its start": {"settings": {"lambda_min": 11, "lambda_start": 10}},
    "growing lambda": {"settings": {"lambda_decay": 1.5}},
    "settings no object": {"settings": [1]},
    "a nested setting": {"settings": {"iterations": {"a": 1}}},
    "a negative seed": {"seed": -1},
    "a seed beyond JavaScript": {"seed": 2**53},
    "a boolean seed": {"seed": True},
    "an unknown field": {"reward": [1]},
}


@pytest.mark.parametrize("body", ABSURD.values(), ids=ABSURD)
def test_absurd_runs_are_refused_and_nothing_is_stored(client, played, database, body):
    response = ask(client, played, **body)
    assert response.status_code == 422, response.text
    assert set(response.json()["error"]) == {"code", "message", "fields"}
    with database.read() as session:
        assert session.scalar(select(func.count()).select_from(Run)) == 0
        assert session.scalar(select(func.count()).select_from(RunEvent)) == 0


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999"])
def test_settings_that_are_no_numbers_are_refused(client, played, number):
    body = '{"settings": {"learning_rate": %s}}' % number  # noqa: UP031 - braces
    response = client.post(
        f"/api/v1/worlds/{played['id']}/runs", content=body, headers={"Content-Type": "application/json"}
    )
    assert response.status_code == 422


def test_a_run_without_what_its_learners_need_says_what(client):
    world = make_world(client)
    response = ask(client, world, learners=["meirl"])
    assert response.status_code == 422
    assert "success" in response.json()["error"]["message"]
    for _ in range(2):
        make_demonstration(client, world)
    assert ask(client, world, learners=["meirl"]).status_code == 202
    unranked = ask(client, world, learners=["irlr"])
    assert unranked.status_code == 422
    assert "order" in unranked.json()["error"]["message"]
    make_demonstration(client, world, failed=True)
    gave_up = ask(client, world, learners=["irlf"])
    assert gave_up.status_code == 422
    assert ask(client, world, learners=["irlf"], settings=QUICK | {"unfinished_failures": "include"}).status_code == 202


def test_an_order_older_than_the_newest_attempt_does_not_count(client, played):
    make_demonstration(client, played)
    stale = ask(client, played, learners=["irlr"])
    assert stale.status_code == 422
    assert "order" in stale.json()["error"]["message"]
    assert ask(client, played, learners=["meirl"]).status_code == 202


def test_runs_are_seen_by_who_asked_for_them_alone(client, other_client, played):
    run_id = ask(client, played).json()["id"]
    assert [run["id"] for run in client.get(f"/api/v1/worlds/{played['id']}/runs").json()] == [run_id]
    assert other_client.get(f"/api/v1/worlds/{played['id']}/runs").json() == []
    for path in ("", "/events", "/frames", "/comparison", "/rollouts", "/demonstrations.jsonl"):
        assert other_client.get(f"/api/v1/runs/{run_id}{path}").status_code == 404
    assert other_client.post(f"/api/v1/runs/{run_id}/cancellation").status_code == 404
