"""The page on which many worlds are seen together."""

from dataclasses import dataclass, field
from typing import Any

from fastapi import APIRouter, Request
from starlette.responses import Response

from app.dependencies import DatabaseFromApp
from app.pages import render
from app.results import queries
from app.results.dependencies import ResultsFromQuery

router = APIRouter(include_in_schema=False)

MOST_BOARDS = 24
"""Worlds drawn as boards; older ones are a line each."""


@dataclass(frozen=True, slots=True)
class ResultsPage:
    """Where a person, or a class, sees many worlds together."""

    data: dict[str, Any] = field(metadata={"help": "The page data: results as the API has them, and worlds by id."})
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
    return render(request, "results/results.html", ResultsPage(data=data))
