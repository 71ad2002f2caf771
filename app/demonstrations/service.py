"""What people can do with demonstrations: record one, discard it, take it back."""

from typing import Any

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

TOLD = ("world_id", "actions", "step_ms", "ending")
"""What makes two tellings of an attempt the same; the rest follows from it."""


async def record(
    database: Database, visitor_id: str, world: StoredWorld, told: DemonstrationIn
) -> tuple[Demonstration, bool]:
    """Store an attempt once. Returns it and whether it is new; Conflict if the id tells another story."""
    if len(told.step_ms) != len(told.actions):
        message = f"step_ms has {len(told.step_ms)} times for {len(told.actions)} actions; each step needs one."
        raise Unprocessable(message, fields={"step_ms": message})
    columns = convert.simulated_columns(world, told) | {"visitor_id": visitor_id}

    def store(session: Session) -> tuple[Demonstration, bool]:
        remember(session, visitor_id)
        columns.update(created_at=now(), discarded_at=None)
        if session.connection().execute(INSERT, columns).rowcount == 1:
            return Demonstration(**columns), True
        known = queries.find(session, told.id)
        _check_is_the_same(known, columns)
        return known, False

    return await database.write_soon(store)


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
