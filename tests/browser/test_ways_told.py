"""What a person hears of the play page, word by word; limits that end an attempt; what a study hides and allows."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import walk, ways
from tests.browser.ways import CHEAP, SMALL
from tests.live_server import LiveServer

#: What is said on squares 0, 1 and 4 of the small world.
FIRST = "Row 1, column 1. Up: the edge; right: blue −0.5; down: blue −0.5; left: the edge."
SECOND = "Row 1, column 2. Up: the edge; right: red −3.2; down: blue −0.5; left: blue −0.5."
BELOW = "Row 2, column 1. Up: blue −0.5; right: blue −0.5; down: blue −0.5; left: the edge."
COSTLY = "You reached the goal, but the way cost more than the goal gave"
MOVES = ("up", "right", "down", "left")
#: All that is on the page to be read or heard, besides what a step or a square costs.
TOLD = """() => {
  const names = ["aria-label", "aria-valuetext", "title", "data-words"];
  const parts = [...document.querySelectorAll("main, .site-header")];
  const labels = parts.flatMap((part) => [...part.querySelectorAll("*")])
    .flatMap((one) => names.map((name) => one.getAttribute(name) ?? ""));
  return [...parts.map((part) => part.innerText), ...labels].join("\\n");
}"""


def test_a_step_a_bump_and_a_step_back_are_said(page: Page) -> None:
    page.goto(SMALL)
    page.keyboard.press("ArrowRight")
    ways.expect_said(page, f"−0.5. {SECOND} Total −0.5.")
    page.keyboard.press("ArrowUp")
    ways.expect_said(page, f"Bumped. −0.5. {SECOND} Total −1.0.")
    page.keyboard.press("z")
    ways.expect_said(page, f"One step back. {SECOND} Total −0.5.")
    page.keyboard.press("r")
    ways.expect_said(page, f"A new attempt. {FIRST}")


def test_looking_around_and_asking_where_one_is_are_answered(page: Page) -> None:
    page.goto("/?rows=3&cols=4&seed=5&painted=0-4:-0.5&walls=5")
    page.keyboard.press("Shift+ArrowUp")
    ways.expect_said(page, "The edge.")
    page.keyboard.press("Shift+ArrowRight")
    ways.expect_said(page, "Row 1, column 2: blue, −0.5.")
    page.keyboard.press("Shift+ArrowDown")
    ways.expect_said(page, "Row 2, column 2: a wall.")
    page.keyboard.press("i")
    ways.expect_said(page, f"{FIRST} The goal is 2 down and 3 right. Total 0.0.")


def test_a_slip_is_said_with_the_way_it_went(page: Page) -> None:
    page.goto("/?rows=3&cols=3&seed=5&slip=0.9&painted=0-7:-0.5")
    was, told = 0, ""
    while not told.startswith("Slipped"):
        was = int(page.locator("#board .agent").get_attribute("data-state") or 0)
        page.keyboard.press("ArrowUp")
        expect(page.locator("#announcer")).not_to_have_text(told)
        told = page.locator("#announcer").text_content() or ""
    found = re.match(r"Slipped (\w+)\. (Bumped\. )?−0\.5\. Row (\d), column (\d)\. Up: .*\. Total −\d+\.\d\.$", told)
    assert found, told
    way, bumped, row, col = found.groups()
    now = 3 * (int(row) - 1) + int(col) - 1
    assert now == was if bumped else now - was == (-3, 1, 3, -1)[MOVES.index(way)]
    ways.expect_state(page, now)


def test_a_success_and_failures_of_each_kind_are_said(page: Page) -> None:
    page.goto(SMALL)
    ways.walk_along(page, CHEAP)
    ways.expect_said(page, "A success: 1 of 3. You reached the goal with +5.0 in 5 steps. Enter plays again.")
    ways.press(page, "Enter", "ArrowRight")
    page.keyboard.press("g")
    ways.expect_said(page, "A useful failure: 1 of 3. You stopped after 1 step, at −0.5. Enter plays again.")
    page.keyboard.press("Enter")
    ways.walk_along(page, [1, 1, 3, 1, 3, 1, 1, 2, 2])
    ways.expect_said(
        page,
        f"A useful failure: 2 of 3. {COSTLY}: −5.1. Enter plays again.",
    )


def test_a_replay_is_said_step_by_step(page: Page) -> None:
    page.goto(SMALL)
    walk.play_by_keys(page, CHEAP)
    replay = page.locator('[data-act="replay"]')
    replay.press("Enter")
    ways.expect_said(page, "Replay of attempt 1: success, +5.0 in 5 steps. Escape goes back to play.")
    ways.press(page, "Space", *["ArrowLeft"] * 5)
    page.keyboard.press("ArrowRight")
    ways.expect_said(page, f"Step 1 of 5, total −0.5. {BELOW}")
    page.keyboard.press("i")
    ways.expect_said(page, f"{BELOW} The goal is 1 down and 3 right.")
    page.keyboard.press("ArrowUp")
    ways.expect_said(page, "2 times.")
    page.keyboard.press("t")
    ways.expect_said(page, f"A new attempt, from step 1 on. {BELOW}")


def test_the_time_runs_out_by_itself(page: Page, base_url: str) -> None:
    page.goto(SMALL + "&time_limit_s=5")
    expect(page.locator(".legend-time")).to_have_text("An attempt may last 5 s from its first step on.")
    expect(page.locator("#time-left")).to_have_text("0:05")
    page.keyboard.press("ArrowRight")
    expect(page.locator("#announcer")).to_have_text("2 seconds left.")
    ways.expect_shows(page, "result")
    ways.expect_said(page, "A useful failure: 1 of 3. The time is up after 1 step, at −0.5. Enter plays again.")
    page.keyboard.press("Enter")
    expect(page.locator("#time-left")).to_have_text("0:05")
    (only,) = ways.attempts_of(page, base_url)
    assert (only["ending"], only["actions"]) == ("out_of_time", [1])
    assert 5000 <= only["record"]["elapsed_ms"] < 60_000


def test_the_steps_run_out(page: Page, base_url: str) -> None:
    page.goto(SMALL + "&step_limit=6")
    ways.walk_along(page, [1, 3, 1, 3, 1, 3])
    ways.expect_said(page, "A useful failure: 1 of 3. All 6 steps are used up, at −3.0. Enter plays again.")
    (only,) = ways.attempts_of(page, base_url)
    assert (only["ending"], len(only["actions"])) == ("out_of_steps", 6)


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveServer]:
    """A server of a study that hides totals and lets a held key go on."""
    settings = {"IRLFR_SHOW_TOTALS": "false", "IRLFR_HOLD_TO_MOVE": "true"}
    live = LiveServer(tmp_path_factory.mktemp("study"), settings)
    live.start()
    yield live
    live.stop()


def test_a_study_may_hide_every_total(browser: Browser, study: LiveServer) -> None:
    with ways.visit(browser, study.address) as page:
        page.goto(SMALL)
        page.keyboard.press("ArrowDown")
        ways.expect_said(page, f"−0.5. {BELOW}")
        page.keyboard.press("z")
        page.keyboard.press("i")
        ways.expect_said(page, f"{FIRST} The goal is 2 down and 3 right.")
        ways.walk_along(page, CHEAP)
        ways.expect_said(page, "A success: 1 of 3. You reached the goal in 5 steps. Enter plays again.")
        page.keyboard.press("Enter")
        ways.walk_along(page, [1, 1, 3, 1, 3, 1, 1, 2, 2])
        ways.expect_said(
            page,
            f"A useful failure: 1 of 3. {COSTLY}. Enter plays again.",
        )
        walk.finish_attempt(page, lambda: ways.press(page, "Enter", "ArrowRight", "ArrowRight", "g", "Enter"))
        expect_no_total(page, {"+5.0", "−5.1", "−3.7"})
        page.locator('[data-act="replay"]').last.press("Enter")
        ways.press(page, "Space", "ArrowRight", "ArrowRight")
        expect_no_total(page, {"+5.0", "−5.1", "−3.7", "−1.0"})
        ways.attempts_of(page, study.address)
        page.goto(f"/worlds/{walk.page_data(page)['world']['id']}/rank")
        expect(page.locator(".card")).to_have_count(3)
        expect_no_total(page, {"+5.0", "−5.1", "−3.7"})
        expect(page.locator("[data-sort]")).to_have_count(0)


def test_the_practice_of_such_a_study_shows_none_either(browser: Browser, study: LiveServer) -> None:
    with ways.visit(browser, study.address) as page:
        page.goto(SMALL)
        page.locator("#practice-begin").click()
        ways.press(page, "ArrowUp", "ArrowRight", "ArrowRight", "ArrowRight", "ArrowDown")
        expect(page.locator("#practice-words")).to_have_text("A success: the goal paid 7, and some is left of it.")
        assert "total" not in page.locator("#practice").inner_text()


def expect_no_total(page: Page, totals: set[str]) -> None:
    told = page.evaluate(TOLD)
    assert not {total for total in totals if total in told}
    assert "total" not in told.replace("with a total of 0 or more", "")


def test_a_study_may_let_a_held_key_go_on(browser: Browser, study: LiveServer) -> None:
    with ways.visit(browser, study.address) as page:
        page.goto("/?rows=3&cols=9&seed=5")
        page.keyboard.down("ArrowRight")
        ways.expect_state(page, 8)
        page.keyboard.up("ArrowRight")
        page.keyboard.press("g")
        (only,) = ways.attempts_of(page, study.address)
        device = only["record"]["device"]
        assert (device[0], set(device[1:])) == ("key", {"hold"})
        assert only["record"]["client"]["hold_to_move"] is True
        assert only["record"]["client"]["totals_shown"] is False


def test_the_page_reads_sensibly_before_the_first_step(page: Page) -> None:
    page.goto(SMALL)
    expect(page.locator("main")).to_match_aria_snapshot("""
      - main:
        - region "The world":
          - heading "Play your best and your worst. Watch algorithms learn from both." [level=1]
          - application /World of 3 by 4 squares\\. Arrow keys move you, with Shift they look around; I says where/
          - paragraph: "Row 1, column 1. Up: the edge; right: blue −0.5; down: blue −0.5; left: the edge."
          - text: "blue: 0 to −1 red, hatched: −1 to −7 goal: +7 Stronger colours cost more."
          - button "Numbers"
          - group: Options
        - complementary "Your play":
          - region "This attempt":
            - heading "This attempt" [level=2]
            - term: total
            - definition: "0.0"
            - term: step
            - definition: 0/24
            - term: last step
            - definition: –
            - button "Undo" [disabled]
            - button "Restart" [disabled]
            - button "Give up" [disabled]
            - paragraph: Arrow keys or W A S D move you. Hold N for numbers; ? shows all keys.
          - region "Your attempts":
            - heading "Your attempts" [level=2]
            - paragraph: 0 of 3 successes 0 of 3 failures
            - list
            - paragraph: /Each attempt you finish appears here/
          - region "Practice":
            - paragraph:
              - strong: New here?
              - text: "Practise first: one minute."
            - button "Practise"
            - button "Skip"
          - paragraph: 3 successes and 3 failures to go.
          - link "Rank them" [disabled]
        - list
        - group: The board as text
    """)


def test_the_page_reads_sensibly_in_the_midst_of_an_attempt(page: Page) -> None:
    page.goto(SMALL + "&slip=0&time_limit_s=90")
    ways.press(page, "ArrowRight", "ArrowDown", "Shift+ArrowRight")
    expect(page.locator("main")).to_match_aria_snapshot("""
      - region "The world":
        - heading
        - application /World of 3 by 4 squares/
        - paragraph: "Row 2, column 2. Up: blue −0.5; right: blue −0.5; down: blue −0.5; left: blue −0.5."
        - text: /An attempt may last 90 s from its first step on/
        - button "Numbers"
      - complementary "Your play":
        - region "This attempt":
          - term: total
          - definition: −1.0
          - term: step
          - definition: 2/24
          - term: last step
          - definition: −0.5
          - term: time left
          - definition:
            - timer: /1:\\d\\d/
          - button "Undo"
          - button "Restart"
          - button "Give up"
          - paragraph: "Row 2, column 3: blue, −0.5."
    """)


def test_the_page_reads_sensibly_with_a_result_and_two_attempts(page: Page) -> None:
    page.goto(SMALL)
    walk.play_by_keys(page, CHEAP)
    ways.press(page, "ArrowRight", "g")
    ways.expect_saved(page)
    expect(page.locator("aside")).to_match_aria_snapshot("""
      - complementary "Your play":
        - region "This attempt":
          - heading "This attempt" [level=2]
          - term: total
          - definition: −0.5
          - term: step
          - definition: 1/24
          - term: last step
          - definition: −0.5
          - 'heading "✗ A useful failure: 1 of 3" [level=3]'
          - paragraph: You stopped after 1 step, at −0.5.
          - button "Again"
        - region "Your attempts":
          - heading "Your attempts" [level=2]
          - text: ✓ all saved
          - paragraph: 1 of 3 successes 1 of 3 failures
          - list:
            - listitem:
              - text: /✗ failure −0\\.5 · 1 step/
              - button "Replay attempt 2"
              - button "Discard attempt 2"
            - listitem:
              - text: /✓ success \\+5\\.0 · 5 steps/
              - button "Replay attempt 1"
              - button "Discard attempt 1"
        - paragraph: 2 successes and 2 failures to go, or rank now.
        - link "Rank them"
    """)
