"""What can be asked about rankings."""

from sqlalchemy import select
from sqlalchemy.orm import Session

from app.models import Ranking


def newest(session: Session, visitor_id: str | None, world_id: str) -> dict[str, Ranking]:
    """Find the newest order of each outcome that a visitor has confirmed in a world."""
    theirs = (Ranking.visitor_id == visitor_id, Ranking.world_id == world_id)
    rows = session.scalars(select(Ranking).where(*theirs).order_by(Ranking.version))
    return {row.outcome: row for row in rows}
