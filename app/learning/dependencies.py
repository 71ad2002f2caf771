"""What the routes of runs ask for by type, and what the app opens for them."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Annotated
from uuid import UUID

from fastapi import Depends, FastAPI, Request

from app.config import Settings
from app.db import Database
from app.dependencies import DatabaseFromApp
from app.errors import NotFound
from app.learning import queries
from app.learning.jobs import Jobs
from app.learning.stream import Watcher
from app.models import Run
from app.visitors import VisitorOrNone


@asynccontextmanager
async def open_learning(app: FastAPI, settings: Settings, database: Database) -> AsyncIterator[None]:
    """Open the queue and the watcher for the life of the app."""
    app.state.jobs = Jobs(settings.database_url)
    app.state.watcher = Watcher(database)
    try:
        yield
    finally:
        await app.state.watcher.close()
        app.state.jobs.close()


async def get_jobs(request: Request) -> Jobs:
    """Return the queue to the workers."""
    jobs: Jobs = request.app.state.jobs
    return jobs


async def get_watcher(request: Request) -> Watcher:
    """Return the watcher of runs."""
    watcher: Watcher = request.app.state.watcher
    return watcher


def get_run(run_id: UUID, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> Run:
    """Load the run of the address, if this visitor asked for it."""
    with database.read() as session:
        run = queries.run_of(session, str(run_id), visitor_id)
    if run is None:
        message = "There is no such run here. Runs can be seen by the browser that asked for them."
        raise NotFound(message)
    return run


JobsFromApp = Annotated[Jobs, Depends(get_jobs)]
WatcherFromApp = Annotated[Watcher, Depends(get_watcher)]
RunFromPath = Annotated[Run, Depends(get_run)]
