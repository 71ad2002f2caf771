"""Table I of the paper as figures: how often each learner came first, second, … in played episodes, and whom it beat.

As in the paper, the human's figure is the mean of all demonstrations, a learner's the mean of its episodes, and places
are among the paper's own learners, whatever others took part; equals share the better place.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from irl_core.arrays import Matrix, Vector
from irl_core.comparison import places
from irl_core.learners import LEARNERS
from irl_core.many_worlds.intervals import Proportion, proportion


@dataclass(frozen=True)
class TableOneRow:
    """A learner of the paper: how often it came at each place, 1st to last, and how often it earned more than each."""

    who: str
    placed: tuple[Proportion, ...]
    beaten: Mapping[str, int]


@dataclass(frozen=True)
class TableOne:
    """`below_all` counts the experiments in which every learner earned more than the human."""

    n: int
    below_all: Proportion
    rows: tuple[TableOneRow, ...]


def papers_learners(names: Sequence[str]) -> list[str]:
    """Those among the names that are the paper's."""
    return [name for name in names if name in LEARNERS and LEARNERS[name].family == "paper"]


def table_one(names: Sequence[str], returns: Matrix, human: Vector, units: Sequence[int] | None = None) -> TableOne:
    """The table from mean returns of (n, L), of which NaN is the worst, and the human's of (n,).

    `units` numbers what is independent; without it each row is.
    """
    independent = list(range(len(human)) if units is None else units)
    scores = np.where(np.isnan(returns), -np.inf, returns)
    placed = np.array([places(row, tolerance=0.0) for row in scores.tolist()]).reshape(scores.shape)
    rows = [
        TableOneRow(
            who=name,
            placed=tuple(
                proportion((placed[:, column] == place).tolist(), independent) for place in range(1, len(names) + 1)
            ),
            beaten={
                other: int((scores[:, column] > scores[:, rival]).sum())
                for rival, other in enumerate(names)
                if rival != column
            },
        )
        for column, name in enumerate(names)
    ]
    below_all = proportion(
        [min(row) > one for row, one in zip(scores.tolist(), human.tolist(), strict=True)], independent
    )
    return TableOne(len(human), below_all, tuple(rows))
