"""Nothing is lost: the server is stopped, browsers are killed, tabs meet, storage is full or damaged. Real processes.

Contexts whose server goes away are not watched: the browser itself reports the requests that failed on its console.
"""

import itertools
import json
import os
import signal
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, Dialog, Page, Playwright, Route, expect

from irl_core.files import read_demonstration_file
from tests import journey
from tests.browser import walk
from tests.browser.conftest import CHROMIUM_FLAGS, WATCH_FOR_VIOLATIONS, find_chromium, watched
from tests.live_server import LiveServer

READ = """async (name) => {
  const { ask, browserStorage } = await import("#js/lib/storage.js");
  return browserStorage.run([name], "readonly", (store) => ask(store(name).getAll()));
}"""
WRITE = """async ([name, item]) => {
  const { browserStorage } = await import("#js/lib/storage.js");
  await browserStorage.run([name], "readwrite", (store) => void store(name).put(item));
}"""

TAKE_TURNS = """() => {
  const turn = async () => {
    const begin = Date.now();
    await new Promise((resolve) => setTimeout(resolve, 40));
    return [begin, Date.now()];
  };
  window.turns = (async () => {
    const { inTurn } = await import("#js/lib/locks.js");
    const { browserStorage } = await import("#js/lib/storage.js");
    return Promise.all([1, 2].map(() => inTurn("irlfr:test", browserStorage, turn)));
  })();
}"""

Json = dict[str, Any]


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveServer]:
    """A server that these tests may stop; the port and the database stay."""
    live = LiveServer(tmp_path_factory.mktemp("home"))
    live.start()
    yield live
    live.stop()


@pytest.fixture
def away(browser: Browser, home: LiveServer) -> Iterator[BrowserContext]:
    """A new visitor of `home`, not watched."""
    context = browser.new_context(base_url=home.address)
    yield context
    context.close()


def begin_again(page: Page) -> None:
    page.keyboard.press("Enter")
    expect(page.locator("#now")).to_have_attribute("data-shows", "playing")


def walk_along(page: Page, actions: list[int]) -> None:
    for action in actions:
        page.keyboard.press(walk.KEYS[action])


def give_up(page: Page, actions: list[int]) -> None:
    walk_along(page, actions)
    page.keyboard.press("g")
    expect(page.locator("#now")).to_have_attribute("data-shows", "result")


def expect_sync(page: Page, sync: str) -> None:
    expect(page.locator("#sync")).to_have_attribute("data-sync", sync)


def kept(page: Page, store: str = "outbox") -> list[Json]:
    found: list[Json] = page.evaluate(READ, store)
    return found


def stored(server: LiveServer, world_id: str) -> dict[str, Json]:
    """What the server has of a world, as it lies in its database."""
    query = "select id, visitor_id, actions, step_ms, record, discarded_at from demonstration where world_id = ?"
    rows = server.ask_database(query, world_id)
    assert len({row[0] for row in rows}) == len(rows)
    names = ("actions", "step_ms", "record")
    return {
        row[0]: {"visitor_id": row[1], "discarded": row[5] is not None}
        | {name: json.loads(text) for name, text in zip(names, row[2:5], strict=True) if text is not None}
        for row in rows
    }


def expect_stored(server: LiveServer, parcels: list[Json]) -> None:
    """Each of the attempts is on the server, with the timings that the browser took."""
    there = stored(server, parcels[0]["worldId"])
    for parcel in parcels:
        told, has = parcel["body"], there[parcel["id"]]
        assert has["actions"] == told["actions"]
        assert has["step_ms"] == told["step_ms"]
        assert has.get("record") == told.get("record")


def expect_turns(tabs: list[Page]) -> None:
    """What only one tab may do at a time, only one does."""
    for page in tabs:
        page.evaluate(TAKE_TURNS)
    turns = sorted(tuple(turn) for page in tabs for turn in page.evaluate("window.turns"))
    assert len(turns) == 2 * len(tabs)
    assert all(end <= begin for (_, end), (begin, _) in itertools.pairwise(turns))


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


class KillableBrowser:
    """A Chromium with a profile on the disk, whose main process can be killed."""

    def __init__(self, playwright: Playwright, folder: Path, address: str) -> None:
        self._playwright, self._folder, self._address = playwright, folder, address

    def open(self) -> Page:
        for lock in self._folder.glob("Singleton*"):  # the killed one could not remove its own
            lock.unlink()
        self._context = self._playwright.chromium.launch_persistent_context(
            self._folder, executable_path=find_chromium(), args=CHROMIUM_FLAGS, base_url=self._address
        )
        return self._context.pages[0]

    def kill(self) -> None:
        processes = self._processes()
        main = [pid for pid, arguments in processes if not any(one.startswith(b"--type=") for one in arguments)]
        assert len(main) == 1
        os.kill(main[0], signal.SIGKILL)
        while self._processes():
            time.sleep(0.02)
        self._context.close()

    def close(self) -> None:
        self._context.close()

    def _processes(self) -> list[tuple[int, list[bytes]]]:
        found = []
        for entry in Path("/proc").iterdir():
            try:
                arguments = (entry / "cmdline").read_bytes().split(b"\0") if entry.name.isdigit() else []
            except OSError:
                continue  # it ended while we looked
            if f"--user-data-dir={self._folder}".encode() in arguments:
                found.append((int(entry.name), arguments))
        return found


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
