"""What the routes of learning again ask for by type, and what the app opens for them."""

import secrets
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Annotated

from fastapi import Depends, FastAPI, Request

from app.errors import NotShown
from app.kit.companion import Asker, Companion
from app.learning.dependencies import RunFromPath
from app.learning.supervisor import ONE_THREAD_EACH
from app.retraining import computing
from app.retraining.answers import Answers
from app.visitors import VisitorOrNone


@asynccontextmanager
async def open_retraining(app: FastAPI) -> AsyncIterator[None]:
    """Have a companion for the life of the app; it starts when somebody needs it."""
    app.state.companion = Companion(
        warm_up=computing.get_ready, expected=computing.EXPECTED, environment=ONE_THREAD_EACH
    )
    app.state.answers = Answers(app.state.database)
    try:
        yield
    finally:
        app.state.companion.close()
        await app.state.answers.close()


async def get_asker(request: Request, visitor_id: VisitorOrNone) -> Asker:
    """Tell those who ask apart, to be fair to them."""
    return Asker(request.app.state.companion, visitor_id or _somebody(request))


async def get_asker_about_run(request: Request, run: RunFromPath, visitor_id: VisitorOrNone) -> Asker:
    """The same about a run: all who came by its link have one's turns together, or a link would buy any number."""
    if run.visitor_id == visitor_id:
        return Asker(request.app.state.companion, run.visitor_id)
    return Asker(request.app.state.companion, f"who looks at {run.id}", among=visitor_id or _somebody(request))


def _somebody(request: Request) -> str:
    """Whoever has no cookie: a connection, or, where a proxy hides that, one question."""
    client = request.client
    return f"{client.host}:{client.port}" if client and client.port else secrets.token_hex(8)


async def check_is_shown(request: Request) -> None:
    """Refuse what the study keeps from its participants while they order."""
    if not request.app.state.settings.show_policy:
        message = "What would be learned from an order is not shown in this study."
        raise NotShown(message)


async def get_answers(request: Request) -> Answers:
    """Return what was found out before."""
    answers: Answers = request.app.state.answers
    return answers


AskerFromRequest = Annotated[Asker, Depends(get_asker)]
AskerAboutRun = Annotated[Asker, Depends(get_asker_about_run)]
AnswersFromApp = Annotated[Answers, Depends(get_answers)]
