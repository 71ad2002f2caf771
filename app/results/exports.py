"""Results as tables for statistics programs.

results.csv        a row for each figure: of one's own worlds, or pooled
comparisons.csv    a row for everybody in each of one's own worlds, to reckon with oneself
"""

from collections.abc import Iterator, Sequence
from typing import Final

from app.kit.table import Cell, csv_text
from app.results.schemas import ProportionOut, ResultsOut

RESULT_COLUMNS: Final = (
    "figure", "who", "other", "place", "count", "of", "value", "low", "high", "method", "p_value", "p_adjusted",
)  # fmt: skip
COMPARISON_COLUMNS: Final = (
    "world_id", "rows", "cols", "seed", "run_id", "finished_at", "optimum", "who", "place", "expected_return",
    "mean_return", "share_of_optimum",
)  # fmt: skip


def results_csv(results: ResultsOut) -> str:
    """Write places, shares of the optimum, wins, and the places of Table I."""
    return csv_text([RESULT_COLUMNS, *_places(results), *_shares(results), *_wins(results), *_table_one(results)])


def comparisons_csv(results: ResultsOut) -> str:
    """Write everybody's entry in each world."""
    rows = (
        [
            *(world.world_id, world.rows, world.cols, world.seed, world.run_id),
            *(world.finished_at.isoformat() if world.finished_at else None, world.optimum),
            *(entry.who, entry.place, entry.expected_return, entry.mean_return, entry.share_of_optimum),
        ]
        for world in results.worlds
        for entry in world.entries
    )
    return csv_text([COMPARISON_COLUMNS, *rows])


def _places(results: ResultsOut) -> Iterator[list[Cell]]:
    for one in results.standings:
        yield from _placed("place", one.who, one.places)


def _table_one(results: ResultsOut) -> Iterator[list[Cell]]:
    for row in results.table_one.rows if results.table_one else []:
        yield from _placed("table_one", row.who, row.places)


def _placed(figure: str, who: str, places: Sequence[ProportionOut]) -> Iterator[list[Cell]]:
    for place, often in enumerate(places, start=1):
        yield _row(
            figure=figure,
            who=who,
            place=place,
            count=often.count,
            of=often.of,
            value=often.count / often.of,
            low=often.low,
            high=often.high,
            method=None if often.low is None else "wilson",
        )


def _shares(results: ResultsOut) -> Iterator[list[Cell]]:
    for one in results.standings:
        share = one.share_of_optimum
        yield _row(figure="share_of_optimum", who=one.who, of=one.n_comparisons, **share.model_dump())


def _wins(results: ResultsOut) -> Iterator[list[Cell]]:
    for duel in results.duels:
        for who, other, count in ((duel.a, duel.b, duel.wins), (duel.b, duel.a, duel.losses)):
            yield _row(
                figure="wins",
                who=who,
                other=other,
                count=count,
                of=duel.n_comparisons,
                value=count / duel.n_comparisons,
                method="sign_test",
                p_value=duel.p_value,
                p_adjusted=duel.p_adjusted,
            )


def _row(**cells: Cell) -> list[Cell]:
    return [cells.get(column) for column in RESULT_COLUMNS]
