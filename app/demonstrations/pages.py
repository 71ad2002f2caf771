"""The play page: the front door, and a world by its link."""

from dataclasses import dataclass, field
from typing import Any

from fastapi import APIRouter, Request
from starlette.responses import RedirectResponse, Response

from app.config import Settings
from app.demonstrations import queries
from app.demonstrations.schemas import DemonstrationOut
from app.dependencies import DatabaseFromApp
from app.pages import PathState, latest_world_id, path_state, render
from app.visitors import VisitorOrNone
from app.worlds.convert import StoredWorld
from app.worlds.dependencies import QueryFromAddress, WorldFromPath
from app.worlds.queries import find_world
from app.worlds.service import imagine

router = APIRouter(include_in_schema=False)


@dataclass(frozen=True, slots=True)
class PlayPage:
    """Where a person plays a world."""

    path: PathState = field(metadata={"help": "How far this visitor has come in this world."})
    world: dict[str, Any] = field(metadata={"help": "The world being played, as the API has it."})
    is_front_door: bool = field(metadata={"help": "The page is `/`: it greets, and says in a line what this is."})
    data: dict[str, Any] = field(metadata={"help": "The page data: world, saved, demonstrations, options."})


@router.get("/", response_model=None)
def show_front_door(
    request: Request, query: QueryFromAddress, database: DatabaseFromApp, visitor_id: VisitorOrNone
) -> Response:
    """Lead a known visitor to their latest world; give everybody else a board to play at once.

    A world that was drawn here is not stored before its first attempt is: looking leaves no trace.
    """
    if visitor_id is not None and not query.asks_for_a_world:
        with database.read() as session:
            latest = latest_world_id(session, visitor_id)
        if latest is not None:
            return RedirectResponse(f"/worlds/{latest}", 303)
    return _play(request, database, visitor_id, imagine(query), is_front_door=True)


@router.get("/worlds/{world_id}", response_model=None)
def show_world(
    request: Request, world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone
) -> Response:
    """Show a stored world, with what this visitor has played in it."""
    return _play(request, database, visitor_id, world, is_front_door=False)


def _play(
    request: Request, database: DatabaseFromApp, visitor_id: str | None, world: StoredWorld, *, is_front_door: bool
) -> Response:
    with database.read() as session:
        is_saved = find_world(session, world.id) is not None
        demonstrations = demonstrations_json(queries.all_in_world(session, visitor_id, world.id))
        path = path_state(session, visitor_id, world.id, "play") if is_saved else PathState()
    data: dict[str, Any] = {
        "world": world.to_json(),
        "saved": is_saved,
        "demonstrations": demonstrations,
        "options": _options(request.app.state.settings),
    }
    page = PlayPage(path=path, world=data["world"], is_front_door=is_front_door, data=data)
    return render(request, "worlds/play.html", page)


def _options(settings: Settings) -> dict[str, bool]:
    """What a study decides about playing."""
    return {"show_totals": settings.show_totals, "hold_to_move": settings.hold_to_move}


def demonstrations_json(rows: Any) -> list[dict[str, Any]]:  # noqa: ANN401 - rows of demonstrations
    """Demonstrations as the API lists them, for a page's data: without the records, which no page looks at."""
    return [DemonstrationOut.of(row, with_record=False).model_dump(mode="json", exclude={"record"}) for row in rows]


def snapshot_json(rows: Any) -> list[dict[str, Any]]:  # noqa: ANN401 - as above
    """The same of what a run learned from: it was kept then, whatever became of it since."""
    return [one | {"discarded": False} for one in demonstrations_json(rows)]
