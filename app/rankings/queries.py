"""What can be asked about rankings and the sittings in which they came to be."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sqlalchemy import Select, func, select
from sqlalchemy.orm import Session

from app.models import Demonstration, Ranking, RankingEvent, Sitting
from app.rankings.content import Outcome


def newest(session: Session, visitor_id: str | None, world_id: str) -> dict[str, Ranking]:
    """Find the newest order of each outcome that a visitor has confirmed in a world."""
    rows = session.scalars(select(Ranking).where(Ranking.id.in_(_newest_ids(visitor_id, world_id))))
    return {row.outcome: row for row in rows}


def versions(session: Session, visitor_id: str | None, world_id: str, outcome: Outcome) -> Sequence[Ranking]:
    """List every version of an order that a visitor has confirmed in a world, newest first."""
    theirs = (Ranking.visitor_id == visitor_id, Ranking.world_id == world_id, Ranking.outcome == outcome)
    return session.scalars(select(Ranking).where(*theirs).order_by(Ranking.version.desc())).all()


def confirmed_in(session: Session, sitting_id: str, outcome: Outcome, n_events: int) -> Ranking | None:
    """Find the version that so many events of a sitting led to."""
    same = (Ranking.sitting_id == sitting_id, Ranking.outcome == outcome, Ranking.n_events == n_events)
    return session.scalar(select(Ranking).where(*same))


@dataclass(frozen=True, slots=True)
class Attempt:
    """What ranking needs to know of a demonstration: not its steps, which may be many."""

    id: str
    outcome: str
    is_kept: bool
    n_steps: int


def attempts(session: Session, visitor_id: str | None, world_id: str) -> dict[str, Attempt]:
    """Find a visitor's attempts in a world, the discarded ones too, by id."""
    theirs = (Demonstration.visitor_id == visitor_id, Demonstration.world_id == world_id)
    asked = (
        Demonstration.id,
        Demonstration.outcome,
        Demonstration.discarded_at.is_(None),
        func.json_array_length(Demonstration.actions),
    )
    return {row[0]: Attempt(*row) for row in session.execute(select(*asked).where(*theirs))}


def find_sitting(session: Session, sitting_id: str) -> Sitting | None:
    """Find a sitting by its id, whosever it is."""
    return session.get(Sitting, sitting_id)


def n_events(session: Session, sitting_id: str) -> int:
    """Tell how many events of a sitting, which there is, are stored."""
    return session.scalars(select(Sitting.n_events).where(Sitting.id == sitting_id)).one()


def stored_events(session: Session, sitting_id: str, start: int, stop: int) -> list[dict[str, Any]]:
    """List events start … stop − 1 of a sitting, as they were sent."""
    within = (RankingEvent.sitting_id == sitting_id, RankingEvent.n >= start, RankingEvent.n < stop)
    return list(session.scalars(select(RankingEvent.event).where(*within).order_by(RankingEvent.n)))


def newest_ids(session: Session, visitor_id: str | None, world_id: str) -> set[int]:
    """Find the row of the newest version of each outcome."""
    return set(session.scalars(_newest_ids(visitor_id, world_id)))


def _newest_ids(visitor_id: str | None, world_id: str) -> Select[int]:
    """Say which rows to look for; each version comes after the one before it."""
    theirs = (Ranking.visitor_id == visitor_id, Ranking.world_id == world_id)
    return select(func.max(Ranking.id)).where(*theirs).group_by(Ranking.outcome)


def next_versions(
    session: Session, visitor_id: str | None, world_id: str, *, after: int, up_to: int, limit: int
) -> Sequence[Ranking]:
    """List the next versions of both outcomes, oldest first."""
    theirs = (Ranking.visitor_id == visitor_id, Ranking.world_id == world_id)
    within = (Ranking.id > after, Ranking.id <= up_to)
    return session.scalars(select(Ranking).where(*theirs, *within).order_by(Ranking.id).limit(limit)).all()


def sittings_in_world(session: Session, visitor_id: str | None, world_id: str) -> Sequence[Sitting]:
    """List a visitor's sittings in a world, oldest first."""
    theirs = (Sitting.visitor_id == visitor_id, Sitting.world_id == world_id)
    return session.scalars(select(Sitting).where(*theirs).order_by(Sitting.created_at, Sitting.id)).all()


def events_with_times(session: Session, sitting_id: str, start: int, stop: int) -> Sequence[RankingEvent]:
    """List events start … stop − 1 of a sitting."""
    within = (RankingEvent.sitting_id == sitting_id, RankingEvent.n >= start, RankingEvent.n < stop)
    return session.scalars(select(RankingEvent).where(*within).order_by(RankingEvent.n)).all()


def versions_by_n_events(session: Session, sitting_id: str) -> dict[int, int]:
    """Find which versions were confirmed in a sitting, by how many events led to each; the last event says of what."""
    rows = session.execute(select(Ranking.n_events, Ranking.version).where(Ranking.sitting_id == sitting_id))
    return {n_events: version for n_events, version in rows if n_events is not None}
