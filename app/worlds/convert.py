"""Rows ⇄ irl_core: the door of this room to the science."""

import json
import secrets
import uuid
from collections.abc import Mapping
from typing import Any

from app.models import World as WorldRow
from app.worlds.schemas import WorldIn
from irl_core import GENERATOR_VERSION, World, draw_playable_world, generate_world

NAMESPACE = uuid.UUID("6d1f4f2e-2f53-5c0c-9c39-9f6f0a3c5d11")


def generate(parameters: WorldIn) -> WorldRow:
    """Generate the world of a seed; without one, draw until a success is possible. The row is not stored yet."""
    numbers = parameters.model_dump(exclude={"seed"})
    numbers["walls"] = sorted(set(parameters.walls))
    if parameters.seed is None:
        return to_row(draw_playable_world(secrets.randbelow(2**32), **numbers))
    return to_row(generate_world(parameters.seed, **numbers))


def to_row(world: World) -> WorldRow:
    """Give a generated world the row under which it is, or would be, stored."""
    spec = {
        "generator": GENERATOR_VERSION,  # another generator gives other worlds other ids; old ids keep theirs
        "rows": world.rows,
        "cols": world.cols,
        "seed": world.seed,
        "red_probability": world.red_probability,
        "slip": world.slip,
        "walls": sorted(world.walls),
    }
    return WorldRow(id=id_of(spec), spec=spec, world=world.to_json())


def id_of(spec: Mapping[str, Any]) -> str:
    """Return the id that this specification always gets."""
    return str(uuid.uuid5(NAMESPACE, json.dumps(spec, sort_keys=True, separators=(",", ":"))))


def to_core(row: WorldRow) -> World:
    """Read a stored world."""
    return World.from_json(row.world)


def to_json(row: WorldRow) -> dict[str, Any]:
    """Show a world as the API has it."""
    return {"id": row.id, **row.world}
