"""Worlds as JSON."""

from typing import Any

from fastapi import APIRouter

from app.dependencies import DatabaseFromApp
from app.visitors import Visitor
from app.worlds import service
from app.worlds.dependencies import WorldFromPath
from app.worlds.schemas import WorldIn, WorldOut

router = APIRouter(prefix="/api/v1", tags=["worlds"])


@router.post("/worlds", status_code=201, response_model=WorldOut, summary="Make a world")
def create_world(database: DatabaseFromApp, visitor_id: Visitor, body: WorldIn | None = None) -> Any:  # noqa: ANN401
    """Generate a world and store it.

    The id is made from the parameters: with a seed the same request gives the same world, so a retry does no harm.
    """
    return service.create(database, visitor_id, body or WorldIn()).to_json()


@router.get("/worlds/{world_id}", response_model=WorldOut, summary="Show a world")
def show_world(world: WorldFromPath) -> Any:  # noqa: ANN401
    """Show a world to anyone who has its link."""
    return world.to_json()
