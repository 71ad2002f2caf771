"""Results over many worlds as JSON, and as tables."""

from typing import Any

from fastapi import APIRouter
from fastapi.responses import Response

from app.results import exports
from app.results.dependencies import OwnResults, ResultsFromQuery
from app.results.schemas import ResultsOut

router = APIRouter(prefix="/api/v1", tags=["results"])

IS_CSV: dict[int | str, dict[str, Any]] = {
    200: {"content": {"text/csv": {}}, "description": "The table, with a header row."}
}


@router.get("/results", summary="Show results over many worlds")
def show_results(results: ResultsFromQuery) -> ResultsOut:
    """Show what the latest finished comparison of each of your worlds says, taken together.

    With `world` (once for each of up to 20): what the latest finished comparisons of everybody say, in worlds that pool
    their results. Nobody is named, and worlds, learners and pairs are shown only from three people on; a world that
    pools nothing is refused (422 `not_pooled`).
    """
    return results


@router.get("/results.csv", summary="Take results away", response_class=Response, responses=IS_CSV)
def export_results(results: ResultsFromQuery) -> Response:
    """Download the same figures as a table, a row for each: docs/codebook.md explains the columns."""
    return _csv(exports.results_csv(results), f"irlfr-{results.scope}-results.csv")


@router.get("/results/comparisons.csv", summary="Take your comparisons away", response_class=Response, responses=IS_CSV)
def export_comparisons(results: OwnResults) -> Response:
    """Download your latest finished comparison of each world as a table: a row for everybody who took part."""
    return _csv(exports.comparisons_csv(results), "irlfr-own-comparisons.csv")


def _csv(text: str, name: str) -> Response:
    told = {"Content-Disposition": f'attachment; filename="{name}"'}
    return Response(text, media_type="text/csv; charset=utf-8; header=present", headers=told)
