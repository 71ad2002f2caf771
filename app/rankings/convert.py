"""Rows ⇄ irl_core: the door of this room to the science."""

from app.models import Ranking as RankingRow
from app.rankings.schemas import RankingOut, RankingsOut
from irl_core import rank_weights


def ranking_out(row: RankingRow) -> RankingOut:
    """Read a row and add the weight that each place gives."""
    return RankingOut(
        outcome=row.outcome,
        order=row.order,
        version=row.version,
        weights=rank_weights(row.order),
        start_order=row.start_order,
        created_at=row.created_at,
    )


def rankings_out(newest: dict[str, RankingRow]) -> RankingsOut:
    """Read the newest row of each outcome that has one."""
    success, failure = newest.get("success"), newest.get("failure")
    return RankingsOut(
        success=ranking_out(success) if success else None,
        failure=ranking_out(failure) if failure else None,
    )
