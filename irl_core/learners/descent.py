"""The descent that the four learners of the paper share.

The reward is linear in the features, R = φ (w_D + w_F), φ of shape (S, K); one-hot by default, so that the weights are
the reward. With the feature counts μ̃ᴰ of successes and μ̃ᶠ of failures (`weights.py`, `features.py`) and the expected
feature counts φᵀμ^π of the path distribution that R implies (`inference`), from the starts of D and of F, one iteration
is, in the order of the paper's Algorithm 5 (its line 12, `computeGradient`, is Algorithm 3, `updateWeights`):

    R   ← φ (w_D + w_F)                               (line 8)
    μ^π ← computeFE(computePolicy(R))                 (9–11; where D and F start alike, μ^π|F = μ^π|D)
    w_D ← w_D − α (φᵀμ^π|D − μ̃ᴰ + ℓ₂ w_D)             (12; the gradient of f below)
    w_F ← (φᵀμ^π|F − μ̃ᶠ) / λ                          (13, Eq. 6, with the λ of this iteration)
    λ   ← max(α_λ λ, λ_min)   while λ > λ_min         (14–16; the paper lets the last step fall below λ_min)

MEIRL and IRLR leave w_F at 0, so that they minimise the convex

    f(w) = log Z(φw) − μ̃ᴰ·w + ℓ₂/2 ‖w‖²  =  −Σ θ_i log P(ζ_i) + ℓ₂/2 ‖w‖² + what w does not change,

which the exact optimisers do too, in fewer iterations (`optimisers.py`). The gap is ‖φᵀμ^π − μ̃ᴰ + ℓ₂ w_D‖∞. The
iterations end when it is below the tolerance, *before* the update, so that the result is the very reward that met it;
or at the limit; or when a weight leaves ±10⁶, beyond which log Z keeps too few digits, or (paths of any length) when
log Z becomes infinite.

*What failures do.* While λ is constant, w_F changes by (φᵀμ^π_t − φᵀμ^π_{t−1}) / λ: the counts μ̃ᶠ cancel. So with w =
w_D + w_F

    w_{t+1} = w_t − α (φᵀμ^π_t − μ̃ᴰ) + (1/λ) (φᵀμ^π_t − φᵀμ^π_{t−1})  ≈  w_t − α ∇f(w_t) + (H/λ) (w_t − w_{t−1}),

H = φᵀ Cov φ the curvature of log Z: MEIRL's descent with heavy-ball momentum (Polyak 1964), H/λ its factor. What the
failures were decides where it sets out (w_F in the first iterations) and nothing else. Momentum speeds the descent
while its factor is below 1 and never dies out from there on: λ has to stay above σ, the largest eigenvalue of H, which
differs between worlds and along a run, of which the paper's λ_min knows nothing. With `lambda_rule="curvature"` the λ
of line 13 is max(λ, 2σ), half the momentum at which it would never die out, since σ moves from one iteration to the
next. σ is followed by four steps of the power method an iteration, v ← Hv / ‖Hv‖, Hv by a central difference of φᵀμ^π.

*A fixed point of IRLF is one of MEIRL*: w_D moves until φᵀμ^π = μ̃ᴰ whatever w_F is, so failures change the way, not
the end. Their gain at a given number of iterations is faster descent; beyond the critical λ it oscillates.

A state holds w_D, w_F, shape (K,), λ, and what an optimiser or the power method keeps. With `causal` inference the
log-likelihood is f's own, −f at ℓ₂ = 0, which is that of the actions where moves are certain; `ziebart` has no
likelihood that it climbs.
"""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from irl_core.arrays import Vector
from irl_core.errors import DivergentPartition, IrlError
from irl_core.evaluation import expected_visits
from irl_core.inference import Inferred, infer
from irl_core.learners import optimisers
from irl_core.learners.base import Frame, LearningResult, LearningState, Outcome
from irl_core.learners.problem import LearningProblem
from irl_core.mdp.dynamics import transition_chances
from irl_core.planning import spectral_radius
from irl_core.weights import feature_counts, start_counts

WEIGHT_LIMIT: Final = 1e6
WIDE_GAP: Final = 0.5
"""In visits of one square: from here on the sentence warns."""
_TIMES_CURVATURE: Final = 2.0
_POWER_STEPS: Final = 4
_DIFFERENCE: Final = 1e-4
_BELOW_DIVERGENCE: Final = 0.25
"""Paths of any length start from the constant reward −log A − this, where their sum is finite."""


