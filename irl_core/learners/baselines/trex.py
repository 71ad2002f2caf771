"""T-REX with a linear reward: weights under which better attempts are worth more than worse ones.

An attempt is worth w·φ_i, φ_i the sum of the features of its states. Of a pair the better one is preferred with
probability σ(w·φ_better − w·φ_worse) (Bradley and Terry 1952; Brown et al. 2019, Eq. 2, with a linear reward for their
network). Pairs are those of the two rankings (a tie makes none) and every success over every usable failure. With the
pairs as rows of a matrix E, +1 at the better attempt and −1 at the worse, Φ (N, K) and z = E Φ w,

    min_w  f(w) = Σ_p log(1 + e^{−z_p}) + ℓ₂/2 ‖w‖²,

strictly convex. Its gradient is −Φᵀ Eᵀ σ(−z) + ℓ₂ w, so the minimum has the form w = Φᵀ b: N numbers b, one an attempt,
however many features there are. With G = Φ Φᵀ and F(b) = ℓ₂ b − Eᵀ σ(−E G b) Newton's step is

    (ℓ₂ I + Eᵀ diag(σ′(z)) E G) Δ = −F(b),

halved until f falls enough (Armijo). It has converged when ‖∇f‖∞ = ‖Φᵀ F‖∞ < 10⁻⁹ · max(1, ‖Φ‖∞). Brown et al. sample
pieces of attempts to have more pairs and train a policy by reinforcement learning; here whole attempts are compared and
the plan is exact (`report.py`, hence R shown is shifted to costs, while `weights` are w itself). The log-likelihood is
−f without its ridge. A state holds b as `worth`, shape (N,), in the order of ids: how much each attempt is to follow.
"""

from dataclasses import dataclass, field
from typing import Final, final

import numpy as np

from irl_core.arrays import Matrix, Vector
from irl_core.errors import IrlError
from irl_core.learners.base import Family, Frame, LearningResult, LearningState, Outcome
from irl_core.learners.baselines import report
from irl_core.learners.problem import LearningProblem
from irl_core.types import Demonstration

_FLAT: Final = 1e-9
_ARMIJO: Final = 1e-4
_MAX_HALVINGS: Final = 40


@dataclass(frozen=True, eq=False)
class Preferences:
    """The attempts, in the order of ids, their feature counts Φ (N, K) and G = Φ Φᵀ, and the pairs E (P, N)."""

    counts: Matrix
    gram: Matrix
    pairs: Matrix


@final
@dataclass(frozen=True)
class Trex:
    """A Bradley–Terry reward over pairs of attempts, then the optimal plan."""

    name: str = field(default="trex", init=False)
    title: str = field(default="T-REX (linear)", init=False)
    summary: str = field(
        default="Finds a reward under which better-ranked attempts are worth more than worse ones, and plans on it.",
        init=False,
    )
    family: Family = field(default="baseline", init=False)
    uses_ranking: bool = field(default=True, init=False)
    uses_failures: bool = field(default=True, init=False)
    uses_scores: bool = field(default=False, init=False)
    takes_anything: bool = field(default=False, init=False)
    references: tuple[str, ...] = field(
        default=(
            (
                "Brown, Goo, Nagarajan, Niekum: Extrapolating beyond suboptimal demonstrations via inverse"
                " reinforcement learning from observations. ICML 2019."
            ),
            "Bradley, Terry: Rank analysis of incomplete block designs. Biometrika 39, 1952.",
        ),
        init=False,
    )

    def start(self, problem: LearningProblem) -> LearningState:
        """No attempt counts for anything."""
        problem.require(self)
        return LearningState(self.name, 0, {"worth": np.zeros(len(_attempts(problem)))})

    def advance(self, problem: LearningProblem, state: LearningState, *, iterations: int) -> LearningState:
        """Newton steps."""
        if len(state.vector("worth")) != len(_attempts(problem)):
            raise IrlError("The state is of other demonstrations than this problem's.", field="state")
        preferences = preferences_of(problem)
        for _ in range(iterations):
            if state.is_finished:
                break
            state = _iterate(problem, preferences, state)
        return state

    def frame(self, problem: LearningProblem, state: LearningState) -> Frame:
        """The plan so far."""
        learned = self._learned(problem, state)
        return report.frame(problem, state, learned, iterations=problem.settings.iterations)

    def result(self, problem: LearningProblem, state: LearningState) -> LearningResult:
        """The plan, and how many preferences the reward meets."""
        return report.result(problem, state, self._learned(problem, state))

    def _learned(self, problem: LearningProblem, state: LearningState) -> report.Learned:
        preferences, worth = preferences_of(problem), state.vector("worth")
        margins = preferences.pairs @ (preferences.gram @ worth)
        weights: Vector = preferences.counts.T @ worth
        reward = report.as_costs(problem, problem.features.reward(weights))
        return report.Learned(
            weights=weights,
            reward=reward,
            policy=report.planned_policy(problem, reward),
            log_likelihood=-float(np.logaddexp(0.0, -margins).sum()),
            sentence=_sentence(state, margins),
            n_left_out=problem.n_left_out,
        )


