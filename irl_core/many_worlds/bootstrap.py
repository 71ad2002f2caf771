"""Shares of the optimum over many worlds, with percentile bootstrap intervals.

The share of a column x of returns is Σ_k x_k / Σ_k o_k, o_k the optimum of unit k: the ratio of means, which a world
with hardly anything to win does not upset as it would the mean of ratios. A unit is what is independent: a world,
or a person, whose x_k and o_k are sums over all their worlds. A resample draws n units out of n with replacement; all
columns see the same resamples, so differences between them are paired. Units without a figure (NaN) count on neither
side of the line. Intervals run from the 2.5th to the 97.5th percentile of 2,000 resamples (Efron & Tibshirani 1993,
Sec. 13.3).
"""

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from irl_core.arrays import Matrix, Vector

N_RESAMPLES: Final = 2000
LEVEL: Final = 0.95
_TAILS: Final = (100 * (1 - LEVEL) / 2, 100 * (1 + LEVEL) / 2)


@dataclass(frozen=True)
class Estimate:
    """A figure and its 95 % interval; NaN where there is none."""

    value: float
    low: float
    high: float

    def to_json(self) -> list[float | None]:
        """[value, low, high], null for NaN."""
        return [one if math.isfinite(one) else None for one in (self.value, self.low, self.high)]

    def __format__(self, spec: str) -> str:
        if not math.isfinite(self.value):
            return "–"
        value, low, high = (format(one, spec or ".2f").replace("-", "−") for one in (self.value, self.low, self.high))
        return f"{value} [{low}, {high}]"


def draw(n_units: int, seed: int) -> Matrix:
    """How often each unit is drawn, shape (1 + resamples, n): row 0, all once, is the sample itself."""
    rng = np.random.default_rng(np.random.SeedSequence([seed, *b"bootstrap"]))
    drawn = rng.multinomial(n_units, np.full(n_units, 1.0 / n_units), size=N_RESAMPLES)
    return np.vstack([np.ones(n_units), drawn])


class Resamples:
    """The units of one sample, with what was possible in each, drawn again and again as `counts` (of `draw`) says."""

    def __init__(self, optima: Vector, counts: Matrix) -> None:
        self._optima = optima
        self._counts = counts

    def shares(self, returns: Matrix) -> Matrix:
        """Share of the optimum of each column of `returns`, (n, L), in the sample and each resample: (1 + N, L)."""
        exists = np.isfinite(returns)
        earned = self._counts @ np.where(exists, returns, 0.0)
        possible = self._counts @ (exists * self._optima[:, None])
        shares: Matrix = np.divide(earned, possible, out=np.full_like(earned, np.nan), where=possible > 0.0)
        return shares


def estimate(resampled: Any) -> Estimate:  # noqa: ANN401 - a vector of (1 + resamples,)
    """The figure of the sample, in row 0, with the interval of the resamples after it."""
    if not np.isfinite(resampled).all():
        return Estimate(float(resampled[0]), math.nan, math.nan)
    low, high = np.percentile(resampled[1:], _TAILS)
    return Estimate(float(resampled[0]), float(low), float(high))
