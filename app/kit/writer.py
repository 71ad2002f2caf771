"""One thread that writes: each piece of work in a savepoint of its own, many pieces in one durable commit.

A commit that survives a power cut waits for the disk (`synchronous=FULL`). Paying for that once for all the work that
arrived in the meantime keeps the guarantee and gives several times the rate of one commit for each piece. The caller is
answered only after the commit, so what was acknowledged is on the disk. A piece that fails is rolled back alone.

When the file cannot be written (locked, full), everybody who waits is told at once, and until a commit succeeds again
only one piece at a time may try: a crowd that waits for a lock would hold every thread that could still read.
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
    """The queue is full or closed, or the file cannot be written just now: try again a little later."""

    def __init__(self, message: str = "too much is waiting to be written") -> None:
        super().__init__(message)


class TransactionLost(WriterIsBusy):
    """The database gave up the whole transaction in the middle of it, as SQLite does when the disk is full."""


@dataclass(frozen=True, slots=True)
class _Item:
    work: Callable[[Session], Any]
    future: Future[Any] = field(default_factory=Future)


class Writer:
    """Runs work on the writing connection, in the order in which it came."""

    def __init__(self, engine: Engine, *, queue_length: int) -> None:
        self._engine = engine
        self._queue: queue.SimpleQueue[_Item | None] = queue.SimpleQueue()
        self._queue_length = queue_length
        self._admission = threading.Lock()  # guards what follows: nobody is let in behind the sign to stop
        self._n_admitted = 0
        self._is_closed = False
        self._is_stuck = False
        self._thread = threading.Thread(target=self._loop, name="writer", daemon=True)
        self._thread.start()

    def run(self, work: Callable[[Session], T]) -> T:
        """Do `work(session)`, wait until it is on the disk, and return what it returned or raise what it raised."""
        return self.submit(work).result()

    def submit(self, work: Callable[[Session], T]) -> "Future[T]":
        """Queue `work(session)`; the future is done when it is on the disk, and cannot be cancelled."""
        item = _Item(work)
        item.future.set_running_or_notify_cancel()  # whoever stops waiting does not stop the work
        self._admit(item)
        return item.future

    def close(self) -> None:
        """Finish what has been accepted, then stop."""
        with self._admission:
            if not self._is_closed:
                self._is_closed = True
                self._queue.put(None)
        self._thread.join()

    def _admit(self, item: _Item) -> None:
        with self._admission:
            most = 1 if self._is_stuck else self._queue_length
            if self._is_closed or self._n_admitted >= most:
                raise WriterIsBusy
            self._n_admitted += 1
            self._queue.put(item)

    def _loop(self) -> None:
        is_last = False
        while not is_last and (first := self._queue.get()) is not None:
            group, is_last = self._gather(first)
            self._commit(group)

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
                        _check_is_in_transaction(connection, error)
                        self._answer(item, error=error)
        except Exception as error:  # noqa: BLE001 - the commit itself failed: nobody may believe they were stored
            self._is_stuck = True
            self._refuse(group, error)
            return
        self._is_stuck = False
        for item, result in done:
            self._answer(item, result=result)

    def _refuse(self, group: list[_Item], error: Exception) -> None:
        """Tell the group why, and those who came meanwhile to come again."""
        for item in group:
            if not item.future.done():
                self._answer(item, error=error)
        for _ in range(self._queue.qsize()):
            waiting = self._queue.get()
            if waiting is None:
                self._queue.put(None)  # the sign to stop is the last in the queue
            else:
                self._answer(waiting, error=WriterIsBusy())

    def _answer(self, item: _Item, *, result: object = None, error: Exception | None = None) -> None:
        """Give the place in the queue back, then wake the caller, who may come again at once."""
        with self._admission:
            self._n_admitted -= 1
        if error is None:
            item.future.set_result(result)
        else:
            item.future.set_exception(error)


def _check_is_in_transaction(connection: Connection, error: Exception) -> None:
    """Raise if the transaction is gone: what followed would be written outside it, and its commit would do nothing."""
    if not connection.connection.dbapi_connection.in_transaction:  # type: ignore[union-attr]  # SQLite's own connection
        raise TransactionLost(str(error)) from error


def _in_savepoint(connection: Connection, work: Callable[[Session], Any]) -> Any:  # noqa: ANN401 - whatever the work returns
    with (
        Session(connection, join_transaction_mode="create_savepoint", expire_on_commit=False) as session,
        session.begin(),
    ):
        return work(session)
