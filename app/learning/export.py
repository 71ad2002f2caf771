"""A run's snapshot as a demonstration file, from which `irlfr learn` gives the same numbers."""

from sqlalchemy.orm import Session

from app.demonstrations.convert import beside_the_play, demonstration_from_row
from app.learning import queries
from app.learning.convert import to_rankings
from app.models import Run
from irl_core import write_demonstration_file


def demonstration_file(session: Session, run: Run) -> str:
    """Write the world, demonstrations and rankings of a run as JSON lines."""
    rows = queries.demonstrations_of(session, run)
    return write_demonstration_file(
        queries.world_of(session, run).world,
        [demonstration_from_row(row) for row in rows],
        to_rankings(run.rankings),
        world_id=run.world_id,
        more={row.id: beside_the_play(row) for row in rows},
    )
