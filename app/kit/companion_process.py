"""One companion process (`companion.py`), seen from the process that started it."""

import contextlib
import os
import pickle
import signal
import subprocess
import sys
import threading
from collections.abc import Mapping
from typing import Any

OVER_ITS_LIMIT = -signal.SIGPROF if hasattr(signal, "SIGPROF") else None
"""The exit code of one that has computed for longer than it may. Windows cannot tell: there only the clock counts."""


class CompanionError(Exception):
    """A call that was not answered."""


class Overdue(CompanionError):
    """It computed for too long."""


class Died(CompanionError):
    """The process died, or could not be started."""


class Process:
    """One companion process, seen from here."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        self._is_overdue = False
        command, around = [sys.executable, "-m", "app.kit.companion_child"], os.environ | dict(environment)
        try:
            self._running = subprocess.Popen(  # noqa: S603 - our own command
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=around
            )
        except OSError as error:
            raise Died(str(error)) from error

    @property
    def is_running(self) -> bool:
        """Whether it is still there: the system may have ended it while nobody asked."""
        return self._running.poll() is None

    def ask(self, call: object, *, limit_s: float, hangs_after_s: float) -> tuple[bool, Any]:
        """Return its answer. Raises Overdue or Died, after which it is of no more use.

        It may compute for `limit_s`, however long that takes on a busy machine, and take `hangs_after_s` by the clock.
        """
        watch = threading.Timer(hangs_after_s, self._give_up)
        watch.daemon = True
        watch.start()
        try:
            answer: tuple[bool, Any] = self._exchange(limit_s, pickle.dumps(call))
        except (OSError, EOFError, pickle.UnpicklingError) as error:
            code = self._running.wait()
            is_overdue = self._is_overdue or code == OVER_ITS_LIMIT
            raise (Overdue if is_overdue else Died)(f"exit code {code}") from error
        finally:
            watch.cancel()
        return answer

    def _exchange(self, limit_s: float, call: bytes) -> Any:  # noqa: ANN401 - see companion_child
        there, back = self._running.stdin, self._running.stdout
        assert there is not None  # noqa: S101 - for the type checker
        assert back is not None  # noqa: S101 - as above
        pickle.dump((limit_s, call), there)
        there.flush()
        return pickle.loads(pickle.load(back))  # noqa: S301 - from our own child

    def _give_up(self) -> None:
        self._is_overdue = True
        self.kill()

    def kill(self) -> None:
        """End it at once: it keeps nothing that could be lost."""
        self._running.kill()

    def end(self) -> None:
        """End it and let go of its pipes."""
        self.kill()
        self._running.wait()
        for pipe in (self._running.stdin, self._running.stdout):
            with contextlib.suppress(OSError):
                if pipe is not None:
                    pipe.close()
