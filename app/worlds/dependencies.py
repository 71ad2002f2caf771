"""The world of a route's address."""

from typing import Annotated
from uuid import UUID

from anyio import to_thread
from fastapi import Depends, Request

from app.db import Database
from app.dependencies import DatabaseFromApp
from app.errors import NotFound
from app.worlds import queries
from app.worlds.address import WorldQuery, read_query
from app.worlds.convert import StoredWorld

MOST_KNOWN = 64
"""How many worlds a process remembers: a class plays one, and 100×100 ones take 1.5 MB each."""


async def get_world(world_id: UUID, request: Request, database: DatabaseFromApp) -> StoredWorld:
    """Load the world, or say that there is none. One that was loaded before costs nothing: worlds never change."""
    known: dict[str, StoredWorld] = request.app.state.known_worlds
    if str(world_id) not in known:
        if len(known) >= MOST_KNOWN:
            known.clear()
        known[str(world_id)] = await to_thread.run_sync(_load, database, str(world_id))
    return known[str(world_id)]


def _load(database: Database, world_id: str) -> StoredWorld:
    with database.read() as session:
        world = queries.find_world(session, world_id)
    if world is None:
        message = "There is no such world here. Its link may be incomplete, or nobody has played it yet."
        raise NotFound(message)
    return world


def get_query(request: Request) -> WorldQuery:
    """Read what the address asks for."""
    return read_query(request.url.query)


WorldFromPath = Annotated[StoredWorld, Depends(get_world)]
QueryFromAddress = Annotated[WorldQuery, Depends(get_query)]
