"""What `irlfr doctor` looks at. Each check says what it found and, where something is wrong, what to do."""

import platform
import shutil
from collections.abc import Iterator
from dataclasses import dataclass

import httpx
import sqlalchemy as sa
from sqlalchemy.exc import SQLAlchemyError

from app.config import Settings
from app.db import SOUND_SQLITE, SQLITE, Database, pending_migrations
from app.learning.queries import worker_is_alive
from app.templating import MissingAssets, Pages

ENOUGH_DISK_BYTES = 200 * 2**20
ANSWER_WITHIN_S = 5.0


@dataclass(frozen=True, slots=True)
class Check:
    """One finding."""

    name: str
    is_well: bool
    found: str
    remedy: str | None = None


def checks(settings: Settings) -> Iterator[Check]:
    """Look at one thing after the other; each next one may rely on those before."""
    yield Check("Python", is_well=True, found=platform.python_version())
    yield _sqlite()
    yield _disk(settings)
    yield _assets()
    if not settings.database_path.exists():
        remedy = "`irlfr serve` makes it; or set IRLFR_DATABASE_URL to the one you mean."
        yield Check("database", is_well=False, found=f"there is no file {settings.database_path}", remedy=remedy)
        return
    yield from _database(settings)
    yield _server(settings)


def _sqlite() -> Check:
    version = tuple(int(part) for part in SQLITE.sqlite_version.split("."))
    if version >= SOUND_SQLITE:
        return Check("SQLite", is_well=True, found=SQLITE.sqlite_version)
    remedy = (
        f"Use a Python built with SQLite {'.'.join(map(str, SOUND_SQLITE))} or newer: older ones can damage a WAL file."
    )
    return Check("SQLite", is_well=False, found=SQLITE.sqlite_version, remedy=remedy)


def _disk(settings: Settings) -> Check:
    folder = settings.data_dir
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    free = shutil.disk_usage(folder).free
    found = f"{free / 2**30:.1f} GiB free at {folder.resolve()}"
    if free >= ENOUGH_DISK_BYTES:
        return Check("disk", is_well=True, found=found)
    return Check("disk", is_well=False, found=found, remedy="Make room, or move the database by IRLFR_DATABASE_URL.")


def _assets() -> Check:
    try:
        packages = Pages().vendor["packages"]
    except MissingAssets as error:
        return Check("browser packages", is_well=False, found="missing", remedy=str(error))
    return Check("browser packages", is_well=True, found=", ".join(f"{n} {p['version']}" for n, p in packages.items()))


def _database(settings: Settings) -> Iterator[Check]:
    database = Database(settings)
    try:
        with database.read() as session:
            verdict = session.scalar(sa.text("PRAGMA quick_check(1)"))
        is_well = verdict == "ok"
        remedy = None if is_well else "Stop the server and restore the file from a backup."
        yield Check("database", is_well=is_well, found=f"{settings.database_path}: {verdict}", remedy=remedy)
        pending = pending_migrations(settings)
        remedy = "`irlfr serve` brings it up to date." if pending else None
        yield Check("layout", is_well=not pending, found=f"{len(pending)} migrations to do", remedy=remedy)
        if not pending:
            yield _worker(database)
    except SQLAlchemyError as error:
        remedy = "See that the file and its folder belong to you and that the disk is not full."
        yield Check("database", is_well=False, found=f"cannot be read: {error.__cause__ or error}", remedy=remedy)
    finally:
        database.close()


def _server(settings: Settings) -> Check:
    address = f"http://{settings.host}:{settings.port}"
    try:
        answer = httpx.get(f"{address}/readyz", timeout=ANSWER_WITHIN_S, trust_env=False)
    except httpx.HTTPError as error:
        remedy = "Start it: `irlfr serve`; or set IRLFR_HOST and IRLFR_PORT to where it listens."
        return Check(
            "server", is_well=False, found=f"{address} does not answer ({type(error).__name__})", remedy=remedy
        )
    if answer.status_code == httpx.codes.OK:
        return Check("server", is_well=True, found=f"{address} is ready")
    remedy = "Another program may listen there, or the server's log says what it lacks."
    return Check("server", is_well=False, found=f"{address} answers {answer.status_code}", remedy=remedy)


def _worker(database: Database) -> Check:
    with database.read() as session:
        is_alive = worker_is_alive(session)
    if is_alive:
        return Check("worker", is_well=True, found="alive")
    return Check(
        "worker", is_well=False, found="no sign of life", remedy="Start one: `irlfr serve`, or `irlfr worker`."
    )
