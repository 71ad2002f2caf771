"""What was found out about learners that have finished: it never changes, so it is worked out once, for all who ask.

The last answers are kept in memory, as long as the app runs. Who asks for one that is being worked out waits with the
others; where the one who began it loses interest (a newer question of the same kind), the next of them takes over.
"""

import asyncio
import contextlib
from collections import OrderedDict
from collections.abc import Awaitable, Callable
from typing import Any, Final, TypeAlias

from app.db import Database
from app.kit.companion import Asker, Line, Superseded

Answer: TypeAlias = dict[str, Any]
Work: TypeAlias = Callable[[Line], Awaitable[Answer]]

MOST_KEPT: Final = 64


class Answers:
    """The answers of one app, by kind of question, run and learner."""

    def __init__(self, database: Database) -> None:
        self.database = database
        self._kept: OrderedDict[tuple[str, ...], Answer] = OrderedDict()
        self._coming: dict[tuple[str, ...], asyncio.Task[Answer]] = {}

    async def find(self, asker: Asker, kind: str, *about: str, work: Work) -> Answer:
        """Return the answer, by `work` where nobody has asked before. Raises what the work raises."""
        key = (kind, *about)
        while key not in self._kept:
            is_ours = key not in self._coming
            if is_ours:
                self._begin(key, work, asker.line(kind))
            try:
                return await asyncio.shield(self._coming[key])
            except Superseded:
                if is_ours:
                    raise
        self._kept.move_to_end(key)
        return self._kept[key]

    async def close(self) -> None:
        """Let go of what is still being worked out."""
        for task in list(self._coming.values()):
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError, Exception):
                await task

    def _begin(self, key: tuple[str, ...], work: Work, line: Line) -> None:
        async def find_out() -> Answer:
            try:
                found = await work(line)
            finally:
                del self._coming[key]
            self._keep(key, found)
            return found

        self._coming[key] = asyncio.create_task(find_out())

    def _keep(self, key: tuple[str, ...], found: Answer) -> None:
        self._kept[key] = found
        if len(self._kept) > MOST_KEPT:
            self._kept.popitem(last=False)
