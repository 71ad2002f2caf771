"""What a worker does in a run, in steps that are each one transaction and may be done again.

    begin      queued → running
    advance    a learner goes on for a moment; its checkpoint and a frame are stored together
               … its last step stores the result instead, once, and forgets the checkpoint
    finish     everybody is compared; running → done
    fail       the reason is stored; → failed

Each step first makes sure that the run is still wanted. A worker that dies loses at most one step: its successor finds
the checkpoint, whose numbers are stored exactly, and goes on to the same result, bit for bit.
"""

import math
import time
from dataclasses import dataclass

from sqlalchemy import delete, func, select, update
from sqlalchemy.dialects.sqlite import insert
from sqlalchemy.orm import Session

from app.db import Database
from app.demonstrations.convert import demonstration_from_row
from app.kit import clock
from app.learning import events, queries
from app.learning.convert import to_problem
from app.models import Run, RunCheckpoint, RunResult
from irl_core import LEARNERS, Demonstration, Frame, Learner, LearningProblem, LearningResult, LearningState, compare

FRAME_EVERY_S = 0.08
"""How long a learner works between two frames: smooth to the eye, and how soon a cancellation is noticed."""
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
        run = session.get_one(Run, run_id)
        world = queries.world_of(session, run).world
        rows = queries.demonstrations_of(session, run)
    if database.write(start) > MOST_VAIN_STARTS:
        message = f"The worker died {MOST_VAIN_STARTS} times at the same point of this run, so it was given up."
        raise KillsWorkers(message)
    problem = to_problem(world, rows, run.rankings, settings=run.settings, seed=run.seed)
    return LoadedRun(run_id, tuple(run.learners), tuple(map(demonstration_from_row, rows)), problem)


def advance(database: Database, run: LoadedRun, name: str) -> bool:
    """Let a learner go on for a moment; True when it has finished. Raises NoLongerWanted."""
    with database.read() as session:
        if session.get(RunResult, (run.id, name)) is not None:
            return True
        checkpoint = session.get(RunCheckpoint, (run.id, name))
    learner = LEARNERS[name]
    if checkpoint is None:
        state = learner.start(run.problem)  # and its first frame is of what it knows before it has learned anything
    else:
        state = LearningState.from_json(checkpoint.state)
        state = _gone_on(learner, run.problem, state)
    frame = learner.frame(run.problem, state)
    if state.outcome is None:
        database.write(lambda session: _store_progress(session, run.id, name, state, frame))
        return False
    result = learner.result(run.problem, state)
    database.write(lambda session: _store_result(session, run.id, name, result, frame))
    return True


def _gone_on(learner: Learner, problem: LearningProblem, state: LearningState) -> LearningState:
    """The state at which the next frame is due, if learning does not end before."""
    n_states = problem.world.n_states
    until = time.monotonic() + max(FRAME_EVERY_S, FRAME_S_PER_STATE * n_states)
    if n_states >= LARGE_WORLD:
        at_once, last = 1, math.inf
    else:
        at_once, last = 5, FRAME_EVERY_SHARE * state.iteration
    while state.outcome is None and time.monotonic() < until:
        state = learner.advance(problem, state, iterations=at_once)
        if state.iteration >= last:
            break
    return state


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


def _store_progress(session: Session, run_id: str, name: str, state: LearningState, frame: Frame) -> None:
    _claim(session, run_id, n_vain_starts=0)
    values = {"run_id": run_id, "learner": name, "state": state.to_json()}
    session.execute(
        insert(RunCheckpoint).values(values).on_conflict_do_update(index_elements=["run_id", "learner"], set_=values)
    )
    events.append(session, run_id, "frame", frame.to_json(digits=FRAME_DIGITS))


def _store_result(session: Session, run_id: str, name: str, result: LearningResult, frame: Frame) -> None:
    _claim(session, run_id, n_vain_starts=0)
    data = result.to_json()
    session.execute(insert(RunResult).values(run_id=run_id, learner=name, result=data, finished_at=clock.now()))
    session.execute(delete(RunCheckpoint).where(RunCheckpoint.run_id == run_id, RunCheckpoint.learner == name))
    events.append(session, run_id, "frame", frame.to_json(digits=FRAME_DIGITS))
    events.append(session, run_id, "learner", {"learner": name} | {k: v for k, v in data.items() if k != "policy"})
