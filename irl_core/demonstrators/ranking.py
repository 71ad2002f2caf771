"""How a simulated person orders attempts: by their totals, with mistakes of a stated size.

Each attempt seems to be worth its total plus `noise` · g, g standard Gumbel. The order by that is Plackett–Luce:
attempt i is put first with probability e^{total_i / noise} / Σ_j e^{total_j / noise}, then again among the rest; of two
attempts Δ apart, the worse is put first with probability 1 / (1 + e^{Δ / noise}). Failures, worst first, likewise with
e^{−total / noise}. Attempts that seem to be at most `ties_within` apart from their neighbour share a place.
"""

from collections.abc import Sequence

import numpy as np

from irl_core.array_checks import check_generator
from irl_core.checks import Refused, real_number
from irl_core.errors import InvalidSettings
from irl_core.types import Demonstration, DemonstrationOutcome, Ranking, check_demonstrations


def rank_by_total(
    outcome: DemonstrationOutcome,
    demonstrations: Sequence[Demonstration],
    rng: np.random.Generator,
    *,
    noise: float = 0.0,
    ties_within: float = 0.0,
) -> Ranking:
    """The order in which somebody puts attempts of one outcome; `noise` and `ties_within` are in points of reward.

    Raises ImpossibleDemonstration, InvalidSettings.
    """
    check_demonstrations(demonstrations)
    check_generator(rng)
    _check_distance("noise", noise)
    _check_distance("ties_within", ties_within)
    sign = 1.0 if outcome == "success" else -1.0
    mistakes = noise * rng.gumbel(size=len(demonstrations))
    seems = {one.id: sign * one.total + float(mistake) for one, mistake in zip(demonstrations, mistakes, strict=True)}
    groups: list[list[str]] = []
    for id_ in sorted(seems, key=lambda id_: -seems[id_]):
        if groups and seems[groups[-1][-1]] - seems[id_] <= ties_within:
            groups[-1].append(id_)
        else:
            groups.append([id_])
    return Ranking(outcome, tuple(tuple(group) for group in groups))


def _check_distance(name: str, value: object) -> None:
    try:
        real_number(value, minimum=0.0)
    except Refused as refused:
        raise InvalidSettings(f"{name} {refused}.", field=name) from None
