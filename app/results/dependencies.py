"""The results that an address asks for."""

from typing import Annotated
from uuid import UUID

from fastapi import Depends, Query

from app.dependencies import DatabaseFromApp
from app.results import service
from app.results.schemas import ResultsOut
from app.visitors import VisitorOrNone

Worlds = Annotated[
    list[UUID],
    Query(
        max_length=service.MOST_WORLDS,
        description="Worlds that pool their results, up to 20; without any: your own worlds.",
    ),
]


def get_results(database: DatabaseFromApp, visitor_id: VisitorOrNone, world: Worlds = []) -> ResultsOut:  # noqa: B006 - FastAPI copies it
    """Gather one's own results, or the pooled ones of the worlds named."""
    if world:
        return service.pooled_results(database, [str(one) for one in world])
    return service.own_results(database, visitor_id)


def get_own_results(database: DatabaseFromApp, visitor_id: VisitorOrNone) -> ResultsOut:
    """Gather one's own results."""
    return service.own_results(database, visitor_id)


ResultsFromQuery = Annotated[ResultsOut, Depends(get_results)]
OwnResults = Annotated[ResultsOut, Depends(get_own_results)]
