"""What people can do with worlds: imagine one, be surprised by one, and keep it."""

import random

from sqlalchemy import insert
from sqlalchemy.orm import Session

from app.db import Database
from app.errors import ImpossibleWorld
from app.kit.clock import now
from app.models import World
from app.visitors import remember
from app.worlds import convert, presets
from app.worlds.address import WorldQuery, write_query
from app.worlds.convert import StoredWorld
from app.worlds.schemas import WorldIn
from irl_core import InvalidWorld

MOST_SURPRISES = 50


def create(database: Database, visitor_id: str, parameters: WorldIn) -> StoredWorld:
    """Generate a world and store it, once: the same parameters give the same world however often they come."""
    stored = convert.generate(parameters)
    columns = {"id": stored.id, "spec": stored.spec, "world": stored.world.to_json(), "created_at": now()}

    def store(session: Session) -> None:
        remember(session, visitor_id)
        session.execute(insert(World).prefix_with("OR IGNORE"), columns)

    database.write(store)
    return stored


def imagine(query: WorldQuery) -> StoredWorld:
    """Generate the world an address asks for and store nothing."""
    if query.problems:
        raise ImpossibleWorld(query.problem, fields=query.problems, mend_at=query.to_mend)
    try:
        return convert.generate(query.to_world_in())
    except InvalidWorld as error:
        fields = {error.field: error.message} if error.field else {}
        raise ImpossibleWorld(error.message, fields=fields, mend_at=query.to_mend) from None


def surprise(rng: random.Random) -> str:
    """Return the query of a world nobody asked for, in which a success is possible."""
    for _ in range(MOST_SURPRISES):
        try:
            # With a seed: without one, a hopeless idea would be drawn a thousand times before it is given up.
            made = convert.generate(WorldIn(seed=rng.getrandbits(32), **presets.surprise(rng)))
        except InvalidWorld:  # these walls close the way
            continue
        if made.world.success_possible:
            return write_query(made.smallest_body)
    return write_query(convert.generate(WorldIn()).smallest_body)
