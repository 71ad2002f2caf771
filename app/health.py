"""Is it alive, is it ready? For whatever watches over the server."""

from fastapi import APIRouter
from starlette.responses import JSONResponse

from app.dependencies import DatabaseFromApp
from app.learning.queries import worker_is_alive

router = APIRouter(include_in_schema=False)


@router.get("/healthz", response_model=None)
async def tell_alive() -> JSONResponse:
    """Answer as long as the process lives."""
    return JSONResponse({"status": "alive"})


@router.get("/readyz", response_model=None)
def tell_ready(database: DatabaseFromApp) -> JSONResponse:
    """Answer 200 when database and worker answer, else 503 with what is missing."""
    missing = {}
    try:
        with database.read() as session:
            if not worker_is_alive(session):
                missing["worker"] = "No worker has given a sign of life for 15 seconds. Start one with: irlfr worker"
    except Exception as error:  # noqa: BLE001 - whatever it is, the database does not answer
        missing["database"] = f"The database does not answer ({type(error).__name__})."
    if missing:
        return JSONResponse({"status": "not ready", "missing": missing}, 503, {"Retry-After": "2"})
    return JSONResponse({"status": "ready"})
