"""A visitor's attempts in a world as a table, one row a step, for statistics. docs/codebook.md explains every column.

The file is made a few attempts at a time and sent as it is made: neither the size of the table nor a slow reader holds
on to memory or to the database.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

from app.db import Database
from app.demonstrations import queries
from app.demonstrations.convert import directions_taken
from app.kit.table import Cell, csv_text
from app.models import Demonstration
from app.worlds.convert import StoredWorld

ATTEMPT_COLUMNS = (
    "world_id", "demonstration_id", "attempt", "parent_id", "parent_step", "outcome", "ending", "total", "discarded",
    "created_at", "elapsed_ms", "abandoned", "resumed", "clock_jumps", "agent", "viewport_width", "viewport_height",
    "pixel_ratio", "refresh_hz", "pointer", "reduced_motion", "forced_colours", "dark", "totals_shown", "hold_to_move",
)  # fmt: skip
STEP_COLUMNS = (
    "step", "state", "row", "col", "action", "direction", "next_state", "colour", "reward", "step_ms", "rt", "device",
    "undone", "blurs", "hidden",
)  # fmt: skip
CLIENT_COLUMNS = ATTEMPT_COLUMNS[ATTEMPT_COLUMNS.index("pixel_ratio") :]

AT_A_TIME = 8


def csv_chunks(database: Database, visitor_id: str | None, world: StoredWorld) -> Iterator[str]:
    """Write the table piece by piece; the header comes even where there is no row."""
    yield csv_text([ATTEMPT_COLUMNS + STEP_COLUMNS])
    colours = [colour for row in world.world.colours for colour in row]
    n_before, last = 0, 0
    while True:
        with database.read() as session:
            attempts = queries.next_with_records(session, visitor_id, world.id, after=last, limit=AT_A_TIME)
        for n, attempt in enumerate(attempts, start=n_before + 1):
            yield csv_text(_rows(world, colours, attempt, n))
        if len(attempts) < AT_A_TIME:
            return
        n_before, last = n_before + len(attempts), attempts[-1].number


def _rows(world: StoredWorld, colours: Sequence[str], attempt: Demonstration, n: int) -> Iterator[list[Cell]]:
    """Tell an attempt, the visitor's n-th in this world, step by step."""
    about_it = _attempt_cells(attempt, n)
    record = attempt.record or {}
    times, devices = attempt.step_ms or [], record.get("device", [])
    happened = Counter((event["type"], event["step"]) for event in record.get("events", ()))
    for t, direction in enumerate(directions_taken(attempt, world.world.slip)):
        state, reached = attempt.states[t], attempt.states[t + 1]
        place = divmod(state, world.world.cols)
        went = (attempt.actions[t], direction, reached, colours[reached], attempt.rewards[t])
        measured = (_at(times, t), _at(record.get("rt", []), t), _at(devices, t))
        counted = (
            (happened["undo", t + 1], happened["blur", t], happened["hidden", t]) if record else (None, None, None)
        )
        yield [*about_it, t + 1, state, *place, *went, *measured, *counted]


def _attempt_cells(attempt: Demonstration, n: int) -> list[Cell]:
    """What is the same in every row of an attempt, in the order of ATTEMPT_COLUMNS."""
    record = attempt.record or {}
    client = record.get("client", {})
    happened = Counter(event["type"] for event in record.get("events", ()))
    counts = (len(record["abandoned"]), happened["resumed"], happened["clock"]) if record else (None, None, None)
    return [
        *(attempt.world_id, attempt.id, n, attempt.parent_id, attempt.parent_step),
        *(attempt.outcome, attempt.ending, attempt.total, attempt.discarded_at is not None),
        attempt.created_at.isoformat(),
        *(record.get("elapsed_ms"), *counts),
        *(client.get("agent"), *client.get("viewport", (None, None))),
        *(client.get(name) for name in CLIENT_COLUMNS),
    ]


def _at(values: list[Any], t: int) -> Any:  # noqa: ANN401 - whatever was measured
    """Return what was measured of step t, None where nothing was."""
    return values[t] if t < len(values) else None
