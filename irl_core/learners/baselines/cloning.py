"""Behavioural cloning: do what was done in this state, as often as it was done there.

With n(s, a) the number of times a success took a in s, all successes alike, and α (`cloning_prior`) for each action,

    π(a | s) = (n(s, a) + α) / (n(s) + α A)    where some success came,    1/A elsewhere,

the mean of a Dirichlet posterior. α = 0.001: at 0.1 one step in ten goes astray, and on 150 simulated worlds of six
kinds the copy then earned less than nothing. Nothing is said about states that nobody visited: there it plays at
random, which is the known weakness of cloning, and the reason to learn rewards instead. It learns no reward (0
everywhere). The log-likelihood is Σ θ_i Σ_t log π(a_t | s_t) of the successes. One iteration; the state holds `counts`,
n, shape (S·A,).
"""

from dataclasses import dataclass, field
from typing import final

import numpy as np

from irl_core.arrays import Matrix, Policy
from irl_core.learners.base import Family, Frame, LearningResult, LearningState, Outcome
from irl_core.learners.baselines import report
from irl_core.learners.problem import LearningProblem


@final
@dataclass(frozen=True)
class BehaviouralCloning:
    """Action frequencies of the successes, smoothed; at random where no success came."""

    name: str = field(default="bc", init=False)
    title: str = field(default="Behavioural cloning", init=False)
    summary: str = field(
        default="Copies what the successes did on each square and plays at random where none of them came.", init=False
    )
    family: Family = field(default="baseline", init=False)
    uses_ranking: bool = field(default=False, init=False)
    uses_failures: bool = field(default=False, init=False)
    uses_scores: bool = field(default=False, init=False)
    takes_anything: bool = field(default=False, init=False)
    references: tuple[str, ...] = field(
        default=(
            "Pomerleau: Efficient training of artificial neural networks for autonomous navigation. 1991.",
            "Bain, Sammut: A framework for behavioural cloning. Machine Intelligence 15, 1999.",
        ),
        init=False,
    )

    def start(self, problem: LearningProblem) -> LearningState:
        """Before the first look: random play."""
        problem.require(self)
        return LearningState(self.name, 0, {"counts": np.zeros(problem.mdp.n_states * problem.mdp.n_actions)})

    def advance(self, problem: LearningProblem, state: LearningState, *, iterations: int) -> LearningState:
        """Count."""
        if state.is_finished or iterations < 1:
            return state
        return LearningState(self.name, 1, {"counts": _counts(problem).reshape(-1)}, Outcome.CONVERGED)

    def frame(self, problem: LearningProblem, state: LearningState) -> Frame:
        """The policy so far."""
        return report.frame(problem, state, self._learned(problem, state), iterations=1)

    def result(self, problem: LearningProblem, state: LearningState) -> LearningResult:
        """The policy, and how many states it knows."""
        return report.result(problem, state, self._learned(problem, state))

    def _learned(self, problem: LearningProblem, state: LearningState) -> report.Learned:
        counts = state.vector("counts").reshape(problem.mdp.n_states, problem.mdp.n_actions)
        policy, n_known = _policy(problem, counts), int(counts.any(axis=1).sum())
        weights = np.zeros(problem.features.n_features)
        return report.Learned(
            weights=weights,
            reward=problem.features.reward(weights),
            policy=policy,
            log_likelihood=report.action_log_likelihood(problem, policy),
            sentence=(
                f"Copied the actions of {len(problem.successes)} successes in {n_known} of {problem.mdp.n_states}"
                " states; in the others it plays at random. No reward is learned."
            ),
        )


def _counts(problem: LearningProblem) -> Matrix:
    """How often a success took a in s, shape (S, A)."""
    counts: Matrix = np.zeros((problem.mdp.n_states, problem.mdp.n_actions))
    for one in problem.successes:
        np.add.at(counts, (one.states[:-1], one.actions), 1.0)
    return counts


def _policy(problem: LearningProblem, counts: Matrix) -> Policy:
    smoothed = counts + problem.settings.cloning_prior
    known = counts.any(axis=1, keepdims=True)
    return np.where(known, smoothed / smoothed.sum(axis=1, keepdims=True), 1.0 / problem.mdp.n_actions)
