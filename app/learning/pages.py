"""The page on which a person watches the learners learn."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from fastapi import APIRouter, Request
from sqlalchemy.orm import Session
from starlette.responses import Response

from app.demonstrations.pages import demonstrations_json, snapshot_json
from app.demonstrations.queries import all_in_world
from app.dependencies import DatabaseFromApp
from app.learning import queries, service
from app.learning.convert import describe_choice, describe_settings, snapshot_rankings, to_out, to_problem
from app.learning.dependencies import RunFromPath, ShareKey
from app.learning.presets import PRESETS
from app.models import Demonstration, Run
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
        metadata={
            "help": "The page data: world, demonstrations, rankings, run, is_own, key, learners, settings, presets."
        }
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
def show_run(
    request: Request, run: RunFromPath, database: DatabaseFromApp, visitor_id: VisitorOrNone, key: ShareKey = None
) -> Response:
    """Show one run, live or from its first frame; to others than its owner with what it learned from, and no more."""
    with database.read() as session:
        world = queries.world_of(session, run)
        is_own = run.visitor_id == visitor_id
        page = _page(session, world, visitor_id, run) if is_own else _shared_page(session, world, visitor_id, run, key)
    return render(request, "learning/learn.html", page)


def _page(session: Session, world: StoredWorld, visitor_id: str | None, run: Run | None) -> LearnPage:
    """The page of somebody who plays here: what they have now, whatever the run learned from."""
    rows = all_in_world(session, visitor_id, world.id)
    kept = [row for row in rows if row.discarded_at is None]
    rankings = service.current_rankings(session, visitor_id, world.id, kept)
    data = {
        "demonstrations": demonstrations_json(rows),
        "rankings": rankings_out(newest(session, visitor_id, world.id)).model_dump(mode="json"),
        "run": _run_json(session, run, is_own=True) if run else None,
        "is_own": True,
        "key": None,
    }
    return _with_choice(session, world, visitor_id, data, learned_from=(kept, rankings))


def _shared_page(session: Session, world: StoredWorld, visitor_id: str | None, run: Run, key: str | None) -> LearnPage:
    """The page of somebody who came by a link: the run's snapshot, as if nothing had been played or ranked since."""
    rows = queries.demonstrations_of(session, run)
    data = {
        "demonstrations": snapshot_json(rows),
        "rankings": snapshot_rankings(run),
        "run": _run_json(session, run, is_own=False),
        "is_own": False,
        "key": key,
    }
    return _with_choice(session, world, visitor_id, data, learned_from=(rows, run.rankings))


def _with_choice(
    session: Session,
    world: StoredWorld,
    visitor_id: str | None,
    data: dict[str, Any],
    *,
    learned_from: tuple[Sequence[Demonstration], Mapping[str, Any]],
) -> LearnPage:
    """Add what a page says of the world, the learners and the settings."""
    demonstrations, rankings = learned_from
    problem = to_problem(world.world, demonstrations, rankings, settings={}, seed=0)
    data |= {
        "world": world.to_json(),
        "learners": describe_choice(problem),
        "settings": describe_settings(),
        "presets": PRESETS,
    }
    return LearnPage(path=path_state(session, visitor_id, world.id, "learn"), world=data["world"], data=data)


def _run_json(session: Session, run: Run, *, is_own: bool) -> dict[str, Any]:
    return to_out(session, run, is_own=is_own).model_dump(mode="json")
