"""The page on which everybody is seen side by side."""

from dataclasses import dataclass, field
from typing import Any

from fastapi import APIRouter, Request
from starlette.responses import RedirectResponse, Response

from app.comparisons import queries
from app.comparisons.citations import citations_of
from app.demonstrations.pages import snapshot_json
from app.dependencies import DatabaseFromApp
from app.learning.convert import describe_learners, describe_settings, snapshot_rankings, to_out
from app.learning.dependencies import RunFromPath, ShareKey
from app.learning.queries import demonstrations_of, latest_done_run, world_of
from app.pages import PathState, path_state, render
from app.visitors import VisitorOrNone
from app.worlds.dependencies import WorldFromPath

router = APIRouter(include_in_schema=False)


@dataclass(frozen=True, slots=True)
class ComparePage:
    """Where a person sees themselves beside the learners and the optimum."""

    path: PathState = field(metadata={"help": "How far this visitor has come in this world."})
    world: dict[str, Any] = field(metadata={"help": "The world, as the API has it."})
    data: dict[str, Any] = field(
        metadata={
            "help": "The page data: world, demonstrations, rankings, run, is_own, key, learners, comparison, rollouts, "
            "settings, citations."
        }
    )


@router.get("/worlds/{world_id}/compare", response_model=None)
def lead_to_comparison(world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> Response:
    """Lead to the latest comparison in this world, or to where one is made."""
    with database.read() as session:
        run = latest_done_run(session, visitor_id, world.id)
    return RedirectResponse(f"/runs/{run.id}/comparison" if run else f"/worlds/{world.id}/learn", 303)


@router.get("/runs/{run_id}/comparison", response_model=None)
def show_comparison(
    request: Request, run: RunFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone, key: ShareKey = None
) -> Response:
    """Show the comparison of a run; one that is not done leads to where it can be watched."""
    is_own = run.visitor_id == visitor_id
    if run.comparison is None:
        return RedirectResponse(f"/runs/{run.id}" if is_own else f"/runs/{run.id}?key={key}", 303)
    request.app.state.companion.wake()
    with database.read() as session:
        world = world_of(session, run)
        rows = demonstrations_of(session, run)
        shown = to_out(session, run, is_own=is_own)
        path = path_state(session, visitor_id, run.world_id, "compare")
    data: dict[str, Any] = {
        "world": world.to_json(),
        "demonstrations": snapshot_json(rows),
        "rankings": snapshot_rankings(run),
        "run": shown.model_dump(mode="json"),
        "is_own": is_own,
        "key": None if is_own else key,
        "learners": describe_learners(run.learners),
        "comparison": queries.comparison_of(run),
        "rollouts": queries.rollouts_of(run),
        "settings": describe_settings(),
        "citations": citations_of(run.learners, run.settings, versions=run.versions),
    }
    return render(request, "comparisons/compare.html", ComparePage(path=path, world=data["world"], data=data))
