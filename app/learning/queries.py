"""What can be asked about runs."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any, Literal, TypeAlias

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from app.kit.clock import now
from app.models import Demonstration, Run, RunCheckpoint, RunEvent, RunResult, Worker
from app.worlds.convert import StoredWorld
from app.worlds.queries import find_world

WORKER_IS_SILENT_AFTER = timedelta(seconds=15)
ENDED = ("done", "failed", "cancelled")

WorkerState: TypeAlias = Literal["ready", "warming", "none"]


@dataclass(frozen=True, slots=True)
class Standing:
    """How a run stands."""

    status: str
    reason: str | None
    ahead: int | None
    """How many runs come before it; None unless it is queued."""
    worker: WorkerState
    """Whether anybody is there to take it up."""

    @property
    def has_ended(self) -> bool:
        """Nothing more will happen to it."""
        return self.status in ENDED


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


def computed_ms(session: Session, run_ids: Collection[str]) -> dict[str, dict[str, float]]:
    """Collect how long the learners of these runs have computed, in milliseconds: run id → learner → time."""
    found: dict[str, dict[str, float]] = {run_id: {} for run_id in run_ids}
    for table in (RunCheckpoint, RunResult):
        columns = (table.run_id, table.learner, table.compute_ms)
        for run_id, learner, compute_ms in session.execute(select(*columns).where(table.run_id.in_(run_ids))):
            found[run_id][learner] = compute_ms
    return found


def events_after(
    session: Session, run_id: str, number: int, *, limit: int, kind: str | None = None
) -> Sequence[RunEvent]:
    """List the events of a run (or those of one kind) that follow `number`, at most `limit` of them."""
    following = [RunEvent.run_id == run_id, RunEvent.number > number]
    if kind is not None:
        following.append(RunEvent.kind == kind)
    return session.scalars(select(RunEvent).where(*following).order_by(RunEvent.number).limit(limit)).all()


def last_event_numbers(session: Session, run_ids: Collection[str]) -> dict[str, int]:
    """Return the number of the newest event of each of these runs that has any."""
    rows = session.execute(
        select(RunEvent.run_id, func.max(RunEvent.number)).where(RunEvent.run_id.in_(run_ids)).group_by(RunEvent.run_id)
    )
    return {run_id: number for run_id, number in rows}  # noqa: C416 - rows are no pairs to the type checker


def latest_frames(session: Session, run_ids: Collection[str]) -> Sequence[RunEvent]:
    """List the newest frame of each learner of these runs."""
    learner = func.json_extract(RunEvent.data, "$.learner")
    newest = (
        select(RunEvent.run_id, func.max(RunEvent.number).label("number"))
        .where(RunEvent.run_id.in_(run_ids), RunEvent.kind == "frame")
        .group_by(RunEvent.run_id, learner)
        .subquery()
    )
    is_newest = (RunEvent.run_id == newest.c.run_id) & (RunEvent.number == newest.c.number)
    return session.scalars(select(RunEvent).join(newest, is_newest).order_by(RunEvent.run_id, RunEvent.number)).all()


def standings(session: Session, run_ids: Collection[str]) -> dict[str, Standing]:
    """Tell how each of these runs stands that exists."""
    columns = (Run.id, Run.status, Run.reason, Run.visitor_id, Run.created_at)
    rows = session.execute(select(*columns).where(Run.id.in_(run_ids))).all()
    is_waiting = any(row.status not in ENDED for row in rows)
    worker = worker_state(session) if is_waiting else "ready"
    return {
        row.id: Standing(row.status, row.reason, _ahead(session, row) if row.status == "queued" else None, worker)
        for row in rows
    }


def _ahead(session: Session, run: Any) -> int:  # noqa: ANN401 - a row of `standings`
    """How many queued runs come before this one: one's own older ones, and as many of each other visitor's."""
    older = (Run.created_at < run.created_at) | ((Run.created_at == run.created_at) & (Run.id < run.id))
    counted = session.execute(
        select(Run.visitor_id, func.count()).where(Run.status == "queued", older).group_by(Run.visitor_id)
    )
    n_older = {visitor_id: n for visitor_id, n in counted}  # noqa: C416 - rows are no pairs to the type checker
    n_own = n_older.pop(run.visitor_id, 0)
    return n_own + sum(min(n, n_own + 1) for n in n_older.values())


def worker_state(session: Session) -> WorkerState:
    """Tell whether a worker takes runs, or only gets ready to, or none is there."""
    alive = [one.ready_at for one in session.scalars(select(Worker)) if _is_lately(one.seen_at)]
    if not alive:
        return "none"
    return "warming" if all(ready_at is None for ready_at in alive) else "ready"


def worker_is_alive(session: Session) -> bool:
    """Tell whether a worker has shown a sign of life lately. (One from the future: the clock was set back)."""
    return any(map(_is_lately, session.scalars(select(Worker.seen_at))))


def _is_lately(seen_at: datetime) -> bool:
    return abs(now() - seen_at) < WORKER_IS_SILENT_AFTER
