"""Watching a run through what happens to browsers and servers: afterwards the page is true."""

import os
from typing import Any

from playwright.sync_api import Browser, BrowserContext, Page, expect

from tests import journey
from tests.browser import walk
from tests.browser.conftest import scripts_watched
from tests.browser.wire import Wire
from tests.live_server import LiveServer

SLEEP_MS = 1000 * float(os.environ.get("E2E_TAB_SLEEP_S", "1"))
"""How long a tab sleeps. E2E_TAB_SLEEP_S=60 lets it be a whole minute."""

LONG: dict[str, Any] = {"learners": ["meirl"], "settings": {"iterations": 100_000, "tolerance": 1e-12}, "seed": 7}
"""A run that goes on until it is cancelled, for any patience a test has."""

Json = dict[str, Any]


def test_a_connection_cut_in_mid_run_and_restored_leaves_the_page_true(browser: Browser, server: LiveServer) -> None:
    with Wire(server.port) as wire, scripts_watched(browser.new_context(base_url=wire.address)) as context:
        page, client, run_id = watching(context, wire.address, seed=61)
        wire.cut()
        expect(place(page)).to_have_attribute("data-connected", "false")
        expect(page.locator('[data-part="sentence"]')).to_contain_text("The connection was lost; trying again")
        wire.mend()
        expect(place(page)).to_have_attribute("data-connected", "true", timeout=walk.LEARNING_MS)
        goes_on(page)
        page.locator('[data-action="cancel"]').click()
        expect_truth(page, client, run_id, "cancelled")


def test_a_tab_that_slept_while_a_run_ended_is_true_when_it_wakes(visitor: BrowserContext, server: LiveServer) -> None:
    page, client, run_id = watching(visitor, server.address, seed=62)
    tab = visitor.new_cdp_session(page)
    tab.send("Page.setWebLifecycleState", {"state": "frozen"})
    other = visitor.new_page()
    other.wait_for_timeout(SLEEP_MS)
    if client.get(f"/runs/{run_id}")["status"] == "running":  # in a whole minute it may have come to its own end
        client.post(f"/runs/{run_id}/cancellation", {})
    tab.send("Page.setWebLifecycleState", {"state": "active"})
    expect_truth(page, client, run_id, client.get(f"/runs/{run_id}")["status"])


def test_a_web_server_restarted_in_mid_run_loses_nothing(away: BrowserContext, home: LiveServer) -> None:
    page, client, run_id = watching(away, home.address, seed=63)
    home.kill()
    expect(place(page)).to_have_attribute("data-connected", "false")
    home.start()
    expect(place(page)).to_have_attribute("data-connected", "true", timeout=walk.LEARNING_MS)
    goes_on(page)
    page.locator('[data-action="cancel"]').click()
    expect_truth(page, client, run_id, "cancelled")


def test_a_run_deleted_while_watched_is_said_to_be_gone(visitor: BrowserContext, server: LiveServer) -> None:
    page, _, run_id = watching(visitor, server.address, seed=64)
    assert visitor.request.delete(f"{server.address}/api/v1/runs/{run_id}").status == 204
    expect(place(page)).to_have_attribute("data-status", "deleted")
    expect(page.locator('[data-part="sentence"]')).to_contain_text("This run was deleted")
    expect(page.locator('[data-action="cancel"]')).to_be_hidden()
    expect(page.locator('[data-action="learn"]')).to_be_visible()


def watching(context: BrowserContext, address: str, *, seed: int) -> tuple[Page, walk.ContextClient, str]:
    """A page on which a long run goes on."""
    page = context.new_page()
    client = walk.ContextClient(page, address)
    run = asked(client, {"rows": 10, "cols": 10, "seed": seed}, LONG)
    page.goto(f"/runs/{run['id']}")
    expect(place(page)).to_have_attribute("data-status", "running", timeout=walk.LEARNING_MS)
    goes_on(page)
    return page, client, run["id"]


def asked(client: walk.ContextClient, world: Json, run: Json) -> Json:
    """Play and rank in a world by the API, and ask for a run."""
    made = client.post("/worlds", world)
    journey.rank(client, made["id"], *journey.play(client, journey.Grid(made), made["id"]))
    answer: Json = client.post(f"/worlds/{made['id']}/runs", run)
    return answer


def place(page: Page) -> Any:
    return page.locator("learn-page")


def goes_on(page: Page) -> None:
    """Another iteration is on the boards than now."""
    now = place(page).get_attribute("data-iteration") or ""
    expect(place(page)).not_to_have_attribute("data-iteration", now, timeout=walk.LEARNING_MS)


def expect_truth(page: Page, client: walk.ContextClient, run_id: str, status: str) -> None:
    """The page shows how the run stands, and every frame of its record, to the last."""
    expect(place(page)).to_have_attribute("data-status", status, timeout=walk.LEARNING_MS)
    frames = client.get(f"/runs/{run_id}/frames")["frames"]
    assert client.get(f"/runs/{run_id}")["status"] == status
    numbers = [frame["number"] for frame in frames]
    assert numbers == sorted(set(numbers))
    expect(place(page)).to_have_attribute("data-frames", str(len({frame["iteration"] for frame in frames})))
    expect(place(page)).to_have_attribute("data-iteration", str(frames[-1]["iteration"]))
    panel = page.locator('.agent-panel[data-learner="meirl"]')
    expect(panel).to_have_attribute("data-iteration", str(frames[-1]["iteration"]))
