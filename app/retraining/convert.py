"""What was computed, to what crosses the wire."""

from typing import Any

from app.retraining.computing import Learned
from irl_core import LEARNERS

SHOWN = ("learner", "outcome", "sentence", "iterations", "reward", "policy", "visitation")


def learned_out(learned: Learned) -> dict[str, Any]:
    """Show what a learner came to, as runs do."""
    told = learned.result.to_json()
    shown = {name: told[name] for name in SHOWN}
    return shown | {"title": LEARNERS[learned.result.learner].title, "compute_ms": learned.compute_ms}
