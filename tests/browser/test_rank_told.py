"""What the lists say and show while they are put in order: word by word, with the focus kept, in every look."""

import re
from collections.abc import Iterator
from typing import Any, Final, Literal

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser import ranking, ways
from tests.live_server import LiveServer

DESK: dict[str, Any] = {"viewport": {"width": 1280, "height": 800}}
PHONE: dict[str, Any] = {"viewport": {"width": 360, "height": 740}, "has_touch": True, "is_mobile": True}
SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
HOW = "Arrows move it, T ties it with the one above, Space puts it down, Escape puts it back."


@pytest.fixture
def six(page: Page, base_url: str) -> Page:
    """Six successes and two failures, motion reduced."""
    page.emulate_media(reduced_motion="reduce")
    world_id = ranking.played_before(page, base_url, successes=6, failures=2)
    ranking.open_lists(page, world_id, n_cards=8)
    return page


def nth(page: Page, at: int) -> Locator:
    return page.locator("#list-success .card").nth(at)


def words(card: Locator) -> str:
    """A card's words without its place."""
    return (card.get_attribute("aria-label") or "").partition(", place")[0]


def test_a_card_says_what_it_is_and_where_it_stands(six: Page) -> None:
    label = nth(six, 1).get_attribute("aria-label") or ""
    assert re.fullmatch(r"Success with \+\d+\.\d in \d+ steps, place 2 of 6", label), label
    nth(six, 1).locator('[data-act="tie"]').click()
    expect(nth(six, 0)).to_have_attribute("aria-label", re.compile(r", place 1 of 6, shared with 1 other$"))
    expect(nth(six, 1)).to_have_attribute("aria-label", re.compile(r", place 1 of 6, shared with 1 other$"))
    expect(six.locator("#list-success .group-place")).to_have_text(["1=", "3.", "4.", "5.", "6."])


def test_the_keyboard_is_told_every_step(six: Page) -> None:
    card, above = words(nth(six, 1)), words(nth(six, 0))
    nth(six, 1).focus()
    said = iter(
        [
            ("Space", f"Lifted: {card}, place 2 of 6. {HOW}"),
            ("ArrowUp", "Place 1 of 6. Weight 0.29."),
            ("ArrowUp", "It stands first already."),
            ("t", "Nothing stands above it that it could be tied with."),
            ("End", "Place 6 of 6. Weight 0.05."),
            ("ArrowDown", "It stands last already."),
            ("PageUp", "Place 1 of 6. Weight 0.29."),
            ("PageDown", "Place 6 of 6. Weight 0.05."),
            ("Home", "Place 1 of 6. Weight 0.29."),
            ("ArrowDown", "Place 2 of 6. Weight 0.24."),
            ("t", f"Tied with the {above[0].lower()}{above[1:]}: place 1 of 6. Weight 0.26."),
            ("t", "No longer tied: place 2 of 6. Weight 0.24."),
            ("Space", f"Put down: {card}, place 2 of 6. Weight 0.24."),
        ]
    )
    for key, sentence in said:
        six.keyboard.press(key)
        ways.expect_said(six, sentence)
        assert six.evaluate("document.activeElement.getAttribute('aria-label')").startswith(card), f"focus after {key}"


def test_escape_puts_a_lifted_card_back_and_one_undo_takes_back_a_whole_lift(six: Page) -> None:
    before = ranking.order_shown(six, "success")
    card = words(nth(six, 3))
    nth(six, 3).focus()
    for key in ("Space", "ArrowUp", "t", "ArrowUp", "Home"):
        six.keyboard.press(key)
    assert ranking.order_shown(six, "success") != before
    six.keyboard.press("Escape")
    ways.expect_said(six, f"Put back: {card}, place 4 of 6.")
    assert ranking.order_shown(six, "success") == before
    expect(nth(six, 3)).to_be_focused()
    expect(nth(six, 3)).to_have_attribute("data-lifted", "false")

    for key in ("Space", "ArrowUp", "ArrowUp", "Space"):
        six.keyboard.press(key)
    after = ranking.order_shown(six, "success")
    six.keyboard.press("z")
    assert ranking.order_shown(six, "success") == before
    six.keyboard.press("Shift+z")
    assert ranking.order_shown(six, "success") == after


