"""What people can do with demonstrations: record one, discard it, take it back."""

from typing import Any, NoReturn

from anyio import to_thread
from sqlalchemy.dialects.sqlite import insert
from sqlalchemy.orm import Session

from app.db import Database
from app.demonstrations import convert, queries
from app.demonstrations.schemas import DemonstrationIn
from app.errors import Conflict, NotFound, Unprocessable
from app.kit.clock import now
from app.models import Demonstration
from app.visitors import remember
from app.worlds.convert import StoredWorld

INSERT = insert(Demonstration.metadata.tables["demonstration"]).on_conflict_do_nothing(index_elements=["id"])
"""By Core, without the ORM: this is the path that many take at once."""

TOLD = ("world_id", "actions", "step_ms", "ending", "parent_id", "parent_step", "record")
"""What makes two tellings of an attempt the same; the rest follows from it."""


async def record(
    database: Database, visitor_id: str, world: StoredWorld, told: DemonstrationIn
) -> tuple[Demonstration, bool]:
    """Store an attempt once. Returns it and whether it is new; Conflict if the id tells another story."""
    check_lengths(told)
    slip_seeds = None
    if told.parent_id is not None:
        slip_seeds = await to_thread.run_sync(_seeds_from_parent, database, visitor_id, world, told)
    columns = convert.simulated_columns(world, told, slip_seeds=slip_seeds) | {"visitor_id": visitor_id}

    def store(session: Session) -> tuple[Demonstration, bool]:
        remember(session, visitor_id)
        columns.update(created_at=now(), discarded_at=None)
        if session.connection().execute(INSERT, columns).rowcount == 1:
            return Demonstration(**columns), True
        known = queries.find(session, told.id)
        _check_is_the_same(known, columns)
        return known, False

    return await database.write_soon(store)


def check_lengths(told: DemonstrationIn) -> None:
    """Check that there is one of everything for each step, and that a parent is named wholly or not at all."""
    lists: dict[str, list[Any]] = {"step_ms": told.step_ms}
    if told.record is not None:
        lists |= {"record.rt": told.record.rt, "record.device": told.record.device}
    for name, values in lists.items():
        if len(values) != len(told.actions):
            _refuse(name, f"{name} has {len(values)} entries for {len(told.actions)} actions; each step needs one.")
    if (told.parent_id is None) != (told.parent_step is None):
        missing = "parent_id" if told.parent_id is None else "parent_step"
        _refuse(missing, "An attempt that goes on from another names both: parent_id and parent_step.")


def _seeds_from_parent(
    database: Database, visitor_id: str, world: StoredWorld, told: DemonstrationIn
) -> list[tuple[str, int]]:
    with database.read() as session:
        parent = queries.find_parent(session, visitor_id, world.id, told.parent_id or "")
    if parent is None:
        _refuse("parent_id", "You have no such attempt in this world, so none can go on from it.")
    return seeds_after(parent, world, told)


def seeds_after(parent: Demonstration, world: StoredWorld, told: DemonstrationIn) -> list[tuple[str, int]]:
    """Return by which seeds the steps slip: the copied ones as in the parent, then by the attempt's own id."""
    k = told.parent_step or 0
    if k > len(parent.actions) or parent.states[k] in world.world.goals:
        _refuse("parent_step", f"The attempt to go on from is over, or was never, after {k} steps.")
    if told.actions[:k] != parent.actions[:k]:
        _refuse("actions", f"The first {k} actions must be those of the attempt that this one goes on from.")
    if len(told.actions) <= k:
        _refuse("actions", f"After the {k} copied steps an attempt needs at least one of its own.")
    return [(seed, first) for seed, first in parent.slip_seeds if first < k] + [(told.id, k)]


def _refuse(name: str, message: str) -> NoReturn:
    raise Unprocessable(message, fields={name: message})


def _check_is_the_same(known: Demonstration, columns: dict[str, Any]) -> None:
    is_same = known.visitor_id == columns["visitor_id"] and all(getattr(known, name) == columns[name] for name in TOLD)
    if not is_same:
        message = "Another attempt has this id already. Give every attempt an id of its own."
        raise Conflict(message, fields={"id": message})


def discard(database: Database, visitor_id: str | None, demonstration_id: str) -> Demonstration:
    """Take a demonstration out of ranking and learning; it is kept and can come back."""
    return _set_discarded(database, visitor_id, demonstration_id, discarded=True)


def restore(database: Database, visitor_id: str | None, demonstration_id: str) -> Demonstration:
    """Take a discarded demonstration back."""
    return _set_discarded(database, visitor_id, demonstration_id, discarded=False)


def _set_discarded(
    database: Database, visitor_id: str | None, demonstration_id: str, *, discarded: bool
) -> Demonstration:
    def store(session: Session) -> Demonstration:
        known = queries.find_theirs(session, visitor_id, demonstration_id)
        if known is None:
            message = "You have no such demonstration. It belongs to the browser in which it was played."
            raise NotFound(message)
        if (known.discarded_at is not None) != discarded:
            known.discarded_at = now() if discarded else None
        return known

    return database.write(store)
