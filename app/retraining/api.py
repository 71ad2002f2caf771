"""Learning again at once, as JSON."""

from typing import Annotated, Any

from fastapi import APIRouter, Depends, Query

from app.dependencies import DatabaseFromApp
from app.learning.dependencies import RunFromPath
from app.retraining import service
from app.retraining.dependencies import AnswersFromApp, AskerAboutRun, AskerFromRequest, check_is_shown
from app.retraining.schemas import InfluenceOut, LearnedOut, PreviewIn, UncertaintyOut, WhatIfIn, WhatIfOut
from app.visitors import VisitorOrNone
from app.worlds.dependencies import WorldFromPath

router = APIRouter(prefix="/api/v1", tags=["learning again"])

LearnerFromQuery = Annotated[str, Query(max_length=40, description="The name of a learner of this run.")]


@router.post(
    "/worlds/{world_id}/previews",
    summary="Preview what an order teaches",
    response_model=LearnedOut,
    dependencies=[Depends(check_is_shown)],
)
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
    learned yet and `too_slow` where it takes longer than a few seconds, with 503 where the server is too busy, with 403
    `not_shown` where the study keeps it back.
    """
    return await service.preview(asker, database, world=world, visitor_id=visitor_id, asked=asked)


@router.post("/runs/{run_id}/what-ifs", summary="Ask what if", response_model=WhatIfOut)
async def what_if(run: RunFromPath, asked: WhatIfIn, database: DatabaseFromApp, asker: AskerAboutRun) -> dict[str, Any]:
    """Let a learner of a run learn again at once with one thing changed; nothing is stored.

    It learns from the run's own snapshot, with its settings and seed. Refused as previews are, and with 409
    `no_result` while this learner has not finished in this run.
    """
    return await service.what_if(asker, database, run, asked)


@router.get("/runs/{run_id}/influence", summary="Ask which attempt mattered", response_model=InfluenceOut)
async def show_influence(
    run: RunFromPath,
    learner: LearnerFromQuery,
    asker: AskerAboutRun,
    answers: AnswersFromApp,
) -> dict[str, Any]:
    """Show what each attempt changed in what a learner of a run came to: it learns again without each of them.

    Refused as what-ifs are. What was worked out once is at hand the next time.
    """
    return await service.influence(asker, answers, run, learner)


@router.get("/runs/{run_id}/uncertainty", summary="Ask how sure a learner is", response_model=UncertaintyOut)
async def show_uncertainty(
    run: RunFromPath,
    learner: LearnerFromQuery,
    asker: AskerAboutRun,
    answers: AnswersFromApp,
) -> dict[str, Any]:
    """Show how sure a learner of a run can be: by its posterior, or by learning again from draws of the attempts.

    Draws are taken with replacement, successes and failures apart, seeded by the run's seed; there are as many as about
    a second allows, 30 to 200. Refused as what-ifs are. What was worked out once is at hand the next time.
    """
    return await service.uncertainty(asker, answers, run, learner)
