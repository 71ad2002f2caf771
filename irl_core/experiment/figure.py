"""An experiment as a picture: for each kind of demonstrator, the share of the optimum each learner reaches.

A panel a kind, a line a learner. Open marks: the policy executed as learned; filled: the best plan under the learned
reward; whiskers: 95 % intervals; the dotted and dashed lines are the human's mean and best attempt. Colours are Okabe
and Ito's (told apart with any colour vision), and each family of learners has a mark of its own besides.
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from irl_core.experiment.summary import KindSummary
from irl_core.experiment.tables import title_of
from irl_core.learners import LEARNERS
from irl_core.learners.base import Family
from irl_core.many_worlds.bootstrap import Estimate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLUMNS: Final = 3
_LEFT: Final = -0.5
_MARKS: Final = {  # colour, mark and name of each family
    "paper": ("#0072B2", "o", "the paper's"),
    "ours": ("#D55E00", "D", "ours"),
    "baseline": ("#009E73", "s", "neighbourhood"),
}
_STYLE: Final[dict[Any, Any]] = {"svg.hashsalt": "irlfr", "svg.fonttype": "path", "font.size": 9, "axes.titlesize": 10}


def draw_figure(summaries: Sequence[KindSummary], path: Path) -> None:
    """Draw the picture and write it to `path` (SVG, PNG or PDF by its suffix); the same figures give the same file."""
    import matplotlib as mpl  # noqa: PLC0415 - only who draws waits for it
    from matplotlib.figure import Figure  # noqa: PLC0415 - as above

    n_columns = min(_COLUMNS, len(summaries))
    n_rows = -(-len(summaries) // n_columns)
    n_learners = len(summaries[0].learners)
    with mpl.rc_context(_STYLE):
        figure = Figure(figsize=(1.6 + 2.9 * n_columns, (0.9 + 0.27 * n_learners) * n_rows + 0.7), layout="constrained")
        panels = figure.subplots(n_rows, n_columns, sharey=True, sharex=True, squeeze=False)
        for panel in panels.flat[len(summaries) :]:
            panel.set_axis_off()
        for summary, panel in zip(summaries, panels.flat, strict=False):
            _draw_panel(panel, summary)
        for panel in panels[-1]:
            panel.set_xlabel("share of the optimum")
        _draw_legend(figure, panels[0, 0], summaries[0])
        figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)


def _draw_legend(figure: "Figure", panel: "Axes", summary: KindSummary) -> None:
    """Lines and fillings, from a panel; then the families that took part."""
    from matplotlib.lines import Line2D  # noqa: PLC0415 - as above

    handles, labels = panel.get_legend_handles_labels()
    for family in dict.fromkeys(_family(one.name) for one in summary.learners):
        colour, mark, name = _MARKS[family]
        handles.append(Line2D([], [], color=colour, marker=mark, linestyle="none"))
        labels.append(name)
    figure.legend(handles, labels, loc="outside lower center", ncols=4, frameon=False)


def _family(name: str) -> Family:
    return LEARNERS[name].family if name in LEARNERS else "baseline"


def _draw_panel(panel: "Axes", summary: KindSummary) -> None:
    names = [one.title for one in summary.learners]
    panel.axvline(summary.human.value, color="0.35", linestyle=":", linewidth=1.2, label="human, mean")
    panel.axvline(summary.best_attempt.value, color="0.35", linestyle="--", linewidth=1.2, label="human, best attempt")
    for line, one in enumerate(summary.learners):
        colour, mark, _ = _MARKS[_family(one.name)]
        named = line == 0
        _draw_estimate(panel, line - 0.14, one.share["soft"], colour, mark, filled=False, named=named)
        _draw_estimate(panel, line + 0.14, one.share["greedy"], colour, mark, filled=True, named=named)
    panel.set_yticks(range(len(names)), names)
    panel.set_ylim(len(names) - 0.5, -0.5)
    panel.set_xlim(_LEFT, 1.05)
    panel.grid(axis="x", color="0.9")
    panel.set_axisbelow(True)
    panel.spines[["top", "right"]].set_visible(False)
    panel.set_title(f"{title_of(summary.demonstrator)} ({summary.n_worlds} worlds)", loc="left")


def _draw_estimate(
    panel: "Axes", line: float, share: Estimate, colour: str, mark: str, *, filled: bool, named: bool
) -> None:
    """One mark with its whiskers; a mark left of the panel is drawn at its edge, as an arrow."""
    if not math.isfinite(share.value):
        return
    is_outside = share.value < _LEFT
    panel.errorbar(
        max(share.value, _LEFT + 0.03),
        line,
        xerr=None if is_outside else [[share.value - share.low], [share.high - share.value]],
        color=colour,
        marker="<" if is_outside else mark,
        markersize=5,
        markerfacecolor=colour if filled else "white",
        linestyle="none",
        linewidth=1.2,
        label=("best plan" if filled else "policy as learned") if named else None,
    )
