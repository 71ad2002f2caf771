"""A visitor's sittings in a world as a table, one row an event, with both orders as they stood after it.

ranking-events.csv; docs/codebook.md explains every column. The log is gone through again on the way, a few events at a
time; an event that comes meanwhile is not in it.
"""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from app.db import Database
from app.kit.table import Cell, csv_text
from app.models import RankingEvent, Sitting
from app.rankings import queries, replay
from app.rankings.content import OUTCOMES, Order, Outcome, flat
from app.rankings.replay import State
from app.worlds.convert import StoredWorld
from irl_core import display_ranks

EVENT_COLUMNS = (
    "world_id", "sitting", "sitting_id", "n", "type", "means", "at_ms", "received_at", "way", "outcome",
    "demonstration_id", "other_id", "rank_before", "rank_after", "changed", "version", "success_order", "failure_order",
    "event",
)  # fmt: skip
EVENTS_AT_A_TIME = 200


def events_csv(database: Database, visitor_id: str | None, world: StoredWorld) -> Iterator[str]:
    """Write the table piece by piece; the header comes even where there is no row."""
    yield csv_text([EVENT_COLUMNS])
    with database.read() as session:
        sittings = queries.sittings_in_world(session, visitor_id, world.id)
    for number, sitting in enumerate(sittings, start=1):
        yield from _sitting(database, sitting, number)


def _sitting(database: Database, sitting: Sitting, number: int) -> Iterator[str]:
    """Go through a log; what stands is carried from one piece to the next."""
    with database.read() as session:
        versions = queries.versions_by_n_events(session, sitting.id)
    about_it: list[Cell] = [sitting.world_id, number, sitting.id]
    state: State | None = None
    for start in range(0, sitting.n_events, EVENTS_AT_A_TIME):
        stop = min(start + EVENTS_AT_A_TIME, sitting.n_events)
        with database.read() as session:
            stored = queries.events_with_times(session, sitting.id, start, stop)
        rows: list[list[Cell]] = []
        for row in stored:
            before, state = state, replay.begin(row.event) if state is None else replay.apply(state, row.event)
            rows.append([*about_it, *_cells(row, before or state, state, versions)])
        yield csv_text(rows)


def _cells(row: RankingEvent, before: State, after: State, versions: Mapping[int, int]) -> list[Cell]:
    """Tell an event, in the order of EVENT_COLUMNS from `n` on."""
    event = row.event
    about = _subject(event, before)
    return [
        *(row.n, row.type, row.means, row.at_ms, row.created_at.isoformat(), after.way),
        *(about.outcome, about.demonstration_id, about.other_id),
        *(_rank(before, about), _rank(after, about)),
        before.history.present != after.history.present,
        versions.get(row.n + 1),
        *(json.dumps(after.orders[outcome]) for outcome in OUTCOMES),
        json.dumps(event, ensure_ascii=False),
    ]


@dataclass(frozen=True, slots=True)
class _Subject:
    """What an event is about: a list, an attempt, and another one beside it."""

    outcome: Outcome | None
    demonstration_id: str | None
    other_id: str | None


def _subject(event: Mapping[str, Any], before: State) -> _Subject:
    """Name the attempts alike whatever the event calls them; to put down is about the card that is lifted."""
    is_let_go = event["type"] in ("drop", "put_back")
    one = before.lifted if is_let_go else event.get("id") or event.get("a") or event.get("above")
    other = event.get("with") or event.get("b") or event.get("below")
    return _Subject(event.get("outcome") or _outcome_of(one, before), one, other)


def _outcome_of(one: str | None, state: State) -> Outcome | None:
    return next((outcome for outcome in OUTCOMES if one in flat(state.orders[outcome])), None)


def _rank(state: State, about: _Subject) -> int | None:
    """Find the display rank of the attempt an event is about."""
    if about.outcome is None or about.demonstration_id is None:
        return None
    order: Order = state.orders[about.outcome]
    return display_ranks(order).get(about.demonstration_id)
