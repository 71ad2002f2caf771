"""95 % intervals that are honest with few worlds and with several worlds of one person.

Units are what is independent: the worlds of one person, or people, each with all their worlds. Below three units there
is no interval.

**How often.** Of M comparisons x show something, p = x / M. Wilson's interval (1927) at the effective number n* of
comparisons, p (1 − p) / v with v = Σ_u (x_u − p M_u)² / M² over units u, never more than M (Korn & Graubard 1998):
with one comparison a unit n* is M, and people who are all of a piece count once. Where p is 0 or 1, and nothing
varies, n* is the number of units.

**How much.** The share of the optimum r = Σ x / Σ o. From 20 units on by bootstrap; below, where percentiles of
resamples are too narrow, by Student's t: r ± t(k − 1) s, s² = k / (k − 1) · Σ_u (x_u − r o_u)² / (Σ o)² (Cochran 1977,
eq. 2.46, without its finite population).
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal, TypeAlias

import numpy as np

from irl_core.arrays import Matrix, Vector
from irl_core.many_worlds.bootstrap import Resamples, estimate
from irl_core.paired import t_quantile

LEAST_UNITS: Final = 3
ENOUGH_FOR_BOOTSTRAP: Final = 20
Method: TypeAlias = Literal["t", "bootstrap"]

_Z: Final = 1.959963984540054


@dataclass(frozen=True)
class Proportion:
    """`count` of `of`; the interval is NaN where there are too few units for one."""

    count: int
    of: int
    low: float
    high: float


@dataclass(frozen=True)
class Share:
    """A share of the optimum and its interval, NaN where there is none; `method` says how the interval was found."""

    value: float
    low: float
    high: float
    method: Method | None


def proportion(shows: Sequence[bool], units: Sequence[int]) -> Proportion:
    """How often something shows in comparisons; `units` numbers the unit of each of them."""
    of, count = len(shows), sum(map(bool, shows))
    if len(set(units)) < LEAST_UNITS:
        return Proportion(count, of, math.nan, math.nan)
    low, high = wilson(count / of, _effective_number(np.asarray(shows, dtype=np.float64), np.asarray(units)))
    return Proportion(count, of, low, high)


def wilson(p: float, n: float) -> tuple[float, float]:
    """Wilson's 95 % interval of a proportion p among n."""
    middle = (p + _Z**2 / (2 * n)) / (1 + _Z**2 / n)
    reach = _Z / (1 + _Z**2 / n) * math.sqrt(p * (1 - p) / n + _Z**2 / (4 * n**2))
    return max(0.0, middle - reach) if p > 0.0 else 0.0, min(1.0, middle + reach) if p < 1.0 else 1.0


def _effective_number(shows: Vector, units: Any) -> float:  # noqa: ANN401 - whole numbers, (n,)
    p = float(shows.mean())
    if p in {0.0, 1.0}:
        return float(len(set(units.tolist())))
    apart = _by_unit(shows - p, units)
    variance = float(apart @ apart) / len(shows) ** 2
    return min(p * (1 - p) / variance, len(shows)) if variance > 0.0 else float(len(shows))


def share_of_optimum(
    returns: Vector, optima: Vector, units: Sequence[int], *, counts: Callable[[int], Matrix]
) -> Share:
    """Share of the optimum that these returns make up together; `units` numbers the unit of each of them.

    `counts` draws resamples of so many units (`bootstrap.draw`): whoever asks for several shares need draw only once.
    """
    earned, possible = _by_unit(returns, np.asarray(units)), _by_unit(optima, np.asarray(units))
    n_units, all_possible = len(earned), float(possible.sum())
    if all_possible <= 0.0:
        return Share(math.nan, math.nan, math.nan, None)
    value = float(earned.sum()) / all_possible
    if n_units < LEAST_UNITS:
        return Share(value, math.nan, math.nan, None)
    if n_units >= ENOUGH_FOR_BOOTSTRAP:
        found = estimate(Resamples(possible, counts(n_units)).shares(earned[:, None])[:, 0])
        return Share(value, found.low, found.high, "bootstrap")
    apart = earned - value * possible
    error = math.sqrt(n_units / (n_units - 1) * float(apart @ apart)) / all_possible
    reach = t_quantile(n_units - 1) * error
    return Share(value, value - reach, value + reach, "t")


def _by_unit(values: Vector, units: Any) -> Vector:  # noqa: ANN401 - whole numbers, (n,)
    _, numbered = np.unique(units, return_inverse=True)
    return np.bincount(numbered, weights=values).astype(np.float64)
