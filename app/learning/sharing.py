"""Sharing a run: who has a link with its key may see the run and what it learned from, and change nothing."""

import secrets
from collections.abc import Sequence

from sqlalchemy import select, update
from sqlalchemy.orm import Session

from app.errors import NotFound
from app.kit import clock
from app.models import RunShare


def share(session: Session, run_id: str) -> RunShare:
    """Return the key of a run, made at the first request and after the last one was revoked."""
    if standing := keys_of(session, run_id):
        return standing[0]
    made = RunShare(key=secrets.token_urlsafe(32), run_id=run_id, created_at=clock.now())
    session.add(made)
    session.flush()
    return made


def revoke(session: Session, run_id: str, key: str) -> None:
    """Close a run to those who have this key; revoking twice is revoking once. Raises NotFound for a foreign key."""
    theirs = (RunShare.run_id == run_id, RunShare.key == key)
    if session.scalar(select(RunShare.key).where(*theirs)) is None:
        message = "This run was never shared by such a link."
        raise NotFound(message)
    session.execute(update(RunShare).where(*theirs, RunShare.revoked_at.is_(None)).values(revoked_at=clock.now()))


def keys_of(session: Session, run_id: str) -> Sequence[RunShare]:
    """List the keys of a run that open it."""
    opening = (RunShare.run_id == run_id, RunShare.revoked_at.is_(None))
    return session.scalars(select(RunShare).where(*opening).order_by(RunShare.created_at, RunShare.key)).all()


def opens(session: Session, key: str, run_id: str) -> bool:
    """Tell whether a key opens a run."""
    found = session.get(RunShare, key)
    return found is not None and found.run_id == run_id and found.revoked_at is None
