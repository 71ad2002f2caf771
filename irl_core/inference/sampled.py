"""Expected visits of the path distribution from sampled episodes: inference without a transition table.

**Problem.** The path distribution is P(ζ) ∝ Π_t T(s_{t+1} | s_t, a_t) e^{R(ζ)}, R(ζ) = Σ_t R(s_t), over paths that
arrive within N steps (`planning.py`). Here T is unknown; what can be had are paths drawn by a policy π of our choice,
whose density is q(ζ) = Π_t T(s_{t+1} | s_t, a_t) π(a_t | s_t).

**Importance sampling.** In P/q the unknown T cancels, which is the idea of relative-entropy IRL (Boularias, Kober and
Peters 2011, Sec. 4; their base policy is π here). With ζ_1 … ζ_n from π,

    w_i = 1{ζ_i arrived} · e^{R(ζ_i)} / Π_t π(a_t | s_t),     Ẑ = Σ_i w_i / n,     μ̂^π = Σ_i w_i visits(ζ_i) / Σ_i w_i.

Ẑ is unbiased, μ̂^π is consistent. With several starts the weights are normalised for each start by itself, since each
path's likelihood is conditional on its start. `effective` is (Σ w)² / Σ w², the number of paths that really count.

**What follows a choice.** The part of a sampled path from its step t on is itself a path from s = s_t that begins with
a = a_t, of weight e^{R(s_t) + …} / Π_{t′ > t} π(a_t′ | s_t′), in which π(a | s) does not occur. The mean of these over
all tries of a in s, arrived or not, is Ẑ(s, a): the weight of all paths that begin so, with as many steps to go as were
left. Σ of weights and number of tries are given for each (s, a), so that a caller can add up several samples.
"""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from irl_core.arrays import Matrix, Policy, Vector
from irl_core.simulators import Episodes

LOG_ZERO: Final = -1e30
"""Stands for log 0, finite so that it can live in JSON."""


@dataclass(frozen=True, eq=False)
class Sample:
    """What one round of episodes says about a reward.

    `shares`, shape (n,), is each path's part of the weight, Σ = 1, or all 0 where nothing arrived; `log_partition` is
    Σ_s ρ(s) log Ẑ(s) over the starts. `log_sums` and `tries`, shape (S, A), make up Ẑ(s, a).
    """

    episodes: Episodes
    log_weights: Vector
    log_sums: Matrix
    tries: Matrix
    shares: Vector
    log_partition: float

    @property
    def effective(self) -> float:
        """(Σ w)² / Σ w², from 0 to n."""
        squares = float((self.shares**2).sum())
        return 1.0 / squares if squares else 0.0

    def effective_after(self, change: Vector) -> float:
        """What `effective` would be if the reward changed by this, shape (S,)."""
        log_ratios = self._sums(change)
        shares = self.shares * np.exp(log_ratios - log_ratios[self.shares > 0.0].max())
        return float(shares.sum() ** 2 / (shares**2).sum())

    def curvature(self, *, rounds: int = 8) -> float:
        """The largest eigenvalue of the covariance of visits, which is the Hessian of log Z; by power iteration."""
        direction, mean, value = self.visits(), self.visits(), 0.0
        for _ in range(rounds):
            direction = direction / (np.sqrt(float((direction**2).sum())) or 1.0)
            deviations = self._sums(direction) - float(mean @ direction)
            direction = self._counts(self.shares * deviations)
            value = float(np.sqrt(float((direction**2).sum())))
        return value

    @property
    def arrived(self) -> bool:
        """Whether there is any weight to speak of."""
        return bool(self.shares.any())

    def visits(self, starts: Vector | None = None) -> Vector:
        """μ̂^π, shape (S,); from other starts than the sample was weighed for if `starts`, shape (S,), are given."""
        return self._counts(self.shares if starts is None else _shares(self.episodes, self.log_weights, starts)[0])

    def _counts(self, weights: Vector) -> Vector:
        """Σ_i weights_i · (visits of episode i), shape (S,)."""
        from irl_core import _kernels  # noqa: PLC0415 - whoever only reads results needs no compiler

        visits: Vector = np.zeros(len(self.log_sums))
        _kernels.model_free.count(self.episodes.states, self.episodes.lengths, weights, visits)
        return visits

    def _sums(self, values: Vector) -> Vector:
        """Σ_t values(s_t) of each episode that has any weight, shape (n,)."""
        from irl_core import _kernels  # noqa: PLC0415 - as above

        sums: Vector = np.zeros(len(self.shares))
        _kernels.model_free.add_up(self.episodes.states, self.episodes.lengths, self.shares, values, sums)
        return sums


def infer_sampled(episodes: Episodes, reward: Vector, policy: Policy, *, starts: Vector) -> Sample:
    """Weigh episodes that `policy`, shape (S, A), played for this reward, shape (S,); `starts` as in path inference."""
    from irl_core import _kernels  # noqa: PLC0415 - as above

    log_weights = np.full(len(episodes.lengths), LOG_ZERO)
    log_sums, tries = np.full(policy.shape, LOG_ZERO), np.zeros(policy.shape)
    _kernels.model_free.weigh(
        episodes.states, episodes.actions, episodes.lengths, episodes.arrived,
        reward, np.log(policy), log_weights, log_sums, tries,
    )  # fmt: skip
    shares, log_partition = _shares(episodes, log_weights, starts)
    return Sample(episodes, log_weights, log_sums, tries, shares, log_partition)


def _shares(episodes: Episodes, log_weights: Vector, starts: Vector) -> tuple[Vector, float]:
    """Each path's share, from each start as much as `starts` says, and the log partition.

    Starts from which nothing arrived are left out; if that is all of them, shares are 0 and the log partition is log 0.
    """
    shares: Vector = np.zeros(len(log_weights))
    log_partition = covered = 0.0
    first = episodes.states[:, 0]
    for start in np.flatnonzero(starts):
        members = np.flatnonzero((first == start) & episodes.arrived)
        if len(members):
            top = float(log_weights[members].max())
            weights = np.exp(log_weights[members] - top)
            shares[members] = starts[start] * weights / weights.sum()
            log_partition += starts[start] * (top + math.log(weights.sum() / np.count_nonzero(first == start)))
            covered += starts[start]
    if covered == 0.0:
        return shares, LOG_ZERO
    return shares / covered, log_partition / covered
