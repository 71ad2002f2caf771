"""Model-free IRLFR: the paper's descent without a transition table, from episodes that a simulator plays.

IRLFR (`descent.py`) needs μ^π, the expected visits of the path distribution of the reward R learned so far. Here it is
μ̂^π, estimated by importance sampling (`inference/sampled.py`, the idea of relative-entropy IRL, Boularias, Kober and
Peters 2011) from n episodes an iteration, played by a proposal π. Only states and actions are looked at. No count of
transitions is kept, so that nothing here becomes a model in disguise. Two figures of the result alone, ρ and the
executed gap, are computed from the model: they are for the reader and nothing is learned from them.

**Adaptive proposals.** Under random play few paths are good ones and a handful of weights decides everything. So π
follows the learned reward. With Ẑ(s, a) the estimated weight of all paths that begin with a in s,

    π(a | s) = (1 − ε) Ẑ(s, a) / Σ_b Ẑ(s, b) + ε / A,     ε = 0.1.

Were Ẑ exact and ε = 0, every weight of a path would be the same (without slip): the better π, the better the next
estimate. Ẑ(s, a) is a sum of weights over a number of tries, both forgotten by the factor f_k =
min(0.95, 1 − 1 / (2 + k / 10)) at iteration k: quickly while the reward moves fast. The first proposal is random play.
Where nothing has arrived from later on, π is half random and half what the demonstrators did there (guided cost
learning draws on demonstrations likewise; Finn, Levine and Abbeel 2016). The policy shown and executed is
Ẑ(s, a) / Σ_b Ẑ(s, b): no model is needed to act, either.

**Descent.** That of IRLFR with the same settings, inference always over paths of at most N steps. It differs in four
ways, which keep R where samples can speak for it, that is, away from ρ ≥ 1, where long paths outnumber all others and
no sample shows it:

1. It starts from R = −log A − ½ instead of 0 (as nearly as the features can; `initial_weights` adds to it). At −log A,
   P is what random play gives, the base measure of relative-entropy IRL; ½ more makes long paths rare. One-hot weights
   absorb the constant.
2. A change of w_D and w_F is halved until `effective`, on the very same episodes weighed for the changed reward, is at
   least 0.8 of what it was: a trust region, as in relative-entropy policy search.
3. λ counts for at least 2C / (1 + αC), C the largest eigenvalue of the Hessian of log Z, the covariance of visits.
   For r, the part of R − R* along that eigenvector, the two updates in small steps read ẇ_D = −αCr, ẇ_F = (C/λ)r − w_F;
   their matrix has determinant αC and trace C/λ − 1 − αC, so the fixed point attracts only where λ > C / (1 + αC).
   Below it failures drive the oscillations that the paper reports as variance. The fixed point itself knows no λ.
4. An iteration in which fewer than 2 % of the episodes count lowers R by 0.1 everywhere instead; one in which nothing
   arrived leaves R alone and forgets what π had come to.

With demonstrators who know where they go little but the first is noticed. `bench/core/model_free.py` measures the
distance to the exact descent. Iterations end as in `descent.py`, but μ̂^π carries noise, so a tight tolerance is seldom
met.

A state holds w_D, w_F, shape (K,); λ; `log_worth`, the log of the sums of weights, and `tries`, shape (S·A,). The
episodes of iteration k are drawn from the seed and k alone, so a state says everything.
"""

import math
from dataclasses import dataclass, field, replace
from typing import Final, final

import numpy as np

from irl_core.arrays import BoolVector, Matrix, Policy, Vector
from irl_core.errors import IrlError
from irl_core.evaluation import expected_visits
from irl_core.inference.sampled import LOG_ZERO, Sample, infer_sampled
from irl_core.learners.base import Family, Frame, LearningResult, LearningState, Outcome
from irl_core.learners.descent import WEIGHT_LIMIT
from irl_core.learners.problem import LearningProblem
from irl_core.planning import spectral_radius
from irl_core.simulators import Simulator, TableSimulator
from irl_core.weights import feature_counts, start_counts

EXPLORATION: Final = 0.1
_BELOW_RANDOM: Final = 0.5
_OVERLAP: Final = 0.8
_SHORTEST_STEP: Final = 1e-6
_LAMBDA_MARGIN: Final = 2.0
"""Times the bound below which no fixed point attracts: 1 left Boltzmann players in oscillations, 1.5 and 2 did not."""
_FEW: Final = 0.02
_DEARER: Final = 0.1
_NOISY: Final = 0.05
"""Where fewer of the episodes than this count, the sentence says so."""
_LONGEST_MEMORY: Final = 0.95
_CLOSER_LOOK: Final = 10
"""The result is measured on this many times the episodes of an iteration."""


