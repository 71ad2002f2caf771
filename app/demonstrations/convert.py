"""Rows ⇄ irl_core: the door of this room to the science."""

from collections.abc import Sequence
from typing import Any, cast

import numpy as np

from app.demonstrations.schemas import DemonstrationIn
from app.models import Demonstration as DemonstrationRow
from app.worlds.convert import StoredWorld
from irl_core import Demonstration, simulate, slip_direction
from irl_core.types import DemonstrationOutcome, Ending

SlipSeeds = Sequence[tuple[str, int]]
"""Pairs of a seed and the step from which it decides the slips."""


def simulated_columns(
    stored: StoredWorld, told: DemonstrationIn, *, slip_seeds: SlipSeeds | None = None
) -> dict[str, Any]:
    """Live the attempt again and return what is stored of it; raises ImpossibleDemonstration.

    `slip_seeds` are those of an attempt that went on from another; an ordinary one slips by its own id.
    """
    attempt = simulate(stored.world, told.actions, attempt_id=told.id, ending=told.ending, slip_seeds=slip_seeds)
    return {
        "id": told.id,
        "world_id": stored.id,
        "states": attempt.states.tolist(),
        "actions": attempt.actions.tolist(),
        "rewards": attempt.rewards.tolist(),
        "step_ms": told.step_ms,
        "total": float(attempt.total),
        "outcome": str(attempt.outcome),
        "ending": str(attempt.ending),
        "parent_id": told.parent_id,
        "parent_step": told.parent_step,
        "slip_seeds": [list(pair) for pair in attempt.slip_seeds],
        "record": None if told.record is None else told.record.model_dump(),
    }


def directions_taken(row: DemonstrationRow, slip: float) -> list[int]:
    """Which way each step of a stored demonstration really went."""
    if slip == 0.0:
        return row.actions
    ends = [first for _, first in row.slip_seeds[1:]] + [len(row.actions)]
    return [
        slip_direction(seed, step, row.actions[step], slip)
        for (seed, first), end in zip(row.slip_seeds, ends, strict=True)
        for step in range(first, end)
    ]


def demonstration_from_row(row: DemonstrationRow) -> Demonstration:
    """Read a stored demonstration."""
    return Demonstration(
        id=row.id,
        states=np.array(row.states),
        actions=np.array(row.actions),
        rewards=np.array(row.rewards, dtype=np.float64),
        total=row.total,
        outcome=cast("DemonstrationOutcome", row.outcome),
        ending=cast("Ending", row.ending),
        slip_seeds=tuple((seed, first) for seed, first in row.slip_seeds),
    )


def beside_the_play(row: DemonstrationRow) -> dict[str, Any]:
    """What a file says of an attempt more than irl_core knows: its times, and where it comes from."""
    parent = {} if row.parent_id is None else {"parent_id": row.parent_id, "parent_step": row.parent_step}
    return {"step_ms": row.step_ms, "created_at": row.created_at.isoformat(), **parent}
