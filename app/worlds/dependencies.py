"""The world of a route's address."""

from typing import Annotated
from uuid import UUID

from fastapi import Depends

from app.dependencies import DatabaseFromApp
from app.errors import NotFound
from app.worlds import queries
from app.worlds.convert import StoredWorld


def get_world(world_id: UUID, database: DatabaseFromApp) -> StoredWorld:
    """Load the world, or say that there is none."""
    with database.read() as session:
        world = queries.find_world(session, str(world_id))
    if world is None:
        message = "There is no such world here. Its link may be incomplete, or nobody has played it yet."
        raise NotFound(message)
    return world


WorldFromPath = Annotated[StoredWorld, Depends(get_world)]
