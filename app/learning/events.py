"""Appending to a run's stream: numbered without gaps, in the transaction of what the event tells of."""

import json
from collections.abc import Mapping, Sequence
from typing import Any, Literal

from sqlalchemy import func, insert, select
from sqlalchemy.orm import Session

from app.models import RunEvent

Kind = Literal["frame", "learner", "done", "failed"]


def append(session: Session, run_id: str, kind: Kind, data: Mapping[str, Any]) -> None:
    """Store the next event of a run. NaN and infinity, which JSON lacks, are an error here and not in the browser."""
    _append(session, run_id, kind, [data])


def append_frames(session: Session, run_id: str, frames: Sequence[Mapping[str, Any]]) -> None:
    """Store frames, in order."""
    _append(session, run_id, "frame", frames)


def _append(session: Session, run_id: str, kind: Kind, told: Sequence[Mapping[str, Any]]) -> None:
    newest = session.scalar(select(func.coalesce(func.max(RunEvent.number), 0)).where(RunEvent.run_id == run_id)) or 0
    rows = [
        {
            "run_id": run_id,
            "number": number,
            "kind": kind,
            "data": json.dumps(data, allow_nan=False, separators=(",", ":")),
        }
        for number, data in enumerate(told, newest + 1)
    ]
    session.execute(insert(RunEvent), rows)
