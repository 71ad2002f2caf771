"""A run's events as Server-Sent Events.

Workers append events to the table, numbered 1, 2, … in each run; the number is the event's id, so a browser that comes
back says `Last-Event-ID` and is sent what follows. One task of this process looks for news of all watched runs at once
and wakes the streams concerned; no stream holds a database connection while it waits.
"""

import asyncio
import contextlib
from collections import Counter
from collections.abc import AsyncIterator, Sequence

from anyio import to_thread
from fastapi.sse import KEEPALIVE_COMMENT, format_sse_event

from app.db import Database
from app.learning import queries
from app.models import RunEvent

LOOK_EVERY_S = 0.05
KEEP_ALIVE_AFTER_S = 15.0
BATCH = 50
"""How many events are read at once: bounds what a stream that is far behind holds in memory."""
LAST_KINDS = ("done", "failed")


class Watcher:
    """Knows which runs are watched, and wakes their streams when something new is stored."""

    def __init__(self, database: Database) -> None:
        self._database = database
        self._watched: Counter[str] = Counter()
        self._newest: dict[str, int] = {}
        self._news = asyncio.Condition()
        self._task: asyncio.Task[None] | None = None

    @property
    def n_streams(self) -> int:
        """How many streams are open."""
        return self._watched.total()

    async def stream(self, run_id: str, after: int) -> AsyncIterator[bytes]:
        """Send the events of a run that follow number `after`, up to and with its last one."""
        self._watched[run_id] += 1
        self._wake_up()
        try:
            if after > await to_thread.run_sync(self._newest_number, run_id):
                after = 0  # not a number of ours: waiting for the next one could be waiting for ever
            while True:
                events = await to_thread.run_sync(self._read, run_id, after)
                for event in events:
                    yield format_sse_event(data_str=event.data, event=event.kind, id=str(event.number))
                    after = event.number
                    if event.kind in LAST_KINDS:
                        return
                if not events and not await self._wait(run_id, after):
                    yield KEEPALIVE_COMMENT
        finally:
            self._watched[run_id] -= 1
            if not self._watched[run_id]:
                del self._watched[run_id]
                self._newest.pop(run_id, None)

    async def close(self) -> None:
        """Stop looking."""
        if self._task is not None:
            self._task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._task

    def _read(self, run_id: str, after: int) -> Sequence[RunEvent]:
        with self._database.read() as session:
            return queries.events_after(session, run_id, after, limit=BATCH)

    async def _wait(self, run_id: str, after: int) -> bool:
        """Wait for an event after number `after`; False when none has come for the time of a keep-alive."""
        async with self._news:
            try:
                await asyncio.wait_for(
                    self._news.wait_for(lambda: self._newest.get(run_id, 0) > after), KEEP_ALIVE_AFTER_S
                )
            except TimeoutError:
                return False
        return True

    def _wake_up(self) -> None:
        if self._task is None or self._task.done():
            self._task = asyncio.create_task(self._look())

    async def _look(self) -> None:
        """Look for news as long as anybody watches."""
        while self._watched:
            with contextlib.suppress(Exception):  # a busy database is no reason to stop looking
                newest = await to_thread.run_sync(self._last_numbers, list(self._watched))
                if newest != self._newest:
                    async with self._news:
                        self._newest = newest
                        self._news.notify_all()
            await asyncio.sleep(LOOK_EVERY_S)

    def _newest_number(self, run_id: str) -> int:
        return self._last_numbers([run_id]).get(run_id, 0)

    def _last_numbers(self, run_ids: list[str]) -> dict[str, int]:
        with self._database.read() as session:
            return queries.last_event_numbers(session, run_ids)
