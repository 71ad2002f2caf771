"""Score-based IRL: regress what attempts earned on what they passed. It is told the totals, as no other learner is.

The total of attempt i is linear in the reward, y_i = Σ_t R(s_{i,t+1}) = w·φ_i, where φ_i sums the features of the
states it *reached* (the start's own reward is not paid). Ridge regression,

    min_w  Σ_i (y_i − w·φ_i)² + ℓ₂ ‖w‖²    ⇒    w = Φᵀ (Φ Φᵀ + ℓ₂ I)⁻¹ y,    Φ of shape (N, K),

in its dual form, a system of N equations however many features there are. N attempts say little about K = S squares:
what they share is spread over them evenly (the least ‖w‖). El Asri et al. (2016) regress scores on discounted features
by least squares; Burchfiel et al. (2016) minimise the distance to scores likewise. It uses every demonstration,
failures that never arrived too: they have a score. The policy is that of `report.py`, hence R shown is shifted to
costs, while `weights` are w itself. The log-likelihood is −½ (Σ (y_i − w·φ_i)² / ℓ₂ + ‖w‖²), up to a constant that of a
Gaussian posterior whose mode is w. One iteration; the state holds `weights`, shape (K,).
"""

from dataclasses import dataclass, field
from typing import final

import numpy as np

from irl_core.arrays import Matrix, Vector
from irl_core.learners.base import Family, Frame, LearningResult, LearningState, Outcome
from irl_core.learners.baselines import report
from irl_core.learners.problem import LearningProblem
from irl_core.types import Demonstration


@final
@dataclass(frozen=True)
class ScoreIrl:
    """Ridge regression of totals on feature counts, then the optimal plan."""

    name: str = field(default="score_irl", init=False)
    title: str = field(default="Score-based IRL (uses scores)", init=False)
    summary: str = field(
        default="Is told what each attempt earned, fits a reward that explains these totals, and plans on it.",
        init=False,
    )
    family: Family = field(default="baseline", init=False)
    uses_ranking: bool = field(default=False, init=False)
    uses_failures: bool = field(default=True, init=False)
    uses_scores: bool = field(default=True, init=False)
    takes_anything: bool = field(default=False, init=False)
    references: tuple[str, ...] = field(
        default=(
            "El Asri, Piot, Geist, Laroche, Pietquin: Score-based inverse reinforcement learning. AAMAS 2016.",
            "Burchfiel, Tomasi, Parr: Distance minimization for reward learning from scored trajectories. AAAI 2016.",
        ),
        init=False,
    )

    def start(self, problem: LearningProblem) -> LearningState:
        """No reward anywhere."""
        problem.require(self)
        return LearningState(self.name, 0, {"weights": np.zeros(problem.features.n_features)})

    def advance(self, problem: LearningProblem, state: LearningState, *, iterations: int) -> LearningState:
        """Solve."""
        if state.is_finished or iterations < 1:
            return state
        return LearningState(self.name, 1, {"weights": _regressed(problem)}, Outcome.CONVERGED)

    def frame(self, problem: LearningProblem, state: LearningState) -> Frame:
        """The plan so far."""
        return report.frame(problem, state, self._learned(problem, state), iterations=1)

    def result(self, problem: LearningProblem, state: LearningState) -> LearningResult:
        """The plan, and how well the totals are met."""
        return report.result(problem, state, self._learned(problem, state))

    def _learned(self, problem: LearningProblem, state: LearningState) -> report.Learned:
        weights = state.vector("weights")
        counts, totals = _scored(problem)
        misses = totals - counts @ weights
        ridge = problem.settings.score_l2
        reward = report.as_costs(problem, problem.features.reward(weights))
        return report.Learned(
            weights=weights,
            reward=reward,
            policy=report.planned_policy(problem, reward),
            log_likelihood=-0.5 * float(misses @ misses / ridge + weights @ weights),
            sentence=(
                f"Fitted the totals of {len(totals)} attempts to within {np.abs(misses).max():.2g}. It was told these"
                " totals, which the other learners never see."
            ),
        )


def _regressed(problem: LearningProblem) -> Vector:
    counts, totals = _scored(problem)
    within = counts @ counts.T + problem.settings.score_l2 * np.eye(len(totals))
    weights: Vector = counts.T @ np.linalg.solve(within, totals)
    return weights


def _scored(problem: LearningProblem) -> tuple[Matrix, Vector]:
    """Feature counts of what each attempt reached, shape (N, K), and the totals, shape (N,), in the order of ids."""
    ordered = sorted(problem.demonstrations, key=lambda one: one.id)
    return np.array([_reached(problem, one) for one in ordered]), np.array([one.total for one in ordered])


def _reached(problem: LearningProblem, one: Demonstration) -> Vector:
    visits = np.bincount(one.states[1:], minlength=problem.mdp.n_states).astype(np.float64)
    return problem.features.counts(visits)
