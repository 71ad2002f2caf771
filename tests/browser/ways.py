"""Other ways to a page than a mouse and sharp eyes: who comes, what is heard, what is seen."""

import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Final, TypeAlias

import matplotlib.image
import numpy as np
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser import walk
from tests.browser.conftest import watched

Picture: TypeAlias = np.ndarray[tuple[int, int, int], np.dtype[np.float32]]
Colour: TypeAlias = np.ndarray[tuple[int], np.dtype[np.float32]]

#: Three rows of four squares in which every figure is known; the goal pays 7. Right, right costs most.
SMALL: Final = "/?rows=3&cols=4&seed=5&painted=0-1:-0.5,2:-3.2,3-10:-0.5"
#: A way to its goal that earns 4.5, and one through its red square that earns 1.8.
DEAR, CHEAP = [1, 1, 1, 2, 2], [2, 2, 1, 1, 1]

WIDTH: Final = "document.documentElement.scrollWidth"
#: What has the focus: its name for assistive technology, whether its ring shows, whether it can be seen at all.
FOCUSED: Final = """() => {
  const here = document.activeElement;
  const place = here.id === "board" ? here.querySelector(".board-stage") : here;
  const { outlineStyle, outlineWidth } = getComputedStyle(place);
  const box = place.getBoundingClientRect();
  const [top, bottom] = [Math.max(0, box.top), Math.min(innerHeight, box.bottom, Math.max(0, box.top) + 40)];
  const seen = document.elementFromPoint(box.x + box.width / 2, (top + bottom) / 2);
  return {
    name: here.getAttribute("aria-label") ?? here.textContent.trim().replace(/\\s+/g, " ").slice(0, 40),
    isBody: here === document.body,
    hasRing: outlineStyle !== "none" && parseFloat(outlineWidth) >= 2,
    isInWindow: box.left >= 0 && box.right <= innerWidth + 1 && bottom - top >= 8,
    isOnTop: seen !== null && (here.contains(seen) || seen.contains(here)),
  };
}"""


@contextmanager
def visit(browser: Browser, address: str, **options: Any) -> Iterator[Page]:
    """A page of a visitor who comes with a certain screen, finger or wish; it fails on anything amiss."""
    context = browser.new_context(base_url=address, **options)
    page = context.new_page()
    with watched(page, address):
        yield page
    context.close()


def expect_said(page: Page, sentence: str) -> None:
    """What is said aloud last, word by word."""
    expect(page.locator("#announcer")).to_have_text(sentence)


def expect_shows(page: Page, what: str) -> None:
    """The slot beside the board: "playing", "result" or "replay"."""
    expect(page.locator("#now")).to_have_attribute("data-shows", what)


def expect_state(page: Page, state: int) -> None:
    """Where the agent is drawn."""
    expect(page.locator("#board .agent")).to_have_attribute("data-state", str(state))


def expect_attempts(page: Page, address: str, are_so: Callable[[list[walk.Json]], bool]) -> None:
    """The server comes to have them so. A badge still says "saved" in the moment before the next wish is stored."""
    for _ in range(100):
        if are_so(attempts := attempts_of(page, address)):
            return
        page.wait_for_timeout(100)
    raise AssertionError(attempts)


def expect_saved(page: Page) -> None:
    expect(page.locator("#sync")).to_have_attribute("data-sync", "saved")


def attempts_of(page: Page, address: str) -> list[walk.Json]:
    """What the server has of the visitor's attempts in the world on the page, oldest first, once all are saved."""
    expect_saved(page)
    world_id = walk.page_data(page)["world"]["id"]
    found: list[walk.Json] = walk.ContextClient(page, address).get(f"/worlds/{world_id}/demonstrations")
    return found


def walk_along(page: Page, actions: list[int]) -> None:
    press(page, *(walk.KEYS[action] for action in actions))


def tab_to(page: Page, goal: Locator, key: str = "Tab") -> list[str]:
    """Press Tab until something has the focus; on the way the focus is always seen. Returns the names passed."""
    names = []
    for _ in range(60):
        page.keyboard.press(key)
        found = page.evaluate(FOCUSED)
        names.append(found["name"])
        if not found["isBody"]:
            assert found["hasRing"], f"no ring around {found['name']}"
            assert found["isInWindow"], f"{found['name']} is out of sight"
            assert found["isOnTop"], f"{found['name']} is covered"
        if goal.evaluate("goal => goal === document.activeElement"):
            return names
    raise AssertionError(f"Tab does not lead there, only to {names}")


def press(page: Page, *keys: str) -> None:
    for key in keys:
        page.keyboard.press(key)


def picture(page: Page) -> Picture:
    """What is on the screen: rows of CSS pixels, each red, green, blue in 0…1."""
    pixels: Picture = matplotlib.image.imread(io.BytesIO(page.screenshot(scale="css")))[:, :, :3]
    return pixels


def contrast(one: Colour, other: Colour) -> float:
    """The contrast of two colours (WCAG 2.2)."""
    light, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def luminance(colour: Colour) -> float:
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in colour)
    return float(0.2126 * red + 0.7152 * green + 0.0722 * blue)
