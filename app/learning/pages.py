"""The page on which a person watches the learners learn."""

from dataclasses import dataclass, field
from typing import Any

from fastapi import APIRouter, Request
from sqlalchemy.orm import Session
from starlette.responses import Response

from app.demonstrations.pages import demonstrations_json
from app.demonstrations.queries import all_in_world
from app.dependencies import DatabaseFromApp
from app.learning import queries, service
from app.learning.convert import describe_choice, describe_settings, to_out, to_problem
from app.learning.dependencies import RunFromPath
from app.models import Run
from app.pages import PathState, path_state, render
from app.rankings.convert import rankings_out
from app.rankings.queries import newest
from app.visitors import VisitorOrNone
from app.worlds.convert import StoredWorld
from app.worlds.dependencies import WorldFromPath

router = APIRouter(include_in_schema=False)


@dataclass(frozen=True, slots=True)
class LearnPage:
    """Where a person starts a run and watches it."""

    path: PathState = field(metadata={"help": "How far this visitor has come in this world."})
    world: dict[str, Any] = field(metadata={"help": "The world, as the API has it."})
    data: dict[str, Any] = field(
        metadata={"help": "The page data: world, demonstrations, rankings, run, learners, settings."}
    )


@router.get("/worlds/{world_id}/learn", response_model=None)
def show_learn(
    request: Request, world: WorldFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone
) -> Response:
    """Show the latest run in this world, or what it would learn from."""
    with database.read() as session:
        run = queries.latest_run(session, visitor_id, world.id)
        page = _page(session, world, visitor_id, run)
    return render(request, "learning/learn.html", page)


@router.get("/runs/{run_id}", response_model=None)
def show_run(request: Request, run: RunFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone) -> Response:
    """Show one run, live or from its first frame."""
    with database.read() as session:
        page = _page(session, queries.world_of(session, run), visitor_id, run)
    return render(request, "learning/learn.html", page)


def _page(session: Session, world: StoredWorld, visitor_id: str | None, run: Run | None) -> LearnPage:
    rows = all_in_world(session, visitor_id, world.id)
    kept = [row for row in rows if row.discarded_at is None]
    rankings = service.current_rankings(session, visitor_id, world.id, kept)
    problem = to_problem(world.world, kept, rankings, settings={}, seed=0)
    data: dict[str, Any] = {
        "world": world.to_json(),
        "demonstrations": demonstrations_json(rows),
        "rankings": rankings_out(newest(session, visitor_id, world.id)).model_dump(mode="json"),
        "run": _run_json(session, run) if run else None,
        "learners": describe_choice(problem),
        "settings": describe_settings(),
    }
    return LearnPage(path=path_state(session, visitor_id, world.id, "learn"), world=data["world"], data=data)


def _run_json(session: Session, run: Run) -> dict[str, Any]:
    return to_out(run, queries.results(session, [run.id])[run.id]).model_dump(mode="json")
