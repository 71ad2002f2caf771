"""The queue between the web processes, which ask, and the workers, which learn (DBOS Transact on the same database).

A run's row and its job are written in one transaction, and the run's id is the job's id: neither can exist without the
other, and asking twice is asking once. A visitor has a few jobs under way at once and no more, so
that nobody waits for another's tenth.
"""

from dbos import DBOSClient, DBOSPortableJSONSerializer
from sqlalchemy.orm import Session

from app.config import Settings
from app.db import WORKER_PATIENCE_MS, make_engine
from app.kit.bell import Ringer
from app.models import Run

APPLICATION = "irlfr"
APPLICATION_VERSION = "1"
"""Constant, so that a worker of the next release takes up what the last one left."""
QUEUE = "runs"
WORKFLOW = "learn"
WEB_BELL = "web"
"""Rings when a worker has stored something that a stream may wait for."""
WORKER_BELLS = "*.worker"
"""Ring when there is a run to take up."""


def worker_bell(name: str) -> str:
    """The bell of the worker of this name."""
    return WORKER_BELLS.replace("*", name)


class Jobs:
    """The web's side of the queue."""

    def __init__(self, settings: Settings) -> None:
        self._engine = make_engine(settings.database_url, "jobs", patience_ms=WORKER_PATIENCE_MS)
        self._ringer = Ringer(settings.data_dir)
        self._client = DBOSClient(
            system_database_engine=self._engine,
            serializer=DBOSPortableJSONSerializer(),
            application_name=APPLICATION,
            lazy=True,
        )

    def enqueue(self, session: Session, run: Run) -> None:
        """Ask a worker for `run`, in the transaction that stores it."""
        self._client.enqueue_in_transaction(
            session,
            {
                "workflow_name": WORKFLOW,
                "queue_name": QUEUE,
                "workflow_id": run.id,
                "app_version": APPLICATION_VERSION,
                "queue_partition_key": run.visitor_id,
            },
            run.id,
        )

    def wake(self) -> None:
        """Let idle workers look at the queue at once: what was asked for is stored."""
        self._ringer.ring(WORKER_BELLS)

    def close(self) -> None:
        """Let go of the connections."""
        self._ringer.close()
        self._client.destroy()
        self._engine.dispose()
