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

from dbos import DBOS, DBOSConfig, DBOSPortableJSONSerializer
from filelock import FileLock
from sqlalchemy import delete, select
from sqlalchemy.dialects.sqlite import insert
from sqlalchemy.exc import OperationalError
from sqlalchemy.orm import Session

from app.config import Settings
from app.db import WORKER_PATIENCE_MS, Database, make_engine, migrate
from app.kit import clock
from app.learning import steps
from app.learning.jobs import APPLICATION, APPLICATION_VERSION, QUEUE, WORKFLOW
from app.models import Run, Worker
from irl_core import IrlError

logger = logging.getLogger(__name__)

SIGN_OF_LIFE_EVERY_S = 3.0
LOOK_FOR_RUNS_EVERY_S = 0.05
MOST_ATTEMPTS = 5
"""A run whose worker dies this often is given up: it is most likely what kills them."""
DEAD_JOB_STATUSES = ("ERROR", "CANCELLED", "MAX_RECOVERY_ATTEMPTS_EXCEEDED")
NICENESS = 10
"""Workers give way to the web server: at equal rights one doubled its median latency."""


def work(settings: Settings, *, name: str, follow_stdin: bool = False) -> None:
    """Take runs from the queue until told to stop. With `follow_stdin`, the end of standard input says so."""
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    migrate(settings)
    with FileLock(settings.data_dir / f"{name}.lock"):
        database = Database(settings, patience_ms=WORKER_PATIENCE_MS)
        _define_workflow(database)
        DBOS(
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
            QUEUE, worker_concurrency=1, partition_concurrency=1, polling_interval_sec=LOOK_FOR_RUNS_EVERY_S
        )
        _stay_alive(database, name, follow_stdin=follow_stdin)


def learn_now(database: Database, run_id: str) -> None:
    """Carry a run to its end, whatever the end is."""
    try:
        run = steps.begin(database, run_id)
        for learner in run.learners:
            while not steps.advance(database, run, learner):
                pass
        steps.finish(database, run)
    except steps.NoLongerWanted:
        logger.info("Run %s is no longer wanted", run_id)
    except IrlError as error:
        steps.fail(database, run_id, str(error))
    except MemoryError:
        steps.fail(database, run_id, "The learners ran out of memory. Try a smaller world or fewer learners.")
    except OperationalError:
        raise  # the database, not the run: the job engine tries again
    except Exception as error:
        logger.exception("Run %s failed", run_id)
        reason = f"Something went wrong inside the learner ({type(error).__name__}); the server's log has the details."
        steps.fail(database, run_id, reason)


def _define_workflow(database: Database) -> None:
    @DBOS.workflow(name=WORKFLOW, max_recovery_attempts=MOST_ATTEMPTS)
    def learn(run_id: str) -> None:
        while True:
            try:
                return learn_now(database, run_id)
            except OperationalError:
                logger.exception("The database could not take a step of run %s; trying again", run_id)
                time.sleep(1.0)


def _stay_alive(database: Database, name: str, *, follow_stdin: bool) -> None:
    """Show a sign of life every few seconds, and end runs that no job will end, until told to stop."""
    stop = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stop.set())
    if follow_stdin:
        threading.Thread(target=_until_stdin_ends, args=(stop,), daemon=True).start()
    while True:
        try:
            database.write(lambda session: _show_life(session, name))
            _end_abandoned_runs(database)
        except OperationalError:
            logger.exception("The database could not take a sign of life")
        if stop.wait(SIGN_OF_LIFE_EVERY_S):
            break
    try:
        database.write(lambda session: session.execute(delete(Worker).where(Worker.name == name)))
    finally:
        os._exit(0)


def _until_stdin_ends(stop: threading.Event) -> None:
    sys.stdin.buffer.read()
    stop.set()


def _show_life(session: Session, name: str) -> None:
    values = {"name": name, "pid": os.getpid(), "seen_at": clock.now()}
    session.execute(insert(Worker).values(values).on_conflict_do_update(index_elements=["name"], set_=values))


def _end_abandoned_runs(database: Database) -> None:
    """Fail the runs whose job is over although they are not: their workers died again and again."""
    with database.read() as session:
        open_runs = session.scalars(select(Run.id).where(Run.status.in_(("queued", "running")))).all()
    for job in DBOS.list_workflows(workflow_ids=list(open_runs), status=list(DEAD_JOB_STATUSES)) if open_runs else []:
        reason = f"The worker died in this run {MOST_ATTEMPTS} times, so it was given up."
        steps.fail(database, job.workflow_id, reason)
