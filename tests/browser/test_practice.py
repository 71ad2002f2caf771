"""The first minute: the practice by keyboard, touch and gamepad, enlarged, and remembered."""

import pytest
from playwright.sync_api import Browser, Page, Request, expect

from tests.browser import walk
from tests.browser.conftest import watched
from tests.browser.gamepad import Gamepad
from tests.browser.test_pages import SCHEMES, Scheme, check_axe

UP, RIGHT, DOWN = 0, 1, 2
OVER_BLUE = [UP, RIGHT, RIGHT, RIGHT, DOWN]
THROUGH_RED = [RIGHT, RIGHT, RIGHT]
FRONT_DOOR = "/?seed=5"


def test_somebody_new_practises_by_keyboard_alone(page: Page) -> None:
    page.goto(FRONT_DOOR)
    page.locator("#practice-begin").focus()
    page.keyboard.press("Enter")
    expect(page.locator("#practice-board")).to_be_focused()
    expect_part(page, "move", "press an arrow key")
    page.keyboard.press("ArrowUp")
    expect_part(page, "goal", "walk to the flag over blue")
    press(page, OVER_BLUE[1:])
    expect_part(page, "goal", "A success: the goal paid 7, and +5.6 is left of it.")
    page.keyboard.press("Enter")
    expect_part(page, "fail", "Now fail on purpose")
    press(page, THROUGH_RED)
    expect_part(page, "done", "A useful failure")
    page.keyboard.press("Enter")
    check_back_on_the_real_board(page)


def test_somebody_new_practises_by_touch_alone(phone: Page) -> None:
    phone.goto(FRONT_DOOR)
    phone.locator("#practice-begin").tap()
    expect_part(phone, "move", "swipe on the board")
    walk.swipe(phone, phone.locator("#practice-board"), UP)
    expect_part(phone, "goal", "over blue")
    for action in OVER_BLUE[1:]:
        phone.locator(f'[data-practice-move="{action}"]').tap()
    phone.locator('[data-practice="goOn"]').tap()
    expect_part(phone, "fail", "press Give up")
    walk.swipe(phone, phone.locator("#practice-board"), RIGHT)
    phone.locator('[data-practice="giveUp"]').tap()
    expect_part(phone, "done", "A useful failure")
    phone.locator('[data-practice="goOn"]').tap()
    check_back_on_the_real_board(phone)


def test_a_tap_on_the_next_square_is_a_step(phone: Page) -> None:
    phone.goto(FRONT_DOOR)
    phone.locator("#practice-begin").tap()
    box = phone.locator("#practice-board").bounding_box()
    assert box is not None
    phone.touchscreen.tap(box["x"] + box["width"] / 8, box["y"] + box["height"] / 6)
    expect_part(phone, "goal", "over blue")


def test_somebody_new_practises_by_gamepad(page: Page) -> None:
    gamepad = Gamepad(page)
    page.goto(FRONT_DOOR)
    gamepad.connect()
    page.locator("#practice-begin").click()
    expect_part(page, "move", "the stick or the d-pad")
    gamepad.walk(OVER_BLUE)
    gamepad.press("A")
    expect_part(page, "fail", "give up with Back")
    gamepad.press("down")
    gamepad.press("B")
    expect(page.locator("#practice-total")).to_have_text("0.0")
    gamepad.push(1, 0)
    gamepad.press("Back")
    expect_part(page, "done", "A useful failure")
    gamepad.press("A")
    check_back_on_the_real_board(page)


def test_whoever_fails_when_asked_to_succeed_tries_once_more(page: Page) -> None:
    page.goto(FRONT_DOOR)
    page.locator("#practice-begin").click()
    press(page, THROUGH_RED)
    expect_part(page, "goal", "the red took more than the goal paid, −2.3 in all")
    page.locator('[data-practice="goOn"]').click()
    expect(page.locator("#practice-board")).to_be_focused()
    press(page, OVER_BLUE)
    expect_part(page, "goal", "A success")


def test_at_400_percent_the_sentence_stays_beside_the_board_and_the_rest_scrolls(
    browser: Browser, base_url: str
) -> None:
    context = browser.new_context(base_url=base_url, viewport={"width": 320, "height": 256})
    page = context.new_page()
    with watched(page, base_url):
        page.goto(FRONT_DOOR)
        page.locator("#practice-begin").click()
        check_in_sight(page, "#practice-words", "#practice-board")
        press(page, OVER_BLUE)
        check_in_sight(page, "#practice-words", '[data-practice="goOn"]')
        page.locator('[data-practice="goOn"]').click()
        check_in_sight(page, "#practice-words", "#practice-board")
        press(page, THROUGH_RED)
        check_in_sight(page, "#practice-words", '[data-practice="goOn"]')
        page.locator('[data-practice-move="2"]').scroll_into_view_if_needed()
        check_in_sight(page, '[data-practice-move="2"]')
        page.locator('[data-practice="leave"]').click()
        expect(page.locator("#practice")).to_be_hidden()
    context.close()


