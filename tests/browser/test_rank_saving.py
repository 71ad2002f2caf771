"""Nothing of an order is lost: pages load again, browsers are killed, servers are away, tabs meet. Real processes.

Contexts whose server goes away are not watched: the browser itself reports the requests that failed on its console.
"""

import json
import time
import uuid
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import BrowserContext, Locator, Page, Playwright, Route, expect

from app.rankings import replay
from tests import journey
from tests.browser import saving, walk
from tests.browser.conftest import watched
from tests.live_server import LiveServer

READ = """async (name) => {
  const { ask, rankingStorage } = await import("#js/lib/storage.js");
  return rankingStorage.run([name], "readonly", (store) => ask(store(name).getAll()));
}"""
SHOWN = """outcome => [...document.querySelectorAll(`#list-${outcome} > .group`)].map((group) =>
  [...group.querySelectorAll(".card")].map((card) => card.dataset.demonstrationId))"""

Json = dict[str, Any]
Order = list[list[str]]


def ready_to_rank(page: Page, address: str, *, seed: int) -> str:
    """Four failures and a success by the API, the rank page open; the world's id."""
    client = walk.ContextClient(page, address)
    world = client.post("/worlds", {"seed": seed})
    grid = journey.Grid(world)
    best = grid.cheapest_path([max(-reward, 0.0) for reward in grid.rewards])
    for actions, ending in [(best, "goal"), *(([1] * n, "gave_up") for n in (1, 2, 3, 4))]:
        body = {"id": str(uuid.uuid4()), "actions": actions, "step_ms": [200.0] * len(actions), "ending": ending}
        client.post(f"/worlds/{world['id']}/demonstrations", body)
    open_ranking(page, world["id"])
    return str(world["id"])


def open_ranking(page: Page, world_id: str) -> None:
    page.goto(f"/worlds/{world_id}/rank")
    expect(page.locator("#list-failure .card").first).to_be_visible()


def shown(page: Page, outcome: str = "failure") -> Order:
    order: Order = page.evaluate(SHOWN, outcome)
    return order


def card(page: Page, place: int) -> Locator:
    return page.locator(f'#list-failure .card[data-position="{place}"]')


def lift_to_top(page: Page, place: int) -> None:
    """By keyboard."""
    card(page, place).focus()
    for key in ("Space", "Home", "Space"):
        page.keyboard.press(key)


def move_about(page: Page) -> tuple[Order, Order, Order]:
    """Some moves, some ties, two of them undone; the order then, and what redoing both would bring."""
    lift_to_top(page, 4)
    card(page, 3).locator('[data-act="tie"]').click()
    one_less = shown(page)
    card(page, 2).locator('[data-act="up"]').click()
    two = shown(page)
    lift_to_top(page, 3)
    all_ = shown(page)
    page.locator("#undo").click()
    page.locator("#undo").click()
    assert shown(page) == one_less
    return one_less, two, all_


def expect_to_go_on(page: Page, now: Order, two: Order, all_: Order) -> None:
    """The order stands, and undo and redo lead where they did."""
    expect(page.locator("#list-failure .card")).to_have_count(4)
    assert shown(page) == now
    for wanted in (two, all_):
        page.locator("#redo").click()
        assert shown(page) == wanted
    expect(page.locator("#redo")).to_be_disabled()
    for _ in range(4):
        page.locator("#undo").click()
    expect(page.locator("#undo")).to_be_disabled()
    for _ in range(2):
        page.locator("#redo").click()
    assert shown(page) == now


def confirm(page: Page) -> None:
    page.locator("#confirm").click()


def expect_confirmed(page: Page) -> None:
    expect(page.locator("#rank")).to_have_attribute("data-confirmed", "true")


def kept(page: Page, store: str) -> list[Json]:
    found: list[Json] = page.evaluate(READ, store)
    return found


