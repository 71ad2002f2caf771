"""Several runs of one worker: turns that are fair between visitors, bells that wake, a worker that says it is ready."""

import asyncio
import socket
import threading
from types import SimpleNamespace

import pytest

from app.db import Database
from app.kit.bell import Bell, Ringer, RungEvent
from app.learning import steps, turns, worker
from app.learning.presets import PRESETS
from app.learning.queries import worker_state
from app.learning.turns import Turns
from app.learning.upkeep import Upkeep
from irl_core import LEARNERS, Settings
from tests.app.test_learning import ask, played  # noqa: F401 - `played` is a fixture
from tests.awaited import awaited
from tests.factories import make_demonstration


@pytest.fixture
def database(settings):
    opened = Database(settings)
    yield opened
    opened.close()


class Queue:
    """Threads that wait for their turn one by one while the first has it, and the order in which they get it."""

    def __init__(self, shared):
        self.shared = shared
        self.order = []
        self.threads = []

    def wait_for_turn(self, name, turn):
        def take():
            with turn:
                self.order.append(name)

        self.threads.append(threading.Thread(target=take))
        self.threads[-1].start()
        while len(self.shared._waiting) < len(self.threads):
            pass

    def finish(self):
        for thread in self.threads:
            thread.join()
        return self.order


def test_who_has_had_least_goes_next_and_a_newcomer_has_a_head_start():
    shared = Turns()
    old, other = shared.join("old"), shared.join("other")
    shared._had_s.update(old=100.0, other=90.0)
    newcomer = shared.join("new")
    assert shared._had_s["new"] == 90.0 - turns.HEAD_START_S
    queue = Queue(shared)
    with other:
        for name, turn in {"old": old, "new": newcomer}.items():
            queue.wait_for_turn(name, turn)
        assert shared.is_anybody_before(other), "the newcomer ought to go first"
    assert queue.finish() == ["new", "old"]


def test_runs_of_one_visitor_share_what_the_visitor_gets():
    shared = Turns()
    mine = [shared.join("me") for _ in range(3)]
    yours = shared.join("you")
    shared._had_s.update(me=3.0, you=2.0)
    queue = Queue(shared)
    with mine[0]:
        queue.wait_for_turn("mine", mine[1])
        queue.wait_for_turn("yours", yours)
    assert queue.finish() == ["yours", "mine"]
    for turn in (*mine, yours):
        turn.leave()
    assert not shared._had_s, "nothing is remembered of who has left"


def test_nobody_waits_for_ever(monkeypatch):
    monkeypatch.setattr(turns, "LONGEST_WAIT_S", 0.0)
    shared = Turns()
    greedy, modest, third = shared.join("greedy"), shared.join("modest"), shared.join("third")
    shared._had_s.update(greedy=1000.0, modest=0.0, third=0.0)
    queue = Queue(shared)
    with third:
        shared._had_s["third"] = 5000.0
        queue.wait_for_turn("greedy", greedy)
    assert queue.finish() == ["greedy"]
    with modest:
        later = Queue(shared)
        later.wait_for_turn("greedy", greedy)
        assert shared.is_anybody_before(modest), "who has waited long goes before who has had less"
    assert later.finish() == ["greedy"]


def test_runs_that_take_turns_come_to_what_they_come_to_alone(client, other_client, played, database):  # noqa: F811
    alone = ask(client, played, learners=["meirl", "irlfr"]).json()["id"]
    worker.learn_now(database, alone)
    make_demonstration(other_client, played)
    run_ids = [ask(client, played, learners=["meirl", "irlfr"]).json()["id"] for _ in range(2)]
    shared = Turns()
    threads = [
        threading.Thread(target=worker.learn_now, args=(database, run_id), kwargs={"turns": shared})
        for run_id in run_ids
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    results = [client.get(f"/api/v1/runs/{run_id}").json()["learners"] for run_id in (alone, *run_ids)]
    assert results[0] == results[1] == results[2], "to the last bit"


def test_a_learner_gives_way_in_the_midst_of_a_step(client, played, database):  # noqa: F811
    run_id = ask(client, played, learners=["meirl"]).json()["id"]
    run = steps.begin(database, run_id)
    asked = []
    assert steps.advance(database, run, "meirl") is False
    steps.advance(database, run, "meirl", lambda: asked.append(1))
    assert asked


def test_a_bell_wakes_who_waits_and_an_earlier_ring_is_not_lost(settings):
    ringer = Ringer(settings.data_dir)
    ringer.ring("*")  # nobody is there: nothing happens
    for number, nowhere in enumerate(("no port", "99999", "-1", "")):
        (settings.data_dir / f"dead-{number}.bell").write_text(nowhere)

    async def hear():
        bell = Bell(settings.data_dir, "web")
        ringer.ring("web")
        ringer.ring("web")
        await asyncio.wait_for(bell.wait(), 30)
        with pytest.raises(TimeoutError):
            await asyncio.wait_for(bell.wait(), 0.01)
        bell.close()

    awaited(hear())
    assert not (settings.data_dir / "web.bell").exists()
    rung = RungEvent(settings.data_dir, "worker-1.worker")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
        port = int((settings.data_dir / "worker-1.worker.bell").read_text())
        for junk in (b"", b"x" * 2000):
            stranger.sendto(junk, ("127.0.0.1", port))
    for _ in range(2):  # a stranger's knock is a ring like any other, and the bell hears on
        rung._event.wait()
        rung._event.clear()
        ringer.ring("*")
    rung.wait(30)
    ringer.close()


def test_the_wait_of_the_job_engine_ends_when_it_rings(settings):
    stop = threading.Event()
    bell, ringer = RungEvent(settings.data_dir, "worker-1.worker"), Ringer(settings.data_dir)
    worker._look_when_it_rings(SimpleNamespace(background_thread_stop_events=[stop]), bell)  # type: ignore[arg-type]
    answers = []
    looking = threading.Thread(target=lambda: answers.append(stop.wait(timeout=60)), name="queue-worker-runs")
    looking.start()
    ringer.ring("*")
    looking.join(30)
    assert answers == [False], "it looks, and is not told to stop"
    assert stop.wait(timeout=0.01) is False, "other threads of the engine wait as ever"
    ringer.close()


def test_a_worker_is_missing_then_warming_then_ready(database, settings):
    mine = Upkeep(database, name="worker-1", data_dir=settings.data_dir, at_work=())
    states = []
    for step in (lambda: None, mine.show_life, mine.say_ready, mine.show_life, mine.say_goodbye):
        step()
        with database.read() as session:
            states.append(worker_state(session))
    assert states == ["none", "warming", "ready", "ready", "none"]


def test_presets_name_learners_and_settings_that_exist():
    assert [preset["name"] for preset in PRESETS] == ["recommended", "paper", "model-free"]
    for preset in PRESETS:
        assert set(preset["learners"]) <= set(LEARNERS)
        Settings.from_json(preset["settings"])
