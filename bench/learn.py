"""Learn: how long a person waits, in a real browser on the real server, and what comes of a hundred who watch.

A wait ends with the task right after the frame that shows what was waited for. Each run is a new visitor's, who has
played three successes and three failures in a 7×7 world and ordered them, by the API. The first time of everything is
not counted: it loads what later ones find there.
"""

import statistics
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, BrowserContext, Page, Response

from bench import learn_streams
from bench.learn_worlds import prepare
from bench.measure import Figure, at_most
from bench.play import a_browser, a_server, percentile
from irl_core import DEFAULT_LEARNERS
from tests.browser import ranking, walk
from tests.live_server import LiveServer

WATCH = Path(__file__).with_name("learn_watch.js")
N_RUNS = 12
N_DROPS = 20
FIRST_FRAME_MS, COMPARISON_MS, REPAINTED_MS, MOST_OVERHEAD = 300, 2000, 150, 3
#: Between two drops: longer than the answer, shorter than a person would take.
INTERVAL_S = 0.5


@dataclass(frozen=True, slots=True)
class Wait:
    """What one press of Learn led to, in milliseconds since it; and what the server says it took."""

    frame: float
    done: float
    comparison: float
    server: float
    compute: float


def measure() -> Iterator[Figure]:
    with tempfile.TemporaryDirectory() as name, a_server(Path(name)) as server, a_browser() as browser:
        if browser is None:
            reason = "Chromium cannot be started; name one by E2E_CHROMIUM"
            yield at_most("pressing Learn", [], target=FIRST_FRAME_MS, unit="ms", reference=reason)
            return
        yield from _measure_learning(browser, server)
        yield from _measure_drops(browser, server)
        yield from learn_streams.measure(browser)


def _measure_learning(browser: Browser, server: LiveServer) -> Iterator[Figure]:
    waits = [_press_learn(browser, server) for _ in range(N_RUNS + 1)][1:]
    title, spread = f"7×7, pressing Learn, {len(DEFAULT_LEARNERS)} learners", _spread
    frame, done = [wait.frame for wait in waits], [wait.done for wait in waits]
    comparison, server_ms = [wait.comparison for wait in waits], [wait.server for wait in waits]
    yield at_most(f"{title}: first frame painted", frame, target=FIRST_FRAME_MS, unit="ms", reference=spread(frame))
    yield at_most(f"{title}: all have learned", done, target=COMPARISON_MS, unit="ms", reference=spread(done))
    name = f"{title}: their comparison painted"
    yield at_most(
        name, comparison, target=COMPARISON_MS, unit="ms", reference=f"followed at once; {spread(comparison)}"
    )
    computed = [wait.compute for wait in waits]
    ratios = [wait.server / wait.compute for wait in waits]
    reference = f"asked to done {statistics.median(server_ms):.0f} ms"
    reference += f", learners {statistics.median(computed):.0f} ms"
    name = f"{title}: time on the server / the learners' own"
    yield at_most(name, ratios, target=MOST_OVERHEAD, unit="×", reference=reference)


def _press_learn(browser: Browser, server: LiveServer) -> Wait:
    context = _visit(browser, server)
    page = context.new_page()
    world_id = prepare(walk.ContextClient(page, server.address))
    page.goto(f"/worlds/{world_id}/learn")
    learn = page.locator('[data-action="learn"]')
    learn.hover()  # waits until it can be pressed
    page.wait_for_timeout(300)  # whatever the page began with is done
    page.evaluate("() => watchLearning()")
    learn.click()
    seen: dict[str, Any] = page.evaluate("() => watched")
    if seen["status"] != "done":
        raise RuntimeError(f"a run of the benchmark ended as {seen['status']}")
    page.locator('[data-part="compare"]').click()
    rows = len(DEFAULT_LEARNERS) + 2
    asked = "([pressedAt, nRows]) => comparisonShownAfter(pressedAt, nRows)"
    page.wait_for_url("**/comparison*", wait_until="commit")
    comparison: float = page.evaluate(asked, [seen["pressedAt"], rows])
    server_ms, compute_ms = _time_on_server(page, server, world_id)
    context.close()
    return Wait(seen["frame"], seen["done"], comparison, server_ms, compute_ms)


def _time_on_server(page: Page, server: LiveServer, world_id: str) -> tuple[float, float]:
    """From asked to done, and what all learners of the run computed together."""
    client = walk.ContextClient(page, server.address)
    listed = client.get(f"/worlds/{world_id}/runs")
    run = client.get(f"/runs/{listed[0]['id']}")
    asked, done = (datetime.fromisoformat(run[name]) for name in ("created_at", "finished_at"))
    return 1000 * (done - asked).total_seconds(), sum(run["compute_ms"].values())


def _measure_drops(browser: Browser, server: LiveServer) -> Iterator[Figure]:
    context = _visit(browser, server)
    page = context.new_page()
    ranking.open_lists(page, prepare(walk.ContextClient(page, server.address)), n_cards=6)
    page.locator("#policy[data-shown]").wait_for()
    heard: list[dict[str, Any]] = []

    def hear(answer: Response) -> None:
        if answer.url.endswith("/previews") and answer.ok:
            heard.append(answer.json())

    page.on("response", hear)
    for learner, title in (("irlfr", "IRLFR"), ("irlr", "IRLR"), ("birlfr", "Bayesian IRLFR")):
        _choose(page, learner)
        drops = [_drop(page) for _ in range(N_DROPS + 1)][1:]
        computed = [one["compute_ms"] for one in heard if one["learner"] == learner]
        reference = f"learning itself {statistics.median(computed):.0f} ms; {_spread(drops)}"
        name = f"7×7, dropping a card: what {title} would learn repainted"
        yield at_most(name, drops, target=REPAINTED_MS, unit="ms", reference=reference)
    context.close()


def _choose(page: Page, learner: str) -> None:
    page.locator(f'#policy input[value="{learner}"]').check()
    page.locator(f'#policy[data-learner="{learner}"]:not([data-asking])').wait_for()


def _drop(page: Page) -> float:
    """Drag the last success to the top, and time what follows the drop."""
    order = ranking.order_shown(page, "success")
    page.evaluate("() => watchDrop()")
    ranking.Mouse(page).drag(order[-1][0], ranking.Where(order[0][0], "above"))
    took: float = page.evaluate("() => watched")
    time.sleep(INTERVAL_S)
    return took


def _visit(browser: Browser, server: LiveServer) -> BrowserContext:
    """Begin to time in all pages of a new visitor."""
    context = browser.new_context(base_url=server.address, viewport={"width": 1280, "height": 800})
    context.add_init_script(path=WATCH)
    return context


def _spread(waits: list[float]) -> str:
    return f"p90 {percentile(waits, 0.9):.0f} ms of {len(waits)}"
