"""One thread that writes: each piece of work in a savepoint of its own, many pieces in one durable commit.

A commit that survives a power cut waits for the disk (`synchronous=FULL`). Paying for that once for all the work that
arrived in the meantime keeps the guarantee and gives several times the rate of one commit for each piece. The caller is
answered only after the commit, so what was acknowledged is on the disk. A piece that fails is rolled back alone.
"""

import queue
import threading
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Any, TypeVar

from sqlalchemy import Connection, Engine
from sqlalchemy.orm import Session

T = TypeVar("T")

GROUP_SIZE = 64
"""How many pieces of work at most share a commit: bounds how long the first of them waits for the last."""


class WriterIsBusy(Exception):
    """The queue is full or closed: try again a little later."""


@dataclass(frozen=True, slots=True)
class _Item:
    work: Callable[[Session], Any]
    future: Future[Any] = field(default_factory=Future)


class Writer:
    """Runs work on the writing connection, in the order in which it came."""

    def __init__(self, engine: Engine, *, queue_length: int) -> None:
        self._engine = engine
        self._queue: queue.Queue[_Item | None] = queue.Queue(maxsize=queue_length)
        self._is_closed = False
        self._thread = threading.Thread(target=self._loop, name="writer", daemon=True)
        self._thread.start()

    def run(self, work: Callable[[Session], T]) -> T:
        """Do `work(session)`, wait until it is on the disk, and return what it returned or raise what it raised."""
        item = _Item(work)
        if self._is_closed:
            raise WriterIsBusy
        try:
            self._queue.put_nowait(item)
        except queue.Full:
            raise WriterIsBusy from None
        result: T = item.future.result()
        return result

    def close(self) -> None:
        """Finish what has been accepted, then stop."""
        if not self._is_closed:
            self._is_closed = True
            self._queue.put(None)
            self._thread.join()

    def _loop(self) -> None:
        while (first := self._queue.get()) is not None:
            group, is_last = self._gather(first)
            self._commit(group)
            if is_last:
                break
        self._refuse_the_rest()

    def _gather(self, first: _Item) -> tuple[list[_Item], bool]:
        """Take what is already waiting; the flag says that the sign to stop was among it."""
        group = [first]
        while len(group) < GROUP_SIZE:
            try:
                item = self._queue.get_nowait()
            except queue.Empty:
                break
            if item is None:
                return group, True
            group.append(item)
        return group, False

    def _commit(self, group: list[_Item]) -> None:
        done: list[tuple[_Item, Any]] = []
        try:
            with self._engine.begin() as connection:
                for item in group:
                    try:
                        done.append((item, _in_savepoint(connection, item.work)))
                    except Exception as error:  # noqa: BLE001 - handed to the caller who asked for this work
                        item.future.set_exception(error)
        except Exception as error:  # noqa: BLE001 - the commit itself failed: nobody may believe they were stored
            for item in group:
                if not item.future.done():
                    item.future.set_exception(error)
            return
        for item, result in done:
            item.future.set_result(result)

    def _refuse_the_rest(self) -> None:
        while True:
            try:
                item = self._queue.get_nowait()
            except queue.Empty:
                return
            if item is not None:
                item.future.set_exception(WriterIsBusy())


def _in_savepoint(connection: Connection, work: Callable[[Session], Any]) -> Any:  # noqa: ANN401 - whatever the work returns
    with (
        Session(connection, join_transaction_mode="create_savepoint", expire_on_commit=False) as session,
        session.begin(),
    ):
        return work(session)
