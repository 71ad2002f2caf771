"""Inverse reinforcement learning from ranked successes and failures, importable alone.

What this module exports is the public interface; the docstrings are its reference.
"""

from irl_core.errors import (
    ImpossibleDemonstration,
    InvalidFile,
    InvalidRanking,
    InvalidSettings,
    InvalidWorld,
    IrlError,
    MissingDemonstrations,
)
from irl_core.gridworld import (
    GENERATOR_VERSION,
    draw_playable_world,
    generate_world,
    simulate,
    slip_direction,
    success_is_possible,
)
from irl_core.types import Demonstration, Ranking, World
from irl_core.weights import feature_counts, rank_weights, uniform_weights

__all__ = [
    "GENERATOR_VERSION",
    "Demonstration",
    "ImpossibleDemonstration",
    "InvalidFile",
    "InvalidRanking",
    "InvalidSettings",
    "InvalidWorld",
    "IrlError",
    "MissingDemonstrations",
    "Ranking",
    "World",
    "draw_playable_world",
    "feature_counts",
    "generate_world",
    "rank_weights",
    "simulate",
    "slip_direction",
    "success_is_possible",
    "uniform_weights",
]
