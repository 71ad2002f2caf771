"""Play: from the key press to the frame that shows it, with and without a network; six large boards; the page's weight.

A press is real input to a real browser on the real server. It counts as shown in the frame whose callbacks see the
agent's box on its way in the direction of the key; its time ends with the task right after that frame. What is pressed
is a random walk at irregular intervals, and the bench knows where it leads: an agent on another square is an error, not
a figure. Every few presses an attempt is given up, so that there is something to send while the network is slow.
"""

import gzip
import random
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, Error, Page, Response, sync_playwright

from bench.measure import Figure, at_most
from tests.browser.conftest import CHROMIUM_FLAGS, find_chromium
from tests.live_server import LiveServer

HERE = Path(__file__).parent
FRAME_MS = 16.7
TWO_FRAMES_MS = 33
N_PRESSES = 300
N_PRESSES_PER_ATTEMPT = 40
LATENCY_MS = 400
SIZES = (7, 100)
#: Seconds between presses: longer than the agent's way, so that the box's next move is the press's own.
INTERVAL_S = (0.11, 0.19)
MOVES = {"ArrowUp": (-1, 0), "ArrowRight": (0, 1), "ArrowDown": (1, 0), "ArrowLeft": (0, -1)}


@dataclass(frozen=True, slots=True)
class Presses:
    """What 300 presses took: milliseconds to the end of the frame, and what Event Timing says of the slowest."""

    frame_ms: list[float]
    n_frames: list[int]
    event_ms: list[float]

    def percentile(self, share: float) -> float:
        return percentile(self.frame_ms, share)


def measure() -> Iterator[Figure]:
    with tempfile.TemporaryDirectory() as name, a_server(Path(name)) as server, a_browser() as browser:
        if browser is None:
            reason = "Chromium cannot be started; name one by E2E_CHROMIUM"
            yield at_most("key to frame", [], target=TWO_FRAMES_MS, unit="ms", reference=reason)
            return
        yield from _measure_load(browser, server)
        yield from _measure_boards(browser, server)
        for size in SIZES:
            yield from _measure_presses(browser, server, size)


def _measure_presses(browser: Browser, server: LiveServer, size: int) -> Iterator[Figure]:
    found = {
        "no delay": presses_under(browser, server, size),
        f"{LATENCY_MS} ms": presses_under(browser, server, size, latency_ms=LATENCY_MS),
        "server stopped": presses_under(browser, server, size, is_server_stopped=True),
    }
    for network, presses in found.items():
        name = f"key to frame, {size}×{size}, {network}"
        event = percentile(presses.event_ms, 0.99)
        slow = f"{sum(n > 1 for n in presses.n_frames)} of {len(presses.n_frames)} after their first frame"
        reference = f"max {max(presses.frame_ms):.0f} ms, {slow}; Event Timing p99 {event:.0f} ms"
        yield at_most(f"{name}: p50", [presses.percentile(0.5)], target=TWO_FRAMES_MS, unit="ms", reference=reference)
        yield at_most(f"{name}: p99", [presses.percentile(0.99)], target=TWO_FRAMES_MS, unit="ms", reference=reference)
    plain = found.pop("no delay").percentile(0.99)
    for network, presses in found.items():
        more = presses.percentile(0.99) - plain
        name = f"key to frame, {size}×{size}, {network}: p99, how much later than with no delay"
        yield at_most(name, [more], target=FRAME_MS, unit="ms", reference=f"no delay: {plain:.1f} ms")


def presses_under(
    browser: Browser, server: LiveServer, size: int, *, latency_ms: int = 0, is_server_stopped: bool = False
) -> Presses:
    """Play at random with so slow a network, or none."""
    with _page(browser, server) as page:
        page.add_init_script(path=HERE / "play_presses.js")
        page.goto(f"/?seed=5&rows={size}&cols={size}")
        page.locator("#board .agent").wait_for()
        page.wait_for_load_state("networkidle")
        if latency_ms:
            _delay(page, latency_ms)
        if is_server_stopped:
            server.stop()
            _check_server_is_gone(page)
        try:
            expected = _walk(page, size)
        finally:
            if is_server_stopped:
                server.start()
        return _read_presses(page, expected)


def _delay(page: Page, latency_ms: int) -> None:
    """Delay every answer, and see for ourselves that one is late."""
    conditions = {"offline": False, "latency": latency_ms, "downloadThroughput": -1, "uploadThroughput": -1}
    session = page.context.new_cdp_session(page)
    session.send("Network.enable")
    session.send("Network.emulateNetworkConditions", conditions)
    took = page.evaluate(
        "async () => { const t = performance.now(); await fetch('/healthz'); return performance.now() - t; }"
    )
    if took < latency_ms:
        raise RuntimeError(f"the network is not as slow as asked for: an answer took {took:.0f} ms, not {latency_ms}")


def _check_server_is_gone(page: Page) -> None:
    if page.evaluate("() => fetch('/healthz').then(() => true, () => false)"):
        raise RuntimeError("the server was stopped, and still it answers")