@dataclass(frozen=True, eq=False)
class Aims:
    """What to steer toward and away from, μ̃ᴰ and μ̃ᶠ, shape (K,), and where D and F start, shape (S,)."""

    successes: Vector
    failures: Vector
    starts: Vector
    failure_starts: Vector


@final
@dataclass(frozen=True)
class ModelFree:
    """IRLFR from sampled episodes. Without a `simulator` the problem's model is played, and only played."""

    simulator: Simulator | None = None
    name: str = field(default="model_free", init=False)
    title: str = field(default="Model-free IRLFR", init=False)
    summary: str = field(
        default="IRLFR that knows no transitions: it learns by playing many episodes of its own in a simulator.",
        init=False,
    )
    family: Family = field(default="ours", init=False)
    uses_ranking: bool = field(default=True, init=False)
    uses_failures: bool = field(default=True, init=False)
    uses_scores: bool = field(default=False, init=False)
    takes_anything: bool = field(default=False, init=False)
    references: tuple[str, ...] = field(
        default=(
            "Inverse reinforcement learning through failure and ranking (the IRLFR paper), Sec. III-D.",
            "Boularias, Kober, Peters: Relative entropy inverse reinforcement learning. AISTATS 2011.",
            "Finn, Levine, Abbeel: Guided cost learning. ICML 2016.",
            "Ziebart, Maas, Bagnell, Dey: Maximum entropy inverse reinforcement learning. AAAI 2008.",
        ),
        init=False,
    )

    def start(self, problem: LearningProblem) -> LearningState:
        """The reward under which random play is the path distribution; nothing is known of the world yet."""
        problem.require(self)
        w_success, features = _constant(problem, -math.log(problem.mdp.n_actions) - _BELOW_RANDOM), problem.features
        if problem.settings.initial_weights == "uniform":
            rng = np.random.default_rng(np.random.SeedSequence([problem.seed, *b"initial weights"]))
            w_success = w_success + rng.uniform(-1.0, 1.0, features.n_features)
        values: dict[str, Vector | float] = {
            "w_success": w_success,
            "w_failure": np.zeros(features.n_features),
            "lambda": problem.settings.lambda_start,
            **_nothing_known(problem),
        }
        return LearningState(self.name, 0, values)

    def advance(self, problem: LearningProblem, state: LearningState, *, iterations: int) -> LearningState:
        """Play, weigh, step; fewer iterations if learning ends."""
        _check_state(problem, state)
        simulator, aims = self._simulator(problem), aims_of(problem)
        for _ in range(iterations):
            if state.is_finished:
                break
            state = _iterate(problem, simulator, aims, state)
        return state

    def frame(self, problem: LearningProblem, state: LearningState) -> Frame:
        """What the episodes of this iteration show."""
        _check_state(problem, state)
        aims = aims_of(problem)
        sample = look(problem, self._simulator(problem), aims, state)
        return Frame(
            learner=self.name,
            iteration=state.iteration,
            iterations=problem.settings.iterations,
            gap=_gap(problem, aims, state, sample),
            log_likelihood=_log_likelihood(aims, state, sample),
            reward=problem.features.reward(_weights(state)),
            policy=learned_policy(problem, _remembering(state, sample)),
            visitation=sample.visits(),
        )

    def result(self, problem: LearningProblem, state: LearningState) -> LearningResult:
        """What it came to, on ten times as many episodes. The log-likelihood leaves out log Π T, which is unknown."""
        _check_state(problem, state)
        aims = aims_of(problem)
        sample = look(problem, self._simulator(problem), aims, state, times=_CLOSER_LOOK)
        policy, weights = learned_policy(problem, _remembering(state, sample)), _weights(state)
        reward, visits, gap = problem.features.reward(weights), sample.visits(), _gap(problem, aims, state, sample)
        outcome = state.outcome or Outcome.STOPPED
        return LearningResult(
            learner=self.name,
            outcome=outcome,
            sentence=_sentence(problem, state, outcome, gap=gap, effective=sample.effective),
            iterations=state.iteration,
            gap=gap,
            log_likelihood=_log_likelihood(aims, state, sample),
            reward=reward,
            policy=policy,
            visitation=visits,
            n_left_out=problem.n_left_out,
            shape=problem.shape,
            spectral_radius=spectral_radius(problem.mdp, reward),
            executed_gap=float(np.abs(expected_visits(problem.mdp, policy, starts=aims.starts) - visits).max()),
            weights=weights,
        )

    def _simulator(self, problem: LearningProblem) -> Simulator:
        return self.simulator or TableSimulator(problem.mdp)


