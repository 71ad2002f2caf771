"""What can be asked about worlds."""

from sqlalchemy import Text, select, type_coerce
from sqlalchemy.orm import Session

from app.models import World
from app.worlds.convert import StoredWorld, world_from_text


def find_world(session: Session, world_id: str) -> StoredWorld | None:
    """Find a stored world by its id; read as text, so that a world read before is not parsed again."""
    found = session.execute(select(type_coerce(World.world, Text()), World.spec).where(World.id == world_id)).first()
    return None if found is None else StoredWorld(world_id, world_from_text(found[0]), found[1])