def stored_logs(server: LiveServer, world_id: str) -> dict[str, list[Json]]:
    """Each sitting's log as it lies in the server's database, the oldest sitting first."""
    query = """select sitting.id, event from sitting join ranking_event on sitting_id = sitting.id
               where world_id = ? order by sitting.created_at, sitting.id, n"""
    logs: dict[str, list[Json]] = {}
    for id_, event in server.ask_database(query, world_id):
        logs.setdefault(id_, []).append(json.loads(event))
    return logs


def stored_versions(server: LiveServer, world_id: str) -> list[tuple[Any, ...]]:
    """Outcome, version, order, sitting and number of events of every confirmed order."""
    query = """select outcome, version, "order", sitting_id, n_events from ranking
               where world_id = ? order by outcome, version"""
    rows = server.ask_database(query, world_id)
    return [(outcome, version, json.loads(order), id_, n) for outcome, version, order, id_, n in rows]


def expect_versions_rebuilt(server: LiveServer, world_id: str) -> None:
    """Every version is what its log comes to."""
    logs = stored_logs(server, world_id)
    for outcome, _, order, id_, n_events in stored_versions(server, world_id):
        rebuilt = replay.rebuild(logs[id_][:n_events]).orders[outcome]
        assert [list(group) for group in rebuilt] == order


def wait_for(found: Any, what: str) -> None:
    deadline = time.monotonic() + 15
    while not found():
        assert time.monotonic() < deadline, what
        time.sleep(0.1)


def test_loading_the_page_again_keeps_the_order_its_undo_and_its_redo(page: Page, server: LiveServer) -> None:
    ready_to_rank(page, server.address, seed=81)
    stood = move_about(page)
    page.reload()
    expect_to_go_on(page, *stood)
    page.goto("/")
    page.go_back()
    expect_to_go_on(page, *stood)


def test_a_page_closed_and_opened_another_day_goes_on(context: BrowserContext, page: Page, server: LiveServer) -> None:
    world_id = ready_to_rank(page, server.address, seed=82)
    stood = move_about(page)
    page.close()
    page = context.new_page()
    with watched(page, server.address):
        open_ranking(page, world_id)
        expect_to_go_on(page, *stood)
    assert len({one["id"] for one in kept(page, "sittings")}) == 1


def test_the_servers_log_is_what_was_done_with_what_and_when(page: Page, server: LiveServer) -> None:
    world_id = ready_to_rank(page, server.address, seed=83)
    begun = time.monotonic()
    start = shown(page)
    lift_to_top(page, 2)
    page.wait_for_timeout(300)
    card(page, 2).locator('[data-act="tie"]').click()
    page.wait_for_timeout(300)
    page.keyboard.press("z")
    order = shown(page)
    confirm(page)
    expect_confirmed(page)
    passed_ms = 1000 * (time.monotonic() - begun)

    (log,) = stored_logs(server, world_id).values()
    told = [event for event in log if event["type"] not in {"watch", "hidden", "visible"}]
    done = ["begin", "lift", "place", "drop", "place", "undo", "confirm", "confirm"]
    assert [event["type"] for event in told] == done
    assert [event["means"] for event in told[1:7]] == ["key", "key", "key", "button", "key", "button"]
    assert told[0]["orders"]["failure"] == start
    assert told[0]["from"] == {"success": "random", "failure": "random"}
    times = [event["at_ms"] for event in log]
    assert times[0] >= 0
    assert all(before <= after for before, after in pairwise(times))
    assert 600 <= times[-1] <= passed_ms + 2000
    assert told[4]["at_ms"] - told[3]["at_ms"] >= 300
    rebuilt = replay.rebuild(log)
    assert [list(group) for group in rebuilt.orders["failure"]] == order
    assert [(outcome, version) for outcome, version, *_ in stored_versions(server, world_id)] == [
        ("failure", 1), ("success", 1),
    ]  # fmt: skip
    expect_versions_rebuilt(server, world_id)


