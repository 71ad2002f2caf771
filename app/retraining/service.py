"""What people can have learned again at once, without a run. Nothing of it is stored."""

from collections.abc import Mapping, Sequence
from typing import Any

from anyio import to_thread

from app.db import Database
from app.demonstrations import queries as demonstrations
from app.errors import Conflict, Unprocessable
from app.kit.companion import Asker, Line
from app.learning import queries as runs
from app.learning.convert import missing, to_problem
from app.models import Demonstration, Run
from app.rankings.content import OUTCOMES
from app.rankings.queries import Attempt
from app.rankings.service import check_order
from app.retraining import computing
from app.retraining.answers import Answers
from app.retraining.convert import changed_out, learned_out
from app.retraining.findings import Finding, find_influence, find_uncertainty
from app.retraining.refusals import TOO_SLOW, in_words, missing_demonstrations
from app.retraining.schemas import OrdersIn, PreviewIn, WhatIfIn
from app.worlds.convert import StoredWorld
from irl_core import LEARNERS, LearningProblem, LearningResult

SHOW_WHAT_AN_ORDER_TEACHES = ("irlfr", "irlr", "irlf", "meirl", "birlfr")
"""The first of them that can learn from it."""
NOTHING_YET = "There is nothing to learn from yet: none of the attempts has reached the goal."
SEED = 0
"""A preview always has the same, so that the same order shows the same policy."""


async def preview(
    asker: Asker, database: Database, *, world: StoredWorld, visitor_id: str | None, asked: PreviewIn
) -> dict[str, Any]:
    """Learn from orders as they stand. Raises Unprocessable; Conflict where this asker wants another by now."""
    line = asker.line("preview")
    learner, problem = await to_thread.run_sync(_previewed, database, world, visitor_id, asked)
    with in_words(too_slow=TOO_SLOW):
        return learned_out(await line.ask(computing.learn_again, learner, problem))


async def what_if(asker: Asker, database: Database, run: Run, asked: WhatIfIn) -> dict[str, Any]:
    """Learn what a run learned, with one thing changed. Raises Unprocessable and Conflict."""
    line, change = asker.line("what-if"), asked.change.told
    _check_attempts(run, change)
    problem, before = await to_thread.run_sync(learned_by, database, run, asked.learner)
    with in_words():
        return changed_out(await line.ask(computing.learn_changed, problem, before, change), change)


async def influence(asker: Asker, answers: Answers, run: Run, learner: str) -> dict[str, Any]:
    """Tell what each demonstration of a run changed in what this learner came to. Raises Unprocessable and Conflict."""
    return await _found_out(asker, answers, run, learner, find_influence)


async def uncertainty(asker: Asker, answers: Answers, run: Run, learner: str) -> dict[str, Any]:
    """Tell how sure this learner of a run can be. Raises Unprocessable and Conflict."""
    return await _found_out(asker, answers, run, learner, find_uncertainty)


async def _found_out(asker: Asker, answers: Answers, run: Run, learner: str, find: Finding) -> dict[str, Any]:
    async def work(line: Line) -> dict[str, Any]:
        problem, whole = await to_thread.run_sync(learned_by, answers.database, run, learner)
        return await find(line, problem, whole)

    with in_words():
        return await answers.find(asker, find.__name__, run.id, learner, work=work)


def _check_attempts(run: Run, change: Mapping[str, Any]) -> None:
    """Raise Unprocessable where a change speaks of an attempt that the run did not learn from."""
    told = {one for said in change.values() for one in ([said] if isinstance(said, str) else said)}
    if not told <= set(run.demonstrations):
        message = "There is an attempt in this change that is not one of this run's."
        raise Unprocessable(message, fields={"change": message})


def learned_by(database: Database, run: Run, learner: str) -> tuple[LearningProblem, LearningResult]:
    """Load what a run learned from, and what one of its learners came to. Raises Unprocessable and Conflict."""
    if learner not in run.learners:
        message = f"This learner is not one of this run's, which are {', '.join(run.learners)}."
        raise Unprocessable(message, fields={"learner": message})
    with database.read() as session:
        world = runs.world_of(session, run).world
        rows = runs.demonstrations_of(session, run)
        stored = runs.results(session, [run.id])[run.id].get(learner)
    if stored is None:
        message = f"{LEARNERS[learner].title} has not finished in this run, so there is nothing to compare with."
        raise Conflict(message, code="no_result")
    problem = to_problem(world, rows, run.rankings, settings=run.settings, seed=run.seed)
    return problem, LearningResult.from_json(stored.result)


def _previewed(
    database: Database, world: StoredWorld, visitor_id: str | None, asked: PreviewIn
) -> tuple[str, LearningProblem]:
    with database.read() as session:
        rows = demonstrations.all_in_world(session, visitor_id, world.id)
    orders = _checked(rows, asked.orders)
    kept = [row for row in rows if row.discarded_at is None]
    problem = to_problem(world.world, kept, orders, settings=asked.settings, seed=SEED)
    return _learner_for(problem, asked.learner), problem


def _checked(rows: Sequence[Demonstration], told: OrdersIn) -> dict[str, list[list[str]]]:
    """Return the orders that are told, each of exactly the attempts that are kept."""
    attempts = {row.id: Attempt(row.id, row.outcome, row.discarded_at is None, len(row.actions)) for row in rows}
    orders: dict[str, list[list[str]]] = {}
    for outcome in OUTCOMES:
        if order := getattr(told, outcome):
            check_order(order, attempts, outcome)
            orders[outcome] = order
    return orders


def _learner_for(problem: LearningProblem, asked: str | None) -> str:
    """Return the learner that is asked for, or the first that can learn from this. Raises Unprocessable."""
    if asked is not None and asked not in LEARNERS:
        message = f"There is no such learner; there are {', '.join(LEARNERS)}."
        raise Unprocessable(message, fields={"learner": message})
    sentences = {name: missing(problem, LEARNERS[name]) for name in ([asked] if asked else SHOW_WHAT_AN_ORDER_TEACHES)}
    able = [name for name, sentence in sentences.items() if sentence is None]
    if able:
        return able[0]
    if asked is None and not problem.successes and not problem.failures:
        raise missing_demonstrations(NOTHING_YET)
    raise missing_demonstrations(next(sentence for sentence in sentences.values() if sentence))
