"""Bells between the processes of one machine: who stored something rings, who waits for it looks at once.

A bell is a datagram to a port of this machine that its owner has written beside the database. It carries nothing and
promises nothing: one that is not heard (the owner is elsewhere, or gone) costs the time until the next regular look.
"""

import asyncio
import contextlib
import socket
import threading
from pathlib import Path

HERE = "127.0.0.1"
RING = b"irlfr"
SUFFIX = ".bell"


class Bell:
    """A bell of one's own, under a name that nobody else has at the time. To be waited for in one event loop."""

    def __init__(self, folder: Path, name: str) -> None:
        self._socket = open_bell(folder, name)
        self._file, self._port = folder / f"{name}{SUFFIX}", self._socket.getsockname()[1]
        self._socket.setblocking(False)

    async def wait(self) -> None:
        """Wait until it rings, if it has not rung since the last time."""
        await asyncio.get_running_loop().sock_recv(self._socket, len(RING))
        with contextlib.suppress(BlockingIOError):
            while True:
                self._socket.recv(len(RING))

    def close(self) -> None:
        """Take the bell down, unless a successor has put up another."""
        self._socket.close()
        with contextlib.suppress(OSError):
            if self._file.read_text(encoding="ascii") == str(self._port):
                self._file.unlink()


class RungEvent:
    """The same for a thread: a bell that sets an event."""

    def __init__(self, folder: Path, name: str) -> None:
        self._socket = open_bell(folder, name)
        self._event = threading.Event()
        threading.Thread(target=self._listen, name="bell", daemon=True).start()

    def wait(self, timeout_s: float) -> None:
        """Wait until it rings, if it has not rung since the last time, but no longer than so."""
        self._event.wait(timeout_s)
        self._event.clear()

    def _listen(self) -> None:
        while True:
            self._socket.recv(len(RING))  # whatever it carries, were it nothing
            self._event.set()


class Ringer:
    """Rings the bells of others."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setblocking(False)

    def ring(self, pattern: str) -> None:
        """Ring every bell whose name fits. Whoever rings need not know whether anybody hears it."""
        for file in self._folder.glob(f"{pattern}{SUFFIX}"):
            with contextlib.suppress(OSError, ValueError, OverflowError):  # no port of ours
                self._socket.sendto(RING, (HERE, int(file.read_text(encoding="ascii"))))

    def close(self) -> None:
        """Let go of the socket."""
        self._socket.close()


def open_bell(folder: Path, name: str) -> socket.socket:
    """Put up a bell: a port of this machine alone, written down where ringers find it."""
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    made.bind((HERE, 0))
    draft = folder / f"{name}{SUFFIX}.new"
    draft.write_text(str(made.getsockname()[1]), encoding="ascii")
    draft.replace(folder / f"{name}{SUFFIX}")
    return made
