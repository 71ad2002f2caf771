"""What can be asked about worlds."""

from sqlalchemy import Text, select, type_coerce
from sqlalchemy.orm import Session

from app.models import World
from app.worlds.convert import StoredWorld, world_from_text


def find_world(session: Session, world_id: str) -> StoredWorld | None:
    """Find a stored world by its id; read as text, so that a world read before is not parsed again."""
    text = session.scalar(select(type_coerce(World.world, Text())).where(World.id == world_id))
    return None if text is None else StoredWorld(world_id, world_from_text(text))
