"""A person at a desk: arrow keys, mouse and keyboard, from the first page to the comparison."""

import re

from playwright.sync_api import Page, expect

from tests import journey
from tests.browser import walk


def test_a_person_plays_ranks_learns_and_compares(page: Page, base_url: str) -> None:
    page.goto("/?seed=12")
    for n, actions in enumerate(walk.attempts_for(page), 1):
        walk.play_by_keys(page, actions)
        expect(page.locator("#attempts .attempt")).to_have_count(n)
    expect(page.locator("#n-successes")).to_have_text("3")
    expect(page.locator("#n-failures")).to_have_text("3")
    expect(page.locator("#sync")).to_have_attribute("data-sync", "saved")
    expect(page).to_have_url(re.compile(r"/worlds/[0-9a-f-]{36}$"))
    page.locator("#next").click()

    check_mouse_and_keyboard_rank(page)
    walk.confirm_order(page)
    page.locator("#learn").click()

    expect(page.locator('[data-part="more"]')).to_be_visible()
    learners = [*walk.preselected(page), "trex"]
    walk.add_learner(page, "trex")
    assert walk.learn(page) >= 3, "fewer than three frames before the end"
    expect(page).to_have_url(re.compile(r"/runs/[0-9a-f-]{36}$"))
    run_id = page.url.rpartition("/")[2]
    page.locator('[data-part="compare"]').click()
    check_comparison(page, base_url, run_id, learners)
    expect(page.locator('[data-part="intervals"]')).to_contain_text("Bayesian IRLFR itself expects its plan to earn")


def check_mouse_and_keyboard_rank(page: Page) -> None:
    """Successes by mouse: the last to the top. Failures by keyboard: the first down by two."""
    first, second, third = walk.order_of(page, "success")
    cards = page.locator("#list-success .card")
    walk.drag_by_mouse(page, cards.nth(2), cards.nth(0))
    expect(cards.nth(0)).to_have_attribute("data-demonstration-id", third)
    assert walk.order_of(page, "success") == [third, first, second]

    first, second, third = walk.order_of(page, "failure")
    page.locator(f'[data-demonstration-id="{first}"]').focus()
    for key in ("Space", "ArrowDown", "ArrowDown", "Space"):
        page.keyboard.press(key)
    assert walk.order_of(page, "failure") == [second, third, first]
    expect(page.locator(f'[data-demonstration-id="{first}"]')).to_be_focused()
    weights = [card.get_attribute("data-weight") for card in page.locator("#list-failure .card").all()]
    assert weights == ["0.500000", "0.333333", "0.166667"]


def check_comparison(page: Page, base_url: str, run_id: str, learners: list[str]) -> None:
    """Figures of the table are the API's, in order of place; `test_compare.py` recomputes them all."""
    comparison = walk.ContextClient(page, base_url).get(f"/runs/{run_id}/comparison")
    rows = page.locator('[data-part="rows"] tr')
    expect(rows).to_have_count(len(learners) + 2)
    assert {entry["who"] for entry in comparison["entries"]} == {"human", "optimal", *learners}
    assert set(learners) > set(journey.LEARNERS), "the paper's four are among them"
    for row, entry in zip(rows.all(), comparison["entries"], strict=True):
        expect(row).to_have_attribute("data-who", entry["who"])
        told = {cell.get_attribute("data-figure"): cell.text_content() or "" for cell in row.locator("td").all()}
        assert told["place"] == str(entry["place"])
        assert told["mean"].partition(" ±")[0] == figure(entry["mean_return"], 1)
        assert told["expected"] == figure(entry["expected_return"], 2)
        assert told["episodes"] == str(entry["episodes"])


def figure(value: float | None, decimals: int) -> str:
    return "–" if value is None else f"{value:.{decimals}f}".replace("-", "−")
