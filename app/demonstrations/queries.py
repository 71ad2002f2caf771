"""What can be asked about demonstrations."""

from collections.abc import Sequence

from sqlalchemy import select
from sqlalchemy.orm import Session

from app.models import Demonstration


def find(session: Session, demonstration_id: str) -> Demonstration:
    """Find a demonstration that is known to be there by its id, whoever made it."""
    return session.scalars(select(Demonstration).where(Demonstration.id == demonstration_id)).one()


def find_theirs(session: Session, visitor_id: str | None, demonstration_id: str) -> Demonstration | None:
    """Find a demonstration by its id if this visitor made it."""
    theirs = Demonstration.visitor_id == visitor_id
    return session.scalar(select(Demonstration).where(Demonstration.id == demonstration_id, theirs))


def all_in_world(session: Session, visitor_id: str | None, world_id: str) -> Sequence[Demonstration]:
    """List a visitor's demonstrations in a world, oldest first, the discarded ones too."""
    theirs = (Demonstration.visitor_id == visitor_id, Demonstration.world_id == world_id)
    return session.scalars(select(Demonstration).where(*theirs).order_by(Demonstration.number)).all()


def kept_in_world(session: Session, visitor_id: str | None, world_id: str) -> Sequence[Demonstration]:
    """List a visitor's demonstrations in a world that are not discarded, oldest first."""
    return [row for row in all_in_world(session, visitor_id, world_id) if row.discarded_at is None]
