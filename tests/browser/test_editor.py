"""The editor of worlds: by mouse, by keyboard alone, by touch; nothing is lost, and what cannot be is said."""

import re
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest
from playwright.sync_api import Browser, BrowserContext, Locator, Page, expect

from app.config import WAYS
from tests.browser import walk
from tests.browser.conftest import watched
from tests.browser.test_pages import check_axe

ASKED = "**/api/v1/worlds/preview*"


def world_on(page: Page) -> dict[str, Any]:
    """The world on the board, painted or answered."""
    world: dict[str, Any] = page.locator("#board").evaluate("board => board.world")
    return world


def query_of(page: Page) -> dict[str, str]:
    """What the address says, once it has been written."""
    return {name: values[0] for name, values in parse_qs(urlsplit(page.url).query).items()}


def centre(page: Page, square: int) -> tuple[float, float]:
    """Where a square is in the window."""
    x, y = page.locator("#board").evaluate(
        """(board, square) => {
          const { left, top, width, height } = board.querySelector(".board-stage").getBoundingClientRect();
          const { rows, cols } = board.world;
          const [row, col] = [Math.floor(square / cols), square % cols];
          return [left + (col + 0.5) * width / cols, top + (row + 0.5) * height / rows];
        }""",
        square,
    )
    return x, y


def drag(page: Page, *squares: int) -> None:
    page.mouse.move(*centre(page, squares[0]))
    page.mouse.down()
    for square in squares[1:]:
        page.mouse.move(*centre(page, square))
    page.mouse.up()


def drag_by_finger(page: Page, *squares: int) -> None:
    finger = page.context.new_cdp_session(page)
    for n, square in enumerate(squares):
        x, y = centre(page, square)
        kind = "touchMove" if n else "touchStart"
        finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y}]})
    finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    finger.detach()


def choose(page: Page, tool: str) -> None:
    page.locator(f'#tools label:has([value="{tool}"])').click()


def set_number(page: Page, name: str, text: str) -> None:
    page.locator(f"#{name}").fill(text)
    page.locator(f"#{name}").blur()


def verdict(page: Page) -> Locator:
    return page.locator("#verdict")


@pytest.fixture
def loose_page(context: BrowserContext) -> Page:
    """For refusals and dead networks, which the browser itself reports on its console."""
    return context.new_page()


def test_what_is_painted_by_mouse_is_in_the_address_survives_a_reload_and_is_played(page: Page) -> None:
    page.goto("/worlds/new?seed=5")
    expect(verdict(page)).to_have_attribute("data-state", "possible")
    drag(page, 8, 12)
    choose(page, "paint")
    set_number(page, "reward", "6.5")
    drag(page, 21, 23)
    choose(page, "goal")
    set_number(page, "pay", "30")
    drag(page, 6)
    choose(page, "start")
    drag(page, 42)
    set_number(page, "slip", "10")
    set_number(page, "time_limit_s", "90")
    expected = {
        "seed": "5",
        "slip": "0.1",
        "walls": "8-12",
        "start": "42",
        "goals": "48,6",
        "painted": "6:30,21-23:-6.5",
        "time_limit_s": "90",
    }
    expect(page).to_have_url(re.compile("time_limit_s=90"))
    assert query_of(page) == expected
    expect(page.locator("#fact-way")).to_have_text("6 steps")
    expect(page.locator("#fact-limit")).to_have_text("98 steps, 90 seconds")
    before = world_on(page)
    page.reload()
    assert query_of(page) == expected
    after = world_on(page)
    assert [after[key] for key in ("walls", "goals", "start", "rewards")] == [
        before[key] for key in ("walls", "goals", "start", "rewards")
    ]
    page.locator("#play-link").click()
    expect(page.locator("#now")).to_be_visible()
    played = walk.page_data(page)["world"]
    assert (played["walls"], played["start"], played["time_limit_s"]) == ([8, 9, 10, 11, 12], 42, 90)
    page.go_back()
    expect(page.locator("#fact-way")).to_have_text("6 steps")
    assert query_of(page) == expected


def test_how_attempts_are_ordered_is_chosen_for_everybody(loose_page: Page) -> None:
    page = loose_page
    page.goto("/worlds/new?seed=5")
    field = page.get_by_label("How attempts are ordered")
    options = field.locator("option").evaluate_all("options => options.map((one) => one.value)")
    assert options == ["", *WAYS]
    expect(field).to_have_value("")
    field.select_option("pair by pair")
    expect(page).to_have_url(re.compile("seed=5&rank_by=pairwise$"))
    page.reload()
    expect(field).to_have_value("pairwise")
    field.select_option("with sliders")
    page.locator("#undo").click()
    expect(field).to_have_value("pairwise")
    page.locator("#play-link").click()
    expect(page.locator("#now")).to_be_visible()
    assert walk.page_data(page)["world"]["rank_by"] == "pairwise"
    page.goto("/worlds/new?seed=5&rank_by=alphabet")
    expect(page.locator("#notice")).to_contain_text("rank_by must be lists, pairwise, magnitude or segments.")
    expect(page.locator("#rank_by-problem")).to_have_text("Choose one of these ways, or leave it to the people.")
    field.select_option("in two lists")
    expect(page.locator("#rank_by-problem")).to_be_hidden()
    expect(page).to_have_url(re.compile("seed=5&rank_by=lists$"))


