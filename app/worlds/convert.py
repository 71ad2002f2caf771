"""Rows ⇄ irl_core: the door of this room to the science."""

import json
import secrets
import uuid
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from app.worlds.schemas import WorldIn
from irl_core import GENERATOR_VERSION, World, draw_playable_world, generate_world

NAMESPACE = uuid.UUID("6d1f4f2e-2f53-5c0c-9c39-9f6f0a3c5d11")


@dataclass(frozen=True, slots=True)
class StoredWorld:
    """A world and the id under which it is, or would be, stored."""

    id: str
    world: World

    def to_json(self) -> dict[str, Any]:
        """Show the world as the API has it."""
        return {"id": self.id, **self.world.to_json()}


def generate(parameters: WorldIn) -> StoredWorld:
    """Generate the world of a seed; without one, draw until a success is possible."""
    numbers = parameters.model_dump(exclude={"seed"})
    numbers["walls"] = sorted(set(parameters.walls))
    if parameters.seed is None:
        world = draw_playable_world(secrets.randbelow(2**32), **numbers)
    else:
        world = generate_world(parameters.seed, **numbers)
    return StoredWorld(id_of(spec_of(world)), world)


def spec_of(world: World) -> dict[str, Any]:
    """Say what a world was generated from; another generator gives other worlds other ids, old ids keep theirs."""
    return {
        "generator": GENERATOR_VERSION,
        "rows": world.rows,
        "cols": world.cols,
        "seed": world.seed,
        "red_probability": world.red_probability,
        "slip": world.slip,
        "walls": sorted(world.walls),
    }


def id_of(spec: Mapping[str, Any]) -> str:
    """Return the id that this specification always gets."""
    return str(uuid.uuid5(NAMESPACE, json.dumps(spec, sort_keys=True, separators=(",", ":"))))


@lru_cache(maxsize=64)
def world_from_text(text: str) -> World:
    """Read a stored world. Cached, because every attempt is simulated in one."""
    return World.from_json(json.loads(text))
