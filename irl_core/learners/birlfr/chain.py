"""The Markov chain: Hamiltonian Monte Carlo on the posterior of `model.py`, and what it carries between iterations.

One iteration draws a momentum p ~ N(0, M), takes 4 to 12 leapfrog steps of size ε, and accepts with probability
min(1, e^{−ΔH}), H = −log posterior + p·M⁻¹p / 2 (Neal 2011; the number of steps is drawn so that no orbit repeats). For
the first W iterations, the warm-up, log ε is led towards an acceptance of 0.65 by dual averaging (Hoffman and Gelman
2014, Sec. 3.2: γ = 0.05, t₀ = 10, κ = 0.75), and M⁻¹, diagonal, is set twice to the variances of the iterations before,
shrunk towards 1, the prior's. Afterwards both stay, and every position is a draw.

The random numbers of iteration i come from SeedSequence([seed, "birlfr transition", i]), so that how the iterations are
portioned out changes nothing. Of each draw three numbers are kept (log posterior, mean log cost, expected acceptance),
of every fifth all costs: enough for intervals, and a state of a 7×7 world stays below 100 kB.
"""

import math
from dataclasses import dataclass
from typing import Final, Self

import numpy as np

from irl_core import _kernels
from irl_core.arrays import Matrix, Vector
from irl_core.errors import IrlError
from irl_core.learners.base import LearningState, Outcome
from irl_core.learners.birlfr.model import Model

WARM_UP: Final = 150
N_DRAWS: Final = 250
KEEP_EVERY: Final = 5
_N_TRACES: Final = 3
_SHORTEST_QUARTER: Final = 10
_FEWEST_STEPS: Final = 4
_MOST_STEPS: Final = 12
_TARGET: Final = 0.65
"""Of the dual averaging; the averaged step is shorter than the tried ones, and 0.8 of its proposals are accepted."""
_FIRST_STEP_SIZE: Final = 0.1
_LEARNING_BEGINS: Final = 0.2
_METRIC_SET_AT: Final = (0.45, 0.7)
"""When, as shares of the warm-up, variances begin to be summed, and when they are taken over."""
_PRIOR_WEIGHT: Final = 10.0


