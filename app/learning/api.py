"""Runs as JSON and as a stream."""

from typing import Annotated

from anyio import to_thread
from fastapi import APIRouter, Header, Response
from fastapi.responses import PlainTextResponse, StreamingResponse
from sqlalchemy.orm import Session

from app.db import Database
from app.dependencies import DatabaseFromApp
from app.learning import queries, service, sharing
from app.learning.convert import to_out
from app.learning.dependencies import JobsFromApp, OwnRunFromPath, RunFromPath, WatcherFromApp
from app.learning.export import demonstration_file
from app.learning.schemas import RunIn, RunOut, ShareOut
from app.models import Run, RunShare
from app.visitors import Visitor, VisitorOrNone, remember
from app.worlds.dependencies import WorldFromPath

router = APIRouter(prefix="/api/v1", tags=["runs"])

STREAM_HEADERS = {"Cache-Control": "no-cache, no-transform", "X-Accel-Buffering": "no"}


@router.post("/worlds/{world_id}/runs", status_code=202, summary="Ask for a run")
def ask(
    world: WorldFromPath, asked: RunIn, database: DatabaseFromApp, jobs: JobsFromApp, visitor_id: Visitor
) -> RunOut:
    """Queue a run of your demonstrations and rankings of this world as they are now."""

    def store(session: Session) -> Run:
        remember(session, visitor_id)
        return service.learn_later(session, jobs, world=world, visitor_id=visitor_id, asked=asked)

    return to_out(database.write(store), {})


@router.get("/worlds/{world_id}/runs", summary="List your runs of a world")
def list_runs(world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> list[RunOut]:
    """List your runs of this world, oldest first."""
    with database.read() as session:
        runs = queries.runs_of(session, visitor_id, world.id)
        results = queries.results(session, [run.id for run in runs])
    return [to_out(run, results[run.id]) for run in runs]


@router.get("/runs/{run_id}", summary="Show a run")
def show(run: RunFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> RunOut:
    """Show a run: its status, and what each learner has come to."""
    with database.read() as session:
        return to_out(run, queries.results(session, [run.id])[run.id], is_own=run.visitor_id == visitor_id)


@router.get("/runs/{run_id}/events", summary="Follow a run", response_class=StreamingResponse)
async def follow(
    run: RunFromPath,
    database: DatabaseFromApp,
    watcher: WatcherFromApp,
    last_event_id: Annotated[int, Header(ge=0, le=2**62, description="Resume after this event.")] = 0,
) -> Response:
    """Stream a run as Server-Sent Events: `frame`, `learner`, and last `done` or `failed`; `id` counts from 1.

    A browser that already has the last event gets 204, which ends its reconnecting.
    """
    if run.status in queries.ENDED and last_event_id >= await to_thread.run_sync(newest_event, database, run.id):
        return Response(status_code=204)
    return StreamingResponse(
        watcher.stream(run.id, last_event_id), media_type="text/event-stream", headers=STREAM_HEADERS
    )


@router.post("/runs/{run_id}/cancellation", status_code=202, summary="Cancel a run")
def cancel(run: OwnRunFromPath, database: DatabaseFromApp) -> RunOut:
    """Cancel a run that has not ended."""
    database.write(lambda session: service.cancel(session, run.id))
    with database.read() as session:
        results = queries.results(session, [run.id])
        return to_out(session.get_one(Run, run.id), results[run.id])


@router.post("/runs/{run_id}/shares", status_code=201, summary="Share a run")
def share(run: OwnRunFromPath, database: DatabaseFromApp) -> ShareOut:
    """Make a link that opens this run, its comparison and what it learned from to whoever has it."""
    return share_out(database.write(lambda session: sharing.share(session, run.id)))


@router.get("/runs/{run_id}/shares", summary="List the links to a run")
def list_shares(run: OwnRunFromPath, database: DatabaseFromApp) -> list[ShareOut]:
    """List the links that open this run."""
    with database.read() as session:
        return [share_out(one) for one in sharing.keys_of(session, run.id)]


@router.delete("/runs/{run_id}/shares/{key}", status_code=204, summary="Revoke a link to a run")
def revoke_share(run: OwnRunFromPath, key: str, database: DatabaseFromApp) -> None:
    """Close this run again to those who have the link."""
    database.write(lambda session: sharing.revoke(session, run.id, key))


@router.get("/runs/{run_id}/demonstrations.jsonl", summary="Take a run's demonstrations away")
def export(run: RunFromPath, database: DatabaseFromApp) -> PlainTextResponse:
    """Download the world, demonstrations and rankings that a run learned from, for `irlfr learn`."""
    with database.read() as session:
        text = demonstration_file(session, run)
    name = f"irlfr-{run.id[:8]}.jsonl"
    return PlainTextResponse(
        text, media_type="application/jsonl", headers={"Content-Disposition": f'attachment; filename="{name}"'}
    )


def share_out(share: RunShare) -> ShareOut:
    """Show a link."""
    address = f"/runs/{share.run_id}/comparison?key={share.key}"
    return ShareOut(key=share.key, address=address, created_at=share.created_at)


def newest_event(database: Database, run_id: str) -> int:
    """Return the number of a run's newest event, 0 if it has none."""
    with database.read() as session:
        return queries.last_event_numbers(session, [run_id]).get(run_id, 0)
