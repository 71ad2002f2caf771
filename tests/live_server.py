"""The real server, started as people start it, on a folder of its own."""

import contextlib
import http.client
import os
import signal
import socket
import sqlite3
import subprocess
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
READY_WITHIN_S = 60.0


class LiveServer:
    """`irlfr serve` with its worker, on a port chosen beforehand."""

    def __init__(self, folder: Path, settings: Mapping[str, str] | None = None) -> None:
        self.folder = folder
        self.settings = settings or {}
        self.port = free_port()
        self.address = f"http://127.0.0.1:{self.port}"
        self.database = folder / "irlfr.sqlite3"
        self.log = folder / "server.log"
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Start it and wait until database and worker answer."""
        environment = os.environ | {
            "IRLFR_DATABASE_URL": f"sqlite:///{self.database}",
            "IRLFR_HOST": "127.0.0.1",
            "IRLFR_PORT": str(self.port),
            "PYTHONPATH": str(ROOT),
            **self.settings,
        }
        with self.log.open("ab") as log:
            command = [sys.executable, "-m", "app.cli", "serve"]
            self._process = subprocess.Popen(
                command, cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log
            )
        deadline = time.monotonic() + READY_WITHIN_S
        while not self._is_ready():
            if self._process.poll() is not None or time.monotonic() > deadline:
                self.kill()
                raise RuntimeError(f"the server did not become ready:\n{self.log.read_text()[-4000:]}")
            time.sleep(0.1)

    def stop(self) -> None:
        """Stop it as Ctrl-C does."""
        if self._process is None:
            return
        self._process.terminate()
        try:
            self._process.wait(15)
        except subprocess.TimeoutExpired:
            self.kill()

    def kill(self) -> None:
        """Kill the web process; nothing of it can tidy up."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()

    def kill_worker(self) -> int:
        """Kill the worker process; return its number."""
        worker = self.worker_pid()
        os.kill(worker, signal.SIGKILL)
        return worker

    def worker_pid(self) -> int:
        """The worker: the child of the web process whose command line says so."""
        if self._process is None:
            raise RuntimeError("the server was not started")
        for entry in Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            with contextlib.suppress(OSError):  # it ended while we looked
                parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
                if parent == self._process.pid and b"worker" in (entry / "cmdline").read_bytes().split(b"\0"):
                    return int(entry.name)
        raise RuntimeError("the server has no worker")

    def lost_files(self) -> list[str]:
        """Database files that the web process still holds although they were deleted: what it writes there is lost."""
        if self._process is None:
            return []
        names = []
        for descriptor in Path(f"/proc/{self._process.pid}/fd").iterdir():
            with contextlib.suppress(OSError):  # closed while we looked
                names.append(str(descriptor.readlink()))
        return [name for name in names if name.startswith(str(self.database)) and name.endswith("(deleted)")]

    def ask_database(self, query: str, *values: object) -> list[tuple[Any, ...]]:
        """Look into the database from outside."""
        with contextlib.closing(sqlite3.connect(f"file:{self.database}?mode=ro", uri=True, timeout=30)) as connection:
            return connection.execute(query, values).fetchall()

    def _is_ready(self) -> bool:
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=5)
        try:
            connection.request("GET", "/readyz")
            return connection.getresponse().status == 200
        except OSError:
            return False
        finally:
            connection.close()


def free_port() -> int:
    """A port that nobody listens on just now."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port
