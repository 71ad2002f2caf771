"""A run's snapshot as a demonstration file, from which `irlfr learn` gives the same numbers."""

from typing import Any

from sqlalchemy.orm import Session

from app.demonstrations.convert import demonstration_from_row
from app.learning import queries
from app.learning.convert import to_rankings
from app.models import Demonstration, Run
from irl_core import write_demonstration_file


def demonstration_file(session: Session, run: Run) -> str:
    """Write the world, demonstrations and rankings of a run as JSON lines."""
    rows = queries.demonstrations_of(session, run)
    return write_demonstration_file(
        queries.world_of(session, run).world,
        [demonstration_from_row(row) for row in rows],
        to_rankings(run.rankings),
        world_id=run.world_id,
        more={row.id: _beside_the_play(row) for row in rows},
    )


def _beside_the_play(row: Demonstration) -> dict[str, Any]:
    """What a file says of an attempt more than irl_core knows: its times, and where it comes from."""
    parent = {} if row.parent_id is None else {"parent_id": row.parent_id, "parent_step": row.parent_step}
    return {"step_ms": row.step_ms, "created_at": row.created_at.isoformat(), **parent}
