"""By keyboard alone, by touch alone, by gamepad alone: from the first page through failures and successes."""

import re

from playwright.sync_api import Page, expect

from tests.browser import walk, ways
from tests.browser.gamepad import Gamepad
from tests.browser.ways import CHEAP, SMALL


def test_tab_leads_through_the_page_in_the_order_it_is_read(page: Page) -> None:
    page.goto(SMALL)
    skip = page.locator(".skip-link")
    assert ways.tab_to(page, skip) == ["Skip to the page"]
    page.keyboard.press("Enter")
    board = page.locator("#board")
    assert len(ways.tab_to(page, board)) == 1
    page.keyboard.press("ArrowRight")
    passed = ways.tab_to(page, page.locator("#as-text summary"))
    assert passed == [
        "Numbers",
        "Options",
        "Undo Z",
        "Restart R",
        "Give up G",
        "Practise",
        "Skip",
        "The board as text",
    ]
    ways.tab_to(page, board, "Shift+Tab")


def test_every_key_does_what_the_list_of_keys_says(page: Page) -> None:
    page.goto(SMALL)
    for keys, state in (
        (["ArrowRight"], 1),
        (["d", "s"], 6),
        (["h", "j"], 9),
        (["k", "l"], 6),
        (["w", "a"], 1),
        (["z"], 2),
        (["u", "Backspace"], 5),
        (["Shift+ArrowUp"], 5),
        (["r"], 0),
    ):
        ways.press(page, *keys)
        ways.expect_state(page, state)
    ways.press(page, "ArrowDown", "g")
    ways.expect_shows(page, "result")
    expect(page.locator("#result-text")).to_have_text("You stopped after 1 step, at −0.5.")
    page.keyboard.press("Enter")
    ways.expect_shows(page, "playing")
    ways.expect_state(page, 0)


def test_the_cursor_looks_around_while_the_agent_stays(page: Page) -> None:
    page.goto(SMALL)
    cursor, hint = page.locator("#board .board-cursor"), page.locator("#hint")
    ways.press(page, "ArrowRight", "Shift+ArrowRight")
    expect(cursor).to_have_count(1)
    expect(hint).to_have_text("Row 1, column 3: red, −3.2.")
    ways.press(page, "Shift+ArrowDown")
    expect(hint).to_have_text("Row 2, column 3: blue, −0.5.")
    page.keyboard.press("Escape")
    expect(cursor).to_have_count(0)
    page.keyboard.press("i")
    expect(hint).to_contain_text("Row 1, column 2.")
    expect(hint).to_contain_text("The goal is 2 down and 2 right.")
    ways.expect_state(page, 1)
    expect(page.locator("#n-steps")).to_have_text("1")
    page.keyboard.press("ArrowDown")
    expect(hint).to_contain_text("Arrow keys")  # what was said of another square is over


def test_an_attempt_is_tried_again_from_the_midst_of_another_by_keyboard_alone(page: Page, base_url: str) -> None:
    page.goto(SMALL)
    walk.play_by_keys(page, CHEAP)
    ways.press(page, "ArrowRight", "ArrowRight", "g")
    ways.expect_saved(page)
    replay = page.locator('[data-act="replay"]').last
    ways.tab_to(page, replay)
    page.keyboard.press("Enter")
    ways.expect_shows(page, "replay")
    steer_the_replay(page)
    page.keyboard.press("t")
    ways.expect_shows(page, "playing")
    ways.expect_state(page, 8)
    expect(page.locator("#board")).to_be_focused()
    page.keyboard.press("z")
    ways.expect_state(page, 8)  # what was copied is not taken back
    ways.press(page, "ArrowRight", "ArrowRight", "ArrowRight")
    ways.expect_shows(page, "result")
    ways.expect_saved(page)
    expect(page.locator(".attempt-origin").first).to_have_text("from attempt 1, step 2")
    first, _, child = ways.attempts_of(page, base_url)
    assert (child["parent_id"], child["parent_step"]) == (first["id"], 2)
    assert child["actions"] == CHEAP
    assert child["step_ms"][:2] == first["step_ms"][:2]
    assert child["record"]["device"] == ["copied", "copied", "key", "key", "key"]


