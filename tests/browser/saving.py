"""What the tests of saving share: a look into the browser's storage and into the server's."""

import contextlib
import itertools
import json
import os
import signal
import time
from pathlib import Path
from typing import Any

from playwright.sync_api import Error, Page, Playwright, expect

from tests.browser import walk
from tests.browser.conftest import CHROMIUM_FLAGS, find_chromium
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
        with contextlib.suppress(Error):  # the driver may have noticed by itself
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