def test_a_lifted_card_that_loses_the_focus_is_put_down_where_it_is(six: Page) -> None:
    lifted = nth(six, 3)
    lifted.focus()
    six.keyboard.press("Space")
    six.keyboard.press("ArrowUp")
    after = ranking.order_shown(six, "success")
    six.locator("#undo").focus()
    expect(six.locator('.card[data-lifted="true"]')).to_have_count(0)
    assert ranking.order_shown(six, "success") == after


def test_arrows_go_from_card_to_card_and_tab_to_the_buttons_of_one(six: Page) -> None:
    nth(six, 0).focus()
    for key, at in (("ArrowDown", 1), ("End", 5), ("ArrowDown", 5), ("ArrowUp", 4), ("Home", 0), ("PageDown", 5)):
        six.keyboard.press(key)
        expect(nth(six, at)).to_be_focused()
    six.keyboard.press("Tab")
    expect(nth(six, 5).locator('[data-act="up"]')).to_be_focused()
    for _ in ("tie", "compare", "sort the failures", "their first"):
        six.keyboard.press("Tab")
    expect(six.locator("#list-failure .card").first).to_be_focused()


def test_buttons_move_tie_and_part_and_keep_the_focus(six: Page) -> None:
    card, above = words(nth(six, 1)), words(nth(six, 0))
    nth(six, 1).locator('[data-act="tie"]').press("Enter")
    ways.expect_said(six, f"Tied with the {above[0].lower()}{above[1:]}: place 1 of 6. Weight 0.26.")
    expect(nth(six, 1).locator('[data-act="tie"]')).to_be_focused()
    expect(nth(six, 1).locator('[data-act="tie"]')).to_have_attribute("aria-pressed", "true")
    six.keyboard.press("Enter")
    ways.expect_said(six, "No longer tied: place 2 of 6. Weight 0.24.")
    nth(six, 1).locator('[data-act="down"]').press("Enter")
    ways.expect_said(six, f"{card}, place 3 of 6. Weight 0.19.")
    expect(nth(six, 2).locator('[data-act="down"]')).to_be_focused()
    for _ in range(3):
        six.keyboard.press("Enter")
    ways.expect_said(six, f"{card}, place 6 of 6. Weight 0.05.")
    expect(nth(six, 5)).to_be_focused()


def test_sorting_says_how(six: Page) -> None:
    six.locator('[data-sort="success"]').click()
    ways.expect_said(six, "Sorted by total, the highest first.")
    six.locator('[data-sort="success"]').click()
    ways.expect_said(six, "It is sorted by total already.")


def test_two_cards_are_marked_to_be_compared(six: Page) -> None:
    card = words(nth(six, 0))
    nth(six, 0).focus()
    six.keyboard.press("c")
    ways.expect_said(six, f"To compare: {card}. Press C on the other one; Escape forgets it.")
    expect(nth(six, 0).locator('[data-act="compare"]')).to_have_attribute("aria-pressed", "true")
    six.keyboard.press("Escape")
    ways.expect_said(six, "Nothing is marked to compare any more.")
    expect(nth(six, 0).locator('[data-act="compare"]')).to_have_attribute("aria-pressed", "false")


def test_by_mouse_the_next_step_of_comparing_is_seen(six: Page) -> None:
    hint = six.locator("#list-success").locator("xpath=ancestor::section").locator(".column-hint")
    expect(hint).to_be_hidden()
    stands = nth(six, 0).bounding_box()
    nth(six, 0).locator('[data-act="compare"]').click()
    assert nth(six, 0).bounding_box() == stands
    ways.expect_said(six, f"To compare: {words(nth(six, 0))}. Now press Compare on the other one.")
    expect(hint).to_be_visible()
    expect(six.locator(".column-hint:visible")).to_have_count(1)
    nth(six, 0).locator('[data-act="compare"]').click()
    expect(hint).to_be_hidden()


