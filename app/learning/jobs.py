"""The queue between the web processes, which ask, and the workers, which learn (DBOS Transact on the same database).

A run's row and its job are written in one transaction, and the run's id is the job's id: neither can exist without the
other, and asking twice is asking once. Jobs of one visitor follow each other, so that nobody waits for another's tenth.
"""

from dbos import DBOSClient, DBOSPortableJSONSerializer
from sqlalchemy.orm import Session

from app.db import WORKER_PATIENCE_MS, make_engine
from app.models import Run

APPLICATION = "irlfr"
APPLICATION_VERSION = "1"
"""Constant, so that a worker of the next release takes up what the last one left."""
QUEUE = "runs"
WORKFLOW = "learn"


class Jobs:
    """The web's side of the queue."""

    def __init__(self, database_url: str) -> None:
        self._engine = make_engine(database_url, "jobs", patience_ms=WORKER_PATIENCE_MS)
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

    def close(self) -> None:
        """Let go of the connections."""
        self._client.destroy()
        self._engine.dispose()
