"""The web: recording a demonstration, against a bare one-row insert through the same writer."""

import http.client
import json
import os
import socket
import subprocess
import sys
import tempfile
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from bench.load import Load, post_for
from bench.measure import Figure, at_least, at_most
from irl_core import World, draw_playable_world

N_CONNECTIONS = 32
N_PAIRS = 7
SECONDS_PER_SIDE = 2.0
READY_WITHIN_S = 60.0


def measure() -> Iterator[Figure]:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with _bare_server(folder) as bare, _full_server(folder) as full:
            pairs = _measure_pairs(bare, full)
    reference = f"bench/bare.py, {max(bare.rate for bare, _ in pairs):.0f}/s"
    title = f"recording a demonstration, {N_CONNECTIONS} connections"
    rates = [full.rate / bare.rate for bare, full in pairs]
    tails = [full.p99_ms / bare.p99_ms for bare, full in pairs]
    yield at_least(f"{title}: rate", rates, target=0.5, unit="×", reference=reference)
    yield at_most(f"{title}: p99", tails, target=2, unit="×", reference=reference)
    errors = [float(full.n_errors + bare.n_errors) for bare, full in pairs]
    yield at_most(f"{title}: errors", [sum(errors)], target=0, unit="", reference=reference)


def _measure_pairs(bare: int, full: int) -> list[tuple[Load, Load]]:
    world, cookies = _prepare(full)
    attempt = {"actions": _shortest_path(world), "ending": "goal"}
    attempt["step_ms"] = [250.0] * len(attempt["actions"])

    def body() -> bytes:
        return json.dumps(attempt | {"id": str(uuid.uuid4())}).encode()

    path = f"/api/v1/worlds/{world['id']}/demonstrations"
    nobody = [""] * N_CONNECTIONS
    post_for(0.5, port=bare, path="/bare", body=lambda: b"{}", cookies=nobody)  # the first ones pay for imports
    post_for(0.5, port=full, path=path, body=body, cookies=cookies)
    return [
        (
            post_for(SECONDS_PER_SIDE, port=bare, path="/bare", body=lambda: b"{}", cookies=nobody),
            post_for(SECONDS_PER_SIDE, port=full, path=path, body=body, cookies=cookies),
        )
        for _ in range(N_PAIRS)
    ]


def _prepare(port: int) -> tuple[dict[str, Any], list[str]]:
    """A world, and a visitor for each connection."""
    spec = json.dumps({"seed": draw_playable_world(5).seed})
    cookies = []
    for _ in range(N_CONNECTIONS):
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=30)
        connection.request("POST", "/api/v1/worlds", spec, {"Content-Type": "application/json"})
        answer = connection.getresponse()
        world = json.load(answer)
        cookies.append((answer.getheader("Set-Cookie") or "").partition(";")[0])
        connection.close()
    return world, cookies


def _shortest_path(world: dict[str, Any]) -> list[int]:
    """Right, then down: a world of the benchmark has no walls."""
    known = World.from_json(world)
    return [1] * (known.cols - 1) + [2] * (known.rows - 1)


@contextmanager
def _bare_server(folder: Path) -> Iterator[int]:
    port = _free_port()
    with _started([sys.executable, "-m", "bench.bare", str(port), str(folder)], port, {}):
        yield port


@contextmanager
def _full_server(folder: Path) -> Iterator[int]:
    port = _free_port()
    settings = {"IRLFR_DATABASE_URL": f"sqlite:///{folder / 'full.sqlite3'}", "IRLFR_PORT": str(port)}
    with _started([sys.executable, "-m", "app.cli", "serve"], port, settings):
        yield port


@contextmanager
def _started(command: list[str], port: int, settings: dict[str, str]) -> Iterator[None]:
    process = subprocess.Popen(command, env=os.environ | settings, stdout=subprocess.DEVNULL)
    try:
        _wait_until_ready(process, port)
        yield
    finally:
        process.terminate()
        process.wait(30)


def _wait_until_ready(process: subprocess.Popen[bytes], port: int) -> None:
    deadline = time.monotonic() + READY_WITHIN_S
    while time.monotonic() < deadline and process.poll() is None:
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=5)
        try:
            connection.request("GET", "/readyz")
            if connection.getresponse().status == 200:
                return
        except OSError:
            pass  # not listening yet
        finally:
            connection.close()
        time.sleep(0.1)
    raise RuntimeError("a server of the benchmark did not become ready")


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port
