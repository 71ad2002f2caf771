"""Many comparisons together: a person's worlds, a class's, an experiment's.

overview = look_over([Measured(unit="world 1", optimum=7.7, expected={"human": 0.2, "irlfr": 5.1}, played={…}), …])
overview.standings      # places and shares of the optimum, with 95 % intervals
overview.duels          # who beats whom, with sign tests
overview.table_one      # Table I of the paper
"""

from irl_core.many_worlds.bootstrap import Estimate
from irl_core.many_worlds.intervals import LEAST_UNITS, Proportion, Share, proportion, share_of_optimum
from irl_core.many_worlds.overview import Duel, Measured, Overview, Standing, look_over
from irl_core.many_worlds.signs import sign_test
from irl_core.many_worlds.table_one import TableOne, TableOneRow

__all__ = [
    "LEAST_UNITS",
    "Duel",
    "Estimate",
    "Measured",
    "Overview",
    "Proportion",
    "Share",
    "Standing",
    "TableOne",
    "TableOneRow",
    "look_over",
    "proportion",
    "share_of_optimum",
    "sign_test",
]
