"""Rows ⇄ irl_core: the door of this room to the science."""

from typing import Any, cast

import numpy as np

from app.demonstrations.schemas import DemonstrationIn
from app.models import Demonstration as DemonstrationRow
from app.worlds.convert import StoredWorld
from irl_core import Demonstration, simulate
from irl_core.types import DemonstrationOutcome, Ending


def simulated_columns(stored: StoredWorld, told: DemonstrationIn) -> dict[str, Any]:
    """Live the attempt again and return what is stored of it; raises ImpossibleDemonstration."""
    attempt = simulate(stored.world, told.actions, attempt_id=told.id, ending=told.ending, id=told.id)
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
    }


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
    )