def test_painting_shows_at_once_without_waiting_for_the_server(page: Page) -> None:
    page.goto("/worlds/new?seed=5")
    page.route(ASKED, lambda route: None)  # never answered
    drag(page, 8, 10)
    assert world_on(page)["walls"] == [8, 9, 10]
    choose(page, "erase")
    drag(page, 9)
    assert world_on(page)["walls"] == [8, 10]
    assert world_on(page)["rewards"][1][2] == walk.page_data(page)["world"]["rewards"][1][2]
    page.unroute_all(behavior="ignoreErrors")


def test_everything_can_be_done_by_keyboard_alone(page: Page) -> None:
    page.goto("/worlds/new?seed=5")
    spoken = page.locator("#announcer")
    while page.evaluate("document.activeElement.id") != "board":
        page.keyboard.press("Tab")
    expect(spoken).to_have_text(re.compile("Row 1, column 1: blue, .*, the start"))
    assert page.locator("#board").evaluate("board => board.cursor") == 0
    page.keyboard.press("ArrowDown")
    expect(spoken).to_have_text(re.compile("Row 2, column 1: red"))
    page.keyboard.down("Space")
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    page.keyboard.up("Space")
    assert world_on(page)["walls"] == [7, 8, 9, 10]
    expect(spoken).to_have_text(re.compile("Row 2, column 4: a wall"))
    page.keyboard.press("3")
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Enter")
    assert world_on(page)["goals"] == [48, 3]
    expect(spoken).to_have_text(re.compile("Row 1, column 4: the goal, plus 14"))
    page.keyboard.press("z")
    page.keyboard.press("z")
    assert (world_on(page)["walls"], world_on(page)["goals"]) == ([], [48])
    page.keyboard.press("Shift+Z")
    assert world_on(page)["walls"] == [7, 8, 9, 10]
    page.keyboard.press("Enter")
    page.keyboard.press("1")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Space")
    assert world_on(page)["walls"] == [7, 8, 9]
    expect(page).to_have_url(re.compile("walls=7-9&goals=48,3$"))


def test_a_finger_paints_without_moving_the_page(browser: Browser, base_url: str) -> None:
    context = browser.new_context(base_url=base_url, viewport={"width": 360, "height": 740}, has_touch=True)
    page = context.new_page()
    with watched(page, base_url):
        page.goto("/worlds/new?seed=5")
        drag_by_finger(page, 14, 16, 18)
        assert world_on(page)["walls"] == [14, 15, 16, 17, 18]
        assert page.evaluate("scrollY") == 0
        page.locator('#tools label:has([value="erase"])').tap()
        drag_by_finger(page, 16)
        assert world_on(page)["walls"] == [14, 15, 17, 18]
        page.locator("#undo").tap()
        assert world_on(page)["walls"] == [14, 15, 16, 17, 18]
        page.locator('[data-preset="maze"]').tap()
        expect(page.locator("#fact-size")).to_have_text("11 × 11")
        expect(page.locator('[data-preset="maze"]')).to_have_attribute("aria-pressed", "true")
        page.locator("#undo").tap()
        expect(page).to_have_url(re.compile("walls=14-18$"))
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        page.locator("#play-link").tap()
        expect(page.locator("#now")).to_be_visible()
    context.close()


def test_shrinking_keeps_what_fits_and_growing_brings_the_rest_back(page: Page) -> None:
    page.goto("/worlds/new?seed=5&walls=8,40&goals=48,6")
    set_number(page, "rows", "4")
    expect(page).to_have_url(re.compile("rows=4&cols=7&seed=5&walls=8&goals=6$"))
    set_number(page, "rows", "7")
    expect(page).to_have_url(re.compile(r"\?seed=5&walls=8,40&goals=48,6$"))


