"""A visitor's rankings in a world, to take away. docs/codebook.md explains every column and field.

    rankings.csv          a row for each attempt of each confirmed version
    rankings.jsonl        a demonstration file: the world, the attempts, every version, oldest first

(and `event_export.py`: ranking-events.csv). Each is made a few rows at a time and sent as it is made: neither its size
nor a slow reader holds on to memory or to the database. A version that is confirmed meanwhile is not in it.
"""

from collections.abc import Iterator
from typing import cast

from app.db import Database
from app.demonstrations.convert import beside_the_play, demonstration_from_row
from app.demonstrations.queries import next_in_world
from app.kit.table import Cell, csv_text
from app.models import Demonstration
from app.models import Ranking as RankingRow
from app.rankings import convert, queries
from app.worlds.convert import StoredWorld
from irl_core import Ranking, display_ranks, paper_index, rank_weights
from irl_core.files import demonstration_line, ranking_line, world_line
from irl_core.types import DemonstrationOutcome

RANKING_COLUMNS = (
    "world_id", "outcome", "version", "counts", "way", "confirmed_at", "sitting_id", "n_events", "untouched", "n",
    "demonstration_id", "start_place", "display_rank", "paper_index", "tied_with", "theta",
)  # fmt: skip
VERSIONS_AT_A_TIME = 20
ATTEMPTS_AT_A_TIME = 20


def rankings_csv(database: Database, visitor_id: str | None, world: StoredWorld) -> Iterator[str]:
    """Write every place in every version; the header comes even where there is no row."""
    yield csv_text([RANKING_COLUMNS])
    for row, counts in _versions(database, visitor_id, world.id):
        yield csv_text(_ranked_attempts(row, counts=counts))


def _ranked_attempts(row: RankingRow, *, counts: bool) -> Iterator[list[Cell]]:
    about_it = [
        *(row.world_id, row.outcome, row.version, counts, row.way, row.created_at.isoformat()),
        *(row.sitting_id, row.n_events, row.untouched, sum(map(len, row.order))),
    ]
    start_places = {one: place for place, one in enumerate(row.start_order, start=1)}
    ranks, indices, weights = display_ranks(row.order), paper_index(row.order), rank_weights(row.order)
    for group in row.order:
        for one in group:
            yield [*about_it, one, start_places.get(one), ranks[one], indices[one], len(group) - 1, weights[one]]


def rankings_file(database: Database, visitor_id: str | None, world: StoredWorld) -> Iterator[str]:
    """Write a demonstration file, which `irl_core.read_demonstration_file` and `irlfr learn` take."""
    versions = _versions(database, visitor_id, world.id)
    first = next(versions, None)  # before the attempts are read: so none is missing that a version names
    yield world_line(world.world, world_id=world.id)
    for attempt in _attempts(database, visitor_id, world.id):
        discarded = {} if attempt.discarded_at is None else {"discarded": True}
        more = beside_the_play(attempt) | discarded
        yield demonstration_line(demonstration_from_row(attempt), world_id=world.id, more=more)
    for row, counts in versions if first is None else (first, *versions):
        yield _version_line(row, counts=counts)


def _version_line(row: RankingRow, *, counts: bool) -> str:
    more = convert.ranking_out(row, counts=counts).model_dump(mode="json", exclude={"outcome", "order"})
    ranking = Ranking(cast("DemonstrationOutcome", row.outcome), tuple(tuple(group) for group in row.order))
    return ranking_line(ranking, world_id=row.world_id, more=more)


def _versions(database: Database, visitor_id: str | None, world_id: str) -> Iterator[tuple[RankingRow, bool]]:
    """Every version, oldest first, and whether it counts."""
    with database.read() as session:
        newest = queries.newest_ids(session, visitor_id, world_id)
    last, up_to = 0, max(newest, default=0)
    while last < up_to:
        with database.read() as session:
            rows = queries.next_versions(
                session, visitor_id, world_id, after=last, up_to=up_to, limit=VERSIONS_AT_A_TIME
            )
        yield from ((row, row.id in newest) for row in rows)
        last = rows[-1].id


def _attempts(database: Database, visitor_id: str | None, world_id: str) -> Iterator[Demonstration]:
    last = 0
    while True:
        with database.read() as session:
            rows = next_in_world(session, visitor_id, world_id, after=last, limit=ATTEMPTS_AT_A_TIME)
        yield from rows
        if len(rows) < ATTEMPTS_AT_A_TIME:
            return
        last = rows[-1].number
