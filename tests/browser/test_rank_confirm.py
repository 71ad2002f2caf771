"""Confirming an order: what is asked before, what counts after, and the versions that are kept."""

import re
import uuid

from playwright.sync_api import Browser, BrowserContext, expect

from tests.browser import walk
from tests.browser.confirming import (
    CONFIRMED,
    Api,
    check_axe,
    expect_confirmed,
    expect_said,
    flat,
    move_first_down,
    played,
    rank_page,
    touch_both,
    versions,
)
from tests.browser.conftest import scripts_watched

RANDOM_BOTH = (
    "You have not moved anything in your successes or your failures."
    " Both lists stand in a random order. Are they yours?"
)


def test_an_untouched_random_order_is_asked_about_and_going_on_sends_nothing(
    visitor: BrowserContext, base_url: str
) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    expect(page.locator("#rank-state")).to_have_text("An order counts once you confirm it.")
    page.locator("#confirm").focus()
    page.keyboard.press("Enter")
    dialog = page.get_by_role("dialog", name="Is this your order?")
    expect(dialog).to_have_accessible_description(RANDOM_BOTH)
    expect(page.locator("#untouched-title")).to_be_focused()
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    expect(page.locator("#confirm")).to_be_focused()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    expect(dialog.get_by_role("button", name="Go on ordering")).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.locator('#list-success .card[data-position="1"]')).to_be_focused()
    assert versions(visitor, base_url, world_id, "success") == []