def test_an_impossible_number_is_said_beside_its_field_and_nothing_is_lost(page: Page) -> None:
    page.goto("/worlds/new?seed=5&walls=8")
    set_number(page, "rows", "500")
    expect(page.locator("#rows-problem")).to_have_text("A world has 2 to 100 rows.")
    expect(page.locator("#rows")).to_have_attribute("aria-invalid", "true")
    expect(page.locator("#announcer")).to_have_text(re.compile("2 to 100 rows"))
    drag(page, 9)
    expect(page.locator("#rows")).to_have_value("500")
    assert (world_on(page)["rows"], world_on(page)["walls"]) == (7, [8, 9])
    set_number(page, "rows", "5")
    expect(page.locator("#rows-problem")).to_be_hidden()
    assert world_on(page)["rows"] == 5
    set_number(page, "step_limit", "3")
    expect(page.locator("#step_limit-problem")).to_contain_text("from 10, the shortest way, to 70")
    expect(verdict(page)).to_contain_text("from 10, the shortest way, to 70")
    expect(page.locator("#play-link")).to_have_attribute("aria-disabled", "true")
    set_number(page, "step_limit", "")
    expect(verdict(page)).to_have_attribute("data-state", "possible")


def test_the_fields_take_what_the_server_takes(page: Page) -> None:
    page.goto("/worlds/new?seed=5")
    limits = walk.page_data(page)["limits"]
    expected = {name: limits[name] for name in ("rows", "cols", "seed", "time_limit_s")}
    expected |= {name: [100 * limit for limit in limits[name]] for name in ("red_probability", "slip")}
    expected |= {"reward": [0, -limits["reward"][0]], "pay": limits["goal_reward"]}
    rules = page.evaluate("import('/static/js/worlds/editor/rules.js').then(({ RULES }) => RULES)")
    for name, bounds in expected.items():
        assert [rules[name]["least"], rules[name]["most"]] == bounds, name
        field = page.locator(f"#{name}")
        assert [float(field.get_attribute(end) or "nan") for end in ("min", "max")] == bounds, name


def test_walls_that_close_every_way_are_told_and_an_undo_opens_it(page: Page) -> None:
    page.goto("/worlds/new?seed=5")
    drag(page, 21, 27)
    expect(verdict(page)).to_contain_text("Walls close every way")
    expect(page.locator("#marks-problem")).to_contain_text("Open one of them")
    expect(page.locator("#play-link")).to_have_attribute("aria-disabled", "true")
    page.keyboard.press("z")
    expect(verdict(page)).to_have_text("A success is possible.")
    expect(page.locator("#play-link")).to_have_attribute("href", "/?seed=5")


def test_what_a_tool_cannot_do_is_said_beside_the_tools(page: Page) -> None:
    page.goto("/worlds/new?seed=5")
    drag(page, 0)
    expect(page.locator("#marks-problem")).to_have_text("The start cannot be a wall. Put the start elsewhere first.")
    choose(page, "erase")
    drag(page, 48)
    expect(page.locator("#marks-problem")).to_have_text("A world needs a goal. Put another one first.")
    drag(page, 30)
    expect(page.locator("#marks-problem")).to_be_hidden()


def test_a_world_without_a_possible_success_is_told_and_what_would_help(page: Page) -> None:
    page.goto("/worlds/new?seed=5")
    choose(page, "paint")
    set_number(page, "reward", "7")
    drag(page, 7, 13)
    drag(page, 14, 20)
    expect(verdict(page)).to_contain_text("no success is possible")
    choose(page, "goal")
    set_number(page, "pay", "90")
    drag(page, 48)
    expect(verdict(page)).to_have_text("A success is possible.")


def test_an_impossible_address_opens_with_what_could_be_read(page: Page) -> None:
    page.goto("/worlds/new?rows=1&seed=5&walls=3,4&slip=0.2")
    expect(page.locator("#notice")).to_contain_text("rows must be a whole number from 2 to 100")
    expect(page.locator("#rows")).to_have_attribute("aria-invalid", "true")
    expect(page.locator("#rows-problem")).to_have_text("A world has 2 to 100 rows.")
    expect(page.locator("#slip")).to_have_value("20")
    assert world_on(page)["walls"] == [3, 4]
    expect(verdict(page)).to_contain_text("A success is possible")
    assert query_of(page)["rows"] == "1"
    set_number(page, "rows", "6")
    expect(page.locator("#notice")).to_be_hidden()
    expect(page).to_have_url(re.compile("rows=6&cols=7&seed=5&slip=0.2&walls=3-4$"))


LONG = "rows=50&cols=50&seed=5&painted=" + ",".join(f"{square}:-{square % 9 * 0.5 + 0.25}" for square in range(1, 1400))


