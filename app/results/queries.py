"""What can be asked over many worlds. Of a comparison only its entries are read; the rest is far longer."""

import json
from collections.abc import Collection
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from sqlalchemy import ColumnElement, Text, func, select, type_coerce
from sqlalchemy.orm import Session

from app.models import Run, World


@dataclass(frozen=True, slots=True)
class Finished:
    """The latest finished comparison of one visitor in one world."""

    run_id: str
    visitor_id: str
    world_id: str
    finished_at: datetime | None
    entries: list[dict[str, Any]]


def own_comparisons(session: Session, visitor_id: str) -> list[Finished]:
    """List the latest finished comparison in each of a visitor's worlds, the newest first."""
    return _latest(session, Run.visitor_id == visitor_id)


def comparisons_in(session: Session, world_ids: Collection[str]) -> list[Finished]:
    """List the latest finished comparison of everybody in each of these worlds."""
    return _latest(session, Run.world_id.in_(world_ids))


def _latest(session: Session, asked_for: ColumnElement[bool]) -> list[Finished]:
    newest_first = (Run.created_at.desc(), Run.id.desc())
    age = func.row_number().over(partition_by=(Run.visitor_id, Run.world_id), order_by=newest_first)
    ages = select(Run.id, age.label("age")).where(asked_for, Run.status == "done").subquery()
    entries = func.json_extract(type_coerce(Run.comparison, Text()), "$.entries")
    rows = session.execute(
        select(Run.id, Run.visitor_id, Run.world_id, Run.finished_at, entries)
        .join(ages, Run.id == ages.c.id)
        .where(ages.c.age == 1, Run.comparison.is_not(None))
        .order_by(*newest_first)
    )
    return [
        Finished(run_id, visitor_id, world_id, finished_at, json.loads(text))
        for run_id, visitor_id, world_id, finished_at, text in rows
    ]


def specs_of(session: Session, world_ids: Collection[str]) -> dict[str, dict[str, Any]]:
    """Find what each of these worlds was made from."""
    rows = session.execute(select(World.id, World.spec).where(World.id.in_(world_ids)))
    return {world_id: spec for world_id, spec in rows}  # noqa: C416 - rows are no pairs to the type checker


def squares_of(session: Session, world_ids: Collection[str]) -> dict[str, dict[str, Any]]:
    """Find the squares and rewards of each of these worlds."""
    rows = session.execute(select(World.id, World.world).where(World.id.in_(world_ids)))
    return {world_id: squares for world_id, squares in rows}  # noqa: C416 - as above
