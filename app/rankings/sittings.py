"""The log of a sitting: appended to, checked, never changed.

What comes is checked while reading, outside the one writer: each new event is applied to what the log has come to. What
this process has gone through of a log it does not go through again. Then the writer stores it, if the log is still as
long as it was; if another request was faster, all of it begins anew.
"""

from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from itertools import pairwise
from threading import Lock
from typing import Any, NoReturn, TypeVar

from sqlalchemy import insert
from sqlalchemy.orm import Session

from app.db import Database
from app.errors import Conflict, NotFound, Unavailable, Unprocessable
from app.kit.clock import now
from app.models import RankingEvent, Sitting
from app.rankings import queries
from app.rankings.log import Event, Log, Owner, checked_after, log_after, n_held
from app.rankings.replay import InvalidEvent
from app.visitors import remember

T = TypeVar("T")

INSERT = insert(RankingEvent)
MOST_TRIES = 5
MOST_KNOWN = 8_000_000
"""What the logs that a process remembers may hold together, as `n_held` measures it: 60 MB, or hundreds of sittings."""


class KnownLogs:
    """The logs that this process has gone through lately, as far as they were stored then."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._logs: OrderedDict[str, Log] = OrderedDict()
        self._n_held = 0

    def find(self, sitting_id: str) -> Log | None:
        """Return what is remembered of a sitting."""
        with self._lock:
            return self._logs.get(sitting_id)

    def keep(self, sitting_id: str, log: Log) -> None:
        """Remember it, unless more of it is remembered, and forget those that were not asked for the longest."""
        with self._lock:
            known = self._logs.pop(sitting_id, None)
            longer = known if known is not None and known.n_events > log.n_events else log
            self._logs[sitting_id] = longer
            self._n_held += _weight(longer) - (0 if known is None else _weight(known))
            while self._n_held > MOST_KNOWN:
                self._n_held -= _weight(self._logs.popitem(last=False)[1])


def _weight(log: Log) -> int:
    return 100 + n_held(log.state)


@dataclass(frozen=True, slots=True)
class Whose:
    """Who orders, and where."""

    visitor_id: str | None
    world_id: str


class Sittings:
    """The logs of all sittings."""

    def __init__(self, database: Database) -> None:
        self.database = database
        self._known = KnownLogs()

    def append(self, whose: Whose, sitting_id: str, events: Sequence[Event], work: Callable[[Session, Log], T]) -> T:
        """Append events, leaving out those that are there already, and do `work` in the same transaction.

        `work` is given the log up to the last of these events; without any, the whole of it.
        """
        _check_numbers(events)
        for _ in range(MOST_TRIES):
            with self.database.read() as session:
                batch = _check(session, self._known, whose, sitting_id, events)
            try:
                return self.database.write(partial(_store, whose=whose, batch=batch, work=work))
            except _OvertakenError:
                continue
        message = "Too much came at once from this sitting; please try again in a moment."
        raise Unavailable(message)


@dataclass(frozen=True, slots=True)
class _Batch:
    """Checked events that go on from the `n_stored` that there are, and the log up to the last of those sent."""

    sitting_id: str
    n_stored: int
    new: Sequence[Event]
    log: Log


class _OvertakenError(Exception):
    """The log grew between the check and the writing."""


def _check_numbers(events: Sequence[Event]) -> None:
    for before, event in pairwise(events):
        if event["n"] != before["n"] + 1:
            _refuse(event, f"it stands after event {before['n']}")


def _check(session: Session, known: KnownLogs, whose: Whose, sitting_id: str, events: Sequence[Event]) -> _Batch:
    n_stored = _n_stored(session, whose, sitting_id)
    first = events[0]["n"] if events else n_stored
    log = None
    if first <= n_stored:
        again, new = events[: n_stored - first], events[n_stored - first :]
        _check_is_same(session, sitting_id, again)
        n_wanted = again[-1]["n"] + 1 if again and not new else n_stored
        log = _continued(_log_at(session, known, sitting_id, n_wanted), new, session, whose)
    if log is None:
        message = f"Of this sitting {n_stored} events are stored. Send those from event {n_stored} on."
        raise Conflict(message, code="log_gap", fields={"n_events": str(n_stored)})
    return _Batch(sitting_id, n_stored, new, log)


def _n_stored(session: Session, whose: Whose, sitting_id: str) -> int:
    sitting = queries.find_sitting(session, sitting_id)
    if sitting is None:
        return 0
    if (sitting.visitor_id, sitting.world_id) != (whose.visitor_id, whose.world_id):
        message = "You have no such sitting in this world. It belongs to the browser in which it began."
        raise NotFound(message)
    return sitting.n_events


def _check_is_same(session: Session, sitting_id: str, again: Sequence[Event]) -> None:
    stored = queries.stored_events(session, sitting_id, again[0]["n"], again[-1]["n"] + 1) if again else []
    for event, known in zip(again, stored, strict=True):
        if event != known:
            message = f"Event {event['n']} of this sitting is stored already, and it is another. Nothing was changed."
            raise Conflict(message, fields={"n": str(event["n"])})


def _log_at(session: Session, known: KnownLogs, sitting_id: str, n_events: int) -> Log | None:
    log = known.find(sitting_id)
    if log is not None and log.n_events > n_events:
        log = None
    for event in queries.stored_events(session, sitting_id, log.n_events if log else 0, n_events):
        log = log_after(log, event)
    if log is not None:
        known.keep(sitting_id, log)
    return log


def _continued(log: Log | None, new: Sequence[Event], session: Session, whose: Whose) -> Log | None:
    if not new:
        return log
    owner = _owner(session, whose)
    for event in new:
        try:
            log = checked_after(log, event, owner)
        except InvalidEvent as error:
            _refuse(event, str(error))
    return log


def _owner(session: Session, whose: Whose) -> Owner:
    if whose.visitor_id is None:
        message = "You have no attempts in this world yet, so there is nothing to order."
        raise Unprocessable(message, fields={"events": message})
    attempts = queries.attempts(session, whose.visitor_id, whose.world_id)
    return Owner(whose.visitor_id, whose.world_id, attempts)


def _refuse(event: Event, why: str) -> NoReturn:
    message = f"Event {event['n']} of this sitting cannot be: {why}. Nothing was stored."
    raise Unprocessable(message, fields={"events": message, "n": str(event["n"])})


def _store(session: Session, *, whose: Whose, batch: _Batch, work: Callable[[Session, Log], T]) -> T:
    if batch.new:
        _append(session, whose, batch)
    return work(session, batch.log)


def _append(session: Session, whose: Whose, batch: _Batch) -> None:
    sitting = queries.find_sitting(session, batch.sitting_id)
    if (sitting.n_events if sitting else 0) != batch.n_stored:
        raise _OvertakenError
    n_events, moment = batch.log.n_events, now()
    if sitting is not None:
        sitting.n_events = n_events
    else:
        visitor_id = str(whose.visitor_id)
        remember(session, visitor_id)
        columns = {"id": batch.sitting_id, "visitor_id": visitor_id, "world_id": whose.world_id}
        session.add(Sitting(**columns, n_events=n_events, created_at=moment))
    session.flush()
    session.execute(INSERT, [_columns(batch.sitting_id, event, moment) for event in batch.new])


def _columns(sitting_id: str, event: Event, moment: datetime) -> dict[str, Any]:
    named = {name: event[name] for name in ("n", "type", "means", "at_ms")}
    return {"sitting_id": sitting_id, "event": event, "created_at": moment, **named}