def test_the_last_undo_keeps_the_focus_and_one_more_says_that_there_is_none(six: Page) -> None:
    nth(six, 0).locator('[data-act="down"]').click()
    undo = six.locator("#undo")
    undo.focus()
    six.keyboard.press("Enter")
    ways.expect_said(six, "Undone.")
    expect(undo).to_be_disabled()
    expect(undo).to_be_focused()
    six.keyboard.press("Enter")
    ways.expect_said(six, "There is nothing to undo.")


def test_where_nothing_can_be_ordered_nothing_is_explained_and_the_way_on_stands_there(
    page: Page, base_url: str
) -> None:
    world_id = ranking.played_before(page, base_url, successes=1)
    ranking.open_lists(page, world_id, n_cards=1)
    for part in ("#how", "#undo", "#redo", "#confirm"):
        expect(page.locator(part)).to_be_hidden()
    expect(nth(page, 0).locator("button:enabled")).to_have_count(0)
    expect(page.locator("#rank-state")).to_have_text("One attempt alone needs no order. Go on, or play more.")
    expect(page.locator("#learn")).to_be_visible()


def test_in_a_low_window_the_foot_covers_no_card(page: Page, base_url: str) -> None:
    page.set_viewport_size({"width": 640, "height": 400})
    world_id = ranking.played_before(page, base_url, successes=6, failures=2)
    ranking.open_lists(page, world_id, n_cards=8)
    nth(page, 2).focus()
    box, foot = nth(page, 2).bounding_box(), page.locator(".rank-next").bounding_box()
    assert box is not None
    assert foot is not None
    assert box["y"] >= 0
    assert box["y"] + box["height"] <= 400
    assert foot["y"] >= 400


def test_a_drag_shows_every_weight_it_would_make_and_moves_nothing_else(six: Page) -> None:
    before = ranking.order_shown(six, "success")
    last, second = before[5][0], before[1][0]
    boxes = """() => [...document.querySelectorAll("#list-success .group")]
      .map((one) => one.getBoundingClientRect().y + scrollY)"""
    stood = six.evaluate(boxes)
    six.mouse.move(*six.evaluate(ranking.GRIP, last))
    six.mouse.down()
    six.mouse.move(*six.evaluate(ranking.SIDE, [second, "beside"]), steps=4)
    expect(six.locator('#list-success ~ .landing [data-mark="bracket"]')).to_be_visible()
    would = {id_: six.locator(f'.card[data-demonstration-id="{id_}"]').get_attribute("data-would") for [id_] in before}
    assert would[last] == would[second] == f"{(5 + 4) / 2 / 21:.6f}"
    assert would[before[0][0]] is None
    assert six.evaluate(boxes) == stood
    six.mouse.move(*six.evaluate(ranking.SIDE, [second, "above"]))
    expect(six.locator('.cards-frame[data-landing="above"] [data-mark="bar"]')).not_to_have_attribute("hidden", "")
    expect(six.locator(f'.card[data-demonstration-id="{last}"]')).to_have_attribute("data-would", f"{5 / 21:.6f}")
    label = words(nth(six, 5))
    six.mouse.up()
    ways.expect_said(six, f"{label}, place 2 of 6. Weight 0.24.")
    expect(six.locator("[data-would], .landing > :not([hidden])")).to_have_count(0)
    assert ranking.order_shown(six, "success") == [before[0], [last], *before[1:5]]


