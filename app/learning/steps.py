"""What a worker does in a run, in steps that are each one transaction and may be done again.

    begin      queued → running
    advance    a learner goes on for a moment; its checkpoint and its frames are stored together
               … its last step stores the result instead, once, and forgets the checkpoint
    finish     everybody is compared; running → done
    fail       the reason is stored; → failed

Each step first makes sure that the run is still wanted. A worker that dies loses at most one step: its successor finds
the checkpoint, whose numbers are stored exactly, and goes on to the same result, bit for bit.
"""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from sqlalchemy import delete, func, select, update
from sqlalchemy.dialects.sqlite import insert
from sqlalchemy.orm import Session

from app.db import Database
from app.demonstrations.convert import demonstration_from_row
from app.kit import clock
from app.learning import events, queries
from app.learning.convert import to_problem
from app.models import Run, RunCheckpoint, RunResult
from irl_core import LEARNERS, Demonstration, Learner, LearningProblem, LearningResult, LearningState, compare

T = TypeVar("T")

FRAME_EVERY_S = 0.08
"""How long a learner works between two frames: smooth to the eye."""
STORE_EVERY_S = 0.05
"""Frames that come faster are stored together: a transaction costs more than a small frame."""
FRAME_EVERY_SHARE = 7 / 6
"""A frame whenever a learner has gone this much further, however fast it is: what changes most changes first."""
FRAME_S_PER_STATE = 1e-4
"""Large worlds make large frames: 10,000 squares give one each second."""
N_EPISODES = 50
"""The paper's: "we have each of the agents perform the task for 50 episodes"."""
FRAME_DIGITS = 5
"""Significant digits of the figures in a frame: enough for the eye, and a third of the bytes."""


MOST_VAIN_STARTS = 5
"""A run that was begun this often without a step forward is given up: it is most likely what kills its workers."""
LARGE_WORLD = 1000
"""Squares from which on a single iteration takes a good part of the time between two frames, or more."""


class NoLongerWanted(Exception):
    """The run was cancelled, or somebody else ended it."""


class KillsWorkers(Exception):
    """The worker died in this run again and again."""


@dataclass(frozen=True, slots=True)
class LoadedRun:
    """A run that has begun, and what it learns from."""

    id: str
    learners: tuple[str, ...]
    visitor_id: str
    demonstrations: tuple[Demonstration, ...]
    problem: LearningProblem


def begin(database: Database, run_id: str) -> LoadedRun:
    """Mark the run as running and load its snapshot. Raises NoLongerWanted and KillsWorkers."""

    def start(session: Session) -> int:
        _claim(
            session,
            run_id,
            status="running",
            started_at=func.coalesce(Run.started_at, clock.now()),
            n_vain_starts=Run.n_vain_starts + 1,
        )
        return session.scalars(select(Run.n_vain_starts).where(Run.id == run_id)).one()

    with database.read() as session:
        run = session.get(Run, run_id)
        if run is None:
            raise NoLongerWanted
        world = queries.world_of(session, run).world
        rows = queries.demonstrations_of(session, run)
    if database.write(start) > MOST_VAIN_STARTS:
        message = f"The worker died {MOST_VAIN_STARTS} times at the same point of this run, so it was given up."
        raise KillsWorkers(message)
    problem = to_problem(world, rows, run.rankings, settings=run.settings, seed=run.seed)
    return LoadedRun(run_id, tuple(run.learners), run.visitor_id, tuple(map(demonstration_from_row, rows)), problem)


def advance(database: Database, run: LoadedRun, name: str, give_way: Callable[[], None] = lambda: None) -> bool:
    """Let a learner go on for a moment; True when it has finished. Raises NoLongerWanted.

    Between iterations it gives way to whoever ought to compute before it.
    """
    with database.read() as session:
        if session.get(RunResult, (run.id, name)) is not None:
            return True
        checkpoint = session.get(RunCheckpoint, (run.id, name))
    stint = _Stint(LEARNERS[name], run.problem)
    if checkpoint is None:
        stint.start()  # and its first frame is of what it knows before it has learned anything
    else:
        stint.go_on(LearningState.from_json(checkpoint.state), checkpoint.compute_ms, give_way)
    if stint.state.outcome is None:
        database.write(lambda session: _store_progress(session, run.id, stint))
        return False
    result = stint.result()
    database.write(lambda session: _store_result(session, run.id, result, stint))
    return True


