"""The worker: a process of its own that takes runs from the queue and lets the learners learn.

DBOS hands out the runs and hands them out again after a death; `steps.py` makes that harmless. Two processes must never
work under one name, so the name is locked; one that finds it taken waits, as after a web server that died and left its
worker a moment longer. There is no orderly way to stop: a worker that is told to stop dies between two steps.
"""

import logging
import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import ParamSpec, TypeVar

from dbos import DBOS, DBOSConfig, DBOSPortableJSONSerializer
from filelock import FileLock, Timeout

from app.config import Settings
from app.db import CANNOT_WRITE, WORKER_PATIENCE_MS, Database, make_engine, migrate
from app.kit.bell import Ringer, RungEvent
from app.learning import steps
from app.learning.jobs import APPLICATION, APPLICATION_VERSION, QUEUE, WEB_BELL, WORKFLOW, worker_bell
from app.learning.turns import Turns
from app.learning.upkeep import Upkeep, lock_of
from irl_core import IrlError, warm_up

logger = logging.getLogger(__name__)
P = ParamSpec("P")
T = TypeVar("T")

UPKEEP_EVERY_S = 3.0
SHOW_LIFE_EVERY_S = 1.0
LOOK_FOR_RUNS_EVERY_S = 0.5
"""Where nobody rings, as when a visitor's limit held a run back; otherwise at once. Looking costs an idle machine."""
RUNS_AT_ONCE = 16
RUNS_OF_A_VISITOR_AT_ONCE = 4
"""In all workers together: who asks for many leaves room for others."""
TRY_AGAIN_AFTER_S = 1.0
SAY_GOODBYE_WITHIN_S = 1.0
NICENESS = 10
"""Workers give way to the web server: at equal rights one doubled its median latency."""


def work(settings: Settings, *, name: str, follow_stdin: bool = False) -> None:
    """Take runs from the queue until told to stop. With `follow_stdin`, the end of standard input says so."""
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    stop = _sign_to_stop(follow_stdin=follow_stdin)
    migrate(settings)
    lock = lock_of(settings.data_dir, name)
    if not _wait_for(lock, stop):
        return
    code = 1
    try:
        _work(settings, name, stop)
        code = 0
    except Exception:
        logger.exception("%s cannot go on", name)
    finally:
        os._exit(code)  # the job engine's threads would keep a process alive that does nothing any more


def learn_now(
    database: Database, run_id: str, *, turns: Turns | None = None, tell: Callable[[], None] = lambda: None
) -> None:
    """Carry a run to its end, whatever the end is; `tell` that something was stored."""
    try:
        run = _insist(steps.begin, database, run_id)
        _learn_by_turns(database, run, turns or Turns(), tell)
        _insist(steps.finish, database, run)
    except steps.NoLongerWanted:
        logger.info("Run %s is no longer wanted", run_id)
    except (IrlError, steps.KillsWorkers) as error:
        _insist(steps.fail, database, run_id, str(error))
    except MemoryError:
        reason = "The learners ran out of memory. Try a smaller world or fewer learners."
        _insist(steps.fail, database, run_id, reason)
    except Exception as error:
        logger.exception("Run %s failed", run_id)
        reason = f"Something went wrong inside the learner ({type(error).__name__}); the server's log has the details."
        _insist(steps.fail, database, run_id, reason)
    tell()


def _learn_by_turns(database: Database, run: steps.LoadedRun, turns: Turns, tell: Callable[[], None]) -> None:
    turn = turns.join(run.visitor_id)
    try:
        for learner in run.learners:
            is_finished = False
            while not is_finished:
                with turn:
                    is_finished = _insist(steps.advance, database, run, learner, turn.give_way)
                tell()
    finally:
        turn.leave()


def _insist(step: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
    """Do a step, again and again while it is the database that cannot take it."""
    while True:
        try:
            return step(*args, **kwargs)
        except CANNOT_WRITE:
            logger.warning("The database could not take a step of a run; trying again", exc_info=True)
            time.sleep(TRY_AGAIN_AFTER_S)


def _sign_to_stop(*, follow_stdin: bool) -> threading.Event:
    stop = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stop.set())
    if follow_stdin:
        threading.Thread(target=_until_stdin_ends, args=(stop,), daemon=True).start()
    return stop


