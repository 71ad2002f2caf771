"""Keeps the workers of `irlfr serve` running: one that dies is started again, and none outlives its parent."""

import logging
import os
import subprocess
import sys
import threading
import time

from app.config import Settings

logger = logging.getLogger(__name__)

SHORTEST_PAUSE_S = 0.5
LONGEST_PAUSE_S = 30.0
SOUND_AFTER_S = 5.0
"""A worker that has lived this long can start: its death was an accident, and the pauses begin anew."""
STOP_WITHIN_S = 2.0

ONE_THREAD_EACH = {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL")}
"""A worker uses one core: BLAS threads of several workers would fight over them."""


class Supervisor:
    """The workers of one web server. Each holds the reading end of a pipe; when this process dies, so do they."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._stopping = threading.Event()
        self._processes: dict[str, subprocess.Popen[bytes]] = {}
        self._threads = [
            threading.Thread(target=self._keep_running, args=(f"worker-{number}",), daemon=True)
            for number in range(1, settings.workers + 1)
        ]

    def start(self) -> None:
        """Start the workers and return."""
        for thread in self._threads:
            thread.start()

    def stop(self) -> None:
        """Stop the workers and wait for them."""
        self._stopping.set()
        processes = list(self._processes.values())
        for process in processes:
            _close_pipe(process)
        for process in processes:
            _wait_or_kill(process)

    def _keep_running(self, name: str) -> None:
        pause_s = SHORTEST_PAUSE_S
        while not self._stopping.is_set():
            process = self._start(name)
            self._processes[name] = process
            started = time.monotonic()
            code = process.wait()
            _close_pipe(process)
            if time.monotonic() - started > SOUND_AFTER_S:
                pause_s = SHORTEST_PAUSE_S
            if self._stopping.is_set():
                return
            logger.warning("%s ended with code %s; starting it again in %.1f s", name, code, pause_s)
            self._stopping.wait(pause_s)
            pause_s = min(2 * pause_s, LONGEST_PAUSE_S)

    def _start(self, name: str) -> subprocess.Popen[bytes]:
        environment = os.environ | ONE_THREAD_EACH | {"IRLFR_DATABASE_URL": self._settings.database_url}
        command = [sys.executable, "-m", "app.cli", "worker", "--name", name, "--follow-stdin"]
        return subprocess.Popen(command, stdin=subprocess.PIPE, env=environment)  # noqa: S603 - our own command


def _close_pipe(process: subprocess.Popen[bytes]) -> None:
    if process.stdin is not None:
        process.stdin.close()


def _wait_or_kill(process: subprocess.Popen[bytes]) -> None:
    try:
        process.wait(STOP_WITHIN_S)
    except subprocess.TimeoutExpired:
        process.kill()
