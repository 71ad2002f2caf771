"""A process beside this one that does short calculations which somebody waits for.

It is a fresh interpreter (never a fork), started when it is first needed or by `wake`, and warmed up before its first
call; this process never loads what it loads. One call at a time: each of those who ask has at most one call of a kind
waiting, a newer one takes its place, and they take turns. A call that computes for too long (by the processor's time:
a busy machine is no reason), or that hangs, costs the process its life; then, and when it dies of itself, the one who
asked is told and it is started anew. It ends when this process does.
"""

import asyncio
import logging
import threading
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Any, TypeVar, TypeVarTuple
from weakref import WeakValueDictionary

from app.kit.companion_process import CompanionError, Died, Process

logger = logging.getLogger(__name__)
T = TypeVar("T")
Arguments = TypeVarTuple("Arguments")

LIMIT_S = 10.0
"""The longest that a call may compute, in time of the processor."""
HANGS_AFTER_S = 120.0
"""The longest that a call may take by the clock."""
WARM_UP_LIMIT_S = 600.0
"""The longest that warming up may take, by either: on a fresh installation everything has to be compiled."""
PATIENCE_S = 30.0
"""The longest that somebody waits for an answer, the wait for their turn included."""
CLOSE_WITHIN_S = 2.0


class Superseded(CompanionError):
    """A newer call of the same kind took its place."""


class Busy(CompanionError):
    """Its turn did not come in time."""


class Failed(CompanionError):
    """The function raised what nobody expected; the log of the companion has the details."""


@dataclass(eq=False, frozen=True, slots=True)
class _Call:
    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    answer: Future[Any] = field(default_factory=Future)


