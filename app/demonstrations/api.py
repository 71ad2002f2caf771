"""Demonstrations as JSON."""

from uuid import UUID

from fastapi import APIRouter, Response
from fastapi.responses import StreamingResponse

from app.demonstrations import queries, service
from app.demonstrations.schemas import DemonstrationIn, DemonstrationOut
from app.demonstrations.steps import csv_chunks
from app.dependencies import DatabaseFromApp
from app.visitors import Visitor, VisitorOrNone
from app.worlds.dependencies import WorldFromPath

router = APIRouter(prefix="/api/v1", tags=["demonstrations"])


@router.post(
    "/worlds/{world_id}/demonstrations",
    status_code=201,
    summary="Record an attempt",
    responses={200: {"model": DemonstrationOut, "description": "It was recorded before; the same body again."}},
)
async def record_demonstration(
    world: WorldFromPath, body: DemonstrationIn, database: DatabaseFromApp, visitor_id: Visitor, response: Response
) -> DemonstrationOut:
    """Live the attempt again on the server and store it, once for each id.

    The answer comes when the attempt is on the disk. Sending it again does no harm (200); another attempt under the
    same id is refused (409), as is one that cannot have happened (422, naming the step).
    """
    demonstration, is_new = await service.record(database, visitor_id, world, body)
    if not is_new:
        response.status_code = 200
    return DemonstrationOut.of(demonstration)


@router.get("/worlds/{world_id}/demonstrations", summary="List your attempts")
def list_demonstrations(
    world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone
) -> list[DemonstrationOut]:
    """List your attempts in this world, oldest first; discarded ones say so."""
    with database.read() as session:
        return [DemonstrationOut.of(row) for row in queries.all_with_records(session, visitor_id, world.id)]


@router.get(
    "/worlds/{world_id}/steps.csv",
    summary="Take your steps away",
    response_class=StreamingResponse,
    responses={200: {"content": {"text/csv": {}}, "description": "The table, with a header row."}},
)
def export_steps(world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> StreamingResponse:
    """Download your attempts in this world as a table with one row a step; docs/codebook.md explains its columns."""
    return StreamingResponse(
        csv_chunks(database, visitor_id, world),
        media_type="text/csv; charset=utf-8; header=present",
        headers={"Content-Disposition": f'attachment; filename="irlfr-{world.id[:8]}-steps.csv"'},
    )


@router.put("/demonstrations/{demonstration_id}/discard", summary="Discard an attempt")
def discard_demonstration(
    demonstration_id: UUID, database: DatabaseFromApp, visitor_id: VisitorOrNone
) -> DemonstrationOut:
    """Leave an attempt out of ranking and learning. Doing it twice changes nothing."""
    return DemonstrationOut.of(service.discard(database, visitor_id, str(demonstration_id)))


@router.delete("/demonstrations/{demonstration_id}/discard", summary="Restore an attempt")
def restore_demonstration(
    demonstration_id: UUID, database: DatabaseFromApp, visitor_id: VisitorOrNone
) -> DemonstrationOut:
    """Take a discarded attempt back. Doing it twice changes nothing."""
    return DemonstrationOut.of(service.restore(database, visitor_id, str(demonstration_id)))
