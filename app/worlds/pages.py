"""Where worlds come from: the editor, and a surprise."""

import random
from dataclasses import dataclass, field
from typing import Any

from fastapi import APIRouter, Request
from starlette.responses import RedirectResponse, Response

from app.errors import ImpossibleWorld
from app.pages import PathState, render
from app.worlds import schemas, service
from app.worlds.address import LONGEST, WorldQuery
from app.worlds.dependencies import QueryFromAddress
from app.worlds.presets import PRESETS

router = APIRouter(include_in_schema=False)

LIMITS = {
    "rows": schemas.SIDE,
    "cols": schemas.SIDE,
    "seed": schemas.SEED,
    "red_probability": schemas.RED_PROBABILITY,
    "slip": schemas.SLIP,
    "n_goals": (1, schemas.MOST_GOALS),
    "reward": schemas.REWARD,
    "goal_reward": schemas.GOAL_REWARD,
    "time_limit_s": schemas.TIME_LIMIT_S,
    "query_length": (0, LONGEST),
}


@dataclass(frozen=True, slots=True)
class EditorPage:
    """Where a person makes a world of their own."""

    data: dict[str, Any] = field(metadata={"help": "The page data: spec, world, problem, presets, limits."})
    path: PathState = field(metadata={"help": "The beginning: what is made here is not played yet."})


@router.get("/worlds/new", response_model=None)
def show_editor(request: Request, query: QueryFromAddress) -> Response:
    """Open the editor on the world of the address; what is wrong with that is said there."""
    presets = [{"name": one.name, "title": one.title, "text": one.text, "spec": one.spec} for one in PRESETS]
    data = {**_asked_for(query), "presets": presets, "limits": LIMITS}
    return render(request, "worlds/editor.html", EditorPage(data=data, path=PathState()))


@router.get("/worlds/surprise", response_model=None)
def surprise() -> Response:
    """Lead to a world nobody asked for, another one each time."""
    return RedirectResponse(f"/?{service.surprise(random.SystemRandom())}", 303)


def _asked_for(query: WorldQuery) -> dict[str, Any]:
    try:
        world = service.imagine(query)
    except ImpossibleWorld as problem:
        told = {"message": problem.message, "fields": problem.fields}
        return {"spec": dict(query.spec), "world": None, "problem": told}
    return {"spec": world.smallest_body, "world": world.to_json(), "problem": None}
