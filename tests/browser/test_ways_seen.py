"""Enlarged to 400 %, in forced colours, without motion: the play page is all there, and axe finds nothing."""

from collections.abc import Iterator
from typing import Any, Literal

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect

from tests.browser import walk, ways
from tests.browser.ways import CHEAP, SMALL, Colour, Picture

ZOOMS: dict[str, dict[str, Any]] = {
    "200 %": {"viewport": {"width": 640, "height": 400}, "device_scale_factor": 2},
    "400 %": {"viewport": {"width": 320, "height": 256}, "device_scale_factor": 4},
}
SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
SCROLL_DOWN = """async () => {
  scrollTo(0, document.body.scrollHeight);
  for (let i = 0; i < 3; i += 1) await new Promise(requestAnimationFrame);
}"""
BOTH_ARE_KEPT = """async () => {
  const { ask, browserStorage } = await import("#js/lib/storage.js");
  const kept = await browserStorage.run(["unfinished"], "readonly", (store) => ask(store("unfinished").getAll()));
  return kept.length === 2;
}"""
#: Whether anything moves one frame after each key, and where the agent then is, in squares.
WATCH_FRAMES = """() => {
  window.frames = [];
  const moves = (animation) => animation instanceof CSSTransition ||
    new Set(animation.effect.getKeyframes().map(({ transform }) => transform)).size > 1;
  document.addEventListener("keydown", () => requestAnimationFrame(() => {
    const [agent, stage] = ["#board .agent", "#board .board-stage"].map((name) =>
      document.querySelector(name).getBoundingClientRect());
    const at = [(agent.y - stage.y) / agent.height, (agent.x - stage.x) / agent.width];
    window.frames.push([...at, document.getAnimations().filter(moves).length]);
  }));
}"""


def states_of_play(page: Page) -> Iterator[str]:
    """Lead the page through its states, one after the other."""
    page.goto(SMALL)
    yield "fresh"
    ways.press(page, "ArrowDown")
    yield "playing"
    ways.press(page, "Shift+ArrowRight", "Shift+ArrowRight")
    yield "cursor"
    ways.press(page, "r")
    ways.walk_along(page, CHEAP)
    ways.expect_shows(page, "result")
    yield "success"
    ways.press(page, "Enter", "ArrowRight", "g")
    ways.expect_shows(page, "result")
    yield "failure"
    page.locator('[data-act="replay"]').last.press("Enter")
    ways.press(page, "Space", "ArrowRight")
    yield "replay"
    ways.press(page, "t")
    ways.expect_shows(page, "playing")
    ways.press(page, "ArrowRight")
    yield "after branching"
    ways.press(page, "g")
    page.locator('[data-act="discard"]').last.press("Enter")
    yield "discarded"
    page.locator("#as-text summary").press("Enter")
    yield "text board"
    page.locator("#options summary").press("Enter")
    yield "options"
    page.keyboard.press("Escape")
    leave_attempts_behind(page)
    expect(page.locator("#hint")).to_have_attribute("data-is-usual", "false")
    yield "taken up again"
    ways.press(page, "g")
    expect(page.locator("#left")).to_be_visible()
    yield "another was left behind"
    page.goto("/?seed=5&slip=0.3&time_limit_s=5")
    ways.walk_along(page, [1, 2])
    yield "slippery, with a time limit"
    page.goto("/?seed=5&goals=48,6&walls=9,10")
    ways.walk_along(page, [2, 2])
    yield "two goals and walls"
    page.goto("/?seed=5&rows=100&cols=100")
    ways.walk_along(page, [1, 2])
    expect(page.locator("#close-up")).to_be_visible()
    yield "close-up"


def leave_attempts_behind(page: Page) -> None:
    """One in a tab that is closed, one in this tab, which is loaded again."""
    ways.press(page, "r", "ArrowDown")
    other = page.context.new_page()
    other.goto(SMALL)
    ways.press(other, "ArrowRight")
    other.wait_for_function(BOTH_ARE_KEPT)
    other.close()
    page.reload()