def test_from_the_midst_of_another_a_way_leads_back_to_the_start(page: Page) -> None:
    page.goto(SMALL)
    walk.play_by_keys(page, CHEAP)
    page.locator('[data-act="replay"]').click()
    steer_the_replay(page)
    page.keyboard.press("t")
    expect(page.locator("#hint")).to_have_text("A new attempt, from step 2 on. Restart goes back to the start.")
    page.keyboard.press("r")
    ways.expect_state(page, 0)
    expect(page.locator("#n-steps")).to_have_text("0")


def steer_the_replay(page: Page) -> None:
    """Pause it, step through it, change its speed; in the end it stands after two steps."""
    page.keyboard.press("Space")
    expect(page.locator("#replay")).to_have_attribute("data-playing", "false")
    for _ in range(5):
        page.keyboard.press("ArrowLeft")
    ways.expect_state(page, 0)
    ways.press(page, "ArrowRight", "ArrowRight", "ArrowRight", "ArrowLeft")
    ways.expect_state(page, 8)
    expect(page.locator("#replay-at")).to_have_attribute("aria-valuetext", "Step 2 of 5, total −1.0")
    ways.press(page, "ArrowUp", "ArrowUp")
    expect(page.locator("#replay-speed")).to_have_value("4")
    ways.press(page, "ArrowDown", "ArrowDown", "ArrowDown")
    expect(page.locator("#replay-speed")).to_have_value("0.5")


def test_leaving_a_replay_and_discarding_keep_the_focus(page: Page, base_url: str) -> None:
    page.goto(SMALL)
    ways.press(page, "ArrowRight", "g")
    ways.expect_saved(page)
    replay = page.locator('[data-act="replay"]')
    ways.tab_to(page, replay)
    page.keyboard.press("Enter")
    ways.expect_shows(page, "replay")
    page.keyboard.press("Escape")
    ways.expect_shows(page, "result")
    expect(replay).to_be_focused()
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(page.locator('[data-act="restore"]')).to_be_focused()
    expect(page.locator("#n-failures")).to_have_text("0")
    page.keyboard.press("Enter")
    expect(page.locator('[data-act="discard"]')).to_be_focused()
    expect(page.locator("#n-failures")).to_have_text("1")
    ways.expect_attempts(page, base_url, lambda attempts: [one["discarded"] for one in attempts] == [False])


def test_tab_and_enter_lead_on_to_the_order(page: Page) -> None:
    page.goto(SMALL)
    walk.play_by_keys(page, CHEAP)
    ways.press(page, "ArrowRight", "g")
    expect(page.locator("#next")).to_have_attribute("href", re.compile("/rank$"))
    ways.tab_to(page, page.locator("#next"))
    page.keyboard.press("Enter")
    expect(page).to_have_url(re.compile("/rank$"))


def test_numbers_shown_while_a_key_is_held_are_noted(page: Page, base_url: str) -> None:
    page.goto(SMALL)
    page.keyboard.press("ArrowRight")
    page.keyboard.down("n")
    page.keyboard.up("n")
    ways.press(page, "Shift+ArrowRight", "g")
    (only,) = ways.attempts_of(page, base_url)
    events = [(event["type"], event["step"], event["value"]) for event in only["record"]["events"]]
    assert events == [("numbers", 1, 1), ("numbers", 1, 0), ("look", 1, 2)]


def test_a_phone_plays_by_pad_swipe_and_tap(phone: Page, base_url: str) -> None:
    phone.goto(SMALL)
    phone.locator('[data-move="2"]').tap()
    walk.swipe(phone, phone.locator("#board"), 2)
    for state in (9, 10, 11):
        ways.expect_state(phone, state - 1)
        tap_square(phone, state)
    ways.expect_shows(phone, "result")
    (only,) = ways.attempts_of(phone, base_url)
    assert only["actions"] == CHEAP
    assert only["record"]["device"] == ["pad", "swipe", "tap", "tap", "tap"]


def tap_square(phone: Page, state: int) -> None:
    """Tap the middle of a square of the small world."""
    box = phone.locator("#board .board-stage").bounding_box()
    assert box is not None
    row, col = divmod(state, 4)
    phone.touchscreen.tap(box["x"] + (col + 0.5) * box["width"] / 4, box["y"] + (row + 0.5) * box["height"] / 3)