def aims_of(problem: LearningProblem) -> Aims:
    """The counts of ranked successes and failures, and where they start."""
    mdp, features = problem.mdp, problem.features
    good, bad = problem.success_weights(ranked=True), problem.failure_weights(ranked=True)
    return Aims(
        successes=features.counts(feature_counts(mdp, problem.successes, good)),
        failures=features.counts(feature_counts(mdp, problem.failures, bad)),
        starts=start_counts(mdp, problem.successes, good),
        failure_starts=start_counts(mdp, problem.failures, bad),
    )


def look(problem: LearningProblem, simulator: Simulator, aims: Aims, state: LearningState, *, times: int = 1) -> Sample:
    """Play an iteration's episodes (or other ones, `times` as many) and weigh them by the state's reward."""
    policy = proposal(problem, state)
    rng = _generator(problem, state, purpose=b"episodes" if times == 1 else b"closer look")
    episodes = simulator.play(policy, times * problem.settings.episodes, rng)
    return infer_sampled(episodes, problem.features.reward(_weights(state)), policy, starts=aims.starts)


def proposal(problem: LearningProblem, state: LearningState) -> Policy:
    """The policy π that plays the next episodes, shape (S, A)."""
    log_worth = _log_mean_worth(problem, state)
    known, at_random = _is_known(log_worth), 1.0 / problem.mdp.n_actions
    explored = (1.0 - EXPLORATION) * learned_policy(problem, state) + EXPLORATION * at_random
    unknown = (_imitated(problem) + at_random) / 2.0 if state.iteration else at_random
    return np.where(known[:, None], explored, unknown)


def learned_policy(problem: LearningProblem, state: LearningState) -> Policy:
    """Ẑ(s, a) / Σ_b Ẑ(s, b), shape (S, A); uniform where nothing has arrived from."""
    log_worth = _log_mean_worth(problem, state)
    policy: Policy = np.exp(log_worth - log_worth.max(axis=1, keepdims=True))
    policy /= policy.sum(axis=1, keepdims=True)
    return policy


def _constant(problem: LearningProblem, value: float) -> Vector:
    """Weights of a reward that is this everywhere, or of what comes nearest to it, shape (K,)."""
    wanted: Vector = np.full(problem.mdp.n_states, value)
    if problem.features.name == "one_hot":
        return wanted
    weights: Vector = np.linalg.lstsq(problem.features.dense(), wanted, rcond=None)[0].astype(np.float64)
    return weights


def _iterate(problem: LearningProblem, simulator: Simulator, aims: Aims, state: LearningState) -> LearningState:
    settings, sample = problem.settings, look(problem, simulator, aims, state)
    if sample.arrived and _gap(problem, aims, state, sample) < settings.tolerance:
        return state.ended(Outcome.CONVERGED)
    if not sample.arrived:
        values = _nothing_known(problem)
    elif sample.effective < _FEW * settings.episodes:
        dearer = state.vector("w_success") + _constant(problem, -_DEARER)
        values = {**_remembering(state, sample).values, "w_success": dearer}
    else:
        values = {**_remembering(state, sample).values, **_descended(problem, aims, state, sample)}
    moved = LearningState(state.learner, state.iteration + 1, {**state.values, **values})
    if not max(np.abs(moved.vector("w_success")).max(), np.abs(moved.vector("w_failure")).max()) <= WEIGHT_LIMIT:
        return state.ended(Outcome.DIVERGED)
    return moved if moved.iteration < settings.iterations else moved.ended(Outcome.ITERATION_LIMIT)


def _descended(problem: LearningProblem, aims: Aims, state: LearningState, sample: Sample) -> dict[str, Vector | float]:
    """What the update of IRLFR makes of w_D, w_F and λ, as much of it as the sample can speak for."""
    settings, curvature = problem.settings, sample.curvature()
    lam = max(state.number("lambda"), _LAMBDA_MARGIN * curvature / (1.0 + settings.learning_rate * curvature))
    failure_visits = sample.visits(None if np.array_equal(aims.starts, aims.failure_starts) else aims.failure_starts)
    by_success = -settings.learning_rate * _residual(problem, aims, state, sample)
    by_failure = (problem.features.counts(failure_visits) - aims.failures) / lam - state.vector("w_failure")
    share = _trusted_share(sample, problem.features.reward(by_success + by_failure))
    return {
        "w_success": state.vector("w_success") + share * by_success,
        "w_failure": state.vector("w_failure") + share * by_failure,
        "lambda": max(settings.lambda_decay * state.number("lambda"), settings.lambda_min),
    }


def _trusted_share(sample: Sample, change: Vector) -> float:
    """The largest of 1, ½, ¼, … of a change of the reward, shape (S,), that the sample can still speak for."""
    share = 1.0
    while share > _SHORTEST_STEP and sample.effective_after(share * change) < _OVERLAP * sample.effective:
        share /= 2.0
    return share


