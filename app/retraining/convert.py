"""What was computed, to what crosses the wire."""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from app.retraining.computing import Changed, Learned
from irl_core import LEARNERS

SHOWN = ("learner", "outcome", "sentence", "iterations", "reward", "policy", "visitation")


def learned_out(learned: Learned) -> dict[str, Any]:
    """Show what a learner came to, as runs do."""
    told = learned.result.to_json()
    shown = {name: told[name] for name in SHOWN}
    return shown | {"title": LEARNERS[learned.result.learner].title, "compute_ms": learned.compute_ms}


def changed_out(changed: Changed, change: Mapping[str, Any]) -> dict[str, Any]:
    """Show what came of a change."""
    return {
        "learner": changed.learned.result.learner,
        "change": change,
        "result": learned_out(changed.learned),
        **asdict(changed.now),
        "before": asdict(changed.before),
        "difference": changed.difference.to_json(),
        "compute_ms": changed.learned.compute_ms,
    }
