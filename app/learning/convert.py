"""Rows to what irl_core learns from, and back to what crosses the wire."""

from collections.abc import Mapping, Sequence
from typing import Any

from app.demonstrations.convert import demonstration_from_row
from app.learning.schemas import RunOut
from app.models import Demonstration, Run, RunResult
from irl_core import LEARNERS, LearningProblem, Ranking, Settings, World, rank_weights


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


def describe_learners(problem: LearningProblem) -> list[dict[str, Any]]:
    """List the learners, each with the sentence that says why it cannot learn from this, or None."""
    return [
        {
            "name": name,
            "title": learner.title,
            "uses_ranking": learner.uses_ranking,
            "uses_failures": learner.uses_failures,
            "missing": problem.missing(learner),
        }
        for name, learner in LEARNERS.items()
    ]


def describe_settings() -> list[dict[str, Any]]:
    """List the settings with their symbols in the paper, defaults, ranges and what each does."""
    return Settings.describe()


def to_out(run: Run, results: Mapping[str, RunResult]) -> RunOut:
    """Show a run with what its learners have come to."""
    finished = {name: results[name].result for name in run.learners if name in results}
    return RunOut(
        id=run.id,
        world_id=run.world_id,
        status=run.status,  # type: ignore[arg-type]  # the table checks the word
        reason=run.reason,
        seed=run.seed,
        settings=run.settings,
        learners={name: finished.get(name, {"outcome": None}) for name in run.learners},
        n_demonstrations=len(run.demonstrations),
        n_left_out=max((result["n_left_out"] for result in finished.values()), default=0),
        versions=run.versions,
        created_at=run.created_at,
        started_at=run.started_at,
        finished_at=run.finished_at,
    )