def test_a_world_too_long_for_an_address_survives_a_reload_and_is_shared_by_storing_it(
    browser: Browser, base_url: str
) -> None:
    context = browser.new_context(base_url=base_url, permissions=["clipboard-read", "clipboard-write"])
    page = context.new_page()
    with watched(page, base_url):
        page.goto(f"/worlds/new?{LONG}")
        drag(page, 2001, 2005)
        expect(page).to_have_url(re.compile(r"\?rows=50&cols=50&seed=5$"))
        page.reload()
        assert world_on(page)["walls"] == [2001, 2002, 2003, 2004, 2005]
        assert world_on(page)["rewards"][0][1] == -0.75
        page.locator("#share-world").click()
        expect(page.locator("#told")).to_contain_text("The link is copied")
        link = page.evaluate("navigator.clipboard.readText()")
        assert re.fullmatch(rf"{base_url}/worlds/[0-9a-f-]{{36}}", link)
        page.locator("#share").click()
        expect(page.locator("#announcer")).to_contain_text("The link is copied")
        assert page.evaluate("navigator.clipboard.readText()") == link
        page.locator("#play-link").click()
        expect(page).to_have_url(link)
        stored = walk.page_data(page)["world"]
        assert (stored["walls"], stored["rewards"][0][1]) == ([2001, 2002, 2003, 2004, 2005], -0.75)
        page.go_back()
        expect(page.locator("#fact-size")).to_have_text("50 × 50")
        assert world_on(page)["walls"] == [2001, 2002, 2003, 2004, 2005]
    context.close()


def test_painting_goes_on_while_the_server_is_gone(loose_page: Page) -> None:
    page = loose_page
    page.goto("/worlds/new?seed=5")
    page.route("**/api/**", lambda route: route.abort())
    drag(page, 8, 12)
    expect(verdict(page)).to_contain_text("Paint on: nothing is lost")
    drag(page, 15, 19)
    assert world_on(page)["walls"] == [8, 9, 10, 11, 12, 15, 16, 17, 18, 19]
    expect(page).to_have_url(re.compile("walls=8-12,15-19$"))
    page.locator("#play-link").click()
    expect(page.locator("#told")).to_contain_text("cannot be reached")
    page.unroute_all()
    page.evaluate("window.dispatchEvent(new Event('online'))")
    expect(verdict(page)).to_have_text("A success is possible.")


def test_what_was_told_of_a_link_stays_until_the_world_is_another(browser: Browser, base_url: str) -> None:
    context = browser.new_context(base_url=base_url, permissions=["clipboard-read", "clipboard-write"])
    page = context.new_page()
    with watched(page, base_url):
        page.goto("/worlds/new?seed=5")
        rolled = re.compile(r"/preview\?seed=[0-9]{2,}$")
        held: list[Any] = []
        page.route(rolled, lambda route: held.extend([route]))  # a built-in method is no handler
        with page.expect_request(rolled):
            page.locator("#dice").click()
            page.locator("#share-world").click()
        expect(page.locator("#told")).to_contain_text("The link is copied")
        with page.expect_response(rolled):
            held[0].continue_()  # the answer comes after the link was told
        expect(page.locator("#told")).to_contain_text("The link is copied")
        seed = page.locator("#seed").input_value()
        assert page.evaluate("navigator.clipboard.readText()") == f"{base_url}/?seed={seed}"
        drag(page, 8)
        expect(page.locator("#told")).to_be_hidden()
    context.close()


def test_nothing_reaches_beyond_the_window_at_four_hundred_percent(browser: Browser, base_url: str) -> None:
    context = browser.new_context(base_url=base_url, viewport={"width": 320, "height": 256})
    page = context.new_page()
    with watched(page, base_url):
        page.goto("/worlds/new?seed=5")
        choose(page, "paint")
        reach = "all => Math.max(...all.map((one) => one.getBoundingClientRect().right))"
        assert page.locator("main *").evaluate_all(reach) <= 320
        page.locator("#board").scroll_into_view_if_needed()
        choose(page, "wall")
        page.locator("#board").focus()
        page.keyboard.press("ArrowDown")
        page.keyboard.press("Space")
        assert world_on(page)["walls"] == [7]
    context.close()


def test_an_older_answer_never_comes_over_a_newer_one(page: Page) -> None:
    page.goto("/worlds/new?seed=5")
    held: list[Any] = []
    page.route(ASKED, lambda route: held.append(route) if "rows=3" in route.request.url else route.continue_())
    with page.expect_request(lambda request: "rows=3" in request.url):
        set_number(page, "rows", "3")
    set_number(page, "rows", "4")
    expect(page.locator("#fact-limit")).to_have_text("56 steps")
    assert len(held) == 1
    page.unroute_all(behavior="ignoreErrors")
    page.wait_for_timeout(200)
    assert world_on(page)["rows"] == 4


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_in_the_editor(page: Page, scheme: Any) -> None:
    page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
    page.goto("/worlds/new?seed=5")
    expect(page.locator('[data-preset="two_goals"] canvas').first).to_be_visible()
    choose(page, "paint")
    check_axe(page, "painting")
    set_number(page, "rows", "1")
    choose(page, "wall")
    drag(page, 21, 27)
    expect(verdict(page)).to_have_attribute("data-state", "refused")
    check_axe(page, "problems")
    page.goto("/worlds/new?rows=1&seed=5")
    check_axe(page, "impossible address")
