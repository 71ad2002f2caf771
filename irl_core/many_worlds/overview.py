"""Many finished comparisons at once: how often each came at which place, who beats whom, how near to the optimum.

Places are among those who took part in a comparison, the optimum left out, by expected return (the human's: by mean),
as in `irl_core.comparison`; equals share the better place. Learners may differ between comparisons: each is counted in
those it took part in, a pair in those where both did, and the paper's Table I in those with all learners of the paper.
"""

from collections import Counter
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import combinations

import numpy as np

from irl_core.arrays import Matrix, Vector
from irl_core.comparison import HUMAN
from irl_core.learners import LEARNERS
from irl_core.many_worlds.bootstrap import draw
from irl_core.many_worlds.duels import duels, shared_places
from irl_core.many_worlds.intervals import Proportion, Share, proportion, share_of_optimum
from irl_core.many_worlds.signs import sign_test
from irl_core.many_worlds.table_one import TableOne, papers_learners, table_one
from irl_core.paired import holm


@dataclass(frozen=True)
class Measured:
    """One finished comparison: what the optimum was and what everybody else earned, by who they are.

    `unit` names what is independent of the rest: a world of one's own, or whose comparison it is where several people's
    are taken together. `expected` are exact expected returns (the human's: the mean), `played` means of episodes.
    """

    unit: Hashable
    optimum: float
    expected: Mapping[str, float]
    played: Mapping[str, float]


@dataclass(frozen=True)
class Standing:
    """One who took part in `n` of the comparisons: how often at place 1, 2, …, and their share of the optimum."""

    who: str
    n: int
    places: tuple[Proportion, ...]
    share: Share


@dataclass(frozen=True)
class Duel:
    """Two who met in `n` comparisons. `units_for` and `units_against` are the votes of the sign test."""

    a: str
    b: str
    n: int
    wins: int
    losses: int
    units_for: int
    units_against: int
    p_value: float
    p_adjusted: float

    @property
    def ties(self) -> int:
        """In how many comparisons both earned the same."""
        return self.n - self.wins - self.losses


@dataclass(frozen=True)
class Overview:
    """What many comparisons say together. `table_one` is None where never all of the paper's learners took part.

    `left_out` are those of whom too few units tell.
    """

    n: int
    n_units: int
    standings: tuple[Standing, ...]
    duels: tuple[Duel, ...]
    table_one: TableOne | None
    left_out: tuple[str, ...] = ()

    def standing(self, who: str) -> Standing:
        """Find the standing of one who took part. Raises StopIteration for others."""
        return next(one for one in self.standings if one.who == who)


def look_over(comparisons: Iterable[Measured], *, seed: int = 0, least_units: int = 1) -> Overview:
    """Take comparisons together, in whatever order. `seed` is for the resamples.

    Who took part in fewer than `least_units` units is left out, as are pairs who met in fewer: where units are people,
    the figures of one would be that person's.
    """
    listed = list(comparisons)
    if not listed:
        return Overview(0, 0, (), (), None)
    everybody = _in_order({who for one in listed for who in one.expected})
    names = [who for who in everybody if len({one.unit for one in listed if who in one.expected}) >= least_units]
    units = _numbered([one.unit for one in listed])
    optima: Vector = np.array([one.optimum for one in listed])
    expected = _scores([one.expected for one in listed], names)
    return Overview(
        n=len(listed),
        n_units=len(set(units)),
        standings=_standings(names, expected, optima, units, seed=seed),
        duels=_all_duels(names, expected, optima, units, least_units=least_units),
        table_one=_table_one(listed, units, least_units=least_units),
        left_out=tuple(who for who in everybody if who not in names),
    )


def _in_order(names: Iterable[str]) -> list[str]:
    """The human, then learners as `LEARNERS` has them, then strangers by name."""
    known = [HUMAN, *LEARNERS]
    return sorted(names, key=lambda name: (known.index(name) if name in known else len(known), name))


def _numbered(units: Sequence[Hashable]) -> list[int]:
    numbers: dict[Hashable, int] = {}
    return [numbers.setdefault(unit, len(numbers)) for unit in units]


def _scores(given: Sequence[Mapping[str, float]], names: Sequence[str]) -> Matrix:
    scores: Matrix = np.array([[one.get(name, np.nan) for name in names] for one in given], dtype=np.float64)
    return scores.reshape(len(given), len(names))


def _standings(
    names: Sequence[str], scores: Matrix, optima: Vector, units: Sequence[int], *, seed: int
) -> tuple[Standing, ...]:
    places = shared_places(scores, optima)
    counts = cache(partial(draw, seed=seed))
    standings = []
    for column, who in enumerate(names):
        present = np.flatnonzero(~np.isnan(scores[:, column])).tolist()
        came = places[present, column].astype(int).tolist()
        theirs = [units[i] for i in present]
        standings.append(
            Standing(
                who=who,
                n=len(present),
                places=tuple(proportion([one == place for one in came], theirs) for place in range(1, max(came) + 1)),
                share=share_of_optimum(scores[present, column], optima[present], theirs, counts=counts),
            )
        )
    return tuple(standings)


def _all_duels(
    names: Sequence[str], scores: Matrix, optima: Vector, units: Sequence[int], *, least_units: int
) -> tuple[Duel, ...]:
    wins, ties = duels(scores, optima)
    meets = wins | wins.transpose(0, 2, 1) | ties
    found = [
        _duel(
            names[i],
            names[j],
            wins[:, i, j].tolist(),
            wins[:, j, i].tolist(),
            n_ties=int(ties[:, i, j].sum()),
            units=units,
        )
        for i, j in combinations(range(len(names)), 2)
        if len({units[k] for k in np.flatnonzero(meets[:, i, j]).tolist()}) >= max(1, least_units)
    ]
    adjusted = holm([duel.p_value for duel in found])
    return tuple(replace(duel, p_adjusted=p_adjusted) for duel, p_adjusted in zip(found, adjusted, strict=True))


def _duel(a: str, b: str, wins: Sequence[bool], losses: Sequence[bool], *, n_ties: int, units: Sequence[int]) -> Duel:
    balances: Counter[int] = Counter()
    for unit, won, lost in zip(units, wins, losses, strict=True):
        balances[unit] += won - lost
    n_for, n_against = sum(one > 0 for one in balances.values()), sum(one < 0 for one in balances.values())
    p_value = sign_test(n_for, n_against)
    return Duel(a, b, sum(wins) + sum(losses) + n_ties, sum(wins), sum(losses), n_for, n_against, p_value, p_value)


def _table_one(comparisons: Sequence[Measured], units: Sequence[int], *, least_units: int) -> TableOne | None:
    names = papers_learners(list(LEARNERS))
    complete = [i for i, one in enumerate(comparisons) if {HUMAN, *names} <= one.played.keys()]
    if len({units[i] for i in complete}) < max(1, least_units):
        return None
    returns = _scores([comparisons[i].played for i in complete], names)
    human: Vector = np.array([comparisons[i].played[HUMAN] for i in complete])
    return table_one(names, returns, human, [units[i] for i in complete])