@pytest.mark.parametrize("zoom", ZOOMS)
def test_enlarged_no_state_scrolls_sideways(browser: Browser, base_url: str, zoom: str) -> None:
    with ways.visit(browser, base_url, **ZOOMS[zoom]) as page:
        for state in states_of_play(page):
            width = page.evaluate(ways.WIDTH)
            assert width <= ZOOMS[zoom]["viewport"]["width"], f"{state}: {width} px"


@pytest.mark.parametrize("zoom", ZOOMS)
def test_enlarged_a_key_brings_the_board_into_sight_and_the_end_its_result(
    browser: Browser, base_url: str, zoom: str
) -> None:
    with ways.visit(browser, base_url, **ZOOMS[zoom]) as page:
        page.goto(SMALL)
        for actions in (CHEAP, [1, 1, 1, 2, 2]):
            page.evaluate(SCROLL_DOWN)
            ways.walk_along(page, actions[:2])
            expect(page.locator("#board")).to_be_in_viewport(ratio=0.98)
            ways.walk_along(page, actions[2:])
            expect(page.locator("#result-text")).to_be_in_viewport(ratio=0.98)
            page.keyboard.press("Enter")
        page.goto("/?seed=5&rows=100&cols=100")
        ways.walk_along(page, [1])
        expect(page.locator("#close-up")).to_be_in_viewport(ratio=0.98)


@pytest.mark.parametrize("zoom", ZOOMS)
def test_enlarged_everything_is_reached_and_seen_by_keyboard(browser: Browser, base_url: str, zoom: str) -> None:
    with ways.visit(browser, base_url, **ZOOMS[zoom]) as page:
        page.goto(SMALL)
        walk.play_by_keys(page, CHEAP)
        ways.press(page, "ArrowRight", "g")
        ways.tab_to(page, page.locator('[data-act="replay"]').last)
        ways.press(page, "Enter", "Space", "ArrowRight")
        expect(page.locator("#board")).to_be_in_viewport(ratio=0.98)
        ways.tab_to(page, page.locator("#branch"))
        page.keyboard.press("Enter")
        ways.expect_shows(page, "playing")
        ways.tab_to(page, page.locator("#as-text summary"))
        page.keyboard.press("Enter")
        expect(page.locator("#text-board tr")).to_have_count(4)
        table = page.locator("#as-text-scroll")
        ways.tab_to(page, table)
        if table.evaluate("place => place.scrollWidth > place.clientWidth"):
            ways.press(page, *["ArrowRight"] * 3)
            page.wait_for_function("() => document.getElementById('as-text-scroll').scrollLeft > 0")
            ways.expect_state(page, 4)
        page.keyboard.press("?")
        expect(page.locator("#keys-title")).to_be_in_viewport(ratio=0.98)
        assert page.evaluate(ways.WIDTH) <= ZOOMS[zoom]["viewport"]["width"]


@pytest.mark.parametrize("scheme", SCHEMES)
def test_in_forced_colours_agent_cursor_and_focus_stand_out(browser: Browser, base_url: str, scheme: str) -> None:
    with ways.visit(browser, base_url, forced_colors="active", color_scheme=scheme, reduced_motion="reduce") as page:
        page.goto("/?seed=5")
        ways.tab_to(page, page.locator("#board"))
        ways.press(page, "ArrowRight", "ArrowDown", "Shift+ArrowRight")
        page.wait_for_function("() => document.getAnimations().length === 0")
        seen = ways.picture(page)
        squares = [colour for colour in square_colours(page, seen) if colour is not None]
        agent = line_through(page, seen, "#board .agent", 0.75)
        cursor = line_through(page, seen, "#board .board-cursor", 0.5)
        for square in squares:
            assert stands_out(agent, square), f"the agent on {square}"
            assert stands_out(cursor, square), f"the cursor on {square}"
        stage = page.locator("#board .board-stage").bounding_box()
        assert stage is not None
        ring, ground = (seen[int(stage["y"]) + 100, int(stage["x"] - away)] for away in (4.5, 12))
        assert ways.contrast(ring, ground) >= 3
        check_axe(page, f"forced colours, {scheme}")


