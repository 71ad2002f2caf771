"""Faults that people met on the pages; each test failed before its fault was mended."""

import re
import uuid

import pytest
from playwright.sync_api import Browser, Page, expect

from tests import journey
from tests.browser import walk
from tests.browser.conftest import watched


def focused(page: Page) -> str:
    """Id, action or class of what has the focus; empty when nothing has it."""
    words: str = page.evaluate(
        """() => {
          const { id, dataset, className } = document.activeElement;
          return id || dataset.command || dataset.action || dataset.act || className;
        }"""
    )
    return words


def play_one_of_each(page: Page, address: str, *, seed: int) -> str:
    """One success and two failures that never reach the goal, by the API; the world's id."""
    client = walk.ContextClient(page, address)
    world = client.post("/worlds", {"seed": seed})
    grid = journey.Grid(world)
    wise = grid.cheapest_path([max(-reward, 0.0) for reward in grid.rewards])
    for actions, ending in ((wise, "goal"), ([1], "gave_up"), ([1, 1], "gave_up")):
        demonstration = {"id": str(uuid.uuid4()), "actions": actions, "step_ms": [1.0] * len(actions), "ending": ending}
        client.post(f"/worlds/{world['id']}/demonstrations", demonstration)
    return str(world["id"])


def test_unfinished_failures_can_be_included_where_they_are_all_there_is(page: Page, base_url: str) -> None:
    """The page asked for a setting that it then ignored, and led to an order that was complete."""
    world_id = play_one_of_each(page, base_url, seed=31)
    page.goto(f"/worlds/{world_id}/rank")
    walk.confirm_order(page)
    page.goto(f"/worlds/{world_id}/learn")
    expect(page.locator('[data-part="way-there"]')).to_have_attribute("href", f"/worlds/{world_id}")
    boards = [one for one in walk.page_data(page)["learners"] if one["preselected"]]
    expect(page.locator("input[name=learner]:disabled")).to_have_count(
        sum(one["missing"] is not None for one in boards)
    )
    expect(page.locator('.agent-panel[data-learner="irlf"] input')).to_be_disabled()
    page.locator('[data-action="include"]').click()
    expect(page.locator("input[name=learner]:checked")).to_have_count(len(boards))
    page.locator('[data-action="learn"]').click()
    expect(page.locator("learn-page")).to_have_attribute("data-status", "done", timeout=walk.LEARNING_MS)
    expect(page.locator('.agent-panel[data-stage="learned"]')).to_have_count(len(boards))


def test_focus_stays_on_the_page_when_its_button_goes(page: Page, base_url: str) -> None:
    page.goto("/?seed=32")
    page.keyboard.press("ArrowRight")
    page.locator('[data-command="undo"]').focus()
    page.keyboard.press("Enter")
    assert focused(page) == "board"
    page.keyboard.press("ArrowRight")
    page.locator('[data-command="giveUp"]').focus()
    page.keyboard.press("Enter")
    assert focused(page) == "board"
    expect(page.locator("#sync")).to_have_attribute("data-sync", "saved")
    page.locator('[data-act="discard"]').focus()
    page.keyboard.press("Enter")
    assert focused(page) == "restore"

    world_id, _ = walk.prepared(page, base_url, seed=33)
    page.goto(f"/worlds/{world_id}/rank")
    page.locator('#list-success .card >> nth=1 >> [data-act="up"]').focus()
    page.keyboard.press("Enter")
    assert focused(page) == "card"

    page.goto(f"/worlds/{world_id}/learn")
    page.locator('[data-action="learn"]').focus()
    page.keyboard.press("Enter")
    expect(page.locator("learn-page")).to_have_attribute("data-status", "running", timeout=walk.LEARNING_MS)
    expect(page.locator('[data-action="cancel"]')).to_be_focused()
    expect(page.locator("learn-page")).to_have_attribute("data-status", "done", timeout=walk.LEARNING_MS)
    expect(page.locator('[data-part="compare"]')).to_be_focused()
    expect(page.locator('.path-step[data-step="learn"]')).to_have_attribute("data-done", "true")


def test_a_double_press_of_learn_cancels_nothing(page: Page, base_url: str) -> None:
    world_id, _ = walk.prepared(page, base_url, seed=34)
    page.goto(f"/worlds/{world_id}/learn")
    page.locator('[data-action="learn"]').dblclick()
    expect(page.locator("learn-page")).to_have_attribute("data-status", "done", timeout=walk.LEARNING_MS)


def test_a_cancelled_run_says_so_and_can_be_asked_for_again(page: Page, base_url: str) -> None:
    world_id, _ = walk.prepared(page, base_url, seed=35)
    page.goto(f"/worlds/{world_id}/learn")
    page.locator('[data-action="learn"]').click()
    page.wait_for_timeout(800)
    page.locator('[data-action="cancel"]').click()
    expect(page.locator("learn-page")).to_have_attribute("data-status", "cancelled")
    expect(page.locator('[data-action="learn"]')).to_be_visible()


def test_sort_by_score_puts_the_best_success_and_the_worst_failure_first(page: Page, base_url: str) -> None:
    world_id, _ = walk.prepared(page, base_url, seed=36)
    page.goto(f"/worlds/{world_id}/rank")
    totals = {one["id"]: one["total"] for one in walk.page_data(page)["demonstrations"]}
    for outcome, is_falling in (("success", True), ("failure", False)):
        before = walk.order_of(page, outcome)
        page.locator(f'#list-{outcome} [data-act="down"]').first.click()
        page.locator(f'[data-sort="{outcome}"]').click()
        assert walk.order_of(page, outcome) == sorted(before, key=totals.__getitem__, reverse=is_falling)


