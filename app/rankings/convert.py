"""Rows ⇄ irl_core: the door of this room to the science."""

from collections.abc import Sequence

from app.models import Ranking as RankingRow
from app.rankings.schemas import RankingOut, RankingsOut
from irl_core import rank_weights


def ranking_out(row: RankingRow, *, counts: bool) -> RankingOut:
    """Read a row; add the weight that each place gives, and whether it is the newest."""
    return RankingOut(
        outcome=row.outcome,
        order=row.order,
        version=row.version,
        weights=rank_weights(row.order),
        start_order=row.start_order,
        created_at=row.created_at,
        way=row.way,
        given=row.given,
        sitting_id=row.sitting_id,
        n_events=row.n_events,
        untouched=row.untouched,
        counts=counts,
    )


def rankings_out(newest: dict[str, RankingRow]) -> RankingsOut:
    """Read the newest row of each outcome that has one."""
    success, failure = newest.get("success"), newest.get("failure")
    return RankingsOut(
        success=ranking_out(success, counts=True) if success else None,
        failure=ranking_out(failure, counts=True) if failure else None,
    )


def versions_out(newest_first: Sequence[RankingRow]) -> list[RankingOut]:
    """Read every version of one order."""
    return [ranking_out(row, counts=place == 0) for place, row in enumerate(newest_first)]