def lifted_by_mouse(page: Page) -> str:
    """The last success is held above the first; its words."""
    order = ranking.order_shown(page, "success")
    page.mouse.move(*page.evaluate(ranking.GRIP, order[-1][0]))
    page.mouse.down()
    page.mouse.move(*page.evaluate(ranking.SIDE, [order[0][0], "above"]), steps=3)
    expect(page.locator('.card[data-flying="true"]')).to_have_count(1)
    return words(nth(page, 5))


@pytest.mark.parametrize("end", ["escape", "aside", "cancel"])
def test_a_drag_that_is_broken_off_puts_the_card_back(six: Page, end: str) -> None:
    before = ranking.order_shown(six, "success")
    card = lifted_by_mouse(six)
    if end == "escape":
        six.keyboard.press("Escape")
    elif end == "aside":
        six.mouse.move(640, 300)
        six.mouse.up()
    else:
        six.evaluate(
            "() => document.dispatchEvent(new PointerEvent('pointercancel', {pointerId: 1, pointerType: 'mouse'}))"
        )
    ways.expect_said(six, f"Put back: {card}, place 6 of 6.")
    six.mouse.up()
    expect(six.locator('.card[data-flying="true"]')).to_have_count(0)
    assert ranking.order_shown(six, "success") == before
    expect(six.locator("#undo")).to_be_disabled()


def test_the_right_button_drags_nothing_and_no_text_is_selected(six: Page) -> None:
    before = ranking.order_shown(six, "success")
    x, y = six.evaluate(ranking.GRIP, before[5][0])
    six.mouse.move(x, y)
    six.mouse.down(button="right")
    six.mouse.move(x, y - 300, steps=3)
    expect(six.locator('.card[data-flying="true"]')).to_have_count(0)
    six.mouse.up(button="right")
    lifted_by_mouse(six)
    assert six.evaluate("getSelection().toString()") == ""
    six.mouse.up()


def test_a_card_held_at_an_end_of_the_window_scrolls_the_page(page: Page, base_url: str) -> None:
    world_id = ranking.played_before(page, base_url, successes=20, failures=3)
    ranking.open_lists(page, world_id, n_cards=23)
    first = ranking.order_shown(page, "success")[0][0]
    x, y = page.evaluate(ranking.GRIP, first)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, 790, steps=4)
    page.wait_for_function("() => scrollY + innerHeight >= document.documentElement.scrollHeight - 1")
    page.mouse.up()
    assert ranking.order_shown(page, "success")[-1] == [first]


def test_a_finger_scrolls_the_page_by_a_card_and_drags_it_by_its_board(browser: Browser, base_url: str) -> None:
    with ways.visit(browser, base_url, **PHONE) as phone:
        world_id = ranking.played_before(phone, base_url, successes=6, failures=2)
        ranking.open_lists(phone, world_id, n_cards=8)
        before = ranking.order_shown(phone, "success")
        finger = ranking.Finger(phone)
        box = nth(phone, 2).locator(".card-words").bounding_box()
        assert box is not None
        x, y = box["x"] + 10, box["y"] + 10
        finger.touch("touchStart", (x, y))
        for part in range(1, 6):
            finger.touch("touchMove", (x, y - 40 * part))
        finger.touch("touchEnd")
        phone.wait_for_function("() => scrollY > 60")
        assert ranking.order_shown(phone, "success") == before
        grip = nth(phone, 3).locator(".card-grip")
        grip.tap()
        expect(nth(phone, 3).locator(".agent")).to_have_count(1)
        expect(nth(phone, 3)).to_have_attribute("data-watching", "true")


#: In one breath: on a busy machine a glide is over before one can ask about it.
GLIDES: Final = """() => {
  document.querySelector("#list-success [data-act=down]").click();
  const all = document.getAnimations().map(({ effect }) => effect);
  const glides = all.filter((effect) => effect.getKeyframes()[0].translate);
  return [glides.length, all.map((effect) => effect.getTiming().duration)];
}"""


