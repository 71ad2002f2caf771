"""Learn: a hundred streams watch four runs: what each was sent, and what a player elsewhere feels of it."""

import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from playwright.sync_api import Browser

from bench.learn_watchers import N_STREAMS_EACH, N_VISITORS
from bench.measure import Figure, at_most
from bench.play import FRAME_MS, Presses, a_server, presses_under
from tests.live_server import LiveServer

SIZE = 7
#: A round has ended long before; what has not is an error.
LAST_ROUND_WITHIN_S = 900
MOST_SLOWER = 1.25


def measure(browser: Browser) -> Iterator[Figure]:
    with tempfile.TemporaryDirectory() as name, a_server(Path(name), {"IRLFR_WORKERS": str(N_VISITORS)}) as server:
        alone = presses_under(browser, server, SIZE)
        watched, found = _press_while_watched(browser, server)
    yield from _streams(found)
    yield from _keys(alone, watched)


def _press_while_watched(browser: Browser, server: LiveServer) -> tuple[Presses, dict[str, int]]:
    command = [sys.executable, "-m", "bench.learn_watchers", server.address]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as watchers:
        try:
            presses = presses_under(browser, server, SIZE)
            printed, _ = watchers.communicate(timeout=LAST_ROUND_WITHIN_S)
        except BaseException:
            watchers.kill()
            raise
    if watchers.returncode:
        raise RuntimeError("the streams of the benchmark could not be read")
    found: dict[str, int] = json.loads(printed)
    return presses, found


def _streams(found: dict[str, int]) -> Iterator[Figure]:
    title = f"{N_VISITORS * N_STREAMS_EACH} streams, {N_VISITORS} runs going"
    sent = f"{found['n_rounds']} rounds, {found['n_frames'] / found['n_streams']:.0f} frames a stream"
    for name, words in {
        "without_last_frame": "without the last frame of a learner",
        "without_end": "without the end of the run",
        "doubled": "sent an event twice",
        "out_of_order": "sent one out of order",
    }.items():
        yield at_most(f"{title}: {words}", [found[name]], target=0, unit="", reference=sent)


def _keys(alone: Presses, watched: Presses) -> Iterator[Figure]:
    title = f"key to frame, {SIZE}×{SIZE}, with {N_VISITORS * N_STREAMS_EACH} streams and {N_VISITORS} runs"
    ratio, later = (watched.percentile(0.5) / alone.percentile(0.5), watched.percentile(0.99) - alone.percentile(0.99))
    yield at_most(f"{title}: median", [ratio], target=MOST_SLOWER, unit="×", reference=_beside(alone, watched, 0.5))
    name = f"{title}: p99, how much later"
    yield at_most(name, [later], target=FRAME_MS, unit="ms", reference=_beside(alone, watched, 0.99))


def _beside(alone: Presses, watched: Presses, share: float) -> str:
    return f"{watched.percentile(share):.1f} ms, without them {alone.percentile(share):.1f} ms"
