"""What people can do with runs: ask for one, cancel one, delete one."""

import platform
import secrets
import uuid
from collections.abc import Sequence
from functools import cache
from importlib.metadata import version

from sqlalchemy import delete as remove
from sqlalchemy import update
from sqlalchemy.orm import Session

from app.demonstrations import queries as demonstrations
from app.errors import Conflict, Unprocessable
from app.kit import clock
from app.learning import events, queries
from app.learning.convert import missing, to_problem
from app.learning.jobs import Jobs
from app.learning.schemas import RunIn
from app.models import Demonstration, Run
from app.rankings import queries as rankings
from app.worlds.convert import StoredWorld
from irl_core import DEFAULT_LEARNERS, LEARNERS, LearningProblem, MissingDemonstrations

CANCELLED = "You cancelled this run."


def learn_later(session: Session, jobs: Jobs, *, world: StoredWorld, visitor_id: str, asked: RunIn) -> Run:
    """Store a run of the visitor's demonstrations and rankings as they are now, and queue it.

    Raises Unprocessable for unknown learners and for rankings that no longer fit, and irl_core's InvalidSettings and
    MissingDemonstrations for what a learner could not start with.
    """
    names = asked.learners or list(DEFAULT_LEARNERS)
    _check_names(names)
    kept = demonstrations.kept_in_world(session, visitor_id, world.id)
    groups = current_rankings(session, visitor_id, world.id, kept)
    seed = secrets.randbelow(2**31) if asked.seed is None else asked.seed
    problem = to_problem(world.world, kept, groups, settings=asked.settings, seed=seed)
    _check_can_learn(names, problem)
    run = Run(
        id=str(uuid.uuid4()),
        world_id=world.id,
        visitor_id=visitor_id,
        learners=names,
        settings=problem.settings.to_json(),
        seed=seed,
        demonstrations=[row.id for row in kept],
        rankings=groups,
        versions=dict(software_versions()),
        status="queued",
        created_at=clock.now(),
    )
    session.add(run)
    session.flush()
    jobs.enqueue(session, run)
    return run


def cancel(session: Session, run_id: str) -> None:
    """End a run that has not ended. Its worker notices at its next step; what it had shown stays.

    Raises Conflict if it had ended already.
    """
    changed = session.execute(
        update(Run)
        .where(Run.id == run_id, Run.status.not_in(queries.ENDED))
        .values(status="cancelled", reason=CANCELLED, finished_at=clock.now())
        .returning(Run.id)
    ).first()
    if changed is None:
        message = "This run has already ended, so it can no longer be cancelled."
        raise Conflict(message, code="run_already_ended")
    events.append(session, run_id, "failed", {"status": "cancelled", "message": CANCELLED})


def delete(session: Session, run_id: str) -> None:
    """Delete a run with all that hangs on it. A worker in the midst of it notices at its next step."""
    session.execute(remove(Run).where(Run.id == run_id))


def current_rankings(
    session: Session, visitor_id: str | None, world_id: str, kept: Sequence[Demonstration]
) -> dict[str, list[list[str]]]:
    """Return the visitor's orders that still speak of exactly the demonstrations that are kept: outcome → groups."""
    return {
        outcome: ranking.order
        for outcome, ranking in rankings.newest(session, visitor_id, world_id).items()
        if _covers(ranking.order, kept, outcome)
    }


@cache
def software_versions() -> dict[str, str]:
    """Name what a result depends on beside its inputs. Reading it takes milliseconds, and it never changes here."""
    packages = ("irlfr", "numba", "numpy", "scipy")
    return {name: version(name) for name in packages} | {"python": platform.python_version()}


def _check_names(names: Sequence[str]) -> None:
    known = ", ".join(LEARNERS)
    if any(name not in LEARNERS for name in names):
        message = f"There is a learner here that does not exist; there are {known}."
        raise Unprocessable(message, fields={"learners": f"must be among {known}"})
    if len(set(names)) < len(names):
        message = "A learner is named twice; once is enough."
        raise Unprocessable(message, fields={"learners": "must not repeat"})


def _check_can_learn(names: Sequence[str], problem: LearningProblem) -> None:
    """Refuse a learner that lacks something, and say who could learn from what there is."""
    for name in names:
        if sentence := missing(problem, LEARNERS[name]):
            able = [learner.title for learner in LEARNERS.values() if not missing(problem, learner)]
            others = f" As it stands, these can learn: {', '.join(able)}." if able else ""
            raise MissingDemonstrations(f"{sentence}{others}", field="learners")


def _covers(order: Sequence[Sequence[str]], kept: Sequence[Demonstration], outcome: str) -> bool:
    """Tell whether a ranking still speaks of exactly the demonstrations that are kept."""
    return {row.id for row in kept if row.outcome == outcome} == {id_ for group in order for id_ in group}
