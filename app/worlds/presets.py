"""Worlds worth playing: six presets, and surprises. Each has a short way that tempts and a better one beside it."""

import random
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from app.worlds.maze import carve_maze


@dataclass(frozen=True, slots=True)
class Preset:
    """A world to begin from."""

    name: str
    title: str
    text: str
    spec: Mapping[str, Any]


def surprise(rng: random.Random) -> dict[str, Any]:
    """Return the body, without its seed, of a world nobody asked for: a preset drawn anew, or all by chance."""
    preset = rng.choice((*PRESETS, *[None] * len(PRESETS)))
    if preset is None:
        return _by_chance(rng)
    if preset.name == "maze":
        return _maze(rng, side=rng.choice((9, 11, 13, 15)))
    return {name: value for name, value in preset.spec.items() if name != "seed"}


def _by_chance(rng: random.Random) -> dict[str, Any]:
    rows, cols = rng.randint(4, 14), rng.randint(4, 14)
    walled = rng.choice((0.0, 0.0, 0.1, 0.2))
    return {
        "rows": rows,
        "cols": cols,
        "red_probability": rng.choice((0.1, 0.2, 0.3, 0.4)),
        "slip": rng.choice((0.0, 0.0, 0.0, 0.1, 0.2)),
        "walls": [square for square in range(1, rows * cols - 1) if rng.random() < walled],
    }


def _maze(rng: random.Random, *, side: int) -> dict[str, Any]:
    """A maze of blue passages whose shortcuts are dark red."""
    walls, openings = carve_maze(side, side, n_openings=side - 5, rng=rng)
    painted = [[square, -7.0] for square in openings]
    return {"rows": side, "cols": side, "red_probability": 0.0, "walls": walls, "painted": painted}


def _corridor() -> dict[str, Any]:
    """Straight ahead through red, or the long way round, above or below two blocks of wall."""
    walls = [row * 11 + col for row in (1, 3) for col in range(1, 10)]
    painted = [[2 * 11 + col, reward] for col, reward in ((3, -4.0), (4, -6.0), (5, -7.0), (6, -6.0), (7, -4.0))]
    spec = {"rows": 5, "cols": 11, "red_probability": 0.0, "walls": walls}
    return {**spec, "start": 22, "goals": [32], "painted": painted}


def _lake() -> dict[str, Any]:
    """A lake in the middle of a field, the deeper the redder."""
    depth = {square: 4 - abs(square // 9 - 4) - abs(square % 9 - 4) for square in range(81)}
    painted = [[square, -1.0 - 1.5 * deep] for square, deep in depth.items() if deep > 0]
    return {"rows": 9, "cols": 9, "red_probability": 0.05, "painted": painted}


PRESETS: Final = (
    Preset(
        "paper",
        "The paper's",
        "Seven by seven, three squares in ten red: the worlds of the paper.",
        {"seed": 5},
    ),
    Preset(
        "corridor",
        "Corridor",
        "Straight ahead runs through red. The way round is longer, and worth it.",
        {"seed": 5, **_corridor()},
    ),
    Preset(
        "cliff",
        "Cliff",
        "Along the edge it is short and a little slippery. Keep a row between you and the drop.",
        {
            "rows": 4,
            "cols": 12,
            "seed": 5,
            "red_probability": 0.0,
            "slip": 0.1,
            "start": 36,
            "painted": [[square, -7.0] for square in range(37, 47)],
        },
    ),
    Preset(
        "maze",
        "Maze",
        "Every shortcut is dark red. The long way is blue, if you find it.",
        {"seed": 5, **_maze(random.Random(120), side=11)},  # noqa: S311 - a maze is no secret
    ),
    Preset(
        "open_field",
        "Open field",
        "Nothing in your way but a lake: through it, or around?",
        {"seed": 5, **_lake()},
    ),
    Preset(
        "two_goals",
        "Two goals",
        "One goal is near and pays little. The other is far and rich.",
        {
            "cols": 11,
            "seed": 5,
            "red_probability": 0.15,
            "start": 35,
            "goals": [32, 38],
            "painted": [[32, 24.0], [36, -3.0], [37, -3.0], [38, 3.0]],
        },
    ),
)
"""The same world each time, for the editor to begin from."""
