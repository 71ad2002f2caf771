"""Rankings as JSON."""

from fastapi import APIRouter

from app.dependencies import DatabaseFromApp
from app.rankings import convert, queries, service
from app.rankings.schemas import Outcome, RankingIn, RankingOut, RankingsOut
from app.visitors import VisitorOrNone
from app.worlds.dependencies import WorldFromPath

router = APIRouter(prefix="/api/v1", tags=["rankings"])


@router.put("/worlds/{world_id}/rankings/{outcome}", summary="Confirm an order")
def confirm_ranking(
    world: WorldFromPath, outcome: Outcome, body: RankingIn, database: DatabaseFromApp, visitor_id: VisitorOrNone
) -> RankingOut:
    """Store an order of exactly the successes, or failures, that you have kept in this world.

    Each confirmed order is a version of its own; none is overwritten and the newest counts.
    """
    return convert.ranking_out(service.confirm(database, visitor_id, world.id, outcome, body))


@router.get("/worlds/{world_id}/rankings", summary="Show your orders")
def show_rankings(world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> RankingsOut:
    """Show the newest order of each outcome that you have confirmed in this world."""
    with database.read() as session:
        return convert.rankings_out(queries.newest(session, visitor_id, world.id))
