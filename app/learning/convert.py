"""Rows to what irl_core learns from, and back to what crosses the wire."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Final, Protocol, runtime_checkable

from sqlalchemy.orm import Session

from app.demonstrations.convert import demonstration_from_row
from app.learning import queries
from app.learning.schemas import RunOut
from app.models import Demonstration, Run, RunResult
from irl_core import DEFAULT_LEARNERS, LEARNERS, Learner, LearningProblem, Ranking, Settings, World, rank_weights

SEEK_THE_VISITS: Final = frozenset({"meirl", "irlr", "irlf", "irlfr", "model_free"})
"""Learners whose iterations close the gap to the play. That of the others only tells how differently they walk."""


@runtime_checkable
class KnowsItsNeeds(Protocol):
    """A learner with limits of its own, which the problem does not know."""

    def missing(self, problem: LearningProblem) -> str | None: ...


def to_problem(
    world: World,
    demonstrations: Sequence[Demonstration],
    rankings: Mapping[str, Sequence[Sequence[str]]],
    *,
    settings: Mapping[str, Any],
    seed: int,
) -> LearningProblem:
    """Hand a snapshot to irl_core. Raises its InvalidSettings and MissingDemonstrations."""
    return LearningProblem.build(
        world,
        [demonstration_from_row(row) for row in demonstrations],
        to_rankings(rankings),
        settings=Settings.from_json(settings),
        seed=seed,
    )


def to_rankings(groups_by_outcome: Mapping[str, Sequence[Sequence[str]]]) -> list[Ranking]:
    """Hand stored orders to irl_core."""
    return [
        Ranking(outcome, tuple(tuple(group) for group in groups))  # type: ignore[arg-type]  # the table checks the word
        for outcome, groups in groups_by_outcome.items()
    ]


def snapshot_rankings(run: Run) -> dict[str, dict[str, Any] | None]:
    """Show the orders that a run learned from, with the weight that each place gave; None where there was no order."""
    return {
        outcome: {"outcome": outcome, "order": run.rankings[outcome], "weights": rank_weights(run.rankings[outcome])}
        if outcome in run.rankings
        else None
        for outcome in ("success", "failure")
    }


def describe_learners(names: Iterable[str] = tuple(LEARNERS)) -> list[dict[str, Any]]:
    """List learners with what a page says of them."""
    return [
        {
            "name": name,
            "title": LEARNERS[name].title,
            "summary": LEARNERS[name].summary,
            "family": LEARNERS[name].family,
            "uses_ranking": LEARNERS[name].uses_ranking,
            "uses_failures": LEARNERS[name].uses_failures,
            "uses_scores": LEARNERS[name].uses_scores,
            "takes_anything": LEARNERS[name].takes_anything,
            "seeks_visits": name in SEEK_THE_VISITS,
        }
        for name in names
    ]


def describe_choice(problem: LearningProblem) -> list[dict[str, Any]]:
    """List all learners to choose from; `missing` says in a sentence why one cannot learn from this, or is None."""
    return [
        told | {"preselected": told["name"] in DEFAULT_LEARNERS, "missing": missing(problem, LEARNERS[told["name"]])}
        for told in describe_learners()
    ]


def missing(problem: LearningProblem, learner: Learner) -> str | None:
    """Say in a sentence why a learner cannot learn from this, or None. Nothing is computed, as `start` might."""
    return learner.missing(problem) if isinstance(learner, KnowsItsNeeds) else problem.missing(learner)


def describe_settings() -> list[dict[str, Any]]:
    """List the settings with their symbols in the paper, defaults, ranges, what each does and for whom."""
    return [one | {"whole": isinstance(one["default"], int)} for one in Settings.describe()]


def to_out(session: Session, run: Run, *, is_own: bool = True) -> RunOut:
    """Show a run as it stands, with what its learners have come to."""
    (shown,) = runs_out(session, [run], is_own=is_own)
    return shown


def runs_out(session: Session, runs: Sequence[Run], *, is_own: bool = True) -> list[RunOut]:
    """Show runs as they stand."""
    run_ids = [run.id for run in runs]
    standings = queries.standings(session, run_ids)
    results = queries.results(session, run_ids)
    computed = queries.computed_ms(session, run_ids)
    return [_out(run, standings.get(run.id), results[run.id], computed[run.id], is_own=is_own) for run in runs]


def _out(
    run: Run,
    standing: queries.Standing | None,
    results: Mapping[str, RunResult],
    computed_ms: Mapping[str, float],
    *,
    is_own: bool,
) -> RunOut:
    return RunOut(
        id=run.id,
        world_id=run.world_id,
        is_own=is_own,
        status=run.status,  # type: ignore[arg-type]  # the table checks the word
        reason=run.reason,
        ahead=standing.ahead if standing else None,
        worker=standing.worker if standing else "ready",
        seed=run.seed,
        settings=run.settings,
        learners={name: results[name].result if name in results else {"outcome": None} for name in run.learners},
        compute_ms={name: round(computed_ms[name], 3) for name in run.learners if name in computed_ms},
        n_demonstrations=len(run.demonstrations),
        n_left_out=max((row.result["n_left_out"] for row in results.values()), default=0),
        versions=run.versions,
        created_at=run.created_at,
        started_at=run.started_at,
        finished_at=run.finished_at,
    )
