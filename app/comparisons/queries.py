"""What can be asked about comparisons. They are made by the worker that ended the run, once, and kept with it."""

from typing import Any

from app.errors import Conflict
from app.models import Run

_NOT_YET = {
    "queued": "This run is waiting for its turn; the comparison comes when it is done.",
    "running": "This run is still learning; the comparison comes when it is done.",
    "failed": "This run failed, so there is nothing to compare. Start another.",
    "cancelled": "This run was cancelled, so there is nothing to compare. Start another.",
}


_NOT_IN_0_4 = dict.fromkeys(("human", "value_lost", "value_lost_scale", "tests"))
_NOT_IN_ENTRIES_OF_0_4 = dict.fromkeys(("interval_low", "interval_high", "success_rate", "mean_steps"))
"""What comparisons that were stored before it was measured lack."""


def comparison_of(run: Run) -> dict[str, Any]:
    """Return the comparison of a run. Raises Conflict while there is none."""
    if run.comparison is None:
        raise Conflict(_NOT_YET[run.status], code="no_comparison")
    entries = [_NOT_IN_ENTRIES_OF_0_4 | entry for entry in run.comparison["entries"]]
    return {"run_id": run.id, **_NOT_IN_0_4, **run.comparison, "entries": entries}


def rollouts_of(run: Run) -> dict[str, Any]:
    """Return the episodes behind the comparison of a run. Raises Conflict while there are none."""
    comparison_of(run)
    return run.rollouts or {}
