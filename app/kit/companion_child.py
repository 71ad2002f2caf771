"""What the companion process (`companion.py`) does: take calls from standard input, answer on standard output.

A call comes as `(limit_s, bytes)`: how long it may compute, and the pickled `(function, arguments, expected)`. An
answer is the bytes of `(True, value)` or `(False, error)`. Both come from the same program on the same machine, through
a pipe that nobody else holds.
"""

import os
import pickle
import queue
import signal
import sys
import threading
import traceback
from typing import BinaryIO

NICENESS = 5
"""It gives way to the web server, and the workers (10) to it: somebody is waiting for the answer."""


def serve() -> None:
    """Answer calls, one after the other, until standard input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C in a terminal is for the parent, which then goes
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    answers = _take_standard_output()
    calls: queue.SimpleQueue[tuple[float, bytes]] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(calls,), daemon=True).start()
    while True:
        limit_s, call = calls.get()
        _end_after(limit_s)
        answers.write(pickle.dumps(_answer(call)))
        answers.flush()


def _take_standard_output() -> BinaryIO:
    """Keep standard output for answers; what anything prints goes to standard error."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return answers


def _end_after(limit_s: float) -> None:
    """Let the system end this process (SIGPROF) once it has computed for so long, whatever it computes in."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, limit_s)


def _listen(calls: queue.SimpleQueue[tuple[float, bytes]]) -> None:
    """Read ahead, so that the end of the parent is noticed in the middle of a call, too."""
    try:
        while True:
            calls.put(pickle.load(sys.stdin.buffer))  # noqa: S301 - from our parent
    except (EOFError, OSError, pickle.UnpicklingError):
        os._exit(0)


def _answer(call: bytes) -> bytes:
    """Do what is asked; an error that nobody expects is told in the log, and by its name alone to the parent."""
    expected: tuple[type[Exception], ...] = ()
    try:
        function, arguments, expected = pickle.loads(call)  # noqa: S301 - from our parent
        return pickle.dumps((True, function(*arguments)))
    except Exception as error:  # noqa: BLE001 - whatever it is, the next call is answered
        if isinstance(error, expected):
            return pickle.dumps((False, error))
        traceback.print_exc()
        return pickle.dumps((False, type(error).__name__))


if __name__ == "__main__":
    serve()
