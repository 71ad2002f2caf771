"""How much better: distances that a person stated between neighbouring groups of an order.

A gap says, from 1 (hardly) to 100 (far), how much better the group above is than the one right below it (how much worse
in an order of failures). The order itself is the groups as they stand; gaps add distances to it. With d_k said between
the k-th group and the next, k = 1 … G − 1, the k-th stands at

    h_k = d_k + d_{k+1} + … + d_{G−1},   h_G = 0,

an interval scale: its zero is the last group and its unit the person's own, so only ratios of differences mean
something. Stating the differences of neighbours and adding them up is how MACBETH builds value scales (C. A. Bana e
Costa and J.-C. Vansnick, "MACBETH: an interactive path towards the construction of cardinal value functions",
International Transactions in Operational Research 1(4), 1994).

A gap is kept under one attempt of the group above and one of the group below: the first of each, unless what stands
there is said anew. It counts for two neighbouring groups whenever the one holds the former and the other the latter, so
it comes back when they are neighbours again, and who joins a tie brings its gaps along; of several that fit, the last
of the list counts.
"""

from collections.abc import Iterable, Mapping
from itertools import pairwise
from typing import TypedDict

from irl_core.checks import Refused, shown, whole_number
from irl_core.errors import InvalidRanking
from irl_core.types import check_groups
from irl_core.world_checks import is_list

HARDLY, FAR = 1, 100


class Gap(TypedDict):
    """What was said between two attempts, as rankings in demonstration files write it."""

    above: str
    below: str
    value: int


def said_gaps(groups: Iterable[Iterable[str]], gaps: Iterable[Gap]) -> tuple[int | None, ...]:
    """The gap between each group and the next, from the top; None where nothing was said. One fewer than groups."""
    order, said = check_groups(groups), _checked(gaps)
    return tuple(
        next((gap["value"] for gap in reversed(said) if gap["above"] in above and gap["below"] in below), None)
        for above, below in pairwise(order)
    )


def positions_from_gaps(groups: Iterable[Iterable[str]], gaps: Iterable[Gap]) -> dict[str, int]:
    """How far above the last group each attempt stands: the sum of the gaps below it.

    Raises InvalidRanking where a gap was not said: what a person left open is not ours to fill in.
    """
    order = check_groups(groups)
    said = said_gaps(order, gaps)
    if None in said:
        top = order[said.index(None)][0]
        raise InvalidRanking(f"Nothing was said of the gap right below {shown(top)}: no positions.", field="gaps")
    distances = [gap or 0 for gap in said]
    return {id_: sum(distances[place:]) for place, group in enumerate(order) for id_ in group}


def _checked(gaps: Iterable[Gap]) -> tuple[Gap, ...]:
    if not is_list(gaps):
        raise InvalidRanking("Gaps are a list of {above, below, value}.", field="gaps")
    return tuple(map(_checked_gap, gaps))


def _checked_gap(gap: object) -> Gap:
    if not isinstance(gap, Mapping) or not all(isinstance(gap.get(end), str) for end in ("above", "below")):
        raise InvalidRanking("A gap names the attempts above and below it: {above, below, value}.", field="gaps")
    try:
        value = whole_number(gap.get("value"), minimum=HARDLY, maximum=FAR)
    except Refused as refused:
        raise InvalidRanking(f"The gap below {shown(gap['above'])} {refused}.", field="gaps") from None
    return {"above": gap["above"], "below": gap["below"], "value": value}
