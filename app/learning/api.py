"""Runs as JSON; their streams are in `streams_api.py`."""

from fastapi import APIRouter
from fastapi.responses import PlainTextResponse
from sqlalchemy.orm import Session

from app.db import Database
from app.dependencies import DatabaseFromApp
from app.learning import queries, service, sharing
from app.learning.convert import runs_out, to_out
from app.learning.dependencies import JobsFromApp, OwnRunFromPath, RunFromPath
from app.learning.export import demonstration_file
from app.learning.schemas import RunIn, RunOut, ShareOut
from app.models import Run, RunShare
from app.visitors import Visitor, VisitorOrNone, remember
from app.worlds.dependencies import WorldFromPath

router = APIRouter(prefix="/api/v1", tags=["runs"])


@router.post("/worlds/{world_id}/runs", status_code=202, summary="Ask for a run")
def ask(
    world: WorldFromPath, asked: RunIn, database: DatabaseFromApp, jobs: JobsFromApp, visitor_id: Visitor
) -> RunOut:
    """Queue a run of your demonstrations and rankings of this world as they are now."""

    def store(session: Session) -> Run:
        remember(session, visitor_id)
        return service.learn_later(session, jobs, world=world, visitor_id=visitor_id, asked=asked)

    run = database.write(store)
    jobs.wake()
    return shown(database, run, is_own=True)


@router.get("/worlds/{world_id}/runs", summary="List your runs of a world")
def list_runs(world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> list[RunOut]:
    """List your runs of this world, oldest first."""
    with database.read() as session:
        runs = queries.runs_of(session, visitor_id, world.id)
        return runs_out(session, runs)


@router.get("/runs/{run_id}", summary="Show a run")
def show(run: RunFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> RunOut:
    """Show a run: its status, and what each learner has come to."""
    return shown(database, run, is_own=run.visitor_id == visitor_id)


@router.delete("/runs/{run_id}", status_code=204, summary="Delete a run")
def delete(run: OwnRunFromPath, database: DatabaseFromApp) -> None:
    """Delete a run with its results and links; one that has not ended is cancelled by it. Attempts and orders stay."""
    database.write(lambda session: service.delete(session, run.id))


@router.post("/runs/{run_id}/cancellation", status_code=202, summary="Cancel a run")
def cancel(run: OwnRunFromPath, database: DatabaseFromApp) -> RunOut:
    """Cancel a run that has not ended."""
    database.write(lambda session: service.cancel(session, run.id))
    with database.read() as session:
        return to_out(session, session.get_one(Run, run.id))


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


def shown(database: Database, run: Run, *, is_own: bool) -> RunOut:
    """Show a run as it stands."""
    with database.read() as session:
        return to_out(session, run, is_own=is_own)


def share_out(share: RunShare) -> ShareOut:
    """Show a link."""
    address = f"/runs/{share.run_id}/comparison?key={share.key}"
    return ShareOut(key=share.key, address=address, created_at=share.created_at)
