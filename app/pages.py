"""What every page knows: where the person stands on the path Play → Rank → Learn → Compare."""

from dataclasses import dataclass, field
from typing import Any, Literal

from fastapi import Request
from sqlalchemy import Row, func, select
from sqlalchemy.orm import Session
from starlette.responses import HTMLResponse

from app.models import Demonstration, Ranking, Run
from app.templating import Pages

Stage = Literal["play", "rank", "learn", "compare"]


@dataclass(frozen=True, slots=True)
class PathState:
    """How far one visitor has come in one world."""

    world_id: str | None = field(default=None, metadata={"help": "The world, or None while it is not stored yet."})
    n_successes: int = field(default=0, metadata={"help": "Successes kept."})
    n_failures: int = field(default=0, metadata={"help": "Failures kept."})
    n_wanted: int = field(default=3, metadata={"help": "How many of each are asked for."})
    ranked: bool = field(default=False, metadata={"help": "Everything kept stands in a confirmed order."})
    run_id: str | None = field(default=None, metadata={"help": "The latest run in this world."})
    run_status: str | None = field(default=None, metadata={"help": "queued, running, done, failed or cancelled."})
    current: Stage = field(default="play", metadata={"help": "The stage this page belongs to."})


def path_state(session: Session, visitor_id: str | None, world_id: str, current: Stage) -> PathState:
    """Find out how far the visitor has come in this world."""
    if visitor_id is None:
        return PathState(world_id=world_id, current=current)
    kept = _kept_ids(session, visitor_id, world_id)
    run = _latest_run(session, visitor_id, world_id)
    return PathState(
        world_id=world_id,
        n_successes=len(kept["success"]),
        n_failures=len(kept["failure"]),
        ranked=_is_ranked(session, visitor_id, world_id, kept),
        run_id=run.id if run else None,
        run_status=run.status if run else None,
        current=current,
    )


def _kept_ids(session: Session, visitor_id: str, world_id: str) -> dict[str, set[str]]:
    is_kept = Demonstration.discarded_at.is_(None)
    theirs = (Demonstration.visitor_id == visitor_id, Demonstration.world_id == world_id, is_kept)
    kept: dict[str, set[str]] = {"success": set(), "failure": set()}
    for demonstration_id, outcome in session.execute(select(Demonstration.id, Demonstration.outcome).where(*theirs)):
        kept[outcome].add(demonstration_id)
    return kept


def _latest_run(session: Session, visitor_id: str, world_id: str) -> "Row[str, str] | None":
    theirs = (Run.visitor_id == visitor_id, Run.world_id == world_id)
    return session.execute(select(Run.id, Run.status).where(*theirs).order_by(Run.created_at.desc()).limit(1)).first()


def _is_ranked(session: Session, visitor_id: str, world_id: str, kept: dict[str, set[str]]) -> bool:
    """Whether an order was confirmed, and the newest hold exactly what is kept; one attempt alone needs none."""
    ranked = {outcome: _ranked_ids(session, visitor_id, world_id, outcome) for outcome in kept}
    is_settled = all(len(ids) <= 1 or ids == ranked[outcome] for outcome, ids in kept.items())
    return any(kept.values()) and any(ranked.values()) and is_settled


def _ranked_ids(session: Session, visitor_id: str, world_id: str, outcome: str) -> set[str]:
    theirs = (Ranking.visitor_id == visitor_id, Ranking.world_id == world_id, Ranking.outcome == outcome)
    order = session.scalar(select(Ranking.order).where(*theirs).order_by(Ranking.version.desc()).limit(1))
    return {member for group in order or [] for member in group}


def latest_world_id(session: Session, visitor_id: str) -> str | None:
    """The world in which the visitor last played."""
    latest = select(func.max(Demonstration.number)).where(Demonstration.visitor_id == visitor_id).scalar_subquery()
    return session.scalar(select(Demonstration.world_id).where(Demonstration.number == latest))


def render(request: Request, template: str, page: Any, *, status: int = 200) -> HTMLResponse:  # noqa: ANN401 - a page's context class
    """Render a page's context class by its template."""
    pages: Pages = request.app.state.pages
    return pages.render(request, template, page, status=status)