def test_a_log_arrives_though_nothing_was_confirmed_and_the_page_is_never_opened_again(
    away: BrowserContext, home: LiveServer
) -> None:
    page = away.new_page()
    world_id = ready_to_rank(page, home.address, seed=71)
    now, *_ = move_about(page)
    page.close(run_before_unload=True)
    away.new_page().goto("/?seed=5")

    def has_arrived() -> bool:
        logs = stored_logs(home, world_id)
        orders = [replay.rebuild(log).orders["failure"] for log in logs.values()]
        return [[list(group) for group in order] for order in orders] == [now]

    wait_for(has_arrived, "the log did not arrive")


def test_after_everything_is_confirmed_the_page_begins_anew_from_what_counts(page: Page, server: LiveServer) -> None:
    world_id = ready_to_rank(page, server.address, seed=84)
    lift_to_top(page, 3)
    order = shown(page)
    confirm(page)
    expect_confirmed(page)
    page.reload()
    expect_confirmed(page)
    assert shown(page) == order
    expect(page.locator("#undo")).to_be_disabled()
    lift_to_top(page, 2)
    confirm(page)
    expect_confirmed(page)
    first, second = stored_logs(server, world_id).values()
    assert second[0]["from"] == {"success": "version", "failure": "version"}
    assert second[0]["based_on"] == {"success": 1, "failure": 1}
    assert {event["type"] for event in first} >= {"begin", "confirm"}
    versions = [(outcome, version) for outcome, version, *_ in stored_versions(server, world_id)]
    assert versions == [("failure", 1), ("failure", 2), ("success", 1)]
    expect_versions_rebuilt(server, world_id)


# Only Linux lists the browser's processes, which are killed here by their numbers; CI is Linux, so it never skips this.
@pytest.mark.skipif(not Path("/proc/self").exists(), reason="finds the browser's processes in /proc")
@pytest.mark.usefixtures("browser")  # skips or fails where there is none
def test_a_killed_browser_loses_no_step(playwright: Playwright, tmp_path: Path, home: LiveServer) -> None:
    browser = saving.KillableBrowser(playwright, tmp_path / "profile", home.address)
    page = browser.open()
    world_id = ready_to_rank(page, home.address, seed=72)
    browser.close()  # a cookie is on the disk half a minute after it was set, or when the browser was closed

    page = browser.open()
    open_ranking(page, world_id)
    page.context.set_offline(True)
    stood = move_about(page)
    browser.kill()

    page = browser.open()
    with watched(page, home.address):
        open_ranking(page, world_id)
        expect_to_go_on(page, *stood)
        confirm(page)
        expect_confirmed(page)
    browser.close()
    (log,) = stored_logs(home, world_id).values()
    assert log[-1]["type"] == "confirm"
    expect_versions_rebuilt(home, world_id)


def test_an_order_confirmed_without_a_server_arrives_once_from_any_page(away: BrowserContext, home: LiveServer) -> None:
    page = away.new_page()
    world_id = ready_to_rank(page, home.address, seed=73)
    home.stop()
    lift_to_top(page, 4)
    order = shown(page)
    confirm(page)
    expect(page.locator("#rank-state")).to_contain_text("cannot be reached")
    waiting = [one["kind"] for one in kept(page, "outbox")]
    assert sorted(waiting)[-2:] == ["ranking", "ranking"]
    # A page of version 0.3 reads this one, and would take an order for a damaged attempt.
    assert saving.kept(page) == []
    page.close()
    assert stored_versions(home, world_id) == []

    home.start()
    page = away.new_page()
    with watched(page, home.address):
        page.goto(f"/worlds/{world_id}")
        wait_for(lambda: kept(page, "outbox") == [], "it is not sent")
    assert [(outcome, version) for outcome, version, *_ in stored_versions(home, world_id)] == [
        ("failure", 1), ("success", 1),
    ]  # fmt: skip
    assert stored_versions(home, world_id)[0][2] == order
    with watched(page, home.address):
        open_ranking(page, world_id)
        expect_confirmed(page)
    assert len(stored_versions(home, world_id)) == 2
    expect_versions_rebuilt(home, world_id)


