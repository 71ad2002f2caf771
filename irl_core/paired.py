"""How far a mean of episodes is known, and whether one player earned more than another on the same episodes.

**The mean.** Of n totals x_k: x̄ = Σ x_k / n, its standard error s_x̄ = √(Σ (x_k − x̄)² / (n − 1) / n), and the 95 %
interval x̄ ± t s_x̄, where t leaves 2.5 % above it in Student's t distribution with ν = n − 1 degrees of freedom. With
θ = arctan(t / √ν), what lies between −t and t is (Abramowitz and Stegun 1964, 26.7.3 and 26.7.4)

    ν odd    2/π · (θ + sin θ (cos θ + 2/3 cos³ θ + … + (2·4 ⋯ (ν − 3)) / (3·5 ⋯ (ν − 2)) cos^{ν−2} θ))
    ν even   sin θ · (1 + 1/2 cos² θ + … + (1·3 ⋯ (ν − 3)) / (2·4 ⋯ (ν − 2)) cos^{ν−2} θ).

One total alone has no spread to learn from: no interval, and a standard error of 0.

**The pair.** Episode k of two players draws the same random numbers (`comparison.py`), so they are compared episode by
episode: d_k = x_k − y_k. If it makes no difference who plays, each d_k could as well have the other sign. The p-value
is the share of all 2^m ways to sign the m differences that are not 0 for which |Σ ± d_k| is at least |Σ d_k| (Fisher
1935, Sec. 21). Where these are more than 10,000, B = 9,999 of them are drawn from a seed, the observed one is counted
in, and p = (1 + how many reach it) / (1 + B) (Phipson and Smyth 2010), the same signs for every pair.

**Many pairs.** With m pairs, p_(1) ≤ … ≤ p_(m), Holm's (1979) adjusted p-values are
max_{j ≤ i} min(1, (m − j + 1) p_(j)): where none of the differences is real, the chance that even one of these falls
below α is at most α.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import combinations
from typing import Any, Final

import numpy as np

from irl_core.arrays import Matrix, Vector

LEVEL: Final = 0.95
"""What an interval covers."""
MOST_SIGNS: Final = 9_999
"""Ways to sign the differences that are drawn where not all are tried."""
_MOST_EXACT: Final = 13
"""2¹³ = 8,192 ways are tried all."""
_SAME_SUM: Final = 1e-9
"""Sums closer than this share of Σ |d_k| differ by rounding alone."""
_BLOCK: Final = 1 << 14
"""Flips at once: they stay in the cache, and the product too small to be worth waking other threads for."""


@dataclass(frozen=True)
class Mean:
    """The mean of some totals, and how far it is known; an interval needs two."""

    value: float
    standard_error: float
    low: float | None
    high: float | None


@dataclass(frozen=True)
class PairedTest:
    """How much more `a` earned than `b` an episode, on the same episodes."""

    a: str
    b: str
    mean_difference: float
    low: float | None
    high: float | None
    p_value: float
    p_adjusted: float

    def to_json(self) -> dict[str, Any]:
        """The test as the API has it."""
        return {
            "a": self.a,
            "b": self.b,
            "mean_difference": self.mean_difference,
            "low": self.low,
            "high": self.high,
            "p_value": self.p_value,
            "p_adjusted": self.p_adjusted,
        }


def mean_of(totals: Sequence[float] | Vector) -> Mean:
    """The mean of at least one total, with its standard error and its interval."""
    values = np.asarray(totals, dtype=np.float64)
    n, mean = len(values), math.fsum(values) / len(values)
    if n == 1:
        return Mean(mean, 0.0, None, None)
    error = math.sqrt(math.fsum((values - mean) ** 2) / (n - 1) / n)
    reach = t_quantile(n - 1) * error
    return Mean(mean, error, mean - reach, mean + reach)


def paired_tests(totals: Mapping[str, Sequence[float]], *, rng: np.random.Generator) -> tuple[PairedTest, ...]:
    """Every two of those who played the same episodes, the one named first as `a`."""
    pairs = list(combinations(totals, 2))
    if not pairs:
        return ()
    played = {who: np.asarray(earned, dtype=np.float64) for who, earned in totals.items()}
    differences = np.stack([played[a] - played[b] for a, b in pairs], axis=1)
    tests = []
    for (a, b), difference, p_value in zip(pairs, differences.T, _p_values(differences, rng), strict=True):
        mean = mean_of(difference)
        tests.append(PairedTest(a, b, mean.value, mean.low, mean.high, p_value, p_value))
    adjusted = holm([test.p_value for test in tests])
    return tuple(replace(test, p_adjusted=p) for test, p in zip(tests, adjusted, strict=True))


def holm(p_values: Sequence[float]) -> list[float]:
    """Holm's adjusted p-values, in the order given."""
    adjusted, largest = [0.0] * len(p_values), 0.0
    for rank, at in enumerate(sorted(range(len(p_values)), key=p_values.__getitem__)):
        largest = max(largest, min(1.0, (len(p_values) - rank) * p_values[at]))
        adjusted[at] = largest
    return adjusted


@lru_cache(maxsize=256)
def t_quantile(degrees: int) -> float:
    """The t that `LEVEL` of Student's distribution with 1, 2, … degrees of freedom lies within, found by halving."""
    low, high = 0.0, 16.0
    while high - low > 1e-13 * high:
        middle = (low + high) / 2
        low, high = (middle, high) if _t_within(middle, degrees) < LEVEL else (low, middle)
    return (low + high) / 2


def _t_within(t: float, degrees: int) -> float:
    """The probability that Student's t lies between −t and t; the finite sums at the head of this module."""
    theta = math.atan(t / math.sqrt(degrees))
    is_odd = degrees % 2 == 1
    term = math.cos(theta) if is_odd else 1.0
    total, squared = 0.0, math.cos(theta) ** 2
    for k in range(2 + is_odd, degrees + 1, 2):
        total += term
        term *= squared * (k - 1) / k
    return 2 / math.pi * (theta + math.sin(theta) * total) if is_odd else math.sin(theta) * total


def _p_values(differences: Matrix, rng: np.random.Generator) -> list[float]:
    """The p-value of each column of differences, shape (n, pairs)."""
    sums = differences.sum(axis=0)
    least = np.abs(sums) - _SAME_SUM * np.abs(differences).sum(axis=0)
    reached = np.zeros(len(sums), dtype=np.int64)
    for flips in _drawn_flips(len(differences), rng):
        reached += (np.abs(sums - 2.0 * (flips @ differences)) >= least).sum(axis=0)
    drawn = (1 + reached) / (1 + MOST_SIGNS)
    return [
        _exact_p_value(column[column != 0.0], bound) if np.count_nonzero(column) <= _MOST_EXACT else float(p)
        for column, bound, p in zip(differences.T, least, drawn, strict=True)
    ]


def _drawn_flips(n: int, rng: np.random.Generator) -> Iterator[Matrix]:
    """All the drawn ways to flip the signs of n differences, 1 where one flips, in blocks of shape (ways, n)."""
    n_rows = max(1, _BLOCK // n)
    for first in range(0, MOST_SIGNS, n_rows):
        draws = rng.random((min(n_rows, MOST_SIGNS - first), n))
        yield (draws < 0.5).astype(np.float64)


def _exact_p_value(differences: Vector, least: float) -> float:
    flips = np.arange(1 << len(differences))[:, None] >> np.arange(len(differences)) & 1
    sums = np.abs(differences.sum() - 2.0 * (flips @ differences))
    return float((sums >= least).mean())