def test_the_practice_is_offered_until_it_is_answered(page: Page) -> None:
    page.goto(FRONT_DOOR)
    page.locator("#practice-begin").click()
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Escape")
    expect(page.locator("#practice")).to_be_hidden()
    expect(page.locator("#board")).to_be_focused()
    expect(page.locator("#practice-offer")).to_be_hidden()
    page.goto("/?seed=6")
    expect(page.locator("#practice-offer")).to_be_hidden()
    page.locator("#options summary").click()
    page.locator("#practise-again").click()
    expect_part(page, "move", "This is you")


def test_skipping_is_an_answer_and_the_board_has_the_focus(page: Page) -> None:
    page.goto(FRONT_DOOR)
    page.locator("#practice-skip").click()
    expect(page.locator("#practice-offer")).to_be_hidden()
    expect(page.locator("#board")).to_be_focused()
    page.reload()
    expect(page.locator("#practice-offer")).to_be_hidden()


def test_the_first_key_on_the_page_counts_without_any_practice(page: Page) -> None:
    page.goto(FRONT_DOOR)
    expect(page.locator("#practice-offer")).to_be_visible()
    page.keyboard.press("ArrowRight")
    expect(page.locator("#n-steps")).to_have_text("1")


def test_nothing_of_the_practice_leaves_the_browser(page: Page) -> None:
    page.goto(FRONT_DOOR)
    page.locator("#practice-begin").click()
    sent: list[str] = []
    page.on("request", lambda request: note(request, sent))
    press(page, OVER_BLUE)
    page.keyboard.press("Enter")
    press(page, THROUGH_RED)
    page.keyboard.press("Enter")
    check_back_on_the_real_board(page)
    page.wait_for_timeout(200)  # a request would have gone by then
    assert sent == []


def test_what_happens_is_said_within_the_dialog(page: Page) -> None:
    """Beneath an open dialog nothing is spoken, so it has a live region of its own."""
    page.goto(FRONT_DOOR)
    page.locator("#practice-begin").click()
    heard = page.locator("#practice [data-announcer]")
    page.keyboard.press("ArrowUp")
    expect(heard).to_contain_text(
        "−0.4. Blue squares cost little and red ones a lot: walk to the flag over blue. Row 1, column 1."
    )
    page.keyboard.press("ArrowUp")
    expect(heard).to_contain_text("Bumped.")
    page.keyboard.press("i")
    expect(heard).to_contain_text("The goal is 1 down and 3 right.")
    page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("Shift+ArrowDown")
    expect(heard).to_contain_text("Row 2, column 2: red")
    expect(page.locator("#practice-total")).to_have_text("−0.8")
    press(page, OVER_BLUE[1:])
    expect(heard).to_contain_text("A success")
    expect(heard).to_contain_text("Go on: Enter.")
    expect(page.locator("#practice")).to_match_aria_snapshot("""
      - dialog "Practice":
        - heading "Practice" [level=2]
        - button "Leave"
        - list:
          - listitem: Move
          - listitem: Succeed
          - listitem: Fail
        - paragraph: /A success/
        - application "Practice world of 3 by 4 squares. Arrow keys move you."
    """)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_axe_finds_nothing_in_any_part_of_the_practice(page: Page, scheme: Scheme) -> None:
    page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
    page.goto(FRONT_DOOR)
    page.locator("#practice-begin").click()
    check_axe(page, "practice: move")
    press(page, OVER_BLUE)
    check_axe(page, "practice: a success")
    page.keyboard.press("Enter")
    check_axe(page, "practice: fail")
    press(page, THROUGH_RED)
    check_axe(page, "practice: done")
    page.keyboard.press("Enter")
    page.locator("#options summary").click()
    check_axe(page, "options")


def expect_part(page: Page, part: str, words: str) -> None:
    expect(page.locator("#practice")).to_have_attribute("data-part", part)
    expect(page.locator("#practice-words")).to_contain_text(words)


def press(page: Page, actions: list[int]) -> None:
    for action in actions:
        page.keyboard.press(walk.KEYS[action])


def check_back_on_the_real_board(page: Page) -> None:
    expect(page.locator("#practice")).to_be_hidden()
    expect(page.locator("#practice-offer")).to_be_hidden()
    expect(page.locator("#board")).to_be_focused()
    expect(page.locator("#n-steps")).to_have_text("0")
    assert page.evaluate("localStorage.getItem('irlfr:practice')") == "done"


def check_in_sight(page: Page, *selectors: str) -> None:
    """Wholly within the dialog, none covered by the one before."""
    dialog = page.locator("#practice").bounding_box()
    assert dialog is not None
    floor = dialog["y"]
    for selector in selectors:
        box = page.locator(selector).bounding_box()
        assert box is not None
        assert box["y"] >= floor - 1, selector
        floor = box["y"] + box["height"]
        assert box["y"] + box["height"] <= dialog["y"] + dialog["height"] + 1, selector
        assert box["x"] >= dialog["x"], selector
        assert box["x"] + box["width"] <= dialog["x"] + dialog["width"], selector


def note(request: Request, sent: list[str]) -> None:
    if request.resource_type in {"fetch", "xhr", "ping"}:
        sent.append(request.url)
