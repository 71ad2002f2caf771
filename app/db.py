"""The database: SQLite, one file, one writer, any number of readers.

What the server has acknowledged survives a power cut: the writing connections run with `synchronous=FULL`, and every
transaction that writes begins IMMEDIATE (a deferred one that starts to write later fails at once when another holds the
lock, whatever the timeout). Readers are barred from writing.
"""

import asyncio
import sqlite3
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any, Literal, TypeAlias, TypeVar

import sqlalchemy as sa
from alembic import command
from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory
from filelock import FileLock
from sqlalchemy import Connection, Engine, event
from sqlalchemy.exc import OperationalError
from sqlalchemy.orm import Session

from app.config import Settings
from app.kit.writer import Writer, WriterIsBusy

if sys.platform == "linux":
    import pysqlite3

    SQLITE: ModuleType = pysqlite3
else:
    SQLITE = sqlite3
"""The one SQLite library of this process. Two of them on one file undo each other's locks (POSIX drops all locks of a
process on a file when any descriptor of it is closed) and so destroy the file: nothing here may open it by another."""

T = TypeVar("T")

SOUND_SQLITE = (3, 51, 3)
"""Older libraries can damage a WAL file when it is reset (fixed in 3.51.3, and in 3.50.7 and 3.44.6)."""

CANNOT_WRITE = (OperationalError, WriterIsBusy)
"""What says that the database, not the request, is the reason: the same again a little later may succeed."""

WEB_PATIENCE_MS = 3_000
"""How long a web request waits for the write lock before it is told to come back."""
WORKER_PATIENCE_MS = 30_000
"""How long a background step waits: nobody is holding the line."""


class Database:
    """The open database of one process."""

    def __init__(self, settings: Settings, *, patience_ms: int = WEB_PATIENCE_MS) -> None:
        settings.data_dir.mkdir(parents=True, exist_ok=True)
        self.url = settings.database_url
        self._readers = make_engine(self.url, "read", patience_ms=patience_ms)
        self._writers = make_engine(self.url, "write", patience_ms=patience_ms)
        self._writer = Writer(self._writers, queue_length=settings.write_queue_length)

    @contextmanager
    def read(self) -> Iterator[Session]:
        """Open a session on one consistent state of the data; writing in it is an error."""
        with Session(self._readers, expire_on_commit=False) as session:
            yield session

    def write(self, work: Callable[[Session], T]) -> T:
        """Do `work(session)` in the writer; when this returns, what it did is on the disk.

        Raises whatever the work raised (and nothing of it is stored), or one of CANNOT_WRITE when too much is waiting
        or the file is locked, full or gone.
        """
        return self._writer.run(work)

    async def write_soon(self, work: Callable[[Session], T]) -> T:
        """Do the same as `write` without holding a thread: for the path that many take at once."""
        return await asyncio.wrap_future(self._writer.submit(work))

    def close(self) -> None:
        """Finish the writes that were accepted, then close every connection."""
        self._writer.close()
        self._writers.dispose()
        self._readers.dispose()


Access: TypeAlias = Literal["read", "write", "jobs"]


def make_engine(url: str, access: Access, *, patience_ms: int = WEB_PATIENCE_MS) -> Engine:
    """Return an engine whose connections hold the promises at the head of this module.

    The job engine ("jobs") mixes reads and writes in its transactions: the driver begins one, IMMEDIATE, at the first
    write, so that its many polls take no lock.
    """
    engine = sa.create_engine(url, module=SQLITE, pool_size=20, max_overflow=0, pool_timeout=10)

    @event.listens_for(engine, "connect")
    def set_up(connection: Any, _: object) -> None:  # noqa: ANN401 - the driver's own connection
        connection.isolation_level = "IMMEDIATE" if access == "jobs" else None
        for pragma in (
            f"busy_timeout={patience_ms}",
            "journal_mode=WAL",
            "synchronous=FULL",
            "foreign_keys=ON",
            f"journal_size_limit={64 * 2**20}",
            f"query_only={'ON' if access == 'read' else 'OFF'}",
        ):
            connection.execute(f"PRAGMA {pragma}")

    if access != "jobs":

        @event.listens_for(engine, "begin")
        def begin(connection: Connection) -> None:
            connection.exec_driver_sql("BEGIN" if access == "read" else "BEGIN IMMEDIATE")

    return engine


def migrate(settings: Settings) -> None:
    """Bring the file to the newest layout: our tables by Alembic, then the job engine's own."""
    settings.data_dir.mkdir(parents=True, exist_ok=True)
    with FileLock(settings.data_dir / "migration.lock"):  # two processes that start at once take turns
        command.upgrade(_alembic(settings), "head")
        _migrate_job_engine(settings)


def _migrate_job_engine(settings: Settings) -> None:
    """Do what `DBOS.migrate` does, on our own SQLite library: see `SQLITE`."""
    from dbos import DBOSPortableJSONSerializer  # noqa: PLC0415 - half a second of import that readers do not need
    from dbos._sys_db import SystemDatabase  # noqa: PLC0415 - there is no public way to migrate with an engine of ours

    engine = make_engine(settings.database_url, "jobs")
    SystemDatabase.create(
        system_database_url=settings.database_url,
        engine_kwargs={},
        engine=engine,
        schema=None,
        serializer=DBOSPortableJSONSerializer(),
        executor_id=None,
        use_listen_notify=False,
    ).run_migrations()
    engine.dispose()


def pending_migrations(settings: Settings) -> list[str]:
    """List the revisions that the file has yet to go through."""
    scripts = ScriptDirectory.from_config(_alembic(settings))
    engine = make_engine(settings.database_url, "read")
    with engine.connect() as connection:
        done = MigrationContext.configure(connection).get_current_revision()
    engine.dispose()
    return [script.revision for script in scripts.iterate_revisions("head", done or "base")]


def _alembic(settings: Settings) -> Config:
    config = Config()
    config.set_main_option("script_location", str(_migrations_dir()))
    config.attributes["url"] = settings.database_url
    return config


def _migrations_dir() -> Path:
    """Find the migrations: inside the package in an installed wheel, beside it in a checkout."""
    package = Path(__file__).parent
    inside = package / "migrations"
    return inside if inside.is_dir() else package.parent / "migrations"
