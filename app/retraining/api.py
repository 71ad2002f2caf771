"""Learning again at once, as JSON."""

from typing import Any

from fastapi import APIRouter

from app.dependencies import DatabaseFromApp
from app.learning.dependencies import RunFromPath
from app.retraining import service
from app.retraining.dependencies import AskerFromRequest
from app.retraining.schemas import LearnedOut, PreviewIn, WhatIfIn, WhatIfOut
from app.visitors import VisitorOrNone
from app.worlds.dependencies import WorldFromPath

router = APIRouter(prefix="/api/v1", tags=["learning again"])


@router.post("/worlds/{world_id}/previews", summary="Preview what an order teaches", response_model=LearnedOut)
async def preview(
    world: WorldFromPath,
    asked: PreviewIn,
    database: DatabaseFromApp,
    asker: AskerFromRequest,
    visitor_id: VisitorOrNone,
) -> dict[str, Any]:
    """Learn at once from orders of the attempts you have kept in this world. Nothing is stored, and no run is made.

    The result is that of a run with these orders, these settings and seed 0. Refused with 409 `superseded` where you
    asked for another preview before this one's turn came, with 422 `missing_demonstrations` where nothing can be
    learned yet and `too_slow` where it takes longer than a few seconds, with 503 where the server is too busy.
    """
    return await service.preview(asker, database, world=world, visitor_id=visitor_id, asked=asked)


@router.post("/runs/{run_id}/what-ifs", summary="Ask what if", response_model=WhatIfOut)
async def what_if(
    run: RunFromPath, asked: WhatIfIn, database: DatabaseFromApp, asker: AskerFromRequest
) -> dict[str, Any]:
    """Let a learner of a run learn again at once with one thing changed; nothing is stored.

    It learns from the run's own snapshot, with its settings and seed. Refused as previews are, and with 409
    `no_result` while this learner has not finished in this run.
    """
    return await service.what_if(asker, database, run, asked)