def test_an_order_that_waits_is_still_known_after_a_reload(away: BrowserContext, home: LiveServer) -> None:
    page = away.new_page()
    world_id = ready_to_rank(page, home.address, seed=74)
    page.route("**/api/v1/worlds/*/rankings/*", busy)
    lift_to_top(page, 4)
    confirm(page)
    expect(page.locator("#rank-state")).to_contain_text("busy")
    page.reload()
    expect(page.locator("#rank-state")).to_contain_text("busy")
    page.unroute_all()
    expect_confirmed(page)
    assert len(stored_versions(home, world_id)) == 2


def busy(route: Route) -> None:
    body = {"error": {"code": "unavailable", "message": "Please try again in a moment.", "fields": {}}}
    if route.request.method == "PUT":
        route.fulfill(status=503, headers={"Retry-After": "2"}, json=body)
    else:
        route.continue_()


def test_two_tabs_each_have_a_log_and_hear_of_each_other(away: BrowserContext, home: LiveServer) -> None:
    first, second = away.new_page(), away.new_page()
    world_id = ready_to_rank(first, home.address, seed=75)
    lift_to_top(first, 4)
    open_ranking(second, world_id)
    second.bring_to_front()
    lift_to_top(second, 3)
    first.bring_to_front()
    confirm(first)
    expect_confirmed(first)
    second.bring_to_front()
    expect(second.locator("#main")).to_contain_text("was confirmed in another tab")
    confirm(second)
    mine = second.get_by_role("button", name="Mine counts")
    mine.click()
    expect_confirmed(second)
    failures = [row for row in stored_versions(home, world_id) if row[0] == "failure"]
    assert [version for _, version, *_ in failures] == [1, 2]
    assert len({id_ for *_, id_, _ in failures}) == 2
    expect_versions_rebuilt(home, world_id)


def test_attempts_that_came_since_join_the_order_that_was_left(page: Page, server: LiveServer) -> None:
    world_id = ready_to_rank(page, server.address, seed=85)
    now, *_ = move_about(page)
    body = {"id": str(uuid.uuid4()), "actions": [1, 1, 1, 1, 1], "step_ms": [9.0] * 5, "ending": "gave_up"}
    walk.ContextClient(page, server.address).post(f"/worlds/{world_id}/demonstrations", body)
    page.reload()
    expect(page.locator("#list-failure .card")).to_have_count(5)
    assert shown(page) == [*now, [body["id"]]]
    page.locator("#undo").click()
    assert shown(page)[-1] == [body["id"]]


def test_what_version_0_3_kept_of_an_order_is_taken_over(page: Page, server: LiveServer) -> None:
    world_id = ready_to_rank(page, server.address, seed=86)
    order = {"success": shown(page, "success"), "failure": shown(page)[::-1]}
    page.goto("/")
    page.evaluate("() => new Promise((done) => (indexedDB.deleteDatabase('irlfr-rankings').onsuccess = done))")
    page.evaluate("([key, text]) => sessionStorage.setItem(key, text)", [f"irlfr:order:{world_id}", json.dumps(order)])
    open_ranking(page, world_id)
    assert shown(page) == order["failure"]
    assert page.evaluate("key => sessionStorage.getItem(key)", f"irlfr:order:{world_id}") is None
    lift_to_top(page, 3)
    now = shown(page)
    page.reload()
    expect(page.locator("#list-failure .card")).to_have_count(4)
    assert shown(page) == now


def test_without_any_storage_an_order_is_confirmed_all_the_same(away: BrowserContext, home: LiveServer) -> None:
    page = away.new_page()
    page.add_init_script("Object.defineProperty(window, 'indexedDB', { get() { throw new Error('closed'); } });")
    with watched(page, home.address):
        world_id = ready_to_rank(page, home.address, seed=76)
        lift_to_top(page, 4)
        order = shown(page)
        confirm(page)
        expect_confirmed(page)
    assert stored_versions(home, world_id)[0][2] == order
    expect_versions_rebuilt(home, world_id)
