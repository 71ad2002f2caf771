"""Runs as Server-Sent Events: one run with each of its events, or all runs of a page by one connection.

The number of an event in its run is its id, so a browser that comes back says `Last-Event-ID` and is sent what follows.
The stream of a page thins frames out by time: of what came since it last sent, each learner's newest frame, and its
first. Its id is the vector of the numbers of all its runs. One that begins, or is far behind, gets a snapshot instead.
"""

import asyncio
import json
import time
from collections.abc import AsyncIterator, Iterable, Iterator, Sequence
from contextlib import suppress
from typing import Any

from fastapi.sse import KEEPALIVE_COMMENT

from app.learning.queries import Standing
from app.learning.watcher import Feed, Happening, Watcher

KEEP_ALIVE_AFTER_S = 15.0
PACE_S = 1 / 28
"""Between two batches of a stream: with its first frame, a learner is seen at most 30 times a second."""
PACE_S_PER_STREAM = 0.001
"""Many streams are each sent a little less, so that the server answers everybody else as fast as without them."""
FAR_BEHIND = 200
"""Events, from which on a snapshot serves a page better than what it missed."""
DELETED = "This run was deleted, with everything it had learned."


async def every_event(watcher: Watcher, run_id: str, after: int) -> AsyncIterator[bytes]:
    """Send each event of a run that follows number `after`, up to and with its last one."""
    async with watcher.watching([run_id]) as (feed,):
        if after > feed.newest:
            after = 0  # not a number of ours: waiting for the next one could be waiting for ever
        while True:
            news = watcher.news
            for one in await _following(watcher, feed, after):
                yield _message(one.kind, one.data, str(one.number))
                after = one.number
                if one.is_last:
                    return
            if feed.standing is None:
                yield _message("failed", json.dumps({"status": "deleted", "message": DELETED}), str(after))
                return
            if after >= feed.newest and not await _comes(news):
                yield KEEPALIVE_COMMENT


async def many_runs(
    watcher: Watcher, run_ids: Sequence[str], *, with_frames: Iterable[str], seen: Sequence[int] | None
) -> AsyncIterator[bytes]:
    """Send what happens in these runs until all have ended; `seen` are the numbers that the browser has already."""
    async with watcher.watching(run_ids) as feeds:
        page = _Page(watcher, feeds, frozenset(with_frames), seen)
        while True:
            news, began = watcher.news, time.monotonic()
            if batch := await page.next_batch():
                yield b"".join(batch)
            if page.has_ended:
                return
            if not page.is_behind and not await _comes(news):
                yield KEEPALIVE_COMMENT
            pace = max(PACE_S, PACE_S_PER_STREAM * watcher.n_streams)
            await asyncio.sleep(max(0.0, began + pace - time.monotonic()))


class _Page:
    """What one stream has sent of its runs, and what comes next."""

    def __init__(
        self, watcher: Watcher, feeds: Sequence[Feed], with_frames: frozenset[str], seen: Sequence[int] | None
    ) -> None:
        self._watcher = watcher
        numbers: Sequence[int | None] = [None] * len(feeds) if seen is None else seen
        self._runs = [
            _OfRun(feed, number, with_frames=feed.run_id in with_frames)
            for feed, number in zip(feeds, numbers, strict=True)
        ]

    @property
    def has_ended(self) -> bool:
        """Whether everything was told of every run."""
        return all(one.has_ended for one in self._runs)

    @property
    def is_behind(self) -> bool:
        """Whether more could be sent at once."""
        return any(one.is_behind for one in self._runs)

    async def next_batch(self) -> list[bytes]:
        """What is to be sent now, each message with the vector of all numbers as its id."""
        batch = []
        for one in self._runs:
            if one.has_ended:
                continue
            pending = [] if one.needs_snapshot else await _following(self._watcher, one.feed, one.number)
            for kind, data in one.messages(pending):
                batch.append(_message(kind, data, self._id))
        return batch

    @property
    def _id(self) -> str:
        return ".".join(str(one.number or 0) for one in self._runs)


