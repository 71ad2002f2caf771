"""Many attempts at once: each follows its own law of actions until it reaches a goal or its player's patience ends.

Attempt b in square s takes action a with probability laws[b, s, a]. Slips are decided by the attempt's id and the step,
as everywhere (`slip_direction`), so that `simulate` with the same id and actions plays the very attempt again.
Shapes: B attempts, S states, N steps.
"""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from irl_core.arrays import IntVector
from irl_core.playing import slip_direction
from irl_core.types import World

Laws: TypeAlias = np.ndarray[tuple[int, int, int], np.dtype[np.float64]]
"""The probability of each action of each attempt in each state, shape (B, S, 4)."""


def play(
    world: World, laws: Laws, ids: Sequence[str], rng: np.random.Generator, *, patience: int
) -> list[list[int] | None]:
    """The actions of each attempt up to the goal, or None where `patience` steps did not reach one.

    Each step draws one number for each attempt, whether or not it is still under way.
    """
    each = np.arange(len(ids))
    thresholds = laws.cumsum(axis=2)[:, :, :-1]
    here = np.full(len(ids), world.start, dtype=np.int64)
    n_steps = np.zeros(len(ids), dtype=np.int64)
    actions = np.zeros((patience, len(ids)), dtype=np.int64)
    for step in range(patience):
        actions[step] = (rng.random(len(ids))[:, None] >= thresholds[each, here]).sum(axis=1)
        here = world.next_states[here, _directions(world, ids, step, actions[step])]
        n_steps[(n_steps == 0) & world.mdp.terminal[here]] = step + 1
        if n_steps.all():
            break
    return [actions[:n, b].tolist() if n else None for b, n in enumerate(n_steps.tolist())]


def _directions(world: World, ids: Sequence[str], step: int, meant: IntVector) -> IntVector:
    if world.slip == 0.0:
        return meant
    both = zip(ids, meant.tolist(), strict=True)
    return np.array([slip_direction(id_, step, action, world.slip) for id_, action in both], dtype=np.int64)