class _Stint:
    """What a learner does in one step: how far it comes, what it shows, and how long it has computed itself."""

    def __init__(self, learner: Learner, problem: LearningProblem) -> None:
        self.learner = learner
        self.problem = problem
        self.frames: list[dict[str, Any]] = []
        self.compute_ms = 0.0
        self.state: LearningState

    def start(self) -> None:
        """Begin."""
        self.state = self._timed(lambda: self.learner.start(self.problem))
        self._show()

    def go_on(self, state: LearningState, compute_ms: float, give_way: Callable[[], None]) -> None:
        """Learn on from a checkpoint, until it is time to store."""
        self.state, self.compute_ms = state, compute_ms
        until = time.monotonic() + STORE_EVERY_S
        while self.state.outcome is None and (not self.frames or time.monotonic() < until):
            self._go_on_to_next_frame(give_way)
            self._show()

    def result(self) -> LearningResult:
        """What it came to."""
        return self._timed(lambda: self.learner.result(self.problem, self.state))

    def _go_on_to_next_frame(self, give_way: Callable[[], None]) -> None:
        n_states = self.problem.world.n_states
        until = time.monotonic() + max(FRAME_EVERY_S, FRAME_S_PER_STATE * n_states)
        at_once, last = (1, math.inf) if n_states >= LARGE_WORLD else (5, FRAME_EVERY_SHARE * self.state.iteration)
        while self.state.outcome is None and time.monotonic() < until:
            self.state = self._timed(lambda: self.learner.advance(self.problem, self.state, iterations=at_once))
            give_way()
            if self.state.iteration >= last:
                break

    def _show(self) -> None:
        frame = self.learner.frame(self.problem, self.state).to_json(digits=FRAME_DIGITS)
        self.frames.append(frame | {"compute_ms": round(self.compute_ms, 3)})

    def _timed(self, work: Callable[[], T]) -> T:
        """Do it, and count the time of this thread alone: others may take turns with it."""
        began = time.thread_time()
        done = work()
        self.compute_ms += 1000 * (time.thread_time() - began)
        return done


def finish(database: Database, run: LoadedRun) -> None:
    """Compare the human, the learners and the optimum, and end the run. Raises NoLongerWanted."""
    with database.read() as session:
        stored = session.scalars(select(RunResult).where(RunResult.run_id == run.id)).all()
    results = {row.learner: LearningResult.from_json(row.result) for row in stored}
    problem = run.problem
    comparison = compare(
        problem.world,
        run.demonstrations,
        [results[name] for name in run.learners],
        seed=problem.seed,
        n_episodes=N_EPISODES,
    ).to_json()
    rollouts = comparison.pop("rollouts")

    def store(session: Session) -> None:
        _claim(session, run.id, status="done", comparison=comparison, rollouts=rollouts, finished_at=clock.now())
        events.append(session, run.id, "done", {"status": "done"})

    database.write(store)


def fail(database: Database, run_id: str, reason: str) -> None:
    """End a run that cannot go on, with the reason for the person who asked. Does nothing to one that has ended."""

    def store(session: Session) -> None:
        try:
            _claim(session, run_id, status="failed", reason=reason, finished_at=clock.now())
        except NoLongerWanted:
            return
        events.append(session, run_id, "failed", {"status": "failed", "message": reason})

    database.write(store)


def _claim(session: Session, run_id: str, **changes: object) -> None:
    """Change a run that is still wanted, in the same transaction as what this step stores. Raises NoLongerWanted."""
    changed = session.execute(
        update(Run).where(Run.id == run_id, Run.status.in_(("queued", "running"))).values(changes).returning(Run.id)
    ).first()
    if changed is None:
        raise NoLongerWanted


def _store_progress(session: Session, run_id: str, stint: _Stint) -> None:
    _claim(session, run_id, n_vain_starts=0)
    values = {
        "run_id": run_id,
        "learner": stint.learner.name,
        "state": stint.state.to_json(),
        "compute_ms": stint.compute_ms,
    }
    session.execute(
        insert(RunCheckpoint).values(values).on_conflict_do_update(index_elements=["run_id", "learner"], set_=values)
    )
    events.append_frames(session, run_id, stint.frames)


def _store_result(session: Session, run_id: str, result: LearningResult, stint: _Stint) -> None:
    _claim(session, run_id, n_vain_starts=0)
    name, data = stint.learner.name, result.to_json()
    row = {"run_id": run_id, "learner": name, "result": data, "compute_ms": stint.compute_ms}
    session.execute(insert(RunResult).values(row | {"finished_at": clock.now()}))
    session.execute(delete(RunCheckpoint).where(RunCheckpoint.run_id == run_id, RunCheckpoint.learner == name))
    events.append_frames(session, run_id, stint.frames)
    told = {name: value for name, value in data.items() if name != "policy"}
    events.append(session, run_id, "learner", {"learner": name, "compute_ms": round(stint.compute_ms, 3)} | told)
