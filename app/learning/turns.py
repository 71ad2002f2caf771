"""Turns between the runs of one worker: one computes at a time, and who has had least goes next.

A worker uses one core, and threads that compute in Python only hinder each other. So runs take turns of some tens of
milliseconds: a visitor who comes begins with a little less than those who are there have had, which a run in a small
world never uses up, and from then on all visitors get equal shares. Nobody waits for ever: who has waited long goes
first. What a learner comes to does not depend on turns, only when it comes there.
"""

import threading
import time
from collections import Counter
from types import TracebackType
from typing import Self

HEAD_START_S = 2.0
"""How much computing a newcomer is ahead of those who have had least."""
LONGEST_WAIT_S = 2.0


class Turns:
    """The turns of one worker."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._holder: Turn | None = None
        self._waiting: list[Turn] = []
        self._n_runs: Counter[str] = Counter()
        self._had_s: dict[str, float] = {}

    def join(self, visitor_id: str) -> "Turn":
        """Take part; `with` the turn one computes, and `leave` ends it."""
        with self._changed:
            if not self._n_runs[visitor_id]:
                self._had_s[visitor_id] = max(0.0, min(self._had_s.values(), default=0.0) - HEAD_START_S)
            self._n_runs[visitor_id] += 1
        return Turn(self, visitor_id)

    def leave(self, turn: "Turn") -> None:
        """Take part no more."""
        with self._changed:
            self._n_runs[turn.visitor_id] -= 1
            if not self._n_runs[turn.visitor_id]:
                del self._n_runs[turn.visitor_id], self._had_s[turn.visitor_id]

    def take(self, turn: "Turn") -> None:
        """Wait until it is this one's turn."""
        with self._changed:
            turn.since = time.monotonic()
            self._waiting.append(turn)
            if self._holder is None:
                self._choose()
            self._changed.wait_for(lambda: self._holder is turn)
            turn.since = time.monotonic()

    def pass_on(self, turn: "Turn") -> None:
        """Let the next one compute."""
        with self._changed:
            self._had_s[turn.visitor_id] += time.monotonic() - turn.since
            self._choose()

    def is_anybody_before(self, turn: "Turn") -> bool:
        """Tell whether somebody waits who ought to go before the one whose turn it is."""
        if not self._waiting:
            return False
        with self._changed:
            had_s = self._had_s[turn.visitor_id] + time.monotonic() - turn.since
            return any(self._claim(waiting) < (True, had_s) for waiting in self._waiting)

    def _choose(self) -> None:
        """Decide whose turn it is; chosen here alone, so that no two can disagree."""
        self._holder = min(self._waiting, key=lambda turn: (self._claim(turn), turn.since), default=None)
        if self._holder is not None:
            self._waiting.remove(self._holder)
            self._changed.notify_all()

    def _claim(self, turn: "Turn") -> tuple[bool, float]:
        """The smaller, the sooner: who has waited long, then who has had least."""
        return time.monotonic() - turn.since < LONGEST_WAIT_S, self._had_s[turn.visitor_id]


class Turn:
    """One run's part in the turns."""

    def __init__(self, turns: Turns, visitor_id: str) -> None:
        self._turns = turns
        self.visitor_id = visitor_id
        self.since = 0.0
        """When it began to wait, or to compute."""

    def __enter__(self) -> Self:
        self._turns.take(self)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._turns.pass_on(self)

    def give_way(self) -> None:
        """In the midst of a turn: let those compute who ought to go before."""
        if self._turns.is_anybody_before(self):
            self._turns.pass_on(self)
            self._turns.take(self)

    def leave(self) -> None:
        """Take part no more."""
        self._turns.leave(self)