def _residual(problem: LearningProblem, aims: Aims, state: LearningState, sample: Sample) -> Vector:
    """φᵀμ̂^π − μ̃ᴰ + ℓ₂ w_D, shape (K,)."""
    counts = problem.features.counts(sample.visits())
    residual: Vector = counts - aims.successes + problem.settings.l2 * state.vector("w_success")
    return residual


def _gap(problem: LearningProblem, aims: Aims, state: LearningState, sample: Sample) -> float:
    return float(np.abs(_residual(problem, aims, state, sample)).max())


def _log_likelihood(aims: Aims, state: LearningState, sample: Sample) -> float:
    """μ̃ᴰ·w − log Ẑ."""
    return float(aims.successes @ _weights(state)) - sample.log_partition


def _weights(state: LearningState) -> Vector:
    """The sum w_D + w_F, shape (K,)."""
    weights: Vector = state.vector("w_success") + state.vector("w_failure")
    return weights


def _remembering(state: LearningState, sample: Sample) -> LearningState:
    """The state with the sample added to what is remembered of earlier ones."""
    kept = min(_LONGEST_MEMORY, 1.0 - 1.0 / (2.0 + state.iteration / 10.0))
    log_worth = np.logaddexp(state.vector("log_worth") + math.log(kept), sample.log_sums.reshape(-1))
    tries = kept * state.vector("tries") + sample.tries.reshape(-1)
    return replace(state, values={**state.values, "log_worth": np.maximum(log_worth, LOG_ZERO), "tries": tries})


def _nothing_known(problem: LearningProblem) -> dict[str, Vector | float]:
    n_pairs = problem.mdp.n_states * problem.mdp.n_actions
    return {"log_worth": np.full(n_pairs, LOG_ZERO), "tries": np.zeros(n_pairs)}


def _log_mean_worth(problem: LearningProblem, state: LearningState) -> Matrix:
    """The log of Ẑ(s, a), shape (S, A)."""
    log_worth, tries = state.vector("log_worth"), state.vector("tries")
    mean = np.where(log_worth > LOG_ZERO / 2, log_worth - np.log(np.maximum(tries, 1e-300)), LOG_ZERO)
    return mean.reshape(problem.mdp.n_states, problem.mdp.n_actions)


def _is_known(log_worth: Matrix) -> BoolVector:
    """Where something has arrived from, shape (S,)."""
    known: BoolVector = log_worth.max(axis=1) > LOG_ZERO / 2
    return known


def _imitated(problem: LearningProblem) -> Policy:
    """How often each action was taken in the demonstrations learned from, shape (S, A); uniform where none came."""
    taken: Matrix = np.zeros((problem.mdp.n_states, problem.mdp.n_actions))
    for one in (*problem.successes, *problem.failures):
        np.add.at(taken, (one.states[:-1], one.actions), 1.0)
    total = taken.sum(axis=1, keepdims=True)
    return np.where(total > 0.0, taken / np.maximum(total, 1.0), 1.0 / problem.mdp.n_actions)


def _generator(problem: LearningProblem, state: LearningState, *, purpose: bytes) -> np.random.Generator:
    seed = np.random.SeedSequence([problem.seed, *b"model_free ", *purpose, state.iteration])
    return np.random.default_rng(seed)


def _check_state(problem: LearningProblem, state: LearningState) -> None:
    n_given, n_features = len(state.vector("w_success")), problem.features.n_features
    if n_given != n_features:
        raise IrlError(f"The state has {n_given} weights; this problem has {n_features}.", field="state")
    n_given, n_pairs = len(state.vector("tries")), problem.mdp.n_states * problem.mdp.n_actions
    if n_given != n_pairs:
        raise IrlError(f"The state has {n_given} choices; this problem has {n_pairs}.", field="state")


def _sentence(problem: LearningProblem, state: LearningState, outcome: Outcome, *, gap: float, effective: float) -> str:
    n, limit = state.iteration, problem.settings.iterations
    episodes = f"{problem.settings.episodes:,} episodes each"
    seen = f"by samples, the gap to the attempts is {gap:.2g}"
    ended = {
        Outcome.CONVERGED: f"Converged after {n} iterations of {episodes}: {seen}.",
        Outcome.STOPPED: f"Stopped after {n} of {limit} iterations of {episodes}: {seen}.",
        Outcome.ITERATION_LIMIT: f"The limit of {limit} iterations of {episodes} came first: {seen}.",
        Outcome.DIVERGED: (
            f"The learned reward grew beyond a million after {n} iterations; shown is the last before. A smaller"
            " learning rate or a larger λ_min steadies it."
        ),
    }[outcome]
    n_last = _CLOSER_LOOK * problem.settings.episodes
    if effective >= _NOISY * n_last:
        return ended
    return (
        f"{ended} Only {effective:.0f} of the last {n_last:,} episodes were like the ones that matter, so this is a"
        " noisy estimate: allow more episodes."
    )
