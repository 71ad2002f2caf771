"""Worlds as JSON."""

from typing import Any

from fastapi import APIRouter

from app.dependencies import DatabaseFromApp
from app.visitors import Visitor
from app.worlds import service
from app.worlds.dependencies import QueryFromAddress, WorldFromPath
from app.worlds.schemas import WorldIn, WorldOut

router = APIRouter(prefix="/api/v1", tags=["worlds"])

QUERY_PARAMETERS = [
    {"name": name, "in": "query", "required": False, "description": field.description, "schema": {"type": "string"}}
    for name, field in WorldIn.model_fields.items()
]


@router.post("/worlds", status_code=201, response_model=WorldOut, summary="Make a world")
def create_world(database: DatabaseFromApp, visitor_id: Visitor, body: WorldIn | None = None) -> Any:  # noqa: ANN401
    """Generate a world and store it.

    The id is made from the parameters: with a seed the same request gives the same world, so a retry does no harm.
    """
    return service.create(database, visitor_id, body or WorldIn()).to_json()


@router.get(
    "/worlds/preview",
    response_model=WorldOut,
    summary="Look at a world before it is made",
    openapi_extra={"parameters": QUERY_PARAMETERS},
)
def preview_world(query: QueryFromAddress) -> Any:  # noqa: ANN401
    """Generate the world of a query such as `rows=7&cols=9&walls=3-5,9&painted=12-14:-3.5` and store nothing."""
    return service.imagine(query).to_json()


@router.get("/worlds/{world_id}", response_model=WorldOut, summary="Show a world")
def show_world(world: WorldFromPath) -> Any:  # noqa: ANN401
    """Show a world to anyone who has its link."""
    return world.to_json()