@dataclass(eq=False)
class Chain:
    """A state that moves. Positions have shape (D,), costs (n + G,)."""

    model: Model
    seed: int
    warm_up: int
    iteration: int
    position: Vector
    inverse_metric: Vector
    step: Vector  # log ε, its average, the error's average, μ, the number of adaptations
    window: Vector  # how many positions since variances were last taken over, their mean, their sum of squares
    cost_sum: Vector
    traces: Vector  # log posterior, mean log cost, acceptance of each draw
    kept: Vector  # costs of every fifth draw

    @classmethod
    def at_start(cls, model: Model, *, seed: int, iterations: int) -> Self:
        """At the prior's medians."""
        d, log_step = model.dimension, math.log(_FIRST_STEP_SIZE)
        return cls(
            model=model,
            seed=seed,
            warm_up=warm_up_of(iterations),
            iteration=0,
            position=np.zeros(d),
            inverse_metric=np.ones(d),
            step=np.array([log_step, log_step, 0.0, log_step + math.log(10.0), 0.0]),
            window=np.zeros(1 + 2 * d),
            cost_sum=np.zeros(model.n_costs),
            traces=np.zeros(0),
            kept=np.zeros(0),
        )

    @classmethod
    def from_state(cls, model: Model, state: LearningState, *, seed: int, iterations: int) -> Self:
        """Where the state left off."""
        position = state.vector("position").copy()
        if len(position) != model.dimension:
            raise IrlError(
                f"The state's position has {len(position)} numbers; this problem has {model.dimension}.", field="state"
            )
        names = ("inverse_metric", "step", "window", "cost_sum", "traces", "kept")
        vectors = {name: state.vector(name).copy() for name in names}
        return cls(
            model=model,
            seed=seed,
            warm_up=warm_up_of(iterations),
            iteration=state.iteration,
            position=position,
            **vectors,
        )

    def to_state(self, learner: str, outcome: Outcome | None) -> LearningState:
        """All of it, for later."""
        values = {
            "position": self.position.copy(),
            "inverse_metric": self.inverse_metric.copy(),
            "step": self.step.copy(),
            "window": self.window.copy(),
            "cost_sum": self.cost_sum.copy(),
            "traces": self.traces.copy(),
            "kept": self.kept.copy(),
        }
        return LearningState(learner, self.iteration, values, outcome)

    @property
    def n_draws(self) -> int:
        """How many iterations came after the warm-up."""
        return len(self.traces) // _N_TRACES

    @property
    def mean_costs(self) -> Vector:
        """Over all draws; before there are any, where the chain is. Shape (n + G,)."""
        if self.n_draws == 0:
            return self.model.log_posterior(self.position)[2]
        mean: Vector = self.cost_sum / self.n_draws
        return mean

    @property
    def draws(self) -> Matrix:
        """The costs of every fifth draw, shape (draws, n + G); of the position, before there are any."""
        return (self.kept if len(self.kept) else self.mean_costs).reshape(-1, self.model.n_costs)

    @property
    def acceptance(self) -> float:
        """The mean acceptance probability of the draws."""
        return float(self.traces.reshape(-1, _N_TRACES)[:, 2].mean()) if self.n_draws else 0.0

    def split_r_hat(self) -> float:
        """The larger R̂ of log posterior and mean log cost over four quarters of the draws; ∞ below 40 draws.

        Gelman et al. (Bayesian Data Analysis, 3rd ed., Sec. 11.4), each quarter taken as a chain.
        """
        n = self.n_draws // 4
        if n < _SHORTEST_QUARTER:
            return math.inf
        quarters = self.traces.reshape(-1, _N_TRACES)[-4 * n :, :2].reshape(4, n, 2)
        within = quarters.var(axis=1, ddof=1).mean(axis=0)
        between = n * quarters.mean(axis=1).var(axis=0, ddof=1)
        if not within.min() > 0.0:
            return math.inf
        return float(np.sqrt((n - 1) / n + between / (n * within)).max())

    def advance(self) -> None:
        """One iteration."""
        rng = np.random.default_rng(np.random.SeedSequence([self.seed, *b"birlfr transition", self.iteration]))
        momentum = rng.standard_normal(len(self.position)) / np.sqrt(self.inverse_metric)
        n_steps = int(rng.integers(_FEWEST_STEPS, _MOST_STEPS + 1))
        log_uniform = math.log(1.0 - rng.random())
        costs: Vector = np.empty(self.model.n_costs)
        acceptance, value = _kernels.birlfr.transition(
            self.position,
            costs,
            momentum,
            self.inverse_metric,
            math.exp(self.step[0]),
            n_steps,
            log_uniform,
            self.model.evidence,
            self.model.prior,
        )
        self.iteration += 1
        if self.iteration > self.warm_up:
            self._keep(value, costs, acceptance)
            return
        self._adapt_step_size(acceptance)
        self._adapt_metric()
        if self.iteration == self.warm_up:
            self.step[0] = self.step[1]

    def _adapt_step_size(self, acceptance: float) -> None:
        """Dual averaging."""
        _, average, error, centre, n = self.step
        n += 1.0
        share = 1.0 / (n + 10.0)
        error = (1.0 - share) * error + share * (_TARGET - acceptance)
        log_step = centre - math.sqrt(n) / 0.05 * error
        share = n**-0.75
        self.step[:] = log_step, share * log_step + (1.0 - share) * average, error, centre, n

    def _adapt_metric(self) -> None:
        """Sum positions up; twice, take their variances over and let the step size begin anew."""
        if self.iteration <= _LEARNING_BEGINS * self.warm_up:
            return
        d = len(self.position)
        n = self.window[0] + 1.0
        mean, squares = self.window[1 : 1 + d], self.window[1 + d :]
        difference = self.position - mean
        mean += difference / n
        squares += difference * (self.position - mean)
        self.window[0] = n
        if self.iteration in [int(share * self.warm_up) for share in _METRIC_SET_AT]:
            self.inverse_metric = (squares + _PRIOR_WEIGHT) / (n + _PRIOR_WEIGHT)
            self.window[:] = 0.0
            self.step[2:] = 0.0, self.step[1] + math.log(2.0), 0.0

    def _keep(self, value: float, costs: Vector, acceptance: float) -> None:
        """One draw."""
        self.cost_sum += costs
        n_squares = len(self.model.squares)
        self.traces = np.append(self.traces, [value, np.log(costs[:n_squares]).mean(), acceptance])
        if self.n_draws % KEEP_EVERY == 0:
            self.kept = np.append(self.kept, costs)


def warm_up_of(iterations: int) -> int:
    """W: 150 iterations, or three in eight where few are allowed."""
    return min(WARM_UP, 3 * iterations // 8)
