"""The page on which many worlds are seen together."""

from dataclasses import dataclass, field
from typing import Any

from fastapi import APIRouter, Request
from starlette.responses import Response

from app.dependencies import DatabaseFromApp
from app.pages import render
from app.results import queries
from app.results.dependencies import ResultsFromQuery
from app.results.schemas import ResultsOut
from app.results.words import ALPHA

router = APIRouter(include_in_schema=False)

MOST_BOARDS = 24
"""Worlds drawn as boards; older ones are a line each."""


@dataclass(frozen=True, slots=True)
class Cell:
    """One who met another: how often they earned more, and less."""

    wins: int
    losses: int
    p_adjusted: float
    leads: bool

    @property
    def is_marked(self) -> bool:
        """Whether they lead by more than chance would give."""
        return self.leads and self.p_adjusted < ALPHA

    @property
    def deep(self) -> int:
        """How often they won, in fifths; ties count half."""
        return round(5 * self.wins / max(1, self.wins + self.losses))


@dataclass(frozen=True, slots=True)
class ResultsPage:
    """Where a person, or a class, sees many worlds together."""

    data: dict[str, Any] = field(metadata={"help": "The page data: results as the API has them, and worlds by id."})
    matrix: list[list[Cell | None]] = field(metadata={"help": "Who beats whom: a row and a column for each standing."})
    query: str = field(metadata={"help": "What an address asks for, to be asked of the API too."})
    most_boards: int = field(default=MOST_BOARDS, metadata={"help": "How many worlds are drawn as boards."})
    path: None = field(default=None, metadata={"help": "Nowhere on the path: many worlds are no world."})


@router.get("/results", response_model=None)
def show_results(request: Request, results: ResultsFromQuery, database: DatabaseFromApp) -> Response:
    """Show one's own worlds together, or, with `?world=`, everybody's in worlds that pool their results."""
    drawn = [one.world_id for one in results.worlds[:MOST_BOARDS]]
    with database.read() as session:
        worlds = {
            world_id: {"id": world_id, **squares} for world_id, squares in queries.squares_of(session, drawn).items()
        }
    data = {"results": results.model_dump(mode="json"), "worlds": worlds}
    query = "&".join(f"world={one.world_id}" for one in results.worlds) if results.scope == "pooled" else ""
    page = ResultsPage(data=data, matrix=_matrix(results), query=query)
    return render(request, "results/results.html", page)


def _matrix(results: ResultsOut) -> list[list[Cell | None]]:
    cells = {}
    for duel in results.duels:
        ahead, behind, p = duel.votes_for > duel.votes_against, duel.votes_for < duel.votes_against, duel.p_adjusted
        cells[duel.a, duel.b] = Cell(duel.wins, duel.losses, p, ahead)
        cells[duel.b, duel.a] = Cell(duel.losses, duel.wins, p, behind)
    names = [one.who for one in results.standings]
    return [[cells.get((row, column)) for column in names] for row in names]
