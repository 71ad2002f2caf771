"""What workers see to beside learning: no run is forgotten, none is tried for ever, none hangs."""

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from datetime import timedelta
from types import SimpleNamespace

import pytest
from sqlalchemy import insert, select

from app.db import Database
from app.kit import clock
from app.kit.writer import WriterIsBusy
from app.learning import steps, supervisor, upkeep, worker
from app.learning.queries import worker_is_alive
from app.models import Run, RunEvent, Worker
from tests.app.test_learning import ask, played  # noqa: F401 - `played` is a fixture
from tests.live_server import ROOT


@pytest.fixture
def database(settings):
    opened = Database(settings)
    yield opened
    opened.close()


class FakeJobs:
    """The job engine as far as upkeep speaks to it."""

    def __init__(self, **jobs):
        self.jobs = {name: SimpleNamespace(workflow_id=name, **about) for name, about in jobs.items()}
        self.queued_again = []
        self.deleted = []

    def list_workflows(self, *, status, workflow_ids=None, **_):
        wanted = [status] if isinstance(status, str) else status
        return [
            job
            for job in self.jobs.values()
            if job.status in wanted and (workflow_ids is None or job.workflow_id in workflow_ids)
        ]

    def resume_workflow(self, workflow_id, *, queue_name):
        assert queue_name == "runs"
        self.queued_again.append(workflow_id)

    def delete_workflows(self, workflow_ids):
        self.deleted += workflow_ids


def make_upkeep(database, settings, monkeypatch, jobs, at_work=()):
    monkeypatch.setattr(upkeep, "DBOS", jobs)
    return upkeep.Upkeep(database, name="worker-1", data_dir=settings.data_dir, at_work=at_work)


def test_a_worker_that_compiles_shows_life_and_can_be_told_to_stop(database, settings, monkeypatch):
    mine = upkeep.Upkeep(database, name="worker-1", data_dir=settings.data_dir, at_work=())
    stop, compiled = threading.Event(), threading.Event()
    monkeypatch.setattr(worker, "warm_up", lambda: compiled.wait(30))
    monkeypatch.setattr(worker, "SHOW_LIFE_EVERY_S", 0.01)
    threading.Timer(0.2, stop.set).start()
    worker._warm_up(mine, stop)
    assert stop.is_set(), "it went on before everything was compiled"
    with database.read() as session:
        assert worker_is_alive(session)
    compiled.set()
    monkeypatch.setattr(worker, "warm_up", lambda: None)
    worker._warm_up(mine, threading.Event())


def test_jobs_of_a_dead_worker_are_queued_again_and_those_of_a_living_one_are_left(database, settings, monkeypatch):
    jobs = FakeJobs(
        left={"status": "PENDING", "executor_id": "worker-2"},
        held={"status": "PENDING", "executor_id": "worker-3"},
    )
    with upkeep.lock_of(settings.data_dir, "worker-3"):
        make_upkeep(database, settings, monkeypatch, jobs).look_after()
    assert jobs.queued_again == ["left"]


def test_an_own_job_that_nobody_works_on_is_queued_again_at_the_second_look(database, settings, monkeypatch):
    jobs = FakeJobs(
        idle={"status": "PENDING", "executor_id": "worker-1"},
        busy={"status": "PENDING", "executor_id": "worker-1"},
    )
    mine = make_upkeep(database, settings, monkeypatch, jobs, at_work={"busy"})
    mine.look_after()
    assert jobs.queued_again == [], "it may be about to begin"
    mine.look_after()
    assert jobs.queued_again == ["idle"]


def test_an_open_run_whose_job_is_over_fails_with_a_reason(client, played, database, settings, monkeypatch):  # noqa: F811
    run_id = ask(client, played).json()["id"]
    jobs = FakeJobs(**{run_id: {"status": "ERROR", "executor_id": "worker-1"}})
    make_upkeep(database, settings, monkeypatch, jobs).look_after()
    run = client.get(f"/api/v1/runs/{run_id}").json()
    assert (run["status"], run["reason"]) == ("failed", upkeep.LOST)


def test_a_run_that_keeps_killing_its_worker_is_given_up(client, played, database):  # noqa: F811
    run_id = ask(client, played).json()["id"]
    for _ in range(steps.MOST_VAIN_STARTS):
        steps.begin(database, run_id)
    worker.learn_now(database, run_id)
    run = client.get(f"/api/v1/runs/{run_id}").json()
    assert run["status"] == "failed"
    assert "died 5 times" in run["reason"]


