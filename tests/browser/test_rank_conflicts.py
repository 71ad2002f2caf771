"""What may come between a person and their confirmed order: another tab, other attempts, no server. Nothing is lost."""

import json
import re
from pathlib import Path

from playwright.sync_api import BrowserContext, Page, expect

from tests.browser import walk
from tests.browser.confirming import (
    CONFIRMED,
    Api,
    expect_confirmed,
    expect_said,
    flat,
    move_first_down,
    play_more,
    played,
    rank_page,
    touch_both,
    versions,
)

LOOK_AGAIN = "The order of the others is as you left it. Look at it, then confirm again."


def two_orders(context: BrowserContext, address: str) -> tuple[Page, str, list[str], list[str]]:
    """A page whose successes were confirmed elsewhere in another order: it, the world, this order, that one."""
    world_id = played(context, address)
    page = rank_page(context, world_id)
    theirs = walk.order_of(page, "success")[::-1]
    order = {"order": [[id_] for id_ in theirs], "confirmed": True}
    Api(context, address).put(f"/worlds/{world_id}/rankings/success", order)
    touch_both(page)
    page.locator("#confirm").click()
    expect_asked(page)
    return page, world_id, walk.order_of(page, "success"), theirs


def expect_asked(page: Page) -> None:
    dialog = page.get_by_role("dialog", name="Two orders of your successes")
    expect(dialog).to_have_accessible_description(
        re.compile(r"^Version 1 was confirmed at \d\d:\d\d, after this page was opened, perhaps in another tab\. ")
    )
    expect(page.locator("#conflict-title")).to_be_focused()


def test_what_another_tab_confirms_is_told_and_weighed_and_both_versions_are_kept(
    visitor: BrowserContext, base_url: str
) -> None:
    world_id = played(visitor, base_url)
    page, other = rank_page(visitor, world_id), rank_page(visitor, world_id)
    touch_both(page)
    page.locator('#list-success .card[data-position="3"] [data-act="up"]').click()
    mine = walk.order_of(page, "success")
    touch_both(other)
    walk.confirm_order(other)
    theirs = walk.order_of(other, "success")
    expect(page.locator("#rank-told-text")).to_contain_text("was confirmed in another tab just now, and it counts.")
    page.locator("#confirm").click()
    expect_asked(page)
    page.get_by_role("button", name="Mine counts").press("Enter")
    expect_confirmed(page)
    said = "Version 2 of your successes counts, the one on this page. Version 1 is kept beside it."
    expect(page.locator("#rank-told-text")).to_contain_text(said)
    expect(page.locator("#announcer")).to_contain_text(said)
    orders = [flat(one["order"]) for one in versions(visitor, base_url, world_id, "success")]
    assert orders == [mine, theirs]


def test_two_orders_stand_side_by_side_with_what_differs_marked(visitor: BrowserContext, base_url: str) -> None:
    page, _, mine, theirs = two_orders(visitor, base_url)
    for list_id, order, other in (("#orders-mine", mine, theirs), ("#orders-theirs", theirs, mine)):
        cards = page.locator(f"{list_id} .mini").all()
        assert [card.get_attribute("data-id") for card in cards] == order
        higher = [other.index(id_) - place for place, id_ in enumerate(order)]
        assert [int(card.get_attribute("data-moved") or "") for card in cards] == higher
        for card, by in zip(cards, higher, strict=True):
            sign = "" if by == 0 else f"{'▲' if by > 0 else '▼'} {abs(by)}"
            expect(card.locator(".mini-mark")).to_have_text(sign)


def test_mine_counts_and_the_other_order_is_kept_beside_it(visitor: BrowserContext, base_url: str) -> None:
    page, world_id, mine, theirs = two_orders(visitor, base_url)
    page.get_by_role("button", name="Mine counts").press("Enter")
    expect(page.locator("#rank-told-text")).to_contain_text(
        "Version 2 of your successes counts, the one on this page. Version 1 is kept beside it."
    )
    newest, first = versions(visitor, base_url, world_id, "success")
    assert (newest["version"], flat(newest["order"])) == (2, mine)
    assert (first["version"], flat(first["order"])) == (1, theirs)
    move_first_down(page, "success")
    page.locator("#confirm").click()
    expect_confirmed(page)
    assert len(versions(visitor, base_url, world_id, "success")) == 3


def test_the_other_order_is_taken_and_undo_brings_mine_back(visitor: BrowserContext, base_url: str) -> None:
    page, world_id, mine, theirs = two_orders(visitor, base_url)
    page.get_by_role("button", name="Take the other one").press("Enter")
    expect(page.locator("#rank-told-text")).to_contain_text(
        "Version 1 of your successes counts, and your list stands as in it. Undo brings your own order back."
    )
    assert walk.order_of(page, "success") == theirs
    assert len(versions(visitor, base_url, world_id, "success")) == 1
    page.locator("#undo").click()
    assert walk.order_of(page, "success") == mine


def test_who_decides_later_is_asked_again(visitor: BrowserContext, base_url: str) -> None:
    page, world_id, mine, _ = two_orders(visitor, base_url)
    page.keyboard.press("Escape")
    expect(page.locator("#rank-told-text")).to_contain_text(
        "Version 1 of your successes counts for now. Yours is as you left it; confirm again to decide."
    )
    assert walk.order_of(page, "success") == mine
    page.locator("#confirm").click()
    page.get_by_role("button", name="Mine counts").click()
    expect_confirmed(page)
    assert [one["version"] for one in versions(visitor, base_url, world_id, "success")] == [2, 1]