def _walk(page: Page, size: int) -> list[int]:
    """Press 300 arrows; return the square each must lead to."""
    rng = random.Random(size)
    goal, state, expected = size * size - 1, 0, list[int]()
    while len(expected) < N_PRESSES:
        key, state = rng.choice(list(_ways(state, size, goal)))
        page.keyboard.press(key)
        expected.append(state)
        time.sleep(rng.uniform(*INTERVAL_S))
        if len(expected) % N_PRESSES_PER_ATTEMPT == 0:
            _give_up_and_begin_again(page)
            state = 0
    time.sleep(0.3)
    return expected


def _ways(state: int, size: int, goal: int) -> Iterator[tuple[str, int]]:
    """Keys that lead to another square which is not the goal."""
    row, col = divmod(state, size)
    for key, (down, right) in MOVES.items():
        to = (row + down) * size + col + right
        if 0 <= row + down < size and 0 <= col + right < size and to != goal:
            yield key, to


def _give_up_and_begin_again(page: Page) -> None:
    page.keyboard.press("g")
    page.locator("#now[data-shows=result]").wait_for(state="attached")
    page.keyboard.press("Enter")
    page.locator("#board .agent[data-state='0']").wait_for(state="attached")
    time.sleep(0.3)


def _read_presses(page: Page, expected: list[int]) -> Presses:
    seen: dict[str, Any] = page.evaluate("() => pressesSeen()")
    presses = seen["presses"]
    if len(presses) != len(expected) or any(press["nFrames"] is None for press in presses):
        raise RuntimeError("a press was never shown")
    if any(press["state"] != expected[press["nPressed"] - 1] for press in presses):
        raise RuntimeError("the agent did not go where the keys led")
    # Event Timing is silent about events of less than 16 ms.
    event_ms = [*seen["events"], *[16.0] * (len(presses) - len(seen["events"]))]
    return Presses([press["frameMs"] for press in presses], [press["nFrames"] for press in presses], event_ms)


def _measure_boards(browser: Browser, server: LiveServer) -> Iterator[Figure]:
    with _page(browser, server) as page:
        page.goto("/?seed=5&rows=100&cols=100")
        page.wait_for_load_state("networkidle")
        world = page.evaluate("() => document.getElementById('board').world")
        script = (HERE / "play_boards.js").read_text(encoding="utf-8").partition("\n")[2].rstrip().removesuffix(";")
        found = page.evaluate(script, {"seconds": 10, "world": world})
    if found["nAgents"] != 6 or found["side"] < 300:
        raise RuntimeError(f"these are not six boards of a size to look at: {found['nAgents']}, {found['side']} px")
    work = percentile(found["work"], 0.95)
    reference = f"{len(found['frames'])} frames, boards of {found['side']:.0f} px; work of a frame p95 {work:.1f} ms"
    name = "six boards of 100×100, agents in every frame, heat at 10 Hz: frame p95"
    yield at_most(name, [percentile(found["frames"], 0.95)], target=17, unit="ms", reference=reference)


def _measure_load(browser: Browser, server: LiveServer) -> Iterator[Figure]:
    """What a first visit loads, and when it shows something."""
    visits = [_visit(browser, server) for _ in range(7)]
    weights, paints = [weight for weight, _ in visits], [paint for _, paint in visits]
    yield at_most("play page, all it loads, gzip", weights, target=150, unit="kB", reference="every answer")
    yield at_most(
        "play page, first contentful paint", paints, target=500, unit="ms", reference="empty cache, localhost"
    )


def _visit(browser: Browser, server: LiveServer) -> tuple[float, float]:
    """Return the weight of all that a first visit loads (kB), and when it first shows something (ms)."""
    with _page(browser, server) as page:
        responses: list[Response] = []
        page.on("response", lambda response: responses.append(response))  # noqa: PLW0108 - it takes no built-ins
        page.goto("/?seed=5")
        page.wait_for_load_state("networkidle")
        weight = sum(len(gzip.compress(response.body(), 6)) for response in responses) / 1000
        paint = page.evaluate("() => performance.getEntriesByName('first-contentful-paint')[0].startTime")
    return weight, paint


def percentile(values: list[float], share: float) -> float:
    """Return the smallest value that at least this share does not exceed."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


@contextmanager
def a_server(folder: Path, settings: Mapping[str, str] | None = None) -> Iterator[LiveServer]:
    """The real server, until the end of the block."""
    server = LiveServer(folder, settings)
    server.start()
    try:
        yield server
    finally:
        server.stop()


@contextmanager
def a_browser() -> Iterator[Browser | None]:
    """A real browser, or None where there is none."""
    with sync_playwright() as playwright:
        try:
            browser = playwright.chromium.launch(executable_path=find_chromium(), args=CHROMIUM_FLAGS)
        except Error:
            yield None
            return
        yield browser
        browser.close()


@contextmanager
def _page(browser: Browser, server: LiveServer) -> Iterator[Page]:
    """A page of a visitor of its own, with nothing cached."""
    context = browser.new_context(base_url=server.address, viewport={"width": 1280, "height": 800})
    yield context.new_page()
    context.close()
