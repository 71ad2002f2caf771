"""What a worker looks after every few seconds beside its learning: its sign of life, and that no run is forgotten.

A worker that starts takes up what it had begun under the same name. What remains is seen to here: jobs begun by a
worker that is gone for good, jobs that slipped through this worker's fingers (a full disk at the wrong moment), and
runs whose job is over although they are not. A job left `PENDING` would hold up every later job of the same visitor.
"""

import contextlib
import logging
import os
import time
from collections.abc import Collection
from datetime import datetime, timedelta
from pathlib import Path

from dbos import DBOS
from filelock import FileLock, Timeout
from sqlalchemy import delete, select
from sqlalchemy.dialects.sqlite import insert
from sqlalchemy.orm import Session

from app.db import Database
from app.kit import clock
from app.learning import steps
from app.learning.jobs import QUEUE, WORKFLOW
from app.models import Run, Worker

logger = logging.getLogger(__name__)

OVER = ["SUCCESS", "ERROR", "CANCELLED", "MAX_RECOVERY_ATTEMPTS_EXCEEDED"]
JOBS_ARE_KEPT = timedelta(days=1)
FORGET_EVERY_S = 600.0
N_FORGOTTEN_AT_ONCE = 500
LOST = "The job of this run was lost, so it could not be finished. Please start it again."


def lock_of(data_dir: Path, name: str) -> FileLock:
    """The lock that a worker of this name holds while it lives."""
    return FileLock(data_dir / f"{name}.lock")


class Upkeep:
    """The upkeep of one worker; `at_work` are the runs it is learning at the moment."""

    def __init__(self, database: Database, *, name: str, data_dir: Path, at_work: Collection[str]) -> None:
        self._database = database
        self._name = name
        self._data_dir = data_dir
        self._at_work = at_work
        self._idle: set[str] = set()
        self._forget_next = time.monotonic()
        self._ready_at: datetime | None = None

    def look_after(self) -> None:
        """Do all of it once."""
        self.show_life()
        self._return_idle_jobs()
        self._end_lost_runs()
        if time.monotonic() >= self._forget_next:
            self._forget_old_jobs()
            self._forget_next = time.monotonic() + FORGET_EVERY_S

    def show_life(self) -> None:
        """Leave a sign of life."""
        self._database.write(self._sign)

    def say_ready(self) -> None:
        """Say that this worker takes runs from now on."""
        self._ready_at = clock.now()
        self.show_life()

    def say_goodbye(self) -> None:
        """Take the sign of life down."""
        self._database.write(lambda session: session.execute(delete(Worker).where(Worker.name == self._name)))

    def _sign(self, session: Session) -> None:
        values = {"name": self._name, "pid": os.getpid(), "seen_at": clock.now(), "ready_at": self._ready_at}
        session.execute(insert(Worker).values(values).on_conflict_do_update(index_elements=["name"], set_=values))

    def _return_idle_jobs(self) -> None:
        """Queue the begun jobs again that nobody works on."""
        begun: dict[str, set[str]] = {self._name: set()}
        for job in DBOS.list_workflows(status="PENDING", name=WORKFLOW, load_input=False, load_output=False):
            begun.setdefault(job.executor_id or self._name, set()).add(job.workflow_id)
        idle = begun.pop(self._name) - set(self._at_work)
        self._queue_again(idle & self._idle)  # seen twice: it is not just about to begin, or to say that it is done
        self._idle = idle
        for other, jobs in begun.items():
            with contextlib.suppress(Timeout), lock_of(self._data_dir, other).acquire(timeout=0):
                self._queue_again(jobs)

    def _queue_again(self, jobs: Collection[str]) -> None:
        for run_id in jobs:
            logger.warning("Nobody works on run %s; it is queued again", run_id)
            DBOS.resume_workflow(run_id, queue_name=QUEUE)

    def _end_lost_runs(self) -> None:
        """Fail the runs that are open although their job is over; one that has ended meanwhile is left as it is."""
        with self._database.read() as session:
            open_runs = session.scalars(select(Run.id).where(Run.status.in_(("queued", "running")))).all()
        if open_runs:
            lost = DBOS.list_workflows(workflow_ids=list(open_runs), status=OVER, load_input=False, load_output=False)
            for job in lost:
                steps.fail(self._database, job.workflow_id, LOST)

    def _forget_old_jobs(self) -> None:
        """Delete jobs that are long over; the runs themselves stay."""
        long_ago = (clock.now() - JOBS_ARE_KEPT).isoformat()
        old = DBOS.list_workflows(
            status=OVER, completed_before=long_ago, limit=N_FORGOTTEN_AT_ONCE, load_input=False, load_output=False
        )
        if old:
            DBOS.delete_workflows([job.workflow_id for job in old])
