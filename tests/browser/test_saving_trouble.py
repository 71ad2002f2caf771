"""Saving in trouble: a busy server, refusals, storage full, closed or damaged, an older version, plain http."""

import json
import time
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, BrowserContext, Dialog, Route, expect

from irl_core.files import read_demonstration_file
from tests import journey
from tests.browser import walk
from tests.browser.conftest import CHROMIUM_FLAGS, WATCH_FOR_VIOLATIONS, watched
from tests.browser.saving import (
    WRITE,
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


def test_a_busy_server_is_asked_again_when_it_said(away: BrowserContext, home: LiveServer) -> None:
    page = away.new_page()
    page.goto("/?seed=56")
    asked: list[float] = []

    def refuse_once(route: Route) -> None:
        asked.append(time.monotonic())
        if len(asked) > 1:
            route.continue_()
            return
        body = {"error": {"code": "unavailable", "message": "Please try again in a moment.", "fields": {}}}
        route.fulfill(status=503, headers={"Retry-After": "2"}, json=body)

    page.route("**/api/v1/worlds", refuse_once)
    give_up(page, [1])
    expect_sync(page, "busy")
    expect(page.locator("#saving")).to_contain_text("busy and asked for 2 s")
    expect_sync(page, "saved")
    assert asked[1] - asked[0] >= 2
    assert len(stored(home, walk.page_data(page)["world"]["id"])) == 1


def test_an_attempt_that_the_server_refuses_is_kept_and_can_be_saved_as_a_file(
    away: BrowserContext, home: LiveServer, tmp_path: Path
) -> None:
    """Somebody else has told another story under its id: 409."""
    page = away.new_page()
    page.add_init_script(WATCH_FOR_VIOLATIONS)
    said: list[str] = []
    page.on("console", lambda message: said.append(message.text))
    page.goto("/?seed=57")
    away.set_offline(True)
    give_up(page, [1, 2])
    expect_sync(page, "offline")
    (parcel,) = kept(page)
    other = journey.Client(home.address)
    world = other.post("/worlds", parcel["world"])
    told = {"id": parcel["id"], "actions": [2], "step_ms": [5.0], "ending": "gave_up"}
    other.post(f"/worlds/{world['id']}/demonstrations", told)
    away.set_offline(False)

    card = page.locator('.attempt[data-sync="refused"]')
    expect(card.locator(".attempt-note")).to_contain_text("under the same number")
    expect(page.locator("#n-failures")).to_have_text("0")
    page.reload()
    expect(card).to_have_count(1)
    with page.expect_download() as download:
        card.get_by_role("button", name="Save").click()
    file = tmp_path / download.value.suggested_filename
    download.value.save_as(file)
    (demonstration,) = read_demonstration_file(file).demonstrations
    assert demonstration.id == parcel["id"]
    assert demonstration.actions.tolist() == [1, 2]
    assert json.loads(file.read_text().splitlines()[1])["step_ms"] == parcel["body"]["step_ms"]
    card.get_by_role("button", name="Forget").click()
    card.get_by_role("button", name="for good").click()
    expect(card).to_have_count(0)
    assert kept(page) == []
    assert not [text for text in said if text.startswith("CSP")]


def test_discarding_and_restoring_need_no_server(away: BrowserContext, home: LiveServer) -> None:
    page = away.new_page()
    page.goto("/?seed=58")
    away.set_offline(True)
    give_up(page, [1])
    begin_again(page)
    give_up(page, [1, 2])
    for attempt, acts in ((2, ("Discard",)), (1, ("Discard", "Restore"))):
        for act in acts:
            page.get_by_role("button", name=f"{act} attempt {attempt}").press("Enter")
    expect(page.locator("#n-failures")).to_have_text("1")
    away.set_offline(False)
    expect_sync(page, "saved")
    there = stored(home, walk.page_data(page)["world"]["id"])
    assert sorted((len(one["actions"]), one["discarded"]) for one in there.values()) == [(1, False), (2, True)]
    page.reload()
    expect(page.locator("#n-failures")).to_have_text("1")


def test_a_full_storage_costs_nothing_while_the_page_is_open(away: BrowserContext, home: LiveServer) -> None:
    page = away.new_page()
    page.goto("/?seed=59")
    quota = {"origin": home.address, "quotaSize": 1}
    away.new_cdp_session(page).send("Storage.overrideQuotaForOrigin", quota)
    away.set_offline(True)
    give_up(page, [1, 2])
    expect_sync(page, "memory")
    expect(page.locator("#saving")).to_contain_text("in this page alone")
    begin_again(page)
    for action in (1, 2, 3):
        walk_along(page, [action])
        page.wait_for_timeout(100)  # as people press: the storage has said no to the step before
    expect(page.locator("#hint")).to_contain_text("no room to keep an attempt while you play it")
    page.keyboard.press("r")
    questions: list[str] = []

    def stay(dialog: Dialog) -> None:
        questions.append(dialog.type)
        dialog.dismiss()

    page.on("dialog", stay)
    page.close(run_before_unload=True)
    page.wait_for_timeout(300)
    assert questions == ["beforeunload"]
    away.set_offline(False)
    expect_sync(page, "saved")
    assert len(stored(home, walk.page_data(page)["world"]["id"])) == 1
    page.reload()
    expect_sync(page, "saved")
    assert questions == ["beforeunload"]


def test_without_any_storage_attempts_are_sent_all_the_same(away: BrowserContext, home: LiveServer) -> None:
    page = away.new_page()
    page.add_init_script("Object.defineProperty(window, 'indexedDB', { get() { throw new Error('closed'); } });")
    with watched(page, home.address):
        page.goto("/?seed=60")
        give_up(page, [1, 2])
        expect_sync(page, "saved")
        begin_again(page)
        give_up(page, [1])
        expect(page.locator(".attempt")).to_have_count(2)
        expect_sync(page, "saved")
    assert len(stored(home, walk.page_data(page)["world"]["id"])) == 2


def test_damaged_storage_is_said_and_stops_nobody(away: BrowserContext, home: LiveServer) -> None:
    page = away.new_page()
    with watched(page, home.address):
        page.goto("/?seed=61")
        world_id = walk.page_data(page)["world"]["id"]
        parcel = {"id": "p", "worldId": world_id, "world": {"seed": 61}, "body": {"id": "p"}, "at": 1, "refusal": None}
        draft = {"id": "d", "worldId": world_id, "actions": [1, "up"], "stepMs": "?", "savedAt": 9}
        page.evaluate(WRITE, ["outbox", parcel])
        page.evaluate(WRITE, ["unfinished", draft])
        page.reload()
        expect(page.locator('.attempt[data-sync="refused"] .attempt-note')).to_contain_text("damaged")
        expect(page.get_by_text("An unfinished attempt in this browser's storage is damaged").first).to_be_attached()
        give_up(page, [1, 2])
        expect(page.locator('.attempt[data-sync="saved"]')).to_have_count(1)
        expect_sync(page, "refused")
        assert [one["id"] for one in kept(page)] == ["p"]
    assert len(stored(home, world_id)) == 1


def test_what_version_0_2_kept_arrives_even_while_its_tab_is_open(away: BrowserContext, home: LiveServer) -> None:
    old = away.new_page()
    old.goto("/docs")
    world = journey.Client(home.address).post("/worlds", {"seed": 62})
    parcels = [
        {"id": id_, "worldId": world["id"], "world": {"seed": 62}, "at": at, "refusal": None}
        | {"body": {"id": id_, "actions": [1, 2], "step_ms": [11.5, 12.5], "ending": "gave_up"}}
        for id_, at in (("0a8a0d2e-6b55-4c0b-8ab6-0e7a35c9b001", 2), ("0a8a0d2e-6b55-4c0b-8ab6-0e7a35c9b002", 1))
    ]
    old.evaluate(
        """(parcels) => new Promise((resolve) => {
          const request = indexedDB.open("irlfr", 1);
          request.onupgradeneeded = () => request.result.createObjectStore("outbox", { keyPath: "id" });
          request.onsuccess = () => {
            window.held = request.result;
            const transaction = held.transaction("outbox", "readwrite");
            for (const parcel of parcels) transaction.objectStore("outbox").put(parcel);
            transaction.oncomplete = resolve;
          };
        })""",
        parcels,
    )
    checkpoint = {"id": "0a8a0d2e-6b55-4c0b-8ab6-0e7a35c9b003", "actions": [2, 1, 1], "stepMs": [1, 2, 3]}
    key = f"irlfr:attempt:{world['id']}"
    old.evaluate("([key, text]) => localStorage.setItem(key, text)", [key, json.dumps(checkpoint)])
    page = away.new_page()
    with watched(page, home.address):
        page.goto("/?seed=62")
        expect(page.locator(".attempt")).to_have_count(2)
        expect_sync(page, "saved")
        expect(page.locator("#n-steps")).to_have_text("3")
    expect_stored(home, parcels)


def test_over_plain_http_in_a_class_room_nothing_is_lost_either(launch_browser: Any, home: LiveServer) -> None:
    """No secure context: no crypto.randomUUID, no Web Locks. Not watched: the browser reports a header it ignores."""
    browser: Browser = launch_browser(args=[*CHROMIUM_FLAGS, "--host-resolver-rules=MAP class.test 127.0.0.1"])
    context = browser.new_context(base_url=f"http://class.test:{home.port}")
    tabs = [context.new_page() for _ in range(3)]
    errors: list[str] = []
    for page in tabs:
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto("/?seed=63")
    assert not tabs[0].evaluate("isSecureContext || 'locks' in navigator")
    context.set_offline(True)
    for page in tabs:
        page.bring_to_front()
        give_up(page, [1, 1])
        expect_sync(page, "offline")
    begin_again(tabs[2])
    walk_along(tabs[2], [2, 2])
    context.set_offline(False)
    for page in tabs:
        expect_sync(page, "saved")
    there = stored(home, walk.page_data(tabs[0])["world"]["id"])
    assert len(there) == 3
    assert len({one["visitor_id"] for one in there.values()}) == 1
    expect_turns(tabs)

    tabs[0].reload()
    expect_sync(tabs[0], "saved")
    tabs[0].wait_for_timeout(500)
    expect(tabs[0].locator("#n-steps")).to_have_text("0")
    tabs[2].close()
    tabs[0].reload()
    expect(tabs[0].locator("#n-steps")).to_have_text("2")
    assert not errors
    browser.close()