def _until_stdin_ends(stop: threading.Event) -> None:
    while os.read(sys.stdin.fileno(), 1024):  # not sys.stdin.read: its lock would hold up the interpreter's end
        pass
    stop.set()


def _wait_for(lock: FileLock, stop: threading.Event) -> bool:
    """Take the lock as soon as it is free; False when told to stop before."""
    while not stop.is_set():
        try:
            lock.acquire(timeout=0.5)
        except Timeout:
            continue
        return True
    return False


def _work(settings: Settings, name: str, stop: threading.Event) -> None:
    database = Database(settings, patience_ms=WORKER_PATIENCE_MS)
    at_work: set[str] = set()
    upkeep = Upkeep(database, name=name, data_dir=settings.data_dir, at_work=at_work)
    _warm_up(upkeep, stop)
    if not stop.is_set():
        _launch(settings, name, database, at_work)
        upkeep.say_ready()
        _keep_up(upkeep, stop)
    _say_goodbye(upkeep)


def _launch(settings: Settings, name: str, database: Database, at_work: set[str]) -> None:
    """Begin to take jobs."""
    ringer = Ringer(settings.data_dir)
    _define_workflow(database, at_work, tell=lambda: ringer.ring(WEB_BELL))
    engine = DBOS(
        config=DBOSConfig(
            name=APPLICATION,
            application_version=APPLICATION_VERSION,
            executor_id=name,
            system_database_engine=make_engine(settings.database_url, "jobs", patience_ms=WORKER_PATIENCE_MS),
            serializer=DBOSPortableJSONSerializer(),
            run_migrations=False,
            use_listen_notify=False,
            log_level="WARNING",
        )
    )
    DBOS.launch()
    DBOS.register_queue(
        QUEUE,
        worker_concurrency=RUNS_AT_ONCE,
        partition_concurrency=RUNS_OF_A_VISITOR_AT_ONCE,
        polling_interval_sec=LOOK_FOR_RUNS_EVERY_S,
    )
    _look_when_it_rings(engine, RungEvent(settings.data_dir, worker_bell(name)))


def _look_when_it_rings(engine: DBOS, bell: RungEvent) -> None:
    """Let the next look at the queue come as soon as the bell rings: the engine itself only knows to wait for a time.

    It waits by its event to stop. Should a later engine wait otherwise, the looks at intervals remain.
    """

    def wait(event: threading.Event, timeout: float | None = None) -> bool:
        if timeout is None or threading.current_thread().name != f"queue-worker-{QUEUE}":
            return threading.Event.wait(event, timeout)
        bell.wait(timeout)
        return event.is_set()

    for event in engine.background_thread_stop_events:
        event.wait = partial(wait, event)  # type: ignore[method-assign]


def _warm_up(upkeep: Upkeep, stop: threading.Event) -> None:
    """Compile what the learners use before the first run needs it: on a fresh installation that takes a while."""
    warming = threading.Thread(target=warm_up, daemon=True)
    warming.start()
    while warming.is_alive() and not stop.is_set():
        _try(upkeep.show_life)
        warming.join(SHOW_LIFE_EVERY_S)


def _define_workflow(database: Database, at_work: set[str], tell: Callable[[], None]) -> None:
    """Tell the job engine what a job is. It need not count deaths: `steps.begin` does, and knows of progress."""
    turns = Turns()

    @DBOS.workflow(name=WORKFLOW, max_recovery_attempts=None)
    def learn(run_id: str) -> None:
        at_work.add(run_id)
        try:
            learn_now(database, run_id, turns=turns, tell=tell)
        finally:
            at_work.discard(run_id)


def _keep_up(upkeep: Upkeep, stop: threading.Event) -> None:
    """See to the upkeep until told to stop."""
    while not stop.is_set():
        _try(upkeep.look_after)
        stop.wait(UPKEEP_EVERY_S)


def _say_goodbye(upkeep: Upkeep) -> None:
    goodbye = threading.Thread(target=upkeep.say_goodbye, daemon=True)
    goodbye.start()
    goodbye.join(SAY_GOODBYE_WITHIN_S)  # a locked file must not hold up the end


def _try(duty: Callable[[], None]) -> None:
    try:
        duty()
    except Exception:
        logger.exception("The upkeep could not be done; trying again")