class _OfRun:
    """What one stream has sent of one run."""

    def __init__(self, feed: Feed, number: int | None, *, with_frames: bool) -> None:
        self.feed = feed
        self.with_frames = with_frames
        self.has_ended = False
        self._seen = number
        self._waiting: object = None
        self._begun: set[str] = set()

    @property
    def number(self) -> int:
        """The number of the last event that was told of, or left out."""
        return self._seen or 0

    @property
    def needs_snapshot(self) -> bool:
        """Whether to begin with how things stand: nothing is known, something else is, or too much was missed."""
        return self._seen is None or self._seen > self.feed.newest or self.feed.newest - self._seen > FAR_BEHIND

    @property
    def is_behind(self) -> bool:
        """Whether more is known than was told."""
        return not self.has_ended and self.number < self.feed.newest

    def messages(self, pending: Sequence[Happening]) -> Iterator[tuple[str, str]]:
        """Tell what is to be told now, as (kind, JSON); at each message `number` is that of its event."""
        standing = self.feed.standing
        if standing is None:
            self.has_ended = True
            yield "failed", self._told({"status": "deleted", "message": DELETED})
            return
        if self.needs_snapshot:
            yield self._snapshot(standing)
        for one in self._thinned(pending):
            self._seen = one.number
            yield self._message(one)
        if pending:
            self._seen = pending[-1].number
        waiting = (standing.ahead, standing.worker)
        if waiting != self._waiting and not (standing.has_ended or self.has_ended):
            self._waiting = waiting
            yield "queue", self._told({"ahead": standing.ahead, "worker": standing.worker})

    def _snapshot(self, standing: Standing) -> tuple[str, str]:
        # The event that ends a run follows its snapshot, with a number of its own.
        self._seen = self.feed.newest - (1 if standing.has_ended and self.feed.newest else 0)
        self.has_ended = standing.has_ended and not self.feed.newest  # ended by hand: nothing will follow
        self._begun.update(self.feed.latest)
        self._waiting = (standing.ahead, standing.worker)
        latest = {name: frame.told | {"number": frame.number} for name, frame in self.feed.latest.items()}
        how = {name: getattr(standing, name) for name in ("status", "reason", "ahead", "worker")}
        return "snapshot", self._told(how | {"number": self._seen, "latest": latest})

    def _thinned(self, pending: Sequence[Happening]) -> Iterator[Happening]:
        """Leave out the frames that a newer one of the same learner follows; the first of each stays."""
        newest = {one.learner: one.number for one in pending if one.kind == "frame"}
        for one in pending:
            is_first = one.kind == "frame" and one.learner not in self._begun
            if one.kind != "frame" or one.number == newest[one.learner] or is_first:
                self._begun.add(str(one.learner))
                yield one

    def _message(self, one: Happening) -> tuple[str, str]:
        self.has_ended = one.is_last
        if one.kind == "frame" and not self.with_frames:
            return "progress", one.progress
        return one.kind, one.text

    def _told(self, data: dict[str, Any]) -> str:
        return json.dumps({"run_id": self.feed.run_id} | data, separators=(",", ":"))


async def _following(watcher: Watcher, feed: Feed, number: int) -> Sequence[Happening]:
    """The events of a run after `number`, as many as are at hand."""
    kept = feed.after(number)
    if kept is not None:
        return kept
    # The table may know more than the feed does yet: a stream that ran ahead of its feed would never wait for it.
    return [one for one in await watcher.events_after(feed.run_id, number) if one.number <= feed.newest]


async def _comes(news: asyncio.Event) -> bool:
    """Wait for news; False when none has come for the time of a keep-alive."""
    with suppress(TimeoutError):
        return await asyncio.wait_for(news.wait(), KEEP_ALIVE_AFTER_S)
    return False


def _message(kind: str, data: str, number: str) -> bytes:
    """A server-sent event; JSON as we write it has no line breaks."""
    return f"event: {kind}\nid: {number}\ndata: {data}\n\n".encode()
