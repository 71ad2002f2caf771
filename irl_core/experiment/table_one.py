"""Table I of the paper in its words: a sentence for each row of `irl_core.many_worlds.table_one`."""

from collections.abc import Mapping, Sequence
from typing import Final, TypeAlias

import numpy as np

from irl_core.experiment.outcomes import WorldOutcome
from irl_core.learners import LEARNERS
from irl_core.many_worlds.table_one import TableOneRow, papers_learners
from irl_core.many_worlds.table_one import table_one as figures_of

TableOne: TypeAlias = Mapping[str, str]
"""A sentence for each row of the table, by its heading."""

_PLACE_NAMES: Final = ("best", "2nd best", "3rd best", "4th best")


def table_one(worlds: Sequence[WorldOutcome]) -> TableOne:
    """The table's sentences; empty unless at least two of the paper's learners took part."""
    names = papers_learners(list(worlds[0].learners))
    if len(names) < 2:
        return {}
    returns = np.array([[one.learners[name].mean_return for name in names] for one in worlds])
    figures = figures_of(names, returns, np.array([one.human_mean for one in worlds]))
    human_row = (
        f"In {figures.below_all.count} of {figures.n} experiments, the human's average reward is outperformed by all"
        " other agents."
    )
    return {"Human demonstrations": human_row} | {LEARNERS[row.who].title: _learner_row(row) for row in figures.rows}


def _learner_row(row: TableOneRow) -> str:
    counted = [f"{name} in {one.count}" for name, one in zip(_PLACE_NAMES, row.placed, strict=False)]
    surpassed = [f"{LEARNERS[other].title} {n_times} times" for other, n_times in row.beaten.items()]
    return f"Performed the {', '.join(counted)} of {row.placed[0].of} experiments; surpassed {', '.join(surpassed)}."
