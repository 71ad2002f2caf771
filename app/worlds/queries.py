"""What can be asked about worlds."""

from sqlalchemy.orm import Session

from app.models import World


def find(session: Session, world_id: str) -> World | None:
    """Find a stored world by its id."""
    return session.get(World, world_id)
