"""Random play: what anything worth its name must beat. π(a | s) = 1/A; the log-likelihood is that of the actions."""

from dataclasses import dataclass, field
from typing import final

import numpy as np

from irl_core.learners.base import Family, Frame, LearningResult, LearningState, Outcome
from irl_core.learners.baselines import report
from irl_core.learners.problem import LearningProblem


@final
@dataclass(frozen=True)
class RandomPlay:
    """Every action as likely as any other. It ends where it starts; its state holds nothing."""

    name: str = field(default="random", init=False)
    title: str = field(default="Random", init=False)
    summary: str = field(default="Learns nothing and takes every action with the same probability.", init=False)
    family: Family = field(default="baseline", init=False)
    uses_ranking: bool = field(default=False, init=False)
    uses_failures: bool = field(default=False, init=False)
    uses_scores: bool = field(default=False, init=False)
    takes_anything: bool = field(default=False, init=False)
    references: tuple[str, ...] = field(default=(), init=False)

    def start(self, problem: LearningProblem) -> LearningState:
        """Nothing, and the end of it."""
        problem.require(self)
        return LearningState(self.name, 0, {}, Outcome.CONVERGED)

    def advance(self, problem: LearningProblem, state: LearningState, *, iterations: int) -> LearningState:  # noqa: ARG002 - the protocol's
        """The same state."""
        return state

    def frame(self, problem: LearningProblem, state: LearningState) -> Frame:
        """Random play."""
        return report.frame(problem, state, self._learned(problem), iterations=0)

    def result(self, problem: LearningProblem, state: LearningState) -> LearningResult:
        """Random play."""
        return report.result(problem, state, self._learned(problem))

    def _learned(self, problem: LearningProblem) -> report.Learned:
        policy = report.uniform_policy(problem)
        weights = np.zeros(problem.features.n_features)
        return report.Learned(
            weights=weights,
            reward=problem.features.reward(weights),
            policy=policy,
            log_likelihood=report.action_log_likelihood(problem, policy),
            sentence="Nothing is learned: every action is as likely as any other.",
        )
