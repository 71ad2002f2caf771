"""One look for all streams: what happens in the runs that somebody watches.

Workers append events to the table, numbered 1, 2, … in each run, and ring; whoever did not hear it is found out by
looking. Each event is read and understood once, however many streams it goes out to, and no stream holds a database
connection while it waits.
"""

import asyncio
import contextlib
import json
import time
from collections import Counter, deque
from collections.abc import AsyncIterator, Iterable, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from anyio import to_thread

from app.db import Database
from app.kit.bell import Bell
from app.learning import queries
from app.learning.queries import Standing
from app.models import RunEvent

LOOK_EVERY_S = 0.05
"""How soon news is found that nobody rang for."""
REST_S = 0.015
"""Between two looks, however often it rings: what comes meanwhile is found together."""
BATCH = 50
"""How many events are read at once: bounds what a stream that is far behind holds in memory."""
MOST_KEPT = 200
MOST_KEPT_CHARACTERS = 2_000_000
LAST_KINDS = ("done", "failed")


@dataclass(frozen=True)
class Happening:
    """An event of a run, as it was stored."""

    run_id: str
    number: int
    kind: str
    data: str

    @property
    def is_last(self) -> bool:
        """Nothing follows it in its run."""
        return self.kind in LAST_KINDS

    @cached_property
    def told(self) -> dict[str, Any]:
        """What it tells, read once for all streams."""
        told: dict[str, Any] = json.loads(self.data)
        return told

    @property
    def learner(self) -> str | None:
        """Whose frame or result it is."""
        return self.told.get("learner")

    @cached_property
    def text(self) -> str:
        """What it tells beside events of other runs, in JSON: written once for all streams."""
        return f'{{"run_id":"{self.run_id}","number":{self.number},{self.data[1:]}'

    @cached_property
    def progress(self) -> str:
        """A frame without its pictures."""
        kept = {name: self.told[name] for name in ("learner", "iteration", "iterations")}
        return json.dumps({"run_id": self.run_id, "number": self.number} | kept)


@dataclass
class Feed:
    """What is known of one watched run: the events of late, without a gap, and how it stands."""

    run_id: str
    newest: int = 0
    """The number of the newest event."""
    standing: Standing | None = None
    """None: the run is gone."""
    latest: dict[str, Happening] = field(default_factory=dict)
    """The newest frame of each learner."""
    kept: deque[Happening] = field(default_factory=deque)
    n_characters: int = 0

    def after(self, number: int) -> Sequence[Happening] | None:
        """The events that follow `number`; None where they are no longer kept, or never were."""
        if number < self.newest - len(self.kept):
            return None
        return [one for one in self.kept if one.number > number]

    def add(self, happening: Happening) -> None:
        """Keep what has come, and let go of what is old."""
        self.newest = happening.number
        self.kept.append(happening)
        self.n_characters += len(happening.data)
        if happening.kind == "frame":
            self.latest[str(happening.learner)] = happening
        while len(self.kept) > MOST_KEPT or (self.n_characters > MOST_KEPT_CHARACTERS and len(self.kept) > 1):
            self.n_characters -= len(self.kept.popleft().data)


class Watcher:
    """Knows which runs are watched, looks for their news, and wakes the streams."""

    def __init__(self, database: Database, bell: Bell) -> None:
        self._database = database
        self._bell = bell
        self._watched: Counter[str] = Counter()
        self._feeds: dict[str, Feed] = {}
        self._news = asyncio.Event()
        self._task: asyncio.Task[None] | None = None

    @property
    def n_streams(self) -> int:
        """How many runs are watched, counted once for each stream."""
        return self._watched.total()

    @property
    def news(self) -> asyncio.Event:
        """Set at the next news. Take it before looking, so that nothing can come in between."""
        return self._news

    @asynccontextmanager
    async def watching(self, run_ids: Sequence[str]) -> AsyncIterator[list[Feed]]:
        """Watch these runs; their feeds are up to date at the beginning and kept so."""
        self._watched.update(run_ids)
        try:
            await self._begin(run_ids)
            self._start_to_look()
            yield [self._feeds[run_id] for run_id in run_ids]
        finally:
            self._watched.subtract(run_ids)
            for run_id in run_ids:
                if not self._watched[run_id]:
                    del self._watched[run_id]
                    self._feeds.pop(run_id, None)

    async def events_after(self, run_id: str, number: int) -> Sequence[Happening]:
        """Read the next events of a run that its feed no longer keeps."""
        return await to_thread.run_sync(self._read_after, run_id, number)

    async def close(self) -> None:
        """Stop looking."""
        if self._task is not None:
            self._task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._task

    async def _begin(self, run_ids: Sequence[str]) -> None:
        unknown = [run_id for run_id in run_ids if run_id not in self._feeds]
        if unknown:
            for feed in await to_thread.run_sync(self._first_look, unknown):
                self._feeds.setdefault(feed.run_id, feed)  # another stream may have been faster

    def _start_to_look(self) -> None:
        if self._task is None or self._task.done():
            self._task = asyncio.create_task(self._look_on())

    async def _look_on(self) -> None:
        """Look for news as long as anybody watches."""
        while self._watched:
            with contextlib.suppress(Exception):  # a busy database is no reason to stop looking
                if await self._look():
                    self._news.set()
                    self._news = asyncio.Event()
            began = time.monotonic()
            with contextlib.suppress(OSError):  # nor is a broken bell; a TimeoutError is one of them
                await asyncio.wait_for(self._bell.wait(), LOOK_EVERY_S)
            await asyncio.sleep(max(0.0, began + REST_S - time.monotonic()))

    async def _look(self) -> bool:
        """Add what has come to the feeds; False when nothing has changed."""
        known = dict(self._feeds)
        newest = {run_id: feed.newest for run_id, feed in known.items()}
        happenings, standings = await to_thread.run_sync(self._find_news, newest)
        is_news = False
        for happening in happenings:
            feed = known[happening.run_id]
            if happening.number == feed.newest + 1:
                feed.add(happening)
                is_news = True
        for run_id, feed in known.items():  # a feed that began meanwhile knows better than this look
            if feed.standing != standings.get(run_id):
                feed.standing = standings.get(run_id)
                is_news = True
        return is_news

    def _first_look(self, run_ids: Sequence[str]) -> list[Feed]:
        with self._database.read() as session:
            newest = queries.last_event_numbers(session, run_ids)
            standings = queries.standings(session, run_ids)
            latest = _by_run(queries.latest_frames(session, run_ids))
        return [
            Feed(
                run_id,
                newest.get(run_id, 0),
                standings.get(run_id),
                {str(one.learner): one for one in latest if one.run_id == run_id},
            )
            for run_id in run_ids
        ]

    def _find_news(self, known: dict[str, int]) -> tuple[list[Happening], dict[str, Standing]]:
        with self._database.read() as session:
            standings = queries.standings(session, list(known))
            newest = queries.last_event_numbers(session, list(known))
            happenings = [
                happening
                for run_id, number in known.items()
                if newest.get(run_id, 0) > number
                for happening in _by_run(queries.events_after(session, run_id, number, limit=BATCH))
            ]
        for one in happenings:
            _ = one.told, one.text  # here, in a thread, and not where all streams wait
        return happenings, standings

    def _read_after(self, run_id: str, number: int) -> list[Happening]:
        with self._database.read() as session:
            return _by_run(queries.events_after(session, run_id, number, limit=BATCH))


def _by_run(rows: Iterable[RunEvent]) -> list[Happening]:
    return [Happening(row.run_id, row.number, row.kind, row.data) for row in rows]
