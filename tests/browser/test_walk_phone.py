"""A person with a phone: the pad, swipes, and dragging by finger."""

import re

from playwright.sync_api import Page, expect

from tests.browser import walk


def test_a_person_goes_all_the_way_on_a_phone(phone: Page) -> None:
    phone.goto("/?seed=23")
    first, *others = walk.attempts_for(phone)
    walk.play_by_swipes(phone, first)
    for actions in others:
        walk.play_by_pad(phone, actions)
    expect(phone.locator("#n-successes")).to_have_text("3")
    expect(phone.locator("#n-failures")).to_have_text("3")
    expect(phone.locator("#sync")).to_have_attribute("data-sync", "saved")
    phone.locator("#next").tap()

    one, two, three = walk.order_of(phone, "success")
    cards = phone.locator("#list-success .card")
    walk.drag_by_touch(phone, cards.nth(1), cards.nth(0))
    expect(cards.nth(0)).to_have_attribute("data-demonstration-id", two)
    cards.nth(2).locator('[data-act="up"]').tap()
    expect(cards.nth(1)).to_have_attribute("data-demonstration-id", three)
    assert walk.order_of(phone, "success") == [two, three, one]
    walk.confirm_order(phone)
    phone.locator("#learn").tap()

    expect(phone.locator('[data-part="more"]')).to_be_visible()
    n_learners = len(walk.preselected(phone))
    assert walk.learn(phone) >= 3
    phone.locator('[data-part="compare"]').tap()
    expect(phone).to_have_url(re.compile(r"/runs/[0-9a-f-]{36}/comparison$"))
    expect(phone.locator('[data-part="rows"] tr')).to_have_count(n_learners + 2)


def test_a_phone_needs_no_scrolling_to_play(phone: Page) -> None:
    phone.goto("/?seed=5")
    for part in ("#board", '.pad [data-move="2"]', "#total"):
        box = phone.locator(part).bounding_box()
        assert box is not None
        assert box["y"] >= 0
        assert box["y"] + box["height"] <= 740, part


def test_nothing_is_wider_than_a_phone(phone: Page, base_url: str) -> None:
    world_id, run_id = walk.prepared(phone, base_url)
    for path in (f"/worlds/{world_id}", f"/worlds/{world_id}/rank", f"/runs/{run_id}", f"/runs/{run_id}/comparison"):
        phone.goto(path)
        width = phone.evaluate("document.documentElement.scrollWidth")
        assert width <= 360, f"{path} is {width} px wide"
