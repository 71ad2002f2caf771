"""What can be asked about runs."""

from collections.abc import Collection, Sequence
from datetime import timedelta

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from app.kit.clock import now
from app.models import Demonstration, Run, RunEvent, RunResult, Worker
from app.worlds.convert import StoredWorld
from app.worlds.queries import find_world

WORKER_IS_SILENT_AFTER = timedelta(seconds=15)
ENDED = ("done", "failed", "cancelled")


def world_of(session: Session, run: Run) -> StoredWorld:
    """Load the world of a run, which a foreign key keeps in place."""
    stored = find_world(session, run.world_id)
    assert stored is not None  # noqa: S101 - for the type checker: the foreign key has made sure
    return stored


def demonstrations_of(session: Session, run: Run) -> Sequence[Demonstration]:
    """Load the demonstrations that a run learns from, oldest first."""
    ids = set(run.demonstrations)  # sorted out here: SQLite takes no more than 32,766 values in one question
    theirs = (Demonstration.visitor_id == run.visitor_id, Demonstration.world_id == run.world_id)
    rows = session.scalars(select(Demonstration).where(*theirs).order_by(Demonstration.number))
    return [row for row in rows if row.id in ids]


def runs_of(session: Session, visitor_id: str | None, world_id: str) -> Sequence[Run]:
    """List a visitor's runs in a world, oldest first."""
    return session.scalars(
        select(Run).where(Run.visitor_id == visitor_id, Run.world_id == world_id).order_by(Run.created_at, Run.id)
    ).all()


def latest_run(session: Session, visitor_id: str | None, world_id: str) -> Run | None:
    """Find the run that this visitor asked for last in this world."""
    return session.scalar(
        select(Run)
        .where(Run.visitor_id == visitor_id, Run.world_id == world_id)
        .order_by(Run.created_at.desc(), Run.id.desc())
        .limit(1)
    )


def latest_done_run(session: Session, visitor_id: str | None, world_id: str) -> Run | None:
    """Find the last run of this visitor in this world that has a comparison."""
    return session.scalar(
        select(Run)
        .where(Run.visitor_id == visitor_id, Run.world_id == world_id, Run.status == "done")
        .order_by(Run.created_at.desc(), Run.id.desc())
        .limit(1)
    )


def results(session: Session, run_ids: Collection[str]) -> dict[str, dict[str, RunResult]]:
    """Collect what the learners of these runs have come to: run id → learner → result."""
    found: dict[str, dict[str, RunResult]] = {run_id: {} for run_id in run_ids}
    for row in session.scalars(select(RunResult).where(RunResult.run_id.in_(run_ids))):
        found[row.run_id][row.learner] = row
    return found


def events_after(session: Session, run_id: str, number: int, *, limit: int) -> Sequence[RunEvent]:
    """List the events of a run that follow `number`, at most `limit` of them."""
    return session.scalars(
        select(RunEvent)
        .where(RunEvent.run_id == run_id, RunEvent.number > number)
        .order_by(RunEvent.number)
        .limit(limit)
    ).all()


def last_event_numbers(session: Session, run_ids: Collection[str]) -> dict[str, int]:
    """Return the number of the newest event of each of these runs that has any."""
    rows = session.execute(
        select(RunEvent.run_id, func.max(RunEvent.number)).where(RunEvent.run_id.in_(run_ids)).group_by(RunEvent.run_id)
    )
    return {run_id: number for run_id, number in rows}  # noqa: C416 - rows are no pairs to the type checker


def worker_is_alive(session: Session) -> bool:
    """Tell whether a worker has shown a sign of life lately. (One from the future: the clock was set back)."""
    return any(abs(now() - seen_at) < WORKER_IS_SILENT_AFTER for seen_at in session.scalars(select(Worker.seen_at)))
