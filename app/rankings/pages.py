"""The page on which a person puts attempts in order."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from fastapi import APIRouter, Request
from starlette.responses import Response

from app.config import Settings
from app.demonstrations.pages import demonstrations_json
from app.demonstrations.queries import all_in_world
from app.dependencies import DatabaseFromApp
from app.models import Demonstration
from app.pages import PathState, path_state, render
from app.rankings import convert, queries
from app.rankings.content import Outcome
from app.rankings.log import start_order
from app.visitors import VisitorOrNone
from app.worlds.convert import StoredWorld
from app.worlds.dependencies import WorldFromPath

router = APIRouter(include_in_schema=False)


@dataclass(frozen=True, slots=True)
class RankPage:
    """Where a person orders successes, best first, and failures, worst first."""

    path: PathState = field(metadata={"help": "How far this visitor has come in this world."})
    world: dict[str, Any] = field(metadata={"help": "The world, as the API has it."})
    data: dict[str, Any] = field(
        metadata={"help": "The page data: world, demonstrations, rankings, start_order, options."}
    )


@router.get("/worlds/{world_id}/rank", response_model=None)
def show_rank(request: Request, world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> Response:
    """Show both lists: in the order confirmed last, or in their start order."""
    if request.app.state.settings.show_policy:
        request.app.state.companion.wake()
    with database.read() as session:
        rows = all_in_world(session, visitor_id, world.id)
        newest = queries.newest(session, visitor_id, world.id)
        path = path_state(session, visitor_id, world.id, "rank")
    data: dict[str, Any] = {
        "world": world.to_json(),
        "demonstrations": demonstrations_json(rows),
        "rankings": convert.rankings_out(newest).model_dump(mode="json"),
        "start_order": {
            "success": _shuffled_kept(rows, visitor_id, world.id, "success"),
            "failure": _shuffled_kept(rows, visitor_id, world.id, "failure"),
        },
        "options": _options(request.app.state.settings, world),
    }
    return render(request, "rankings/rank.html", RankPage(path=path, world=data["world"], data=data))


def _options(settings: Settings, world: StoredWorld) -> dict[str, Any]:
    return {
        "show_totals": settings.show_totals,
        "show_agreement": settings.show_agreement,
        "show_policy": settings.show_policy,
        "ways": [world.rank_by] if world.rank_by else settings.rank_by,
    }


def _shuffled_kept(rows: Sequence[Demonstration], visitor_id: str | None, world_id: str, outcome: Outcome) -> list[str]:
    kept = [row.id for row in rows if row.outcome == outcome and row.discarded_at is None]
    return start_order(str(visitor_id), world_id, outcome, kept)
