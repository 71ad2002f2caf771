"""Rows ⇄ irl_core: the door of this room to the science."""

import json
import secrets
import uuid
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from app.config import Way
from app.worlds.schemas import WorldIn
from irl_core import GENERATOR_VERSION, World, draw_playable_world, generate_world
from irl_core.grid import default_horizon

NAMESPACE = uuid.UUID("6d1f4f2e-2f53-5c0c-9c39-9f6f0a3c5d11")
DEFAULTS: Mapping[str, Any] = {
    name: WorldIn.model_fields[name].default for name in ("rows", "cols", "red_probability", "slip", "walls")
}
"""What a specification says although nobody has to ask for it; all other defaults are left out of it."""

OPTIONS = {"rank_by", "pooled"}
"""What is agreed for a world beside what it is: nothing of it changes a square."""


@dataclass(frozen=True, slots=True)
class StoredWorld:
    """A world, the id under which it is, or would be, stored, and what it was generated from."""

    id: str
    world: World
    spec: Mapping[str, Any]

    @property
    def rank_by(self) -> Way | None:
        """The one way in which attempts are put in order here, if somebody chose one."""
        return self.spec.get("rank_by")

    @property
    def pooled(self) -> bool:
        """Whether everybody's comparisons in this world are pooled, without names."""
        return bool(self.spec.get("pooled", False))

    @property
    def smallest_body(self) -> dict[str, Any]:
        """What POST /worlds must be told to make this world again."""
        told = {name: value for name, value in self.spec.items() if name != "generator"}
        return {name: value for name, value in told.items() if name not in DEFAULTS or value != DEFAULTS[name]}

    def to_json(self) -> dict[str, Any]:
        """Show the world as the API has it."""
        options = {"rank_by": self.rank_by, "pooled": self.pooled}
        return {"id": self.id, **self.world.to_json(), **options, "spec": self.smallest_body}


def generate(parameters: WorldIn) -> StoredWorld:
    """Generate the world of a seed; without one, draw until a success is possible."""
    numbers = parameters.model_dump(exclude={"seed", *OPTIONS})
    numbers["walls"] = sorted(set(parameters.walls))
    numbers["painted"] = dict(parameters.painted)
    if parameters.seed is None:
        world = draw_playable_world(secrets.randbelow(2**32), **numbers)
    else:
        world = generate_world(parameters.seed, **numbers)
    spec = spec_of(world, painted=numbers["painted"]) | _options(parameters)
    return StoredWorld(id_of(spec), world, spec)


def spec_of(world: World, *, painted: Mapping[int, float]) -> dict[str, Any]:
    """Say what a world was generated from; another generator gives other worlds other ids, old ids keep theirs.

    The fields after the walls came later. They are there only where they differ from their defaults, so that a world
    keeps the id it had before there were such fields.
    """
    return {
        "generator": GENERATOR_VERSION,
        "rows": world.rows,
        "cols": world.cols,
        "seed": world.seed,
        "red_probability": world.red_probability,
        "slip": world.slip,
        "walls": sorted(world.walls),
        **_start_and_goals(world),
        **_paint(world, painted),
        **_limits(world),
    }


def _start_and_goals(world: World) -> dict[str, Any]:
    start = {"start": world.start} if world.start != 0 else {}
    return start if world.goals == (world.n_states - 1,) else {**start, "goals": list(world.goals)}


def _paint(world: World, painted: Mapping[int, float]) -> dict[str, Any]:
    """Leave out what was painted as it was drawn anyway."""
    if not painted:
        return {}
    plain = generate_world(
        world.seed or 0,
        rows=world.rows,
        cols=world.cols,
        red_probability=world.red_probability or 0.0,
        start=world.start,
        goals=world.goals,
    )
    pays = [[square, painted[square]] for square in sorted(painted) if painted[square] != plain.reward[square]]
    return {"painted": pays} if pays else {}


def _limits(world: World) -> dict[str, Any]:
    usual = default_horizon(world.rows, world.cols, shortest=world.shortest_way)
    steps = {} if world.horizon == usual else {"step_limit": world.horizon}
    return steps if world.time_limit_s is None else {**steps, "time_limit_s": world.time_limit_s}


def _options(parameters: WorldIn) -> dict[str, Any]:
    return parameters.model_dump(include=OPTIONS, exclude_defaults=True)


def id_of(spec: Mapping[str, Any]) -> str:
    """Return the id that this specification always gets."""
    return str(uuid.uuid5(NAMESPACE, json.dumps(spec, sort_keys=True, separators=(",", ":"))))


@lru_cache(maxsize=64)
def world_from_text(text: str) -> World:
    """Read a stored world. Cached, because every attempt is simulated in one."""
    return World.from_json(json.loads(text))
