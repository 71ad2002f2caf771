"""What the routes of runs ask for by type, and what the app opens for them."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Annotated
from uuid import UUID

from fastapi import Depends, FastAPI, Query, Request
from sqlalchemy.orm import Session

from app.config import Settings
from app.db import Database
from app.dependencies import DatabaseFromApp
from app.errors import NotFound
from app.kit.bell import Bell
from app.learning.jobs import WEB_BELL, Jobs
from app.learning.sharing import opens
from app.learning.watcher import Watcher
from app.models import Run
from app.visitors import VisitorOrNone


@asynccontextmanager
async def open_learning(app: FastAPI, settings: Settings, database: Database) -> AsyncIterator[None]:
    """Open the queue and the watcher for the life of the app."""
    bell = Bell(settings.data_dir, WEB_BELL)
    app.state.jobs = Jobs(settings)
    app.state.watcher = Watcher(database, bell)
    try:
        yield
    finally:
        await app.state.watcher.close()
        app.state.jobs.close()
        bell.close()


async def get_jobs(request: Request) -> Jobs:
    """Return the queue to the workers."""
    jobs: Jobs = request.app.state.jobs
    return jobs


async def get_watcher(request: Request) -> Watcher:
    """Return the watcher of runs."""
    watcher: Watcher = request.app.state.watcher
    return watcher


MOST_RUNS = 20
"""As many as one stream follows."""

ShareKey = Annotated[
    str | None,
    Query(alias="key", description="The key of a link by which the run was shared, for who does not own it."),
]


def get_run(run_id: UUID, database: DatabaseFromApp, visitor_id: VisitorOrNone, key: ShareKey = None) -> Run:
    """Load the run of the address, if this visitor asked for it or came by a link that opens it."""
    with database.read() as session:
        return find_run(session, str(run_id), visitor_id, key)


def get_own_run(run_id: UUID, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> Run:
    """Load the run of the address, if this visitor asked for it: for what changes it or gives it away."""
    with database.read() as session:
        return find_run(session, str(run_id), visitor_id, None)


def find_run(session: Session, run_id: str, visitor_id: str | None, key: str | None) -> Run:
    """Find a run that this visitor may see. Raises NotFound, which tells nothing of runs that are not theirs."""
    run = session.get(Run, run_id)
    if run is not None and (run.visitor_id == visitor_id or (key is not None and opens(session, key, run_id))):
        return run
    message = (
        "There is no such run here. Runs can be seen by the browser that asked for them, or by a link it shared and has"
        " not taken back."
    )
    raise NotFound(message)


def get_runs(
    run: Annotated[list[UUID], Query(min_length=1, max_length=MOST_RUNS, description="The runs; may repeat.")],
    database: DatabaseFromApp,
    visitor_id: VisitorOrNone,
    key: ShareKey = None,
) -> list[Run]:
    """Load the runs that the address names, each once; one that this visitor may not see is not found."""
    with database.read() as session:
        return [find_run(session, run_id, visitor_id, key) for run_id in dict.fromkeys(map(str, run))]


JobsFromApp = Annotated[Jobs, Depends(get_jobs)]
WatcherFromApp = Annotated[Watcher, Depends(get_watcher)]
RunFromPath = Annotated[Run, Depends(get_run)]
"""A run to look at: its owner's, or opened by the key of a shared link."""
RunsFromQuery = Annotated[list[Run], Depends(get_runs)]
OwnRunFromPath = Annotated[Run, Depends(get_own_run)]
"""A run to change: its owner's alone."""