def test_a_phone_replays_and_tries_again_from_there(phone: Page, base_url: str) -> None:
    phone.goto(SMALL)
    walk.play_by_pad(phone, CHEAP)
    phone.locator('[data-act="replay"]').tap()
    expect(phone.locator("#replay")).to_have_attribute("data-playing", "true")
    tap_square(phone, 5)  # wherever one taps the board
    expect(phone.locator("#replay")).to_have_attribute("data-playing", "false")
    phone.locator("#replay-at").fill("1")
    phone.locator('[data-replay="on"]').tap()
    ways.expect_state(phone, 8)
    phone.locator("#branch").tap()
    ways.expect_shows(phone, "playing")
    phone.locator('[data-move="1"]').tap()
    phone.locator('[data-command="undo"]').tap()
    phone.locator('[data-move="0"]').tap()
    phone.locator('[data-command="giveUp"]').tap()
    expect(phone.locator("#result-text")).to_have_text("You stopped after 3 steps, at −1.5.")
    first, child = ways.attempts_of(phone, base_url)
    assert (child["parent_id"], child["parent_step"], child["actions"]) == (first["id"], 2, [2, 2, 0])
    phone.locator('[data-act="discard"]').first.tap()
    expect(phone.locator("#n-failures")).to_have_text("0")
    phone.locator('[data-act="restore"]:visible').tap()
    expect(phone.locator("#n-failures")).to_have_text("1")


def test_on_a_phone_every_target_is_large_enough_for_a_finger(phone: Page) -> None:
    phone.goto(SMALL)
    phone.locator('[data-move="1"]').tap()
    small = """() => [...document.querySelectorAll("main button, main summary, main .option")]
      .filter((one) => one.checkVisibility({ visibilityProperty: true }))
      .map((one) => [one.ariaLabel ?? one.textContent.trim(), one.getBoundingClientRect()])
      .filter(([, { width, height }]) => width < 36 || height < 36).map(([name]) => name)"""
    assert phone.evaluate(small) == []
    phone.locator("#options summary").tap()
    assert phone.evaluate(small) == []
    phone.locator("#option-sound").tap()
    expect(phone.locator("#option-sound")).to_be_checked()
    phone.locator("#option-sound").tap()
    phone.locator("#board").tap()
    expect(phone.locator("#option-sound")).to_be_hidden()
    phone.locator("#numbers").tap()
    expect(phone.locator("#numbers")).to_have_attribute("aria-pressed", "true")


def test_on_a_phone_a_large_world_is_seen_closely_and_the_pad_stays_in_sight(phone: Page) -> None:
    phone.goto("/?rows=100&cols=100&seed=3")
    close_up = phone.locator("#close-up .agent")
    for state in (1, 2):
        phone.locator('[data-move="1"]').tap()
        ways.expect_state(phone, state)
        expect(close_up).to_have_attribute("data-state", str(state))
    for part in ("#board", "#close-up", '[data-move="2"]', "#total"):
        expect(phone.locator(part)).to_be_in_viewport(ratio=0.99)
    assert phone.evaluate(ways.WIDTH) <= 360


def test_a_gamepad_succeeds_takes_back_gives_up_and_plays_again(page: Page, base_url: str) -> None:
    gamepad = Gamepad(page)
    page.goto(SMALL)
    gamepad.connect()
    gamepad.walk([1, 1])
    gamepad.press("B")
    ways.expect_state(page, 1)
    gamepad.press("B")
    gamepad.walk(CHEAP)
    ways.expect_shows(page, "result")
    gamepad.press("A")
    gamepad.walk([1])
    gamepad.press("Back")
    expect(page.locator("#result-title")).to_have_text("✗ A useful failure: 1 of 3")
    gamepad.press("A")
    ways.expect_shows(page, "playing")
    success, failure = ways.attempts_of(page, base_url)
    assert [success["outcome"], failure["ending"]] == ["success", "gave_up"]
    assert set(success["record"]["device"]) == {"gamepad"}
    undone = [event["value"] for event in success["record"]["events"] if event["type"] == "undo"]
    assert undone == [1, 1]


def test_a_gamepad_pauses_a_replay_steps_through_it_and_goes_back(page: Page) -> None:
    gamepad = Gamepad(page)
    page.goto(SMALL)
    gamepad.connect()
    gamepad.walk(CHEAP)
    page.locator('[data-act="replay"]').click()
    gamepad.press("A")
    expect(page.locator("#replay")).to_have_attribute("data-playing", "false")
    at = int(page.locator("#replay-at").input_value())
    gamepad.press("right")
    expect(page.locator("#replay-at")).to_have_value(str(at + 1))
    gamepad.press("B")
    ways.expect_shows(page, "result")
