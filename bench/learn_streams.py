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
LAST_ROUND_WITHIN_S = 300
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
    for share, word in ((0.5, "median"), (0.99, "p99")):
        before, after = alone.percentile(share), watched.percentile(share)
        reference = f"{after:.1f} ms, without them {before:.1f} ms"
        yield at_most(f"{title}: {word}", [after / before], target=MOST_SLOWER, unit="×", reference=reference)
        yield at_most(
            f"{title}: {word}, how much later", [after - before], target=FRAME_MS, unit="ms", reference=reference
        )
