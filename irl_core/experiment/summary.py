"""An experiment in figures: shares of the optimum with intervals, places, wins, and how learning ended.

Places are among the learners of one world, 1 is best; those within 1e-9 of the optimum of each other share the mean of
their places (midrank), and a learner without a figure comes last. "Wins" is the share of worlds in which the one in the
row earned more than the one in the column, half of the ties counted. "Above the human" asks for a finite expected
return of the soft policy that is larger than the mean of the demonstrations.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from irl_core.arrays import Matrix, Vector
from irl_core.checks import shown
from irl_core.errors import IrlError
from irl_core.experiment.outcomes import MEASURES, Measure, WorldOutcome, finite_or_none
from irl_core.experiment.table_one import TableOne, table_one
from irl_core.learners import LEARNERS
from irl_core.many_worlds.bootstrap import Estimate, Resamples, draw, estimate
from irl_core.many_worlds.duels import duels, midranks


@dataclass(frozen=True)
class LearnerSummary:
    """One learner with one kind of demonstrator. `share`, `mean_return`, `mean_place` are by measure."""

    name: str
    title: str
    share: Mapping[Measure, Estimate]
    mean_return: Mapping[Measure, float]
    mean_place: Mapping[Measure, float]
    above_human: float
    outcomes: Mapping[str, int]
    median_gap: float

    def to_json(self) -> dict[str, Any]:
        """Every field by its name."""
        return {
            "name": self.name,
            "title": self.title,
            "share": {measure: share.to_json() for measure, share in self.share.items()},
            "mean_return": {measure: finite_or_none(mean) for measure, mean in self.mean_return.items()},
            "mean_place": dict(self.mean_place),
            "above_human": self.above_human,
            "outcomes": dict(self.outcomes),
            "median_gap": finite_or_none(self.median_gap),
        }


@dataclass(frozen=True)
class KindSummary:
    """One kind of demonstrator. `wins` and `differences` (row less column) are by measure, then learner by learner."""

    demonstrator: str
    n_worlds: int
    n_redrawn: int
    mean_attempts: float
    mean_optimum: float
    human: Estimate
    best_attempt: Estimate
    learners: tuple[LearnerSummary, ...]
    wins: Mapping[Measure, tuple[tuple[float, ...], ...]]
    differences: Mapping[Measure, tuple[tuple[Estimate, ...], ...]]
    table_one: TableOne

    def learner(self, name: str) -> LearnerSummary:
        """The learner of this name."""
        return self.learners[self.index(name)]

    def difference(self, name: str, other: str, *, measure: Measure = "greedy") -> Estimate:
        """How much larger one learner's share of the optimum is than another's, paired by world."""
        return self.differences[measure][self.index(name)][self.index(other)]

    def index(self, name: str) -> int:
        """Where a learner stands in this summary. Raises IrlError if it took no part."""
        names = [one.name for one in self.learners]
        if name not in names:
            raise IrlError(f"{name} took no part in this experiment; {', '.join(names)} did.", field="learners")
        return names.index(name)

    def to_json(self) -> dict[str, Any]:
        """Every field by its name."""
        return {
            "demonstrator": self.demonstrator,
            "n_worlds": self.n_worlds,
            "n_redrawn": self.n_redrawn,
            "mean_attempts": self.mean_attempts,
            "mean_optimum": self.mean_optimum,
            "human": self.human.to_json(),
            "best_attempt": self.best_attempt.to_json(),
            "learners": [one.to_json() for one in self.learners],
            "wins": {measure: [list(row) for row in rows] for measure, rows in self.wins.items()},
            "differences": {
                measure: [[one.to_json() for one in row] for row in rows] for measure, rows in self.differences.items()
            },
            "table_one": dict(self.table_one),
        }


def summarise(outcomes: Iterable[WorldOutcome], *, seed: int = 0) -> tuple[KindSummary, ...]:
    """A summary for each kind of demonstrator, in the order met; `seed` is for the resamples.

    The order of worlds changes nothing. Raises IrlError where worlds differ in their learners or come twice.
    """
    by_kind: dict[str, dict[int, WorldOutcome]] = {}
    given: Any = outcomes
    for one in given if isinstance(given, Iterable) else [given]:
        if not isinstance(one, WorldOutcome):
            raise IrlError(f"outcomes must be a list of WorldOutcomes; here is {shown(one)}.", field="outcomes")
        worlds = by_kind.setdefault(one.demonstrator, {})
        if one.index in worlds:
            raise IrlError(f"World {one.index} of {one.demonstrator} comes twice.", field="outcomes")
        worlds[one.index] = one
    return tuple(
        _summary_of_kind(kind, [worlds[index] for index in sorted(worlds)], seed) for kind, worlds in by_kind.items()
    )


def _summary_of_kind(kind: str, worlds: Sequence[WorldOutcome], seed: int) -> KindSummary:
    names = list(worlds[0].learners)
    if any(list(one.learners) != names for one in worlds):
        raise IrlError(f"The worlds of {kind} do not all have the same learners.", field="outcomes")
    optima = np.array([one.optimum for one in worlds])
    human, best = (np.array([getattr(one, name) for one in worlds]) for name in ("human_mean", "best_attempt"))
    resamples = Resamples(optima, draw(len(optima), seed))
    returns = {measure: _returns(worlds, names, measure) for measure in MEASURES}
    shares = {measure: resamples.shares(returns[measure]) for measure in MEASURES}
    places = {measure: midranks(_last_without(returns[measure]), optima) for measure in MEASURES}
    above = np.isfinite(returns["soft"]) & (np.nan_to_num(returns["soft"]) > human[:, None])
    learners = [
        LearnerSummary(
            name=name,
            title=LEARNERS[name].title if name in LEARNERS else name,
            share={measure: estimate(shares[measure][:, column]) for measure in MEASURES},
            mean_return={measure: _mean_of_finite(returns[measure][:, column]) for measure in MEASURES},
            mean_place={measure: float(places[measure][:, column].mean()) for measure in MEASURES},
            above_human=float(above[:, column].mean()),
            outcomes=Counter(one.learners[name].outcome for one in worlds),
            median_gap=_median_of_finite(np.array([one.learners[name].gap for one in worlds])),
        )
        for column, name in enumerate(names)
    ]
    return KindSummary(
        demonstrator=kind,
        n_worlds=len(worlds),
        n_redrawn=sum(one.n_redrawn for one in worlds),
        mean_attempts=float(np.mean([one.n_attempts for one in worlds])),
        mean_optimum=float(optima.mean()),
        human=estimate(resamples.shares(human[:, None])[:, 0]),
        best_attempt=estimate(resamples.shares(best[:, None])[:, 0]),
        learners=tuple(learners),
        wins={measure: _wins(returns[measure], optima) for measure in MEASURES},
        differences={measure: _differences(shares[measure]) for measure in MEASURES},
        table_one=table_one(worlds),
    )


def _returns(worlds: Sequence[WorldOutcome], names: Sequence[str], measure: Measure) -> Matrix:
    """What each learner earned in each world, shape (n, L)."""
    returns: Matrix = np.array([[one.learners[name].score(measure) for name in names] for one in worlds])
    return returns


def _last_without(returns: Matrix) -> Matrix:
    """Scores by which a learner without a figure comes last."""
    scores: Matrix = np.where(np.isfinite(returns), returns, -np.finfo(np.float64).max)
    return scores


def _wins(returns: Matrix, optima: Vector) -> tuple[tuple[float, ...], ...]:
    wins, ties = duels(_last_without(returns), optima)
    return tuple(tuple(row) for row in (wins + 0.5 * ties).mean(axis=0).tolist())


def _differences(shares: Matrix) -> tuple[tuple[Estimate, ...], ...]:
    n_learners = shares.shape[1]
    return tuple(
        tuple(estimate(shares[:, row] - shares[:, column]) for column in range(n_learners)) for row in range(n_learners)
    )


def _mean_of_finite(values: Vector) -> float:
    finite = values[np.isfinite(values)]
    return float(finite.mean()) if len(finite) else float("nan")


def _median_of_finite(values: Vector) -> float:
    finite = values[np.isfinite(values)]
    return float(np.median(finite)) if len(finite) else float("nan")