def test_an_untouched_order_that_is_theirs_counts_and_says_so(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    page.locator("#confirm").focus()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect_confirmed(page)
    expect_said(page, CONFIRMED)
    expect(page.locator("#rank-state")).to_have_text(
        "✓ Confirmed: version 1 of your successes and of your failures counts. You can still change it."
    )
    expect(page.locator("#learn")).to_be_focused()
    expect(page.locator('.path-step[data-step="rank"]')).to_have_attribute("data-done", "true")
    for outcome in ("success", "failure"):
        (only,) = versions(visitor, base_url, world_id, outcome)
        assert only["untouched"] is True
        assert flat(only["order"]) == walk.order_of(page, outcome)


def test_only_what_is_untouched_is_asked_about(visitor: BrowserContext, base_url: str) -> None:
    page = rank_page(visitor, played(visitor, base_url))
    move_first_down(page, "success")
    page.locator("#confirm").click()
    expect(page.locator("#untouched-text")).to_have_text(
        "You have not moved anything in your failures. They stand in a random order. Is it yours?"
    )
    page.locator('#untouched [value="no"]').click()
    move_first_down(page, "failure")
    page.locator("#confirm").click()
    expect_confirmed(page)
    expect_said(page, CONFIRMED)


def test_confirming_twice_in_a_hurry_makes_one_version(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    page.locator("#confirm").evaluate("button => { button.click(); button.click(); button.click(); }")
    expect_confirmed(page)
    page.reload()
    expect_confirmed(page)
    for outcome in ("success", "failure"):
        assert [one["version"] for one in versions(visitor, base_url, world_id, outcome)] == [1]


def test_a_change_has_to_be_confirmed_again_unless_it_is_undone(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    walk.confirm_order(page)
    move_first_down(page, "failure")
    expect(page.locator("#rank")).to_have_attribute("data-confirmed", "false")
    expect(page.locator("#rank-state")).to_have_text(
        "Your failures have changed since version 1. The new order counts once you confirm it."
    )
    expect(page.locator("#learn")).to_be_hidden()
    page.locator("#undo").click()
    expect_confirmed(page)
    page.locator("#redo").click()
    walk.confirm_order(page)
    expect_said(page, "Confirmed: version 2 of your failures counts. Next: Learn.")
    assert len(versions(visitor, base_url, world_id, "success")) == 1


def test_an_earlier_order_can_be_looked_at_and_taken_again(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    walk.confirm_order(page)
    first = walk.order_of(page, "success")
    move_first_down(page, "success")
    walk.confirm_order(page)
    panel = page.locator("#versions")
    expect(panel.locator("summary").first).to_contain_text(
        re.compile(r"Successes: version 2 counts, confirmed \d\d:\d\d · 1 earlier one is kept")
    )
    panel.locator("summary").first.press("Enter")
    successes = panel.locator("section").filter(has=page.get_by_role("heading", name="Successes"))
    expect(successes.locator(".version")).to_have_count(2)
    newest, older = successes.locator(".version").all()
    expect(newest.locator(".version-words")).to_have_text(
        re.compile(r"^Version 2 · \d\d:\d\d · in two lists · counts$")
    )
    expect(newest.locator("button")).to_have_text("Stands so now")
    older.locator("summary").press("Enter")
    expect(older.locator(".mini")).to_have_count(3)
    assert [card.get_attribute("data-id") for card in older.locator(".mini").all()] == first
    older.get_by_role("button", name="Take version 1 of your successes again").press("Enter")
    expect_said(page, "Your successes stand as in version 1 again. It counts once you confirm it.")
    assert walk.order_of(page, "success") == first
    walk.confirm_order(page)
    assert [flat(one["order"]) for one in versions(visitor, base_url, world_id, "success")][::2] == [first, first]


def test_axe_finds_nothing_in_any_state_of_confirming(browser: Browser, base_url: str) -> None:
    with scripts_watched(browser.new_context(base_url=base_url, reduced_motion="reduce")) as context:
        world_id = played(context, base_url)
        page = rank_page(context, world_id)
        page.locator("#confirm").click()
        check_axe(page, "an untouched order")
        page.locator('#untouched [value="yes"]').click()
        expect_confirmed(page)
        for panel in ("#agreement", "#versions"):
            page.locator(f"{panel} > summary").click()
        page.locator(".version summary").first.click()
        expect(page.locator(".version .mini").first).to_be_visible()
        check_axe(page, "confirmed")
        move_first_down(page, "success")
        client = Api(context, base_url)
        order = [[id_] for id_ in reversed(walk.order_of(page, "success"))]
        client.put(f"/worlds/{world_id}/rankings/success", {"order": order, "confirmed": True})
        page.locator("#confirm").click()
        expect(page.locator("#conflict")).to_be_visible()
        check_axe(page, "two orders")
        page.keyboard.press("Escape")
        expect(page.locator("#rank-told")).to_be_visible()
        check_axe(page, "a notice")


def test_forty_cards_can_be_compared(visitor: BrowserContext, base_url: str) -> None:
    client = Api(visitor, base_url)
    world_id = str(client.post("/worlds", {"seed": 5})["id"])
    for n in range(40):
        actions = [1, 2, 1, 2, 3, 0][: 1 + n % 6] + [3] * (n // 6)
        body = {"id": str(uuid.uuid4()), "actions": actions, "step_ms": [1.0] * len(actions), "ending": "gave_up"}
        client.post(f"/worlds/{world_id}/demonstrations", body)
    page = rank_page(visitor, world_id)
    move_first_down(page, "failure")
    order = walk.order_of(page, "failure")
    other = [[order[1]], [order[0]], [order[2], order[3]], *([id_] for id_ in order[4:])]
    client.put(f"/worlds/{world_id}/rankings/failure", {"order": other, "confirmed": True})
    page.locator("#confirm").click()
    expect(page.locator("#conflict-text")).to_contain_text("3 of 40 stand elsewhere.")
    expect(page.locator("#orders-mine .mini:visible")).to_have_count(40)
    page.get_by_label("Show only what stands elsewhere").check()
    expect(page.locator("#orders-mine .mini:visible")).to_have_count(3)
    page.get_by_label("Show only what stands elsewhere").uncheck()
    page.locator("#orders").focus()
    page.keyboard.press("End")
    expect(page.locator("#orders-theirs .mini").last).to_be_in_viewport()
    expect(page.get_by_role("button", name="Mine counts")).to_be_in_viewport()
    page.locator("#orders-mine .mini").last.hover()
    expect(page.locator("#orders-theirs .mini").last).to_have_attribute("data-twin", "true")