@pytest.mark.parametrize("scheme", SCHEMES)
def test_in_forced_colours_red_squares_are_hatched_and_blue_ones_are_not(
    browser: Browser, base_url: str, scheme: str
) -> None:
    with ways.visit(browser, base_url, forced_colors="active", color_scheme=scheme) as page:
        page.goto("/?seed=5")
        ways.expect_state(page, 0)
        plain = square_colours(page, ways.picture(page))
        colours = [colour for row in walk.page_data(page)["world"]["colours"] for colour in row]
        told = {n: colour for n, colour in enumerate(colours) if colour in {"red", "blue"} and n != 0}
        assert set(told.values()) == {"red", "blue"}
        assert {n: "red" if plain[n] is None else "blue" for n in told} == told


def square_colours(page: Page, seen: Picture) -> list[Colour | None]:
    """The one colour of the middle of each of the 49 squares; None where there is more than one."""
    box = page.locator("#board .board-stage").bounding_box()
    assert box is not None
    side = box["width"] / 7
    found: list[Colour | None] = []
    for row in range(7):
        for col in range(7):
            x, y = int(box["x"] + (col + 0.2) * side), int(box["y"] + (row + 0.2) * side)
            middle = seen[y : y + int(0.6 * side), x : x + int(0.6 * side)]
            found.append(middle[0, 0] if (middle == middle[0, 0]).all() else None)
    return found


def line_through(page: Page, seen: Picture, what: str, height: float) -> list[Colour]:
    """The colours along a line through something, at this share of its height."""
    box = page.locator(what).bounding_box()
    assert box is not None
    y = int(box["y"] + height * box["height"])
    return list(seen[y, int(box["x"]) : int(box["x"] + box["width"])])


def stands_out(line: list[Colour], ground: Colour) -> bool:
    """Its lightest or its darkest edge holds 3:1 against the ground, and the two of them against each other."""
    light, dark = max(line, key=ways.luminance), min(line, key=ways.luminance)
    return ways.contrast(light, dark) >= 3 and max(ways.contrast(one, ground) for one in (light, dark)) >= 3


def test_with_reduced_motion_a_step_is_there_in_the_next_frame_and_nothing_moves(
    browser: Browser, base_url: str
) -> None:
    with ways.visit(browser, base_url, reduced_motion="reduce") as page:
        page.goto(SMALL)
        page.evaluate(WATCH_FRAMES)
        for action in (0, *CHEAP):
            ways.walk_along(page, [action])
            page.evaluate("() => new Promise(requestAnimationFrame)")
        assert page.evaluate("window.frames") == [
            [row, col, 0] for row, col in ((0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (2, 3))
        ]
        expect(page.locator("#board .board-joy")).to_have_count(1)
        expect(page.locator("#result-title")).to_have_text("✓ A success: 1 of 3")
        ways.expect_said(page, "A success: 1 of 3. You reached the goal with +4.5 in 6 steps. Enter plays again.")
        ways.press(page, "Enter", "ArrowDown", "g")
        page.locator('[data-act="replay"]').last.press("Enter")
        ways.press(page, "ArrowRight", "ArrowRight")
        assert {moving for *_, moving in page.evaluate("window.frames")} == {0}


@pytest.mark.parametrize("scheme", SCHEMES)
def test_axe_finds_nothing_in_any_state(browser: Browser, base_url: str, scheme: str) -> None:
    with ways.visit(browser, base_url, color_scheme=scheme, reduced_motion="reduce") as page:
        for state in states_of_play(page):
            check_axe(page, state)
        page.goto("/?seed=5&time_limit_s=5")
        ways.walk_along(page, [1])
        expect(page.locator("#time-left")).to_have_attribute("data-low", "true")
        check_axe(page, "time nearly up")


@pytest.mark.parametrize("scheme", SCHEMES)
def test_axe_finds_nothing_while_the_network_is_gone(browser: Browser, base_url: str, scheme: Literal["light"]) -> None:
    """Not watched: the browser itself reports on its console what it cannot reach."""
    context = browser.new_context(base_url=base_url, color_scheme=scheme)
    page = context.new_page()
    page.goto(SMALL)
    context.set_offline(True)
    ways.press(page, "ArrowRight", "g")
    expect(page.locator("#sync")).to_have_attribute("data-sync", "offline")
    check_axe(page, "offline")
    context.close()


def check_axe(page: Page, where: str) -> None:
    results = Axe().run(page)
    assert results.violations_count == 0, f"{where}:\n{results.generate_report()}"
