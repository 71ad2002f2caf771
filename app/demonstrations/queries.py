"""What can be asked about demonstrations."""

from collections.abc import Sequence

from sqlalchemy import select
from sqlalchemy.orm import Session, undefer

from app.models import Demonstration

WITH_RECORD = undefer(Demonstration.record)
"""Loads how the attempts were played, too, which may be many times as large as the attempts."""


def find(session: Session, demonstration_id: str) -> Demonstration:
    """Find a demonstration, with its record, that is known to be there by its id, whoever made it."""
    return session.scalars(select(Demonstration).options(WITH_RECORD).where(Demonstration.id == demonstration_id)).one()


def find_theirs(session: Session, visitor_id: str | None, demonstration_id: str) -> Demonstration | None:
    """Find a demonstration, with its record, by its id if this visitor made it."""
    theirs = Demonstration.visitor_id == visitor_id
    return session.scalar(
        select(Demonstration).options(WITH_RECORD).where(Demonstration.id == demonstration_id, theirs)
    )


def find_parent(session: Session, visitor_id: str, world_id: str, demonstration_id: str) -> Demonstration | None:
    """Find an attempt of this visitor in this world from which another can go on."""
    theirs = (Demonstration.visitor_id == visitor_id, Demonstration.world_id == world_id)
    return session.scalar(select(Demonstration).where(Demonstration.id == demonstration_id, *theirs))


def all_in_world(session: Session, visitor_id: str | None, world_id: str) -> Sequence[Demonstration]:
    """List a visitor's demonstrations in a world, oldest first, the discarded ones too, without their records."""
    theirs = (Demonstration.visitor_id == visitor_id, Demonstration.world_id == world_id)
    return session.scalars(select(Demonstration).where(*theirs).order_by(Demonstration.number)).all()


def all_with_records(session: Session, visitor_id: str | None, world_id: str) -> Sequence[Demonstration]:
    """List the same with their records."""
    return _with_records(session, visitor_id, world_id, after=0, limit=None)


def next_with_records(
    session: Session, visitor_id: str | None, world_id: str, *, after: int, limit: int
) -> Sequence[Demonstration]:
    """List those that arrived after number `after`, at most `limit` of them, with their records."""
    return _with_records(session, visitor_id, world_id, after=after, limit=limit)


def _with_records(
    session: Session, visitor_id: str | None, world_id: str, *, after: int, limit: int | None
) -> Sequence[Demonstration]:
    theirs = (Demonstration.visitor_id == visitor_id, Demonstration.world_id == world_id, Demonstration.number > after)
    asked = select(Demonstration).options(WITH_RECORD).where(*theirs).order_by(Demonstration.number).limit(limit)
    return session.scalars(asked).all()


def next_in_world(
    session: Session, visitor_id: str | None, world_id: str, *, after: int, limit: int
) -> Sequence[Demonstration]:
    """List those that arrived after number `after`, at most `limit` of them, without their records."""
    theirs = (Demonstration.visitor_id == visitor_id, Demonstration.world_id == world_id, Demonstration.number > after)
    return session.scalars(select(Demonstration).where(*theirs).order_by(Demonstration.number).limit(limit)).all()


def kept_in_world(session: Session, visitor_id: str | None, world_id: str) -> Sequence[Demonstration]:
    """List a visitor's demonstrations in a world that are not discarded, oldest first."""
    return [row for row in all_in_world(session, visitor_id, world_id) if row.discarded_at is None]
