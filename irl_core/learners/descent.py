"""The descent that the four learners of the paper share.

Features are one-hot, so the weights w are the reward: R(s) = w_s. With the feature counts μ̃ᴰ of successes and μ̃ᶠ of
failures (`weights.py`) and the expected visits μ^π of the path distribution that R implies (`planning.py`), one
iteration is, in the order of the paper's Algorithm 5 (its line 12, `computeGradient`, is Algorithm 3, `updateWeights`):

    R   ← w_D + w_F                                   (line 8)
    μ^π ← computeFE(computePolicy(R))                 (9–11; D and F share their start, so μ^π|F = μ^π|D)
    w_D ← w_D − α (μ^π − μ̃ᴰ)                          (12; the gradient of −Σ θ_i log P(ζ_i))
    w_F ← (μ^π − μ̃ᶠ) / λ                              (13, Eq. 6, with the λ of this iteration)
    λ   ← max(α_λ λ, λ_min)   while λ > λ_min         (14–16; the paper lets the last step fall below λ_min)

MEIRL and IRLR leave w_F at 0. The iterations end when ‖μ^π − μ̃ᴰ‖∞ < tolerance, *before* the update, so that the result
is the very reward that met it; or at the limit; or when a weight leaves ±10⁶, beyond which log Z keeps too few digits.

*A fixed point of IRLF is one of MEIRL*: w_D moves until μ^π = μ̃ᴰ whatever w_F is, so with one-hot features failures
change the way, not the end. Their gain at a given number of iterations is faster descent; and as 1 / λ times the
curvature of log Z grows past 1, positive feedback that oscillates (IRLF, IRLFR at small λ_min).
"""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from irl_core import grid
from irl_core.arrays import Vector
from irl_core.errors import IrlError
from irl_core.evaluation import expected_visits
from irl_core.learners.base import Frame, LearningResult, LearningState, Outcome
from irl_core.learners.problem import LearningProblem
from irl_core.planning import SoftPlan, soft_plan, spectral_radius, visitation
from irl_core.types import Demonstration, World
from irl_core.weights import feature_counts

WEIGHT_LIMIT: Final = 1e6
WIDE_GAP: Final = 0.5
"""In visits of one square: from here on the sentence warns."""


@dataclass(frozen=True, eq=False)
class Aims:
    """What a learner steers toward, μ̃ᴰ, and away from, μ̃ᶠ, each of shape (S,); and Σ θ_i log Π T of the successes."""

    successes: Vector
    failures: Vector | None
    log_dynamics: float


@dataclass(frozen=True, eq=False)
class Moment:
    """All that one reward implies."""

    plan: SoftPlan
    visits: Vector
    gap: float
    log_likelihood: float


def aims_of(problem: LearningProblem, *, uses_ranking: bool, uses_failures: bool) -> Aims:
    """The counts of successes and, if used, failures; ranked or all alike."""
    world = problem.world
    weights = problem.success_weights(ranked=uses_ranking)
    failures = None
    if uses_failures:
        failures = feature_counts(world, problem.failures, problem.failure_weights(ranked=uses_ranking))
    return Aims(
        successes=feature_counts(world, problem.successes, weights),
        failures=failures,
        log_dynamics=math.fsum(weights[one.id] * _log_dynamics(world, one) for one in problem.successes),
    )


def start(problem: LearningProblem, *, learner: str) -> LearningState:
    """Before the first iteration. Start weights that are drawn are the same for every learner of a run."""
    n_states = problem.world.n_states
    w_success: Vector = np.zeros(n_states)
    if problem.settings.initial_weights == "uniform":
        rng = np.random.default_rng(np.random.SeedSequence([problem.seed, *b"initial weights"]))
        w_success = rng.uniform(-1.0, 1.0, n_states)
    return LearningState(learner, 0, w_success, np.zeros(n_states), problem.settings.lambda_start)


def advance(problem: LearningProblem, state: LearningState, aims: Aims, *, iterations: int) -> LearningState:
    """Up to `iterations` more iterations, fewer if learning ends."""
    if len(state.w_success) != problem.world.n_states:
        raise IrlError(f"The state is of a world with {len(state.w_success)} squares, not this one.", field="state")
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
        reward=state.reward,
        policy=moment.plan.policy,
        visitation=moment.visits,
    )