class Companion:
    """The companion of one app. `expected` are the errors of a call that are handed on as they are."""

    def __init__(
        self,
        *,
        warm_up: Callable[[], object],
        expected: tuple[type[Exception], ...],
        environment: Mapping[str, str],
        limit_s: float = LIMIT_S,
        hangs_after_s: float = HANGS_AFTER_S,
    ) -> None:
        self._warm_up = warm_up
        self._expected = expected
        self._environment = environment
        self._limit_s = limit_s
        self._hangs_after_s = hangs_after_s
        self._changed = threading.Condition()  # guards what follows
        self._waiting: dict[str, dict[str, _Call]] = {}  # by who asks and kind; in the order of their turns
        self._lines: WeakValueDictionary[tuple[str, str], Line] = WeakValueDictionary()
        self._process: Process | None = None
        self._is_wanted = False
        self._is_closed = False
        self._keeper = threading.Thread(target=self._keep, name="companion", daemon=True)
        self._keeper.start()

    def wake(self) -> None:
        """Start the process and warm it up, if it is not running; returns at once."""
        with self._changed:
            self._is_wanted = True
            self._changed.notify()

    def line(self, who: str, kind: str) -> "Line":
        """Begin to ask for something, in place of whatever `who` is still asking for of this kind."""
        line = Line(self, who, kind)
        with self._changed:
            self._lines[who, kind] = line
            self._supersede(who, kind)
        return line

    def close(self) -> None:
        """End the process at once; who is still waiting is told."""
        with self._changed:
            self._is_closed = True
            self._changed.notify()
            process = self._process
        if process is not None:
            process.kill()
        self._keeper.join(CLOSE_WITHIN_S)

    def submit(self, line: "Line", function: Callable[..., T], arguments: tuple[Any, ...]) -> Future[T]:
        """Let a call wait for its turn."""
        call = _Call(function, arguments)
        with self._changed:
            if self._is_closed:
                call.answer.set_exception(Died("the app is closing"))
            elif self._lines.get((line.who, line.kind)) is not line:
                call.answer.set_exception(Superseded())
            else:
                self._waiting.setdefault(line.who, {})[line.kind] = call
                self._changed.notify()
        return call.answer

    def _supersede(self, who: str, kind: str) -> None:
        older = self._waiting.get(who, {}).pop(kind, None)
        if older is not None and older.answer.set_running_or_notify_cancel():
            older.answer.set_exception(Superseded())

    def _keep(self) -> None:
        """Do the calls, until the app closes."""
        while self._wait_for_work():
            try:
                process = self._awake()
            except Exception as error:  # noqa: BLE001 - the keeper must not die of it
                self._refuse_all(error)
                continue
            call = self._next()
            if call is not None:
                self._do(process, call)
        self._refuse_all(Died("the app is closing"))
        self._end_process()

    def _wait_for_work(self) -> bool:
        with self._changed:
            self._changed.wait_for(lambda: self._is_closed or self._waiting or self._is_missing)
            return not self._is_closed

    @property
    def _is_missing(self) -> bool:
        return self._is_wanted and self._process is None

    def _awake(self) -> "Process":
        """Return the running process, after starting it and warming it up if need be."""
        if self._process is not None and self._process.is_running:
            return self._process
        self._end_process()
        self._is_wanted = False  # one that cannot start is tried again only when it is needed again
        process = Process(self._environment)
        with self._changed:
            self._process = process
            if self._is_closed:
                process.kill()
        self._ask(process, _Call(self._warm_up, ()), limit_s=WARM_UP_LIMIT_S, hangs_after_s=WARM_UP_LIMIT_S)
        return process

    def _next(self) -> _Call | None:
        """Take the call whose turn it is; whoever has another waiting goes to the end of the queue."""
        with self._changed:
            if not self._waiting:
                return None
            who = next(iter(self._waiting))
            calls = self._waiting.pop(who)
            if not calls:
                return None
            call = calls.pop(next(iter(calls)))
            if calls:
                self._waiting[who] = calls
            return call

    def _do(self, process: "Process", call: _Call) -> None:
        if not call.answer.set_running_or_notify_cancel():
            return
        try:
            answer = self._ask(process, call, limit_s=self._limit_s, hangs_after_s=self._hangs_after_s)
        except Exception as error:  # noqa: BLE001 - it belongs to the one who asked
            self._is_wanted = True
            call.answer.set_exception(error)
        else:
            call.answer.set_result(answer)

    def _ask(self, process: "Process", call: _Call, *, limit_s: float, hangs_after_s: float) -> Any:  # noqa: ANN401 - whatever the function returns
        """Return what the function returns there, or raise what it raises; a process that failed is let go."""
        try:
            is_value, told = process.ask(
                (call.function, call.arguments, self._expected), limit_s=limit_s, hangs_after_s=hangs_after_s
            )
        except CompanionError as error:
            if not self._is_closed:
                logger.warning("The companion is gone: %s, %s", type(error).__name__, error)
            self._end_process()
            raise
        if is_value:
            return told
        raise Failed(told) if isinstance(told, str) else told

    def _refuse_all(self, error: Exception) -> None:
        with self._changed:
            waiting = [call for calls in self._waiting.values() for call in calls.values()]
            self._waiting.clear()
        for call in waiting:
            if call.answer.set_running_or_notify_cancel():
                call.answer.set_exception(error)

    def _end_process(self) -> None:
        with self._changed:
            process, self._process = self._process, None
        if process is not None:
            process.end()


@dataclass(frozen=True, slots=True)
class Asker:
    """Somebody with questions for the companion, who takes turns with the others.

    Several may share the turns of one: `among` tells them apart, so that no question takes the place of another's.
    """

    companion: Companion
    who: str
    among: str = ""

    def line(self, kind: str) -> "Line":
        """Begin to ask for something, in place of whatever they are still asking for of this kind."""
        return self.companion.line(self.who, f"{kind} {self.among}".rstrip())


class Line:
    """One question of somebody, in one call or several. It is superseded when they begin another of its kind."""

    def __init__(self, companion: Companion, who: str, kind: str) -> None:
        self.who = who
        self.kind = kind
        self._companion = companion

    async def ask(self, function: Callable[[*Arguments], T], *arguments: *Arguments) -> T:
        """Return what the function returns in the companion. Raises CompanionError, and what the app expects of it."""
        answer = asyncio.wrap_future(self._companion.submit(self, function, arguments))
        try:
            return await asyncio.wait_for(answer, PATIENCE_S)
        except TimeoutError:
            raise Busy from None
