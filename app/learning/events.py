"""Appending to a run's stream: numbered without gaps, in the transaction of what the event tells of."""

import json
from collections.abc import Mapping
from typing import Any, Literal

from sqlalchemy import func, insert, select
from sqlalchemy.orm import Session

from app.models import RunEvent

Kind = Literal["frame", "learner", "done", "failed"]


def append(session: Session, run_id: str, kind: Kind, data: Mapping[str, Any]) -> None:
    """Store the next event of a run. NaN and infinity, which JSON lacks, are an error here and not in the browser."""
    number = select(func.coalesce(func.max(RunEvent.number), 0) + 1).where(RunEvent.run_id == run_id).scalar_subquery()
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    session.execute(insert(RunEvent).values(run_id=run_id, number=number, kind=kind, data=text))
