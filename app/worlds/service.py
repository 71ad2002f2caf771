"""What people can do with worlds: draw one, and keep it."""

from sqlalchemy import insert
from sqlalchemy.orm import Session

from app.db import Database
from app.kit.clock import now
from app.models import World
from app.visitors import remember
from app.worlds import convert
from app.worlds.convert import StoredWorld
from app.worlds.schemas import WorldIn


def create(database: Database, visitor_id: str, parameters: WorldIn) -> StoredWorld:
    """Generate a world and store it, once: the same parameters give the same world however often they come."""
    stored = convert.generate(parameters)
    columns = {
        "id": stored.id,
        "spec": convert.spec_of(stored.world),
        "world": stored.world.to_json(),
        "created_at": now(),
    }

    def store(session: Session) -> None:
        remember(session, visitor_id)
        session.execute(insert(World).prefix_with("OR IGNORE"), columns)

    database.write(store)
    return stored
