"""An experiment as tables for people: in Markdown, or one by one for whoever prints them."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from statistics import fmean
from typing import Final

from irl_core.demonstrators import DEMONSTRATORS
from irl_core.experiment.outcomes import Measure
from irl_core.experiment.summary import KindSummary, LearnerSummary
from irl_core.learners import LEARNERS
from irl_core.many_worlds.bootstrap import Estimate

_HOW: Final[dict[Measure, str]] = {
    "episodes": "played episodes",
    "soft": "policy executed as learned",
    "greedy": "best plan under the learned reward",
}
_REFERENCE: Final = "meirl"


@dataclass(frozen=True)
class Table:
    """A title, a header, rows of as many texts, and what a reader should know."""

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""
    is_detail: bool = False

    def to_markdown(self) -> str:
        """The table in Markdown, figures to the right."""
        ruler = ["---"] + ["---:" if _is_figure(cell) else "---" for cell in self.rows[0][1:]]
        lines = ["| " + " | ".join(cells) + " |" for cells in (self.header, ruler, *self.rows)]
        return "\n".join([f"## {self.title}", "", *([self.note, ""] if self.note else []), *lines])


def markdown(summaries: Sequence[KindSummary]) -> str:
    """All tables of an experiment."""
    return "\n\n".join(table.to_markdown() for table in tables(summaries)) + "\n"


def tables(summaries: Sequence[KindSummary]) -> list[Table]:
    """Shares of the optimum and differences first, then the details of each kind of demonstrator."""
    overview = [_shares(summaries, "soft"), _shares(summaries, "greedy")]
    differences = [
        _differences(summaries, learner.name) for learner in summaries[0].learners if _family(learner.name) == "ours"
    ]
    overview += [*(table for table in differences if table is not None), _above_human(summaries)]
    details = [table for one in summaries for table in (_learners(one), _wins(one, "soft"), _wins(one, "greedy"))]
    first_tables = [_table_one(one) for one in summaries if one.table_one]
    return [*overview, *details, *first_tables]


def title_of(kind: str) -> str:
    """What people call a kind of demonstrator."""
    return DEMONSTRATORS[kind].title if kind in DEMONSTRATORS else kind


def _shares(summaries: Sequence[KindSummary], measure: Measure) -> Table:
    def row(title: str, estimate_of: Callable[[KindSummary], Estimate]) -> tuple[str, ...]:
        estimates = [estimate_of(one) for one in summaries]
        mean = [_figure(fmean(one.value for one in estimates))] if len(summaries) > 1 else []
        return (title, *(f"{one}" for one in estimates), *mean)

    return Table(
        title=f"Share of the optimum: {_HOW[measure]}",
        header=("", *_kind_titles(summaries), *(["Mean"] if len(summaries) > 1 else [])),
        rows=(
            row("Human, mean", lambda kind: kind.human),
            row("Human, best attempt", lambda kind: kind.best_attempt),
            *(row(one.title, _share_of(one.name, measure)) for one in summaries[0].learners),
        ),
        note=f"Exact expected return over the optimum's, with 95 % bootstrap intervals; {_worlds(summaries)}.",
    )


def _above_human(summaries: Sequence[KindSummary]) -> Table:
    def row(title: str, shares: Sequence[float]) -> tuple[str, ...]:
        mean = [fmean(shares)] if len(shares) > 1 else []
        return (title, *(f"{100 * share:.1f} %" for share in (*shares, *mean)))

    return Table(
        title="Worlds in which a learner is finite and above the human",
        header=("", *_kind_titles(summaries), *(["Mean"] if len(summaries) > 1 else [])),
        rows=tuple(
            row(one.title, [kind.learner(one.name).above_human for kind in summaries]) for one in summaries[0].learners
        ),
        note="The expected return of the policy as learned against the mean of the person's attempts.",
    )


def _share_of(name: str, measure: Measure) -> Callable[[KindSummary], Estimate]:
    return lambda kind: kind.learner(name).share[measure]


def _differences(summaries: Sequence[KindSummary], name: str) -> Table | None:
    others = [
        one for one in summaries[0].learners if one.name != name and any(_plans(kind, one.name) for kind in summaries)
    ]
    if not others:
        return None
    return Table(
        title=f"{summaries[0].learner(name).title} less each other learner: {_HOW['greedy']}",
        header=("less", *_kind_titles(summaries)),
        rows=tuple((one.title, *(f"{kind.difference(name, one.name)}" for kind in summaries)) for one in others),
        note="Difference of the shares of the optimum, paired by world, with 95 % bootstrap intervals.",
    )


def _learners(kind: KindSummary) -> Table:
    has_reference = any(one.name == _REFERENCE for one in kind.learners)
    return Table(
        title=f"{title_of(kind.demonstrator)}: the learners",
        header=(
            "",
            "episodes, points",
            "place, soft",
            "place, greedy",
            f"wins against {LEARNERS[_REFERENCE].title}" if has_reference else "wins",
            "above the human",
            "median gap",
            "how learning ended",
        ),
        rows=tuple(_learner_row(kind, one, has_reference=has_reference) for one in kind.learners),
        note=(
            f"{kind.n_worlds} worlds ({kind.n_redrawn} more were redrawn), {kind.mean_attempts:.0f} attempts each,"
            f" optimum {kind.mean_optimum:.2f} points on average."
        ),
        is_detail=True,
    )


def _plans(kind: KindSummary, name: str) -> bool:
    """Whether a learner has learned a reward to plan with."""
    return math.isfinite(kind.learner(name).share["greedy"].value)


def _learner_row(kind: KindSummary, one: LearnerSummary, *, has_reference: bool) -> tuple[str, ...]:
    wins = kind.wins["soft"][kind.index(one.name)][kind.index(_REFERENCE)] if has_reference else math.nan
    return (
        one.title,
        _figure(one.mean_return["episodes"]),
        _figure(one.mean_place["soft"]),
        _figure(one.mean_place["greedy"] if _plans(kind, one.name) else math.nan),
        _figure(math.nan if one.name == _REFERENCE else wins),
        f"{100 * one.above_human:.1f} %",
        _figure(one.median_gap, digits=3),
        ", ".join(f"{outcome.replace('_', ' ')} {n}" for outcome, n in sorted(one.outcomes.items())),
    )


def _wins(kind: KindSummary, measure: Measure) -> Table:
    taking_part = [i for i, one in enumerate(kind.learners) if measure != "greedy" or _plans(kind, one.name)]
    titles = [one.title for one in kind.learners]
    wins = kind.wins[measure]
    return Table(
        title=f"{title_of(kind.demonstrator)}: who beats whom, {_HOW[measure]}",
        header=("row beats column", *(titles[i] for i in taking_part)),
        rows=tuple((titles[i], *("" if i == j else _figure(wins[i][j]) for j in taking_part)) for i in taking_part),
        note="Share of worlds, half of the ties counted.",
        is_detail=True,
    )


def _table_one(kind: KindSummary) -> Table:
    return Table(
        title=f"{title_of(kind.demonstrator)}: Table I in the paper's form",
        header=("", "mean of played episodes"),
        rows=tuple(kind.table_one.items()),
        is_detail=True,
    )


def _family(name: str) -> str:
    return LEARNERS[name].family if name in LEARNERS else ""


def _kind_titles(summaries: Iterable[KindSummary]) -> list[str]:
    return [title_of(one.demonstrator) for one in summaries]


def _worlds(summaries: Sequence[KindSummary]) -> str:
    n_worlds = sorted({one.n_worlds for one in summaries})
    return f"{' or '.join(map(str, n_worlds))} worlds for each kind of demonstrator"


def _figure(value: float, *, digits: int = 2) -> str:
    return "–" if value != value else f"{value:.{digits}f}".replace("-", "−")  # noqa: PLR0124 - NaN


def _is_figure(cell: str) -> bool:
    return cell[:1] in "−–0123456789" or not cell
