"""Rankings, and the sittings in which they come to be, as JSON."""

from collections.abc import Iterator
from typing import Annotated
from uuid import UUID

from fastapi import APIRouter, Depends, Request
from fastapi.responses import StreamingResponse

from app.dependencies import DatabaseFromApp
from app.rankings import agreement, convert, event_export, exports, queries, service
from app.rankings.content import Outcome
from app.rankings.schemas import AgreementOut, EventsIn, LogOut, RankingIn, RankingOut, RankingsOut
from app.rankings.sittings import Sittings, Whose
from app.visitors import VisitorOrNone
from app.worlds.convert import StoredWorld
from app.worlds.dependencies import WorldFromPath

router = APIRouter(prefix="/api/v1", tags=["rankings"])


async def get_sittings(request: Request) -> Sittings:
    """Return the logs that the lifespan opened."""
    sittings: Sittings = request.app.state.sittings
    return sittings


SittingsFromApp = Annotated[Sittings, Depends(get_sittings)]


@router.post("/worlds/{world_id}/sittings/{sitting_id}/events", summary="Log how an order comes to be")
def log_events(
    world: WorldFromPath,
    sitting_id: UUID,
    body: EventsIn,
    sittings: SittingsFromApp,
    visitor_id: VisitorOrNone,
) -> LogOut:
    """Append events to a sitting: one person's work on the orders of this world, under an id that the client made.

    The first event is `begin`. Events that are stored already may be sent again; another one under the number of a
    stored one is refused (409), as is one that leaves a gap (409 `log_gap`: `fields.n_events` says where to go on) and
    one that cannot have happened after those before it (422, naming its number). Nothing of a refused body is stored.
    """
    n_events = service.log(sittings, Whose(visitor_id, world.id), str(sitting_id), body.events)
    return LogOut(id=str(sitting_id), n_events=n_events)


@router.put("/worlds/{world_id}/rankings/{outcome}", summary="Confirm an order")
def confirm_ranking(
    world: WorldFromPath,
    outcome: Outcome,
    body: RankingIn,
    sittings: SittingsFromApp,
    visitor_id: VisitorOrNone,
) -> RankingOut:
    """Store an order of exactly the successes, or failures, that you have kept in this world.

    Each confirmed order is a version of its own; none is overwritten and the newest counts. With a `sitting` the order
    must be the one its events lead to, and the same confirmation sent again gives the version it gave at first. Refused
    with 409: `new_attempts` (`fields.missing` names those that came meanwhile) and, where `based_on` is told,
    `stale_version` (`fields.version` is the one that counts by now).
    """
    ranking, counts = service.confirm(sittings, Whose(visitor_id, world.id), outcome, body)
    return convert.ranking_out(ranking, counts=counts)


@router.get("/worlds/{world_id}/rankings", summary="Show your orders")
def show_rankings(world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> RankingsOut:
    """Show the newest order of each outcome that you have confirmed in this world."""
    with database.read() as session:
        return convert.rankings_out(queries.newest(session, visitor_id, world.id))


@router.get("/worlds/{world_id}/rankings/{outcome}/versions", summary="List the versions of an order")
def list_versions(
    world: WorldFromPath, outcome: Outcome, database: DatabaseFromApp, visitor_id: VisitorOrNone
) -> list[RankingOut]:
    """List every version of an order that you have confirmed in this world, newest first; `counts` marks that one."""
    with database.read() as session:
        return convert.versions_out(queries.versions(session, visitor_id, world.id, outcome))


@router.get("/worlds/{world_id}/rankings/{outcome}/agreement", summary="Compare an order with the totals")
def show_agreement(
    request: Request, world: WorldFromPath, outcome: Outcome, database: DatabaseFromApp, visitor_id: VisitorOrNone
) -> AgreementOut:
    """Compare the newest version of your order with the true totals, by Kendall's τ-b, and name the swapped pairs.

    403 `not_shown` where the study keeps that back.
    """
    is_shown = request.app.state.settings.show_agreement
    with database.read() as session:
        return agreement.of_the_newest(session, visitor_id, world.id, outcome, is_shown=is_shown)


@router.get(
    "/worlds/{world_id}/rankings.csv",
    summary="Take your orders away",
    response_class=StreamingResponse,
    responses={200: {"content": {"text/csv": {}}, "description": "The table, with a header row."}},
)
def export_rankings(world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> StreamingResponse:
    """Download every version as a table with a row for each attempt; docs/codebook.md explains its columns."""
    return _csv(exports.rankings_csv(database, visitor_id, world), world, "rankings.csv")


@router.get(
    "/worlds/{world_id}/ranking-events.csv",
    summary="Take away how your orders came to be",
    response_class=StreamingResponse,
    responses={200: {"content": {"text/csv": {}}, "description": "The table, with a header row."}},
)
def export_events(world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> StreamingResponse:
    """Download your sittings as a table with a row for each event and both orders as they stood after it."""
    return _csv(event_export.events_csv(database, visitor_id, world), world, "ranking-events.csv")


@router.get(
    "/worlds/{world_id}/rankings.jsonl",
    summary="Take your orders and attempts away",
    response_class=StreamingResponse,
    responses={200: {"content": {"application/jsonl": {}}, "description": "A demonstration file."}},
)
def export_file(world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> StreamingResponse:
    """Download the world, your attempts and every version of your orders as one demonstration file."""
    return _file(exports.rankings_file(database, visitor_id, world), "application/jsonl", world, "rankings.jsonl")


def _csv(pieces: Iterator[str], world: StoredWorld, name: str) -> StreamingResponse:
    return _file(pieces, "text/csv; charset=utf-8; header=present", world, name)


def _file(pieces: Iterator[str], media_type: str, world: StoredWorld, name: str) -> StreamingResponse:
    told = {"Content-Disposition": f'attachment; filename="irlfr-{world.id[:8]}-{name}"'}
    return StreamingResponse(pieces, media_type=media_type, headers=told)
