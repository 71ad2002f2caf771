"""The paper's experiment (Sec. V), on simulated demonstrators and as many worlds as wanted.

spec = ExperimentSpec(seed=1)
outcomes = run_chunk(spec, "mixture", 0, 20)      # pure: worlds 0 … 19, wherever and however often it runs
summary = summarise(outcomes)[0]                   # shares of the optimum with intervals, places, wins, Table I
print(markdown(summarise(outcomes)))               # draw_figure(summaries, path) for the picture
"""

from irl_core.experiment.chunk import run_chunk
from irl_core.experiment.figure import draw_figure
from irl_core.experiment.outcomes import MEASURES, LearnerOutcome, Measure, WorldOutcome
from irl_core.experiment.spec import ExperimentSpec
from irl_core.experiment.summary import KindSummary, LearnerSummary, summarise
from irl_core.experiment.tables import Table, markdown, tables
from irl_core.many_worlds.bootstrap import Estimate

__all__ = [
    "MEASURES",
    "Estimate",
    "ExperimentSpec",
    "KindSummary",
    "LearnerOutcome",
    "LearnerSummary",
    "Measure",
    "Table",
    "WorldOutcome",
    "draw_figure",
    "markdown",
    "run_chunk",
    "summarise",
    "tables",
]
