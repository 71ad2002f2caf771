"""Nothing is lost: the server is stopped, browsers are killed, tabs meet. Real processes.

Contexts whose server goes away are not watched: the browser itself reports the requests that failed on its console.
"""

from pathlib import Path

import pytest
from playwright.sync_api import BrowserContext, Playwright, expect

from tests.browser import walk
from tests.browser.conftest import watched
from tests.browser.saving import (
    KillableBrowser,
    begin_again,
    expect_stored,
    expect_sync,
    expect_turns,
    give_up,
    kept,
    stored,
    walk_along,
)
from tests.live_server import LiveServer


def test_six_attempts_arrive_once_each_though_the_server_was_away_when_the_page_was_closed(
    away: BrowserContext, home: LiveServer
) -> None:
    page = away.new_page()
    page.goto("/?seed=51")
    *five, sixth = walk.attempts_for(page)
    for actions in five:
        walk.play_by_keys(page, actions)
    expect_sync(page, "saved")
    walk_along(page, sixth[:1])
    home.stop()
    walk_along(page, sixth[1:])
    expect(page.locator("#now")).to_have_attribute("data-shows", "result")
    expect_sync(page, "offline")
    expect(page.locator("#saving")).to_contain_text("kept in this browser")
    parcels = kept(page)
    page.close()
    world_id = parcels[0]["worldId"]
    assert len(stored(home, world_id)) == 5

    home.start()
    page = away.new_page()
    with watched(page, home.address):
        page.goto(f"/worlds/{world_id}")
        expect_sync(page, "saved")
        expect(page.locator(".attempt")).to_have_count(6)
        assert kept(page) == []
    assert len(stored(home, world_id)) == 6
    expect_stored(home, parcels)
    assert all(ms > 0 for ms in parcels[0]["body"]["step_ms"])


# Only Linux lists the browser's processes, which are killed here by their numbers; CI is Linux, so it never skips this.
@pytest.mark.skipif(not Path("/proc/self").exists(), reason="finds the browser's processes in /proc")
@pytest.mark.usefixtures("browser")  # skips or fails where there is none
def test_a_killed_browser_loses_at_most_the_last_step(playwright: Playwright, tmp_path: Path, home: LiveServer) -> None:
    browser = KillableBrowser(playwright, tmp_path / "profile", home.address)
    page = browser.open()
    page.goto("/?seed=52")
    page.context.set_offline(True)
    give_up(page, [1, 2, 1])
    expect_sync(page, "offline")
    begin_again(page)
    walk_along(page, [1, 1, 2, 2, 3, 0, 1])
    parcels = kept(page)
    browser.kill()

    page = browser.open()
    with watched(page, home.address):
        page.goto("/?seed=52")
        expect_sync(page, "saved")
        expect(page.locator("#n-steps")).to_have_text("7")
        page.keyboard.press("g")
        expect(page.locator(".attempt")).to_have_count(2)
        expect_sync(page, "saved")
    browser.close()
    expect_stored(home, parcels)
    (ended,) = (one for id_, one in stored(home, parcels[0]["worldId"]).items() if id_ != parcels[0]["id"])
    assert ended["actions"] == [1, 1, 2, 2, 3, 0, 1]


def test_two_tabs_of_a_stranger_lose_and_double_nothing(away: BrowserContext, home: LiveServer) -> None:
    tabs = [away.new_page(), away.new_page()]
    for page in tabs:
        page.goto("/?seed=53")
    away.set_offline(True)
    for number, page in enumerate(tabs):
        page.bring_to_front()
        for _ in range(2):
            give_up(page, [1, 2, 1][: number + 2])
            begin_again(page)
        walk_along(page, [2] * (number + 1))
    for page in tabs:
        expect(page.locator(".attempt")).to_have_count(4)
        expect_sync(page, "offline")
    parcels = kept(tabs[0])
    for page in tabs:
        page.close()

    away.set_offline(False)
    tabs = [away.new_page(), away.new_page()]
    for page in tabs:
        page.goto("/?seed=53", wait_until="commit")
    for page in tabs:
        expect_sync(page, "saved")
        expect(page.locator(".attempt")).to_have_count(4)
    there = stored(home, parcels[0]["worldId"])
    assert there.keys() == {parcel["id"] for parcel in parcels}
    assert len({one["visitor_id"] for one in there.values()}) == 1
    expect_stored(home, parcels)


def test_strangers_in_two_tabs_who_finish_at_once_are_one_visitor(away: BrowserContext, home: LiveServer) -> None:
    tabs = [away.new_page() for _ in range(3)]
    for page in tabs:
        page.goto("/?seed=54")
    away.set_offline(True)
    for page in tabs:
        page.bring_to_front()
        give_up(page, [1, 1])
    away.set_offline(False)
    for page in tabs:
        expect_sync(page, "saved")
    there = stored(home, walk.page_data(tabs[0])["world"]["id"])
    assert len(there) == 3
    assert len({one["visitor_id"] for one in there.values()}) == 1
    expect_turns(tabs)


def test_a_page_closed_while_its_attempt_is_under_way_sends_it_once(away: BrowserContext, home: LiveServer) -> None:
    for number in range(3):
        page = away.new_page()
        page.goto("/?seed=55")
        slow = {"offline": False, "latency": 150 * number, "downloadThroughput": -1, "uploadThroughput": -1}
        away.new_cdp_session(page).send("Network.emulateNetworkConditions", slow)
        walk_along(page, [1, 2])
        page.keyboard.press("g")
        page.close()
    page = away.new_page()
    page.goto("/?seed=55")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("g")
    expect(page.locator("#now")).to_have_attribute("data-shows", "result")
    expect_sync(page, "saved")
    there = stored(home, walk.page_data(page)["world"]["id"])
    assert sum(one["actions"] == [1, 2] for one in there.values()) == 3, there
