"""A person with a gamepad, from the first step to six attempts."""

from playwright.sync_api import Page, expect

from tests.browser import walk
from tests.browser.gamepad import Gamepad


def test_a_person_plays_six_attempts_by_gamepad_alone(page: Page) -> None:
    gamepad = Gamepad(page)
    page.goto("/?seed=12")
    gamepad.connect()
    for n, actions in enumerate(walk.attempts_for(page), 1):
        gamepad.walk(actions)
        expect(page.locator("#now")).to_have_attribute("data-shows", "result")
        expect(page.locator("#attempts .attempt")).to_have_count(n)
        gamepad.press("A")
        expect(page.locator("#now")).to_have_attribute("data-shows", "playing")
    expect(page.locator("#n-successes")).to_have_text("3")
    expect(page.locator("#n-failures")).to_have_text("3")
    expect(page.locator("#sync")).to_have_attribute("data-sync", "saved")


def test_the_stick_and_the_buttons_do_what_keys_do(page: Page) -> None:
    gamepad = Gamepad(page)
    page.goto("/?seed=12")
    gamepad.connect()
    steps = page.locator("#n-steps")
    gamepad.push(1, 0.1)
    gamepad.push(0.9, 0)
    expect(steps).to_have_text("1")
    gamepad.push(0, 0)
    gamepad.push(0, 1)
    expect(steps).to_have_text("2")
    gamepad.press("B")
    expect(steps).to_have_text("1")
    gamepad.press("Y")
    expect(steps).to_have_text("0")
    gamepad.press("right")
    gamepad.press("X")
    expect(page.locator("#now")).to_have_attribute("data-shows", "playing")
    gamepad.press("Back")
    expect(page.locator("#now")).to_have_attribute("data-shows", "result")
    gamepad.press("Start")
    expect(page.locator("#now")).to_have_attribute("data-shows", "playing")


def test_a_button_that_is_held_is_one_step_and_a_dialog_takes_none(page: Page) -> None:
    gamepad = Gamepad(page)
    page.goto("/?seed=12")
    gamepad.connect()
    gamepad.hold("right")
    assert gamepad.reads_in_ten_frames() > 0
    expect(page.locator("#n-steps")).to_have_text("1")
    gamepad.release("right")
    page.keyboard.press("?")
    gamepad.press("down")
    gamepad.hold("right")
    page.keyboard.press("Escape")
    gamepad.release("right")
    expect(page.locator("#n-steps")).to_have_text("1")


def test_gamepads_are_read_only_while_one_is_connected(page: Page) -> None:
    gamepad = Gamepad(page)
    page.goto("/?seed=12")
    assert gamepad.reads_in_ten_frames() == 0
    gamepad.connect()
    assert gamepad.reads_in_ten_frames() > 0
    gamepad.disconnect()
    gamepad.push(0, 0)
    assert gamepad.reads_in_ten_frames() == 0
