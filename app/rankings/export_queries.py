"""What the exports ask: everything a visitor has in a world, a few rows at a time, up to what there was at first."""

from collections.abc import Sequence

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from app.models import Ranking, RankingEvent, Sitting


def newest_ids(session: Session, visitor_id: str | None, world_id: str) -> set[int]:
    """Find the row of the newest version of each outcome."""
    theirs = (Ranking.visitor_id == visitor_id, Ranking.world_id == world_id)
    return set(session.scalars(select(func.max(Ranking.id)).where(*theirs).group_by(Ranking.outcome)))


def next_versions(
    session: Session, visitor_id: str | None, world_id: str, *, after: int, up_to: int, limit: int
) -> Sequence[Ranking]:
    """List the next versions of both outcomes, oldest first."""
    theirs = (Ranking.visitor_id == visitor_id, Ranking.world_id == world_id)
    within = (Ranking.id > after, Ranking.id <= up_to)
    return session.scalars(select(Ranking).where(*theirs, *within).order_by(Ranking.id).limit(limit)).all()


def sittings(session: Session, visitor_id: str | None, world_id: str) -> Sequence[Sitting]:
    """List a visitor's sittings in a world, oldest first."""
    theirs = (Sitting.visitor_id == visitor_id, Sitting.world_id == world_id)
    return session.scalars(select(Sitting).where(*theirs).order_by(Sitting.created_at, Sitting.id)).all()


def events(session: Session, sitting_id: str, start: int, stop: int) -> Sequence[RankingEvent]:
    """List events start … stop − 1 of a sitting."""
    within = (RankingEvent.sitting_id == sitting_id, RankingEvent.n >= start, RankingEvent.n < stop)
    return session.scalars(select(RankingEvent).where(*within).order_by(RankingEvent.n)).all()


def versions_of(session: Session, sitting_id: str) -> dict[int, int]:
    """Find which versions were confirmed in a sitting, by how many events led to each; the last event says of what."""
    rows = session.execute(select(Ranking.n_events, Ranking.version).where(Ranking.sitting_id == sitting_id))
    return {n_events: version for n_events, version in rows if n_events is not None}