def test_a_run_that_gets_on_may_be_begun_any_number_of_times(client, played, database):  # noqa: F811
    long = {"iterations": 10_000, "tolerance": 1e-12}
    run_id = ask(client, played, learners=["meirl"], settings=long).json()["id"]
    for _ in range(2 * steps.MOST_VAIN_STARTS):
        assert steps.advance(database, steps.begin(database, run_id), "meirl") is False
    assert client.get(f"/api/v1/runs/{run_id}").json()["status"] == "running"


def test_a_locked_database_is_waited_for(client, played, database, monkeypatch):  # noqa: F811
    run_id = ask(client, played).json()["id"]
    monkeypatch.setattr(worker, "TRY_AGAIN_AFTER_S", 0.0)
    write, n_refused = database.write, 0

    def refuse_some(work):
        nonlocal n_refused
        n_refused += 1
        if n_refused % 3:
            raise WriterIsBusy
        return write(work)

    monkeypatch.setattr(database, "write", refuse_some)
    worker.learn_now(database, run_id)
    assert client.get(f"/api/v1/runs/{run_id}").json()["status"] == "done"
    with database.read() as session:
        kinds = session.scalars(select(RunEvent.kind).where(RunEvent.run_id == run_id)).all()
    assert kinds.count("done") == 1


@pytest.mark.parametrize(("hours", "is_alive"), [(0, True), (-1, False), (24, False)])
def test_only_a_recent_sign_of_life_counts(database, hours, is_alive):
    seen_at = clock.now() + timedelta(hours=hours)
    database.write(lambda session: session.execute(insert(Worker).values(name="w", pid=1, seen_at=seen_at)))
    with database.read() as session:
        assert worker_is_alive(session) is is_alive


def start_worker(settings, name, **more):
    environment = os.environ | {"IRLFR_DATABASE_URL": settings.database_url, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "app.cli", "worker", "--name", name, *more.pop("options", ())]
    return subprocess.Popen(command, env=environment, cwd=settings.data_dir, **more)


def until(condition, *, within_s=120.0):
    deadline = time.monotonic() + within_s
    while not condition():
        assert time.monotonic() < deadline, "it did not happen in time"
        time.sleep(0.05)


def test_the_run_of_a_worker_that_never_comes_back_is_finished_by_another(client, played, database, settings):  # noqa: F811
    long = {"iterations": 1500, "tolerance": 1e-12}
    run_ids = [ask(client, played, learners=["irlfr"], settings=long).json()["id"] for _ in range(2)]

    def statuses():
        with database.read() as session:
            return {run.id: run.status for run in session.scalars(select(Run))}

    def n_events():
        with database.read() as session:
            return len(session.scalars(select(RunEvent.number).where(RunEvent.run_id == run_ids[0])).all())

    first = start_worker(settings, "worker-2")
    try:
        until(lambda: n_events() > 2)
    finally:
        first.send_signal(signal.SIGKILL)
        first.wait()
    assert statuses()[run_ids[0]] == "running"
    second = start_worker(settings, "worker-1")
    try:
        until(lambda: set(statuses().values()) == {"done"})
    finally:
        second.terminate()
        assert second.wait(5) == 0


def test_a_worker_that_waits_for_its_name_goes_when_its_parent_does(settings):
    with upkeep.lock_of(settings.data_dir, "worker-1"):
        waiting = start_worker(settings, "worker-1", options=["--follow-stdin"], stdin=subprocess.PIPE)
        with contextlib.suppress(subprocess.TimeoutExpired):
            waiting.wait(3)
        assert waiting.poll() is None, "it waits"
        waiting.stdin.close()
        assert waiting.wait(10) == 0


def test_a_worker_that_lived_is_started_again_at_once(settings, monkeypatch):
    """Pauses grow while a worker cannot start; after a sound life they begin anew."""
    monkeypatch.setattr(supervisor, "SHORTEST_PAUSE_S", 0.01)
    monkeypatch.setattr(supervisor, "SOUND_AFTER_S", 0.0)
    keeper = supervisor.Supervisor(settings)
    started = []

    def start(name):
        started.append(name)
        if len(started) > 8:
            keeper._stopping.set()
        return subprocess.Popen([sys.executable, "-c", ""], stdin=subprocess.PIPE)

    monkeypatch.setattr(keeper, "_start", start)
    began = time.monotonic()
    keeper._keep_running("worker-1")
    assert len(started) == 9
    assert time.monotonic() - began < 2.5
