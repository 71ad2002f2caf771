"""The web app, assembled. Reads like a table of contents."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from anyio import to_thread
from fastapi import APIRouter, FastAPI
from starlette.middleware import Middleware
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from app import docs, health
from app.comparisons import api as comparisons_api
from app.comparisons import pages as comparisons_pages
from app.config import Settings
from app.db import Database
from app.demonstrations import api as demonstrations_api
from app.demonstrations import pages as demonstrations_pages
from app.error_handlers import add_error_handlers, apologise
from app.learning import api as learning_api
from app.learning import pages as learning_pages
from app.learning import streams_api as learning_streams_api
from app.learning.dependencies import open_learning
from app.rankings import api as rankings_api
from app.rankings import pages as rankings_pages
from app.rankings.sittings import Sittings
from app.results import api as results_api
from app.results import pages as results_pages
from app.retraining import api as retraining_api
from app.retraining.dependencies import open_retraining
from app.security import CrossSiteGuard, JsonBodies, SecurityHeaders, UnexpectedErrors
from app.templating import Pages, find_folder
from app.visitors import VisitorCookie
from app.worlds import api as worlds_api
from app.worlds import pages as worlds_pages

API_ROUTERS: tuple[APIRouter, ...] = (
    worlds_api.router,
    demonstrations_api.router,
    rankings_api.router,
    learning_api.router,
    learning_streams_api.router,
    retraining_api.router,
    comparisons_api.router,
    results_api.router,
)
PAGE_ROUTERS: tuple[APIRouter, ...] = (
    worlds_pages.router,  # first: /worlds/new is no /worlds/{world_id}
    demonstrations_pages.router,
    rankings_pages.router,
    learning_pages.router,
    comparisons_pages.router,
    results_pages.router,
    docs.router,
    health.router,
)

N_THREADS = 16
"""For routes that wait on the database: more would only queue at its one writer (40 had six times the p99 of 4)."""


def create_app(settings: Settings | None = None) -> FastAPI:
    """Put the app together; its database opens with the lifespan."""
    settings = settings or Settings()
    app = FastAPI(
        title="IRLFR",
        version="1",
        summary="Play a gridworld, rank the attempts, watch algorithms learn from them.",
        lifespan=lifespan,
        middleware=middleware(settings),
        docs_url=None,
        redoc_url=None,
        separate_input_output_schemas=False,
    )
    app.state.settings = settings
    app.state.pages = Pages(allow_missing_assets=settings.allow_missing_assets)
    add_error_handlers(app)
    for router in API_ROUTERS:
        app.include_router(router, responses=docs.ERRORS)
    for router in PAGE_ROUTERS:
        app.include_router(router)
    app.mount("/static", CachedFiles(directory=find_folder("static"), check_dir=not settings.allow_missing_assets))
    return app


@asynccontextmanager
async def lifespan(app: FastAPI) -> AsyncIterator[None]:
    """Open what the routes use, and close it after the last of them."""
    settings: Settings = app.state.settings
    to_thread.current_default_thread_limiter().total_tokens = N_THREADS
    app.state.database = Database(settings)
    app.state.known_worlds = {}
    app.state.sittings = Sittings(app.state.database)
    try:
        async with open_learning(app, settings, app.state.database), open_retraining(app):
            yield
    finally:
        app.state.database.close()


def middleware(settings: Settings) -> list[Middleware]:
    """List what surrounds every request, outermost first."""
    return [
        Middleware(SecurityHeaders, https=settings.https),
        Middleware(VisitorCookie, signing_key=settings.signing_key, https=settings.https),
        Middleware(CrossSiteGuard),
        Middleware(JsonBodies, max_body_bytes=settings.max_body_bytes),
        Middleware(UnexpectedErrors, apologise=apologise),
    ]


class CachedFiles(StaticFiles):
    """Static files: those whose URL names their version are kept for good, the others asked for again each time."""

    def file_response(self, full_path, stat_result, scope: Scope, status_code: int = 200):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
        """Say how long the file may be kept."""
        response = super().file_response(full_path, stat_result, scope, status_code)
        has_version = scope["query_string"].startswith(b"v=") or "/vendor/" in scope["path"]
        response.headers["Cache-Control"] = "public, max-age=31536000, immutable" if has_version else "no-cache"
        return response