def preferences_of(problem: LearningProblem) -> Preferences:
    """Who is better than whom: along each ranking, and every success over every failure."""
    attempts = _attempts(problem)
    row = {one.id: k for k, one in enumerate(attempts)}
    orders = [
        [[row[id_] for id_ in group if id_ in row] for group in problem.orders.get(outcome, ())]
        for outcome in ("success", "failure")
    ]
    failures_best_first = orders[1][::-1]
    good, bad = ([row[one.id] for one in kept] for kept in (problem.successes, problem.failures))
    found = [*_along(orders[0]), *_along(failures_best_first), *((better, worse) for better in good for worse in bad)]
    pairs = np.zeros((len(found), len(attempts)))
    for p, (better, worse) in enumerate(sorted(found)):
        pairs[p, better], pairs[p, worse] = 1.0, -1.0
    counts = np.array([_counts(problem, one) for one in attempts])
    return Preferences(counts, counts @ counts.T, pairs)


def _along(groups: list[list[int]]) -> list[tuple[int, int]]:
    """Every pair of an order, best group first."""
    return [
        (better, worse)
        for k, group in enumerate(groups)
        for later in groups[k + 1 :]
        for better in group
        for worse in later
    ]


def _attempts(problem: LearningProblem) -> list[Demonstration]:
    return sorted((*problem.successes, *problem.failures), key=lambda one: one.id)


def _counts(problem: LearningProblem, one: Demonstration) -> Vector:
    return problem.features.counts(np.bincount(one.states, minlength=problem.mdp.n_states).astype(np.float64))


def _iterate(problem: LearningProblem, preferences: Preferences, state: LearningState) -> LearningState:
    ridge, worth = problem.settings.preference_l2, state.vector("worth")
    if _slope(preferences, worth, ridge) < _FLAT * max(1.0, float(preferences.counts.max())):
        return state.ended(Outcome.CONVERGED)
    moved = LearningState(state.learner, state.iteration + 1, {"worth": _newton(preferences, worth, ridge)})
    return moved if moved.iteration < problem.settings.iterations else moved.ended(Outcome.ITERATION_LIMIT)


def _slope(preferences: Preferences, worth: Vector, ridge: float) -> float:
    """‖∇f‖∞ at w = Φᵀ b."""
    return float(np.abs(preferences.counts.T @ _residual(preferences, worth, ridge)).max())


def _newton(preferences: Preferences, worth: Vector, ridge: float) -> Vector:
    pairs, gram = preferences.pairs, preferences.gram
    chance = _sigmoid(pairs @ (gram @ worth))
    curvature = pairs.T @ ((chance * (1.0 - chance))[:, None] * pairs)
    residual = _residual(preferences, worth, ridge)
    step = np.linalg.solve(ridge * np.eye(len(worth)) + curvature @ gram, -residual)
    value, slope = _objective(preferences, worth, ridge), float(gram @ residual @ step)
    for halvings in range(_MAX_HALVINGS):
        moved: Vector = worth + 0.5**halvings * step
        if _objective(preferences, moved, ridge) <= value + _ARMIJO * 0.5**halvings * slope:
            return moved
    return worth + step  # no digit left to tell f apart: Newton's step itself is the best there is


def _objective(preferences: Preferences, worth: Vector, ridge: float) -> float:
    values = preferences.gram @ worth
    return float(np.logaddexp(0.0, -(preferences.pairs @ values)).sum() + ridge / 2 * (worth @ values))


def _residual(preferences: Preferences, worth: Vector, ridge: float) -> Vector:
    """F(b), shape (N,)."""
    margins = preferences.pairs @ (preferences.gram @ worth)
    residual: Vector = ridge * worth - preferences.pairs.T @ _sigmoid(-margins)
    return residual


def _sigmoid(x: Vector) -> Vector:
    """1 / (1 + e^{−x}), without overflow."""
    chance: Vector = np.exp(-np.logaddexp(0.0, -x))
    return chance


def _sentence(state: LearningState, margins: Vector) -> str:
    met = f"{int((margins > 0.0).sum())} of {len(margins)} preferences are met"
    match state.outcome:
        case Outcome.CONVERGED:
            return f"Converged after {state.iteration} Newton steps: {met}."
        case Outcome.ITERATION_LIMIT:
            return f"The limit of {state.iteration} Newton steps came first: {met}."
    return f"Stopped after {state.iteration} Newton steps: {met}."
