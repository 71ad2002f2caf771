"""How far an order agrees with true values: Kendall's τ-b, and the pairs that stand the wrong way round.

An order puts n things into groups from top to bottom; a group of several is a tie. Of the n₀ = n (n − 1) / 2 pairs

    C  agree: the upper one is worth more          n₁  share a group (tied in the order)
    D  are swapped: the lower one is worth more    n₂  are worth exactly the same (tied in their values)

and a pair may be in both n₁ and n₂. Kendall's coefficient for orders with ties is

    τ_b = (C − D) / √((n₀ − n₁)(n₀ − n₂)),   −1 ≤ τ_b ≤ 1:

1 where order and values are the same order, ties included, −1 where one is the other upside down, 0 where they have
nothing to do with each other. Where all is tied on one side, or there are fewer than two things, it is undefined.

Source: M. G. Kendall (1945), The treatment of ties in ranking problems, Biometrika 33 (3), 239–251.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import combinations

from irl_core.checks import Refused, real_number, shown
from irl_core.errors import InvalidRanking
from irl_core.types import check_groups


@dataclass(frozen=True, slots=True)
class Agreement:
    """What comparing an order with true values shows; n_pairs = n_agreeing + n_swapped + n_tied."""

    tau_b: float | None
    n_agreeing: int
    n_tied: int
    """Pairs tied in the order, in their values, or in both."""
    swapped: tuple[tuple[str, str], ...]
    """Pairs (above, below) of which the lower one belongs above; those whose values differ most come first."""

    @property
    def n_swapped(self) -> int:
        """How many pairs stand the wrong way round."""
        return len(self.swapped)

    @property
    def n_pairs(self) -> int:
        """How many pairs there are."""
        return self.n_agreeing + self.n_swapped + self.n_tied


def agreement_of(
    groups: Iterable[Iterable[str]], values: Mapping[str, float], *, lowest_first: bool = False
) -> Agreement:
    """Compare an order with true values, of which the highest belongs on top, or the lowest (failures: worst first).

    Values of what is not in the order do no harm. Raises InvalidRanking (a value that is missing or no number).
    """
    checked = check_groups(groups)
    sign = -1.0 if lowest_first else 1.0
    worth = {id_: sign * _value_of(id_, values) for group in checked for id_ in group}
    place = {id_: k for k, group in enumerate(checked) for id_ in group}
    pairs = list(combinations(place, 2))
    n_same_place = sum(place[above] == place[below] for above, below in pairs)
    n_same_worth = sum(worth[above] == worth[below] for above, below in pairs)
    apart = [pair for pair in pairs if place[pair[0]] != place[pair[1]]]
    n_agreeing = sum(worth[above] > worth[below] for above, below in apart)
    swapped = [pair for pair in apart if worth[pair[0]] < worth[pair[1]]]
    comparable = (len(pairs) - n_same_place) * (len(pairs) - n_same_worth)
    return Agreement(
        tau_b=(n_agreeing - len(swapped)) / math.sqrt(comparable) if comparable else None,
        n_agreeing=n_agreeing,
        n_tied=len(pairs) - n_agreeing - len(swapped),
        swapped=tuple(sorted(swapped, key=lambda pair: worth[pair[0]] - worth[pair[1]])),
    )


def _value_of(id_: str, values: Mapping[str, float]) -> float:
    given: object = values
    if not isinstance(given, Mapping) or id_ not in given:
        message = f"values must be a mapping with a number for each id; {shown(id_)} has none."
        raise InvalidRanking(message, field="values")
    try:
        return real_number(values[id_])
    except Refused as refused:
        raise InvalidRanking(f"The value of {shown(id_)} {refused}.", field="values") from None