def test_cards_glide_to_their_places_and_not_where_motion_is_reduced(page: Page, base_url: str) -> None:
    world_id = ranking.played_before(page, base_url, successes=3)
    for moves in (True, False):
        page.emulate_media(reduced_motion="no-preference" if moves else "reduce")
        ranking.open_lists(page, world_id, n_cards=3)
        glides, lengths = page.evaluate(GLIDES)
        assert (glides > 0) == moves
        assert all(length <= 200 for length in lengths)


def test_nothing_to_touch_is_too_small(browser: Browser, base_url: str) -> None:
    for device, least in ((DESK, 24), (PHONE, 44)):
        with ways.visit(browser, base_url, **device) as page:
            world_id = ranking.played_before(page, base_url, successes=20, failures=3)
            ranking.open_lists(page, world_id, n_cards=23)
            nth(page, 1).locator('[data-act="tie"]').click()
            sizes = page.evaluate(
                "() => [...document.querySelectorAll('#list-success button')].map((one) => one.getBoundingClientRect())"
                ".map(({ width, height }) => Math.min(width, height))"
            )
            assert min(sizes) > least - 0.01  # a grid's tracks are a hair off


def test_a_narrow_window_needs_no_scrolling_sideways(page: Page, base_url: str) -> None:
    world_id = ranking.played_before(page, base_url, successes=20, failures=3)
    ranking.open_lists(page, world_id, n_cards=23)
    nth(page, 1).locator('[data-act="tie"]').click()
    for width in (640, 360, 320):
        page.set_viewport_size({"width": width, "height": 400})
        assert page.evaluate("document.querySelector('.rank-columns').scrollWidth") <= width
        wide = page.evaluate(
            "() => [...document.querySelectorAll('.card *')].filter((one) => !one.closest('irl-board') &&"
            " one.getBoundingClientRect().right > one.closest('.card').getBoundingClientRect().right + 1)"
            ".map((one) => one.className)"
        )
        assert wide == [], width


def states(page: Page) -> Iterator[str]:
    yield "many cards"
    nth(page, 1).locator('[data-act="tie"]').click()
    yield "a tie"
    nth(page, 3).focus()
    page.keyboard.press("Space")
    yield "a lifted card"
    page.keyboard.press("Escape")
    page.mouse.move(*page.evaluate(ranking.GRIP, ranking.order_shown(page, "success")[4][0]))
    page.mouse.down()
    page.mouse.move(*page.evaluate(ranking.SIDE, [ranking.order_shown(page, "success")[6][0], "beside"]))
    yield "a dragged card"
    page.mouse.up()


def test_axe_finds_nothing(browser: Browser, base_url: str) -> None:
    with ways.visit(browser, base_url, reduced_motion="reduce", **DESK) as page:
        world_id = ranking.played_before(page, base_url, successes=20, failures=3)
        ranking.open_lists(page, world_id, n_cards=23)
        for state in states(page):
            for scheme in SCHEMES:
                page.emulate_media(color_scheme=scheme)
                results = Axe().run(page)
                assert results.violations_count == 0, f"{state}, {scheme}:\n{results.generate_report()}"


def test_a_study_that_hides_totals_hides_them_in_every_word(browser: Browser, discreet: LiveServer) -> None:
    with ways.visit(browser, discreet.address) as page:
        world_id = ranking.world_with(page, discreet.address, successes=3)
        ranking.open_lists(page, world_id, n_cards=3)
        expect(page.locator(".card-total, [data-sort]")).to_have_count(0)
        card = words(nth(page, 1))
        assert re.fullmatch(r"Success in \d+ steps", card)
        nth(page, 1).focus()
        page.keyboard.press("Space")
        ways.expect_said(page, f"Lifted: {card}, place 2 of 3. {HOW}")
        page.keyboard.press("t")
        expect(page.locator("#announcer")).to_have_text(
            re.compile(r"Tied with the success in \d+ steps: place 1 of 3\. Weight 0\.42\.")
        )
