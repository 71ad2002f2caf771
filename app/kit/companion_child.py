"""What the companion process (`companion.py`) does: take calls from standard input, answer on standard output.

A call is the pickled bytes of `(function, arguments, expected)`, an answer the bytes of `(True, value)` or `(False,
error)`. Both come from the same program on the same machine, through a pipe that nobody else holds.
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
    calls: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(calls,), daemon=True).start()
    while True:
        answers.write(pickle.dumps(_answer(calls.get())))
        answers.flush()


def _take_standard_output() -> BinaryIO:
    """Keep standard output for answers; what anything prints goes to standard error."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return answers


def _listen(calls: queue.SimpleQueue[bytes]) -> None:
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
