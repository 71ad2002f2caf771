"""Sound and vibration: off or light, remembered, and never against the browser's rules."""

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect

from tests.browser.conftest import watched

LISTEN = """
  window.heard = { contexts: 0, notes: 0, pulses: [] };
  const { AudioContext, OscillatorNode } = window;
  window.AudioContext = class extends AudioContext { constructor(options) { super(options); heard.contexts += 1; } };
  window.OscillatorNode = class extends OscillatorNode { start(at) { super.start(at); heard.notes += 1; } };
  navigator.vibrate = (pulses) => { heard.pulses.push(pulses); return true; };
"""


@pytest.fixture
def phone(browser: Browser, base_url: str) -> Iterator[BrowserContext]:
    context = browser.new_context(
        base_url=base_url, viewport={"width": 360, "height": 740}, has_touch=True, is_mobile=True
    )
    yield context
    context.close()


def test_playing_is_silent_until_somebody_turns_the_sound_on(page: Page) -> None:
    page.add_init_script(LISTEN)
    page.goto("/?seed=5")
    page.keyboard.press("ArrowRight")
    assert heard(page)["contexts"] == 0
    page.keyboard.press("m")
    expect(page.locator("#announcer")).to_have_text("Sound on.")
    expect_notes(page, 2)
    page.keyboard.press("ArrowRight")
    expect_notes(page, 3)
    page.keyboard.press("m")
    expect(page.locator("#announcer")).to_have_text("Sound off.")
    page.keyboard.press("ArrowRight")
    assert heard(page) == {"contexts": 1, "notes": 3, "pulses": []}


def test_the_choice_is_remembered_and_waits_for_the_first_key(page: Page) -> None:
    """A sound before anybody touched the page would be refused, with a warning that fails this test."""
    page.add_init_script(LISTEN)
    page.goto("/?seed=5")
    page.locator("#options summary").click()
    page.locator("#option-sound").check()
    page.reload()
    page.locator("#options summary").click()
    expect(page.locator("#option-sound")).to_be_checked()
    page.keyboard.press("Escape")
    expect(page.locator("#options summary")).to_be_focused()
    assert heard(page)["contexts"] == 0
    while heard(page)["notes"] == 0:  # the first may come too late to be played, while the browser opens its audio
        page.keyboard.press("ArrowRight")
        page.keyboard.press("z")
    assert heard(page)["contexts"] == 1


def test_the_sheet_of_options_closes_by_a_press_elsewhere_and_then_keys_move_again(page: Page) -> None:
    page.goto("/?seed=5")
    page.locator("#options summary").click()
    page.keyboard.press("ArrowRight")
    expect(page.locator("#n-steps")).to_have_text("0")
    page.locator("h1").click()
    expect(page.locator("#practise-again")).to_be_hidden()
    page.keyboard.press("ArrowRight")
    expect(page.locator("#n-steps")).to_have_text("1")


def test_a_phone_knocks_lightly_until_told_not_to(phone: BrowserContext, base_url: str) -> None:
    page = phone.new_page()
    with watched(page, base_url):
        page.add_init_script(LISTEN)
        page.goto("/?seed=5")
        page.locator('.pad [data-move="1"]').tap()
        assert len(heard(page)["pulses"]) == 1
        page.locator("#options summary").tap()
        page.locator("#option-vibration").uncheck()
        page.reload()
        page.locator('.pad [data-move="1"]').tap()
        assert heard(page)["pulses"] == []


def test_whoever_wants_less_motion_feels_none_unless_asked_for(phone: BrowserContext, base_url: str) -> None:
    page = phone.new_page()
    page.emulate_media(reduced_motion="reduce")
    with watched(page, base_url):
        page.add_init_script(LISTEN)
        page.goto("/?seed=5")
        page.locator('.pad [data-move="1"]').tap()
        assert heard(page)["pulses"] == []
        page.locator("#options summary").tap()
        page.locator("#option-vibration").check()
        assert len(heard(page)["pulses"]) == 1


def test_a_computer_with_a_mouse_is_not_asked_about_vibration(page: Page) -> None:
    page.goto("/?seed=5")
    page.locator("#options summary").click()
    expect(page.locator("#option-sound")).to_be_visible()
    expect(page.locator("#option-vibration")).to_be_hidden()


def heard(page: Page) -> dict[str, Any]:
    found: dict[str, Any] = page.evaluate("heard")
    return found


def expect_notes(page: Page, n_notes: int) -> None:
    page.wait_for_function("n => heard.notes === n", arg=n_notes)