@dataclass(frozen=True, eq=False)
class Aims:
    """What a learner steers toward, μ̃ᴰ, and away from, μ̃ᶠ, shape (K,); where D and F start, shape (S,).

    `log_dynamics` is Σ θ_i log Π T of the successes.
    """

    successes: Vector
    failures: Vector | None
    starts: Vector
    failure_starts: Vector | None
    log_dynamics: float


@dataclass(frozen=True, eq=False)
class Moment:
    """All that one reward implies: for the starts of D, and `failure_counts` φᵀμ^π|F, shape (K,)."""

    inferred: Inferred
    failure_counts: Vector | None
    residual: Vector
    log_likelihood: float

    @property
    def gap(self) -> float:
        """‖φᵀμ^π − μ̃ᴰ + ℓ₂ w_D‖∞."""
        return float(np.abs(self.residual).max())


def aims_of(problem: LearningProblem, *, uses_ranking: bool, uses_failures: bool) -> Aims:
    """The counts of successes and, if used, failures; ranked or all alike."""
    mdp, weights = problem.mdp, problem.success_weights(ranked=uses_ranking)
    discount = _discount(problem)
    failures = failure_starts = None
    if uses_failures:
        theta = problem.failure_weights(ranked=uses_ranking)
        visits = feature_counts(mdp, problem.failures, theta, discount=discount)
        failures, failure_starts = problem.features.counts(visits), start_counts(mdp, problem.failures, theta)
    return Aims(
        successes=problem.features.counts(feature_counts(mdp, problem.successes, weights, discount=discount)),
        failures=failures,
        starts=start_counts(mdp, problem.successes, weights),
        failure_starts=failure_starts,
        log_dynamics=math.fsum(
            weights[one.id] * float(np.log(transition_chances(mdp, one.states, one.actions)).sum())
            for one in problem.successes
        ),
    )


def start(problem: LearningProblem, *, learner: str) -> LearningState:
    """Before the first iteration. Start weights that are drawn are the same for every learner of a run."""
    n_features = problem.features.n_features
    w_success: Vector = np.zeros(n_features)
    if problem.settings.initial_weights == "uniform":
        rng = np.random.default_rng(np.random.SeedSequence([problem.seed, *b"initial weights"]))
        w_success = rng.uniform(-1.0, 1.0, n_features)
    if problem.settings.inference == "path_infinite":
        w_success = w_success + _convergent_constant(problem)
    values: dict[str, Vector | float] = {
        "w_success": w_success,
        "w_failure": np.zeros(n_features),
        "lambda": problem.settings.lambda_start,
    }
    return LearningState(learner, 0, values)


def advance(problem: LearningProblem, state: LearningState, aims: Aims, *, iterations: int) -> LearningState:
    """Up to `iterations` more iterations, fewer if learning ends."""
    n_given, n_features = len(state.vector("w_success")), problem.features.n_features
    if n_given != n_features:
        raise IrlError(f"The state has {n_given} weights; this problem has {n_features}.", field="state")
    for _ in range(iterations):
        if state.is_finished:
            break
        state = _iterate(problem, state, aims)
    return state


def frame(problem: LearningProblem, state: LearningState, aims: Aims) -> Frame:
    """What the state implies, for a person to see."""
    moment = look(problem, state, aims)
    return Frame(
        learner=state.learner,
        iteration=state.iteration,
        iterations=problem.settings.iterations,
        gap=moment.gap,
        log_likelihood=moment.log_likelihood,
        reward=problem.features.reward(_weights(state)),
        policy=moment.inferred.policy,
        visitation=moment.inferred.visitation,
    )


def result(problem: LearningProblem, state: LearningState, aims: Aims) -> LearningResult:
    """What the state implies, and how it came to be; a state that has not ended by itself was stopped."""
    moment, weights = look(problem, state, aims), _weights(state)
    reward = problem.features.reward(weights)
    executed = expected_visits(problem.mdp, moment.inferred.policy, starts=aims.starts, discount=_discount(problem))
    rho = spectral_radius(problem.mdp, reward)
    executed_gap = float(np.abs(executed - moment.inferred.visitation).max())
    outcome = state.outcome or Outcome.STOPPED
    sentences = [
        _how_it_ended(problem, state, outcome, moment.gap),
        *_what_to_know(problem, rho=rho, executed_gap=executed_gap),
    ]
    return LearningResult(
        learner=state.learner,
        outcome=outcome,
        sentence=" ".join(sentences),
        iterations=state.iteration,
        gap=moment.gap,
        log_likelihood=moment.log_likelihood,
        reward=reward,
        policy=moment.inferred.policy,
        visitation=moment.inferred.visitation,
        n_left_out=problem.n_left_out if aims.failures is not None else 0,
        shape=problem.shape,
        spectral_radius=rho,
        executed_gap=executed_gap,
        weights=weights,
    )


