"""Learners of the neighbourhood, behind the same protocol, to measure the others against."""

from irl_core.learners.baselines.cloning import BehaviouralCloning
from irl_core.learners.baselines.random import RandomPlay
from irl_core.learners.baselines.scores import ScoreIrl
from irl_core.learners.baselines.trex import Trex

__all__ = ["BehaviouralCloning", "RandomPlay", "ScoreIrl", "Trex"]
