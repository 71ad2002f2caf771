"""Table I of the paper, in its form: how often each came first, second, … in played episodes, and who beat whom.

As in the paper, the human's figure is the mean of all demonstrations, a learner's the mean of its episodes, and places
are among the paper's own learners, whatever others took part; equals share the better place.
"""

from collections.abc import Mapping, Sequence
from typing import Final, TypeAlias

import numpy as np

from irl_core.comparison import places
from irl_core.experiment.outcomes import WorldOutcome
from irl_core.learners import LEARNERS

TableOne: TypeAlias = Mapping[str, str]
"""A sentence for each row of the table, by its heading."""

_PLACE_NAMES: Final = ("best", "2nd best", "3rd best", "4th best")


def table_one(worlds: Sequence[WorldOutcome]) -> TableOne:
    """The table's sentences; empty unless at least two of the paper's learners took part."""
    names = [name for name in worlds[0].learners if name in LEARNERS and LEARNERS[name].family == "paper"]
    if len(names) < 2:
        return {}
    returns = np.nan_to_num([[one.learners[name].mean_return for name in names] for one in worlds], nan=-np.inf)
    human = np.array([one.human_mean for one in worlds])
    placed = np.array([places(row, tolerance=0.0) for row in returns.tolist()])
    table = {"Human demonstrations": _human_row(returns, human)}
    for column, name in enumerate(names):
        beaten = {
            LEARNERS[other].title: int((returns[:, column] > returns[:, rival]).sum())
            for rival, other in enumerate(names)
            if rival != column
        }
        table[LEARNERS[name].title] = _learner_row(placed[:, column].tolist(), beaten)
    return table


def _human_row(
    returns: np.ndarray[tuple[int, int], np.dtype[np.float64]], human: np.ndarray[tuple[int], np.dtype[np.float64]]
) -> str:
    n_all = int((returns > human[:, None]).all(axis=1).sum())
    return f"In {n_all} of {len(human)} experiments, the human's average reward is outperformed by all other agents."


def _learner_row(placed: Sequence[int], beaten: Mapping[str, int]) -> str:
    counted = [
        f"{name} in {placed.count(place)}" for place, name in enumerate(_PLACE_NAMES[: len(beaten) + 1], start=1)
    ]
    surpassed = [f"{title} {n_times} times" for title, n_times in beaten.items()]
    return f"Performed the {', '.join(counted)} of {len(placed)} experiments; surpassed {', '.join(surpassed)}."