def look(problem: LearningProblem, state: LearningState, aims: Aims) -> Moment:
    """Infer for R = φ (w_D + w_F) and compare with the successes: Σ θ_i log P(ζ_i) = μ̃ᴰ·w − log Z + Σ θ_i log Π T."""
    features, weights = problem.features, _weights(state)
    inferred = _infer(problem, weights, aims.starts)
    residual = features.counts(inferred.visitation) - aims.successes
    if problem.settings.l2:
        residual = residual + problem.settings.l2 * state.vector("w_success")
    return Moment(
        inferred=inferred,
        failure_counts=_failure_counts(problem, weights, aims, inferred),
        residual=residual,
        log_likelihood=float(aims.successes @ weights) - inferred.log_partition + aims.log_dynamics,
    )


def objective(problem: LearningProblem, aims: Aims) -> optimisers.Objective:
    """The convex f above and its gradient; infinite where the path sum is."""

    def value_and_gradient(weights: Vector) -> tuple[float, Vector]:
        try:
            inferred = _infer(problem, weights, aims.starts)
        except DivergentPartition:
            return math.inf, np.zeros_like(weights)
        ridge = problem.settings.l2 * weights
        value = inferred.log_partition - float(aims.successes @ weights) + float(ridge @ weights) / 2
        return value, problem.features.counts(inferred.visitation) - aims.successes + ridge

    return value_and_gradient


def _iterate(problem: LearningProblem, state: LearningState, aims: Aims) -> LearningState:
    """One iteration; at the last one allowed, also the verdict."""
    settings, moment = problem.settings, look(problem, state, aims)
    if moment.gap < settings.tolerance:
        return state.ended(Outcome.CONVERGED)
    moved = _moved(problem, state, aims, moment)
    if moved is None:
        return state.ended(Outcome.DIVERGED)
    if moved.iteration < settings.iterations:
        return moved
    has_converged = look(problem, moved, aims).gap < settings.tolerance
    return moved.ended(Outcome.CONVERGED if has_converged else Outcome.ITERATION_LIMIT)


def _moved(problem: LearningProblem, state: LearningState, aims: Aims, moment: Moment) -> LearningState | None:
    """The state after the update, or None where it would leave the rewards that can be computed with."""
    if aims.failures is None and problem.settings.optimiser != "descent":
        values = optimisers.step(problem.settings.optimiser, objective(problem, aims), state.values)
    else:
        values = _descended(problem, state, aims, moment)
    moved = LearningState(state.learner, state.iteration + 1, values)
    if not max(np.abs(moved.vector("w_success")).max(), np.abs(moved.vector("w_failure")).max()) <= WEIGHT_LIMIT:
        return None
    if problem.settings.inference != "path_infinite":
        return moved
    try:
        look(problem, moved, aims)
    except DivergentPartition:
        return None
    return moved


def _descended(problem: LearningProblem, state: LearningState, aims: Aims, moment: Moment) -> dict[str, Vector | float]:
    settings, lam = problem.settings, state.number("lambda")
    values: dict[str, Vector | float] = {
        "w_success": state.vector("w_success") - settings.learning_rate * moment.residual,
        "w_failure": state.vector("w_failure"),
        "lambda": max(settings.lambda_decay * lam, settings.lambda_min),
    }
    if aims.failures is None or moment.failure_counts is None:
        return values
    if settings.lambda_rule == "curvature":
        values["curvature_vector"], curvature = _largest_curvature(problem, state, aims)
        lam = max(lam, _TIMES_CURVATURE * curvature)
    values["w_failure"] = (moment.failure_counts - aims.failures) / lam
    return values