def result(problem: LearningProblem, state: LearningState, aims: Aims) -> LearningResult:
    """What the state implies, and how it came to be; a state that has not ended by itself was stopped."""
    world, moment = problem.world, look(problem, state, aims)
    executed = expected_visits(world, moment.plan.policy)
    rho = spectral_radius(world, state.reward)
    executed_gap = float(np.abs(executed - moment.visits).max())
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
        reward=state.reward,
        policy=moment.plan.policy,
        visitation=moment.visits,
        n_left_out=problem.n_left_out if aims.failures is not None else 0,
        shape=(world.rows, world.cols),
        spectral_radius=rho,
        executed_gap=executed_gap,
    )


def look(problem: LearningProblem, state: LearningState, aims: Aims) -> Moment:
    """Plan for R = w_D + w_F and compare with the successes: Σ θ_i log P(ζ_i) = μ̃ᴰ·R − log Z + Σ θ_i log Π T."""
    reward = state.reward
    plan = soft_plan(problem.world, reward)
    visits = visitation(problem.world, plan)
    return Moment(
        plan=plan,
        visits=visits,
        gap=float(np.abs(visits - aims.successes).max()),
        log_likelihood=float(aims.successes @ reward) - plan.log_partition + aims.log_dynamics,
    )


def _iterate(problem: LearningProblem, state: LearningState, aims: Aims) -> LearningState:
    """One iteration; at the last one allowed, also the verdict."""
    settings, moment = problem.settings, look(problem, state, aims)
    if moment.gap < settings.tolerance:
        return _ended(state, Outcome.CONVERGED)
    w_success = state.w_success - settings.learning_rate * (moment.visits - aims.successes)
    w_failure = state.w_failure
    if aims.failures is not None:
        w_failure = (moment.visits - aims.failures) / state.lam
    if not max(np.abs(w_success).max(), np.abs(w_failure).max()) <= WEIGHT_LIMIT:
        return _ended(state, Outcome.DIVERGED)
    lam = max(settings.lambda_decay * state.lam, settings.lambda_min)
    moved = LearningState(state.learner, state.iteration + 1, w_success, w_failure, lam)
    if moved.iteration < settings.iterations:
        return moved
    has_converged = look(problem, moved, aims).gap < settings.tolerance
    return _ended(moved, Outcome.CONVERGED if has_converged else Outcome.ITERATION_LIMIT)


def _ended(state: LearningState, outcome: Outcome) -> LearningState:
    return LearningState(state.learner, state.iteration, state.w_success, state.w_failure, state.lam, outcome)


def _log_dynamics(world: World, demonstration: Demonstration) -> float:
    """Log Π_t T(s_{t+1} | s_t, a_t), 0 without slip; several directions may lead to the same square."""
    if world.slip == 0.0:
        return 0.0
    chances = np.full((demonstration.n_steps, grid.N_ACTIONS), world.slip / (grid.N_ACTIONS - 1))
    chances[np.arange(demonstration.n_steps), demonstration.actions] = 1.0 - world.slip
    led_there = world.next_states[demonstration.states[:-1]] == demonstration.states[1:, None]
    return float(np.log((chances * led_there).sum(axis=1)).sum())


def _how_it_ended(problem: LearningProblem, state: LearningState, outcome: Outcome, gap: float) -> str:
    n, limit = state.iteration, problem.settings.iterations
    visits = f"the gap to the attempts is {gap:.2g} {'visit' if f'{gap:.2g}' == '1' else 'visits'} of a square"
    if outcome is Outcome.CONVERGED:
        return f"Converged after {n} iterations: {visits}."
    if outcome is Outcome.STOPPED:
        return f"Stopped after {n} of {limit} iterations: {visits}."
    if outcome is Outcome.DIVERGED:
        return (
            f"The learned reward grew beyond a million after {n} iterations; shown is the last before. A smaller"
            " learning rate or a larger λ_min steadies it."
        )
    advice = " That is still wide: allow more iterations, or a larger λ_min if failures are used." * (gap >= WIDE_GAP)
    return f"The limit of {limit} iterations came first: {visits}.{advice}"


def _what_to_know(problem: LearningProblem, *, rho: float, executed_gap: float) -> list[str]:
    notes = []
    if rho >= 1.0:
        horizon = problem.world.horizon
        notes.append(
            f"The reward is such that the policy depends on the horizon of {horizon} steps (ρ = {rho:.3g} ≥ 1)."
        )
    if executed_gap >= WIDE_GAP:
        notes.append(
            "Executed at every step alike, the policy differs from what was learned by up to"
            f" {executed_gap:.2g} visits of a square."
        )
    return notes