def test_escape_leaves_a_replay(page: Page) -> None:
    page.goto("/?seed=34")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("g")
    page.locator('[data-act="replay"]').click()
    expect(page.locator("#now")).to_have_attribute("data-shows", "replay")
    expect(page.locator("#announcer")).to_contain_text("Replay of attempt 1")
    page.keyboard.press("Escape")
    expect(page.locator("#now")).to_have_attribute("data-shows", "result")


def test_numbers_show_while_a_slider_has_the_focus(page: Page, base_url: str) -> None:
    _, run_id = walk.prepared(page, base_url, seed=35)
    page.goto(f"/runs/{run_id}/comparison")
    page.locator('[data-part="range"]').focus()
    ink = "document.querySelector('.board-ink').toDataURL()"
    before = page.evaluate(ink)
    page.keyboard.down("n")
    page.wait_for_function(f"before => {ink} !== before", arg=before)
    page.keyboard.up("n")
    page.wait_for_function(f"before => {ink} === before", arg=before)


def test_numbers_of_a_world_of_a_hundred_rows_stand_beside_the_agent(page: Page) -> None:
    page.goto("/?seed=36&rows=100&cols=100")
    page.keyboard.press("ArrowRight")
    page.keyboard.down("n")
    expect(page.locator(".board-tag")).to_have_count(3)
    page.keyboard.up("n")
    expect(page.locator(".board-tag")).to_have_count(0)


def test_a_slippery_world_says_so(page: Page) -> None:
    page.goto("/?seed=37&slip=0.9")
    expect(page.locator(".legend-slip")).to_contain_text("90 %")
    told = set()
    for _ in range(12):
        page.keyboard.press("ArrowRight")
        told.add(page.locator(".board-float").text_content() or "")
    assert any(text.startswith("slipped") for text in told), told


def test_a_hopeless_world_leads_on(page: Page) -> None:
    page.goto("/?seed=0&red_probability=0.9")
    expect(page.locator("#next")).to_be_hidden()
    expect(page.locator("#elsewhere")).to_have_attribute("href", "/?new")


def test_an_empty_rank_page_leads_to_play(page: Page, base_url: str) -> None:
    world_id = walk.ContextClient(page, base_url).post("/worlds", {"seed": 38})["id"]
    page.goto(f"/worlds/{world_id}/rank")
    expect(page.locator(".rank-next .button:visible")).to_have_attribute("href", f"/worlds/{world_id}")


@pytest.mark.parametrize("gesture", ["replay", "watch"])
def test_on_a_phone(browser: Browser, base_url: str, gesture: str) -> None:
    """A replay is seen where it is asked for, and a card that played by itself shows its whole path afterwards."""
    context = browser.new_context(
        base_url=base_url, viewport={"width": 360, "height": 740}, has_touch=True, is_mobile=True
    )
    page = context.new_page()
    with watched(page, base_url):
        world_id, _ = walk.prepared(page, base_url, seed=39)
        if gesture == "replay":
            page.goto(f"/worlds/{world_id}")
            page.locator('[data-act="replay"]').last.tap()
            expect(page.locator("#board")).to_be_in_viewport(ratio=0.99)
        else:
            page.goto(f"/worlds/{world_id}/rank")
            cards = page.locator("#list-success .card")
            cards.nth(0).focus()
            expect(cards.nth(0).locator(".agent")).to_have_count(1)
            cards.nth(1).focus()
            expect(cards.nth(0).locator(".agent")).to_have_count(0)
    context.close()


def test_after_a_click_by_mouse_enter_plays_again(page: Page) -> None:
    page.goto("/?seed=5")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("g")
    expect(page.locator("#now")).to_have_attribute("data-shows", "result")
    page.locator("#numbers").click()
    page.locator('[data-act="discard"]').click()
    page.keyboard.press("Enter")
    expect(page.locator("#now")).to_have_attribute("data-shows", "playing")
    expect(page.locator('[data-act="restore"]')).to_be_visible()
    expect(page.locator("#numbers")).to_have_attribute("aria-pressed", "true")


def test_trying_again_keeps_the_attempt_that_was_under_way(page: Page) -> None:
    page.goto("/?seed=5")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("g")
    page.keyboard.press("Enter")
    for _ in range(3):
        page.keyboard.press("ArrowDown")
    page.locator('[data-act="replay"]').click()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("t")
    expect(page.locator("#left")).to_contain_text("after 3 steps")
    page.keyboard.press("ArrowDown")
    expect(page.locator("#left")).to_be_hidden()
    page.keyboard.press("g")
    page.locator('[data-command="takeUp"]').click()
    expect(page.locator("#n-steps")).to_have_text("3")


def test_a_world_that_somebody_else_stored_gets_its_address_too(page: Page, browser: Browser, base_url: str) -> None:
    stranger = browser.new_context()
    walk.ContextClient(stranger.new_page(), base_url).post("/worlds", {"seed": 40})
    stranger.close()
    page.goto("/?seed=40")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("g")
    expect(page).to_have_url(re.compile(r"/worlds/[0-9a-f-]{36}$"))
