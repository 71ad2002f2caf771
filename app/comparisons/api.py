"""Comparisons as JSON."""

from fastapi import APIRouter

from app.comparisons import queries
from app.comparisons.schemas import ComparisonOut, RolloutOut
from app.learning.dependencies import RunFromPath

router = APIRouter(prefix="/api/v1", tags=["comparisons"])


@router.get("/runs/{run_id}/comparison", summary="Compare")
def show_comparison(run: RunFromPath) -> ComparisonOut:
    """Show the human, the learners and the optimum side by side, sorted by place; 409 until the run is done."""
    return ComparisonOut.model_validate(queries.comparison_of(run))


@router.get("/runs/{run_id}/rollouts", summary="Replay the comparison")
def show_rollouts(run: RunFromPath) -> dict[str, list[RolloutOut]]:
    """Show the episodes that the means were taken over, by `who`; the human's are the demonstrations themselves."""
    return {
        who: [RolloutOut.model_validate(one) for one in episodes] for who, episodes in queries.rollouts_of(run).items()
    }
