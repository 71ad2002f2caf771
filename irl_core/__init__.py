"""Inverse reinforcement learning from ranked successes and failures, importable alone.

What this module exports is the public interface; the docstrings are its reference.
"""

from irl_core.agreement import Agreement, agreement_of
from irl_core.comparison import Comparison, Entry, compare
from irl_core.errors import (
    DivergentPartition,
    ImpossibleDemonstration,
    InvalidFeatures,
    InvalidFile,
    InvalidModel,
    InvalidPolicy,
    InvalidRanking,
    InvalidReward,
    InvalidSettings,
    InvalidWorld,
    IrlError,
    MissingDemonstrations,
)
from irl_core.evaluation import (
    Rollout,
    expected_return,
    expected_visits,
    greedy_plan,
    optimal_plan,
    optimum,
    rollouts,
)
from irl_core.features import FeatureMap, features_of
from irl_core.files import DemonstrationFile, WorldSection, read_demonstration_file, write_demonstration_file
from irl_core.gridworld import GENERATOR_VERSION, draw_playable_world, generate_world, success_is_possible
from irl_core.inference import BatchInferred, Inferred, infer, infer_batch
from irl_core.learners import (
    DEFAULT_LEARNERS,
    LEARNERS,
    Frame,
    Learner,
    LearningProblem,
    LearningResult,
    LearningState,
    Outcome,
    Posterior,
    Settings,
    learn,
)
from irl_core.mdp import GridMdp, Mdp, SparseMdp
from irl_core.mdp.toy_text import from_gymnasium
from irl_core.planning import HardPlan, SoftPlan, hard_plan, soft_plan, spectral_radius, visitation
from irl_core.playing import simulate, slip_direction
from irl_core.preferences import order_from_comparisons
from irl_core.trajectories import demonstration_of
from irl_core.types import Demonstration, Ranking, World
from irl_core.warm import warm_up
from irl_core.weights import display_ranks, feature_counts, paper_index, rank_weights, uniform_weights

__all__ = [
    "DEFAULT_LEARNERS",
    "GENERATOR_VERSION",
    "LEARNERS",
    "Agreement",
    "BatchInferred",
    "Comparison",
    "Demonstration",
    "DemonstrationFile",
    "DivergentPartition",
    "Entry",
    "FeatureMap",
    "Frame",
    "GridMdp",
    "HardPlan",
    "ImpossibleDemonstration",
    "Inferred",
    "InvalidFeatures",
    "InvalidFile",
    "InvalidModel",
    "InvalidPolicy",
    "InvalidRanking",
    "InvalidReward",
    "InvalidSettings",
    "InvalidWorld",
    "IrlError",
    "Learner",
    "LearningProblem",
    "LearningResult",
    "LearningState",
    "Mdp",
    "MissingDemonstrations",
    "Outcome",
    "Posterior",
    "Ranking",
    "Rollout",
    "Settings",
    "SoftPlan",
    "SparseMdp",
    "World",
    "WorldSection",
    "agreement_of",
    "compare",
    "demonstration_of",
    "display_ranks",
    "draw_playable_world",
    "expected_return",
    "expected_visits",
    "feature_counts",
    "features_of",
    "from_gymnasium",
    "generate_world",
    "greedy_plan",
    "hard_plan",
    "infer",
    "infer_batch",
    "learn",
    "optimal_plan",
    "optimum",
    "order_from_comparisons",
    "paper_index",
    "rank_weights",
    "read_demonstration_file",
    "rollouts",
    "simulate",
    "slip_direction",
    "soft_plan",
    "spectral_radius",
    "success_is_possible",
    "uniform_weights",
    "visitation",
    "warm_up",
    "write_demonstration_file",
]