def test_the_same_order_confirmed_in_two_tabs_is_one_version(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page, other = rank_page(visitor, world_id), rank_page(visitor, world_id)
    for tab in (page, other):
        touch_both(tab)
    walk.confirm_order(other)
    expect_confirmed(page)
    expect(page.locator("#rank-told")).to_be_hidden()
    assert len(versions(visitor, base_url, world_id, "failure")) == 1


def test_attempts_that_came_meanwhile_join_last_and_the_rest_counts(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    failures = walk.order_of(page, "failure")
    (late,) = play_more(visitor, base_url, world_id)
    page.locator("#confirm").click()
    total = f"{late['total']:+.1f}".replace("-", "−")
    said = (
        "Confirmed: version 1 of your successes counts."
        f" 1 new failure since this page was opened: {total} in 1 step. It stands last: move it to its place."
        f" {LOOK_AGAIN}"
    )
    expect(page.locator("#rank-told-text")).to_have_text(said)
    expect_said(page, said)
    assert walk.order_of(page, "failure") == [*failures, late["id"]]
    page.get_by_role("button", name="Go to the new one").press("Enter")
    expect(page.locator(f'[data-demonstration-id="{late["id"]}"]')).to_be_focused()
    page.locator(f'[data-demonstration-id="{late["id"]}"] [data-act="up"]').click()
    walk.confirm_order(page)
    expect(page.locator("#rank-told")).to_be_hidden()
    assert flat(versions(visitor, base_url, world_id, "failure")[0]["order"]) == walk.order_of(page, "failure")


def test_an_attempt_discarded_meanwhile_leaves_and_the_order_of_the_others_stays(
    visitor: BrowserContext, base_url: str
) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    first, second, third = walk.order_of(page, "success")
    Api(visitor, base_url).put(f"/demonstrations/{second}/discard", {})
    page.locator("#confirm").click()
    said = (
        "Confirmed: version 1 of your failures counts."
        f" 1 success was discarded meanwhile and has left its list. {LOOK_AGAIN}"
    )
    expect(page.locator("#rank-told-text")).to_have_text(said)
    assert walk.order_of(page, "success") == [first, third]
    page.get_by_role("button", name="Understood").press("Enter")
    expect(page.locator("#rank-told")).to_be_hidden()
    expect(page.locator("#confirm")).to_be_focused()
    walk.confirm_order(page)


def test_an_attempt_played_in_another_tab_joins_the_list_by_itself(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page, other = rank_page(visitor, world_id), visitor.new_page()
    touch_both(page)
    failures = walk.order_of(page, "failure")
    other.goto(f"/worlds/{world_id}")
    other.keyboard.press("ArrowRight")
    other.keyboard.press("g")
    expect(page.locator("#rank-told-text")).to_contain_text("1 new failure since this page was opened: ")
    assert walk.order_of(page, "failure")[:-1] == failures
    walk.confirm_order(page)


def test_an_order_confirmed_offline_waits_says_so_and_is_sent_by_itself(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    visitor.set_offline(True)
    page.locator("#confirm").click()
    waiting = (
        "The server cannot be reached just now. The order of your successes and your failures is kept in this browser"
        " and sent by itself; then it counts."
    )
    expect(page.locator("#rank-state")).to_have_text(waiting)
    expect_said(page, waiting)
    expect(page.locator("#rank")).to_have_attribute("data-confirmed", "false")
    expect(page.locator("#confirm")).to_have_attribute("aria-disabled", "true")
    page.locator("#confirm").click(force=True)
    visitor.set_offline(False)
    expect_confirmed(page)
    expect_said(page, CONFIRMED)
    assert [one["version"] for one in versions(visitor, base_url, world_id, "success")] == [1]


def test_an_order_that_waited_through_a_reload_is_sent_and_told(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    page.route("**/rankings/*", lambda route: route.abort())
    page.locator("#confirm").click()
    expect(page.locator("#rank-state")).to_contain_text("The server cannot be reached just now.")
    page.unroute_all()
    page.reload()
    expect_confirmed(page)
    expect(page.locator("#rank-state")).to_contain_text("✓ Confirmed: version 1")
    assert len(versions(visitor, base_url, world_id, "success")) == 1


def test_a_busy_server_gets_the_order_later(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    busy = {"error": {"code": "busy", "message": "Too many writes are waiting.", "fields": {}}}
    page.route("**/rankings/*", lambda route: route.fulfill(status=503, json=busy))
    page.locator("#confirm").click()
    expect(page.locator("#rank-state")).to_have_text(
        "The server is busy just now. The order of your successes and your failures is kept in this browser"
        " and sent by itself; then it counts."
    )
    page.unroute_all()
    expect_confirmed(page)
    assert len(versions(visitor, base_url, world_id, "failure")) == 1


def test_a_browser_whose_cookie_is_gone_keeps_its_order_and_can_save_it(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    orders = {outcome: walk.order_of(page, outcome) for outcome in ("success", "failure")}
    visitor.clear_cookies()
    page.locator("#confirm").click()
    expect(page.locator("#rank-told-text")).to_have_text(
        re.compile("^The server does not know this browser any more as the one that played these attempts: ")
    )
    assert {outcome: walk.order_of(page, outcome) for outcome in orders} == orders
    with page.expect_download() as download:
        page.get_by_role("button", name="Save my order as a file").click()
    lines = [json.loads(line) for line in Path(download.value.path()).read_text().splitlines()]
    assert {line["outcome"]: flat(line["order"]) for line in lines} == orders
    expect(page.locator("#rank")).to_have_attribute("data-confirmed", "false")