def _largest_curvature(problem: LearningProblem, state: LearningState, aims: Aims) -> tuple[Vector, float]:
    """The power method on H, from where the last iteration left it: v, of length 1, and σ ≈ ‖Hv‖."""
    weights, starts = _weights(state), aims.starts if aims.failure_starts is None else aims.failure_starts
    v = state.values.get("curvature_vector")
    if not isinstance(v, np.ndarray):
        v = np.full(len(weights), len(weights) ** -0.5)
    length = 0.0
    for _ in range(_POWER_STEPS):
        there, back = (
            problem.features.counts(_infer(problem, weights + h * v, starts).visitation)
            for h in (_DIFFERENCE, -_DIFFERENCE)
        )
        h_times_v: Vector = (there - back) / (2 * _DIFFERENCE)
        length = float(np.linalg.norm(h_times_v))
        if length == 0.0:
            break
        v = h_times_v / length
    return v, length


def _weights(state: LearningState) -> Vector:
    """The sum w_D + w_F, shape (K,)."""
    return state.vector("w_success") + state.vector("w_failure")


def _infer(problem: LearningProblem, weights: Vector, starts: Vector) -> Inferred:
    settings = problem.settings
    return infer(
        problem.mdp,
        problem.features.reward(weights),
        inference=settings.inference,
        discount=settings.discount,
        starts=starts,
    )


def _failure_counts(problem: LearningProblem, weights: Vector, aims: Aims, inferred: Inferred) -> Vector | None:
    """Expected feature counts from where failures start; those of the successes where the two start alike."""
    if aims.failure_starts is None:
        return None
    if not np.array_equal(aims.failure_starts, aims.starts):
        inferred = _infer(problem, weights, aims.failure_starts)
    return problem.features.counts(inferred.visitation)


def _discount(problem: LearningProblem) -> float:
    """The discount γ, which only causal inference knows."""
    return problem.settings.discount if problem.settings.inference == "causal" else 1.0


def _convergent_constant(problem: LearningProblem) -> Vector:
    """Weights of a reward that is, as nearly as the features can, −log A − ¼ everywhere: there the sum is finite."""
    wanted: Vector = np.full(problem.mdp.n_states, -math.log(problem.mdp.n_actions) - _BELOW_DIVERGENCE)
    if problem.features.name == "one_hot":
        return wanted
    nearest, *_ = np.linalg.lstsq(problem.features.dense(), wanted, rcond=None)
    return np.asarray(nearest, dtype=np.float64).reshape(-1)


def _how_it_ended(problem: LearningProblem, state: LearningState, outcome: Outcome, gap: float) -> str:
    n, limit = state.iteration, problem.settings.iterations
    unit = "visits of a square" if problem.features.name == "one_hot" else "in the count of a feature"
    if unit.startswith("visits") and f"{gap:.2g}" == "1":
        unit = "visit of a square"
    visits = f"the gap to the attempts is {gap:.2g} {unit}"
    if outcome is Outcome.CONVERGED:
        return f"Converged after {n} iterations: {visits}."
    if outcome is Outcome.STOPPED:
        return f"Stopped after {n} of {limit} iterations: {visits}."
    if outcome is Outcome.DIVERGED:
        return f"{_how_it_diverged(problem)} after {n} iterations; shown is the last before. {_remedy(problem)}"
    advice = " That is still wide: allow more iterations, or a larger λ_min if failures are used." * (gap >= WIDE_GAP)
    return f"The limit of {limit} iterations came first: {visits}.{advice}"


def _how_it_diverged(problem: LearningProblem) -> str:
    if problem.settings.inference == "path_infinite":
        return "The sum over paths of any length became infinite"
    return "The learned reward grew beyond a million"


def _remedy(problem: LearningProblem) -> str:
    if problem.settings.inference == "path_infinite":
        return "A smaller learning rate, the optimiser newton, or paths of at most N steps (inference path) avoid it."
    return "A smaller learning rate or a larger λ_min steadies it."


def _what_to_know(problem: LearningProblem, *, rho: float, executed_gap: float) -> list[str]:
    notes = []
    if rho >= 1.0 and problem.settings.inference == "path":
        horizon = problem.mdp.horizon
        notes.append(
            f"The reward is such that the policy depends on the horizon of {horizon} steps (ρ = {rho:.3g} ≥ 1)."
        )
    if executed_gap >= WIDE_GAP:
        notes.append(
            "Executed at every step alike, the policy differs from what was learned by up to"
            f" {executed_gap:.2g} visits of a square."
        )
    return notes
