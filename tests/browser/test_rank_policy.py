"""While one orders, a small board shows what would be learned from the order as it is. It never stands in the way."""

import random
import re
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import BrowserContext, Locator, Page, Request, expect

from tests import journey
from tests.browser import ranking, walk

SHOWN: Any = """async () => {
  const { view } = document.querySelector("#policy-picture irl-board");
  return { values: [...view.values], arrows: view.arrows.map((four) => [...four]) };
}"""


def played(page: Page, address: str) -> str:
    """A world with three successes, and three failures that reached the goal; its id."""
    client = walk.ContextClient(page, address)
    world = client.post("/worlds", {"seed": 5})
    grid = journey.Grid(world)
    wise = grid.cheapest_path([max(-reward, 0.0) for reward in grid.rewards])
    blind = grid.cheapest_path([1.0 for _ in grid.rewards])
    for actions in journey.three_of(grid, wise, success=True) + journey.three_of(grid, blind, success=False):
        ranking.send(client, world["id"], actions, "goal", random.Random(5))
    return str(world["id"])


def policy(page: Page) -> Locator:
    return page.locator("#policy")


def expect_shown(page: Page, n: int) -> None:
    """So many answers were painted, and none is awaited."""
    expect(policy(page)).to_have_attribute("data-shown", str(n), timeout=walk.LEARNING_MS)
    expect(page.locator("#policy:not([data-asking])")).to_have_count(1, timeout=walk.LEARNING_MS)


def asked_by(page: Page) -> list[dict[str, Any]]:
    """What the page asks from now on."""
    asked: list[dict[str, Any]] = []

    def hear(request: Request) -> None:
        if request.url.endswith("/previews"):
            asked.append(request.post_data_json or {})

    page.on("request", hear)
    return asked


def test_each_drop_shows_what_the_new_order_teaches(page: Page, base_url: str) -> None:
    world_id = played(page, base_url)
    client = walk.ContextClient(page, base_url)
    asked = asked_by(page)
    ranking.open_lists(page, world_id, n_cards=6)
    expect_shown(page, 1)
    expect(page.locator("#policy-told")).to_contain_text("Its longest arrows")
    expect(page.locator("#policy-used")).to_have_text("From 3 successes and 3 failures.")
    first = page.evaluate(SHOWN)

    order = ranking.order_shown(page, "success")
    ranking.Mouse(page).drag(order[2][0], ranking.Where(order[0][0], "above"))
    expect_shown(page, 2)
    now = {outcome: ranking.order_shown(page, outcome) for outcome in ("success", "failure")}
    assert asked[-1] == {"learner": "irlfr", "orders": now}
    told = client.post(f"/worlds/{world_id}/previews", asked[-1])
    shown = page.evaluate(SHOWN)
    assert (shown["arrows"], shown["values"]) == (told["policy"], [value for row in told["reward"] for value in row])
    pairs = zip(first["arrows"], shown["arrows"], strict=True)
    # The goal has no arrow.
    turned = sum(after[np.argmax(after)] - after[np.argmax(before)] > 0.01 for before, after in [*pairs][:-1])
    words = {0: "No arrow turned.", 1: "1 arrow turned."}.get(turned, f"{turned} arrows turned.")
    expect(page.locator("#policy-told")).to_contain_text(words)
    expect(page.locator(".policy-mark")).to_have_count(turned)
    expect(page.locator("#policy-picture irl-board")).to_have_attribute("aria-label", re.compile("What IRLFR would"))

    page.locator("#undo").click()
    expect_shown(page, 3)
    assert page.evaluate(SHOWN) == first
    expect(page.locator("#undo")).to_be_focused()

    page.get_by_label("IRLR", exact=True).check()
    expect_shown(page, 4)
    assert asked[-1] == {"learner": "irlr", "orders": {"success": ranking.order_shown(page, "success")}}
    failures = ranking.order_shown(page, "failure")
    ranking.Mouse(page).drag(failures[2][0], ranking.Where(failures[0][0], "beside"))
    compare_ends(page)
    expect(page.locator("#compare-swap-policy")).to_have_text(
        re.compile(r"^In what IRLR would learn, (no|\d+) arrow"), timeout=walk.LEARNING_MS
    )
    assert len(asked) == 5, "failures are nothing to IRLR; the fifth is what if"
    page.keyboard.press("Escape")

    page.reload()
    expect_shown(page, 1)
    expect(page.get_by_label("IRLR", exact=True)).to_be_checked()
    policy(page).locator("summary").click()
    page.reload()
    expect(page.locator(".card")).to_have_count(6)
    assert policy(page).get_attribute("open") is None
    page.locator("#list-success [data-act=down]").first.click()
    page.locator("#undo").click()
    assert len(asked) == 6, "what is closed asks nothing"


def compare_ends(page: Page) -> None:
    """Put the first and the last success side by side."""
    both = page.locator("#list-success [data-act=compare]")
    both.first.click()
    both.last.click()


@pytest.mark.parametrize("successes", [0, 2])
def test_without_an_attempt_that_reached_the_goal_it_says_so_and_asks_nobody(
    page: Page, base_url: str, successes: int
) -> None:
    world_id = ranking.world_with(page, base_url, successes=successes, failures=2)
    asked = asked_by(page)
    ranking.open_lists(page, world_id, n_cards=successes + 2)
    if successes:
        words = "Failures teach it something once they reach the goal."
        expect(page.locator("#policy-used")).to_contain_text(words, timeout=walk.LEARNING_MS)
        expect(page.get_by_label("IRLFR", exact=True)).to_be_hidden()
    else:
        expect(page.locator("#policy-told")).to_contain_text("Reach it once, whatever it costs.")
        assert asked == []


def test_without_an_answer_one_goes_on_ordering_and_the_next_change_asks_again(
    visitor: BrowserContext, base_url: str
) -> None:
    page = visitor.new_page()
    world_id = played(page, base_url)
    ranking.open_lists(page, world_id, n_cards=6)
    expect_shown(page, 1)
    visitor.route("**/previews", lambda route: route.abort())
    order = ranking.order_shown(page, "success")
    ranking.Mouse(page).drag(order[2][0], ranking.Where(order[0][0], "above"))
    expect(page.locator("#policy-told")).to_have_text("No connection just now. The picture is of an earlier order.")
    refusal = {"error": {"code": "too_slow", "message": "Learning takes too long here.", "fields": {}}}
    visitor.unroute("**/previews")
    visitor.route("**/previews", lambda route: route.fulfill(status=422, json=refusal))
    page.locator("#undo").click()
    expect(page.locator("#policy-told")).to_contain_text("Learning takes too long here.")
    assert ranking.order_shown(page, "success") == order
    visitor.unroute("**/previews")
    page.locator("#redo").click()
    expect_shown(page, 2)
    walk.confirm_order(page)


def test_a_study_that_hides_it_has_no_word_of_it_on_the_page(visitor: BrowserContext, base_url: str) -> None:
    page = visitor.new_page()
    world_id = played(page, base_url)
    asked = asked_by(page)
    visitor.route("**/rank", hide_policy)
    ranking.open_lists(page, world_id, n_cards=6)
    order = ranking.order_shown(page, "success")
    ranking.Mouse(page).drag(order[2][0], ranking.Where(order[0][0], "above"))
    compare_ends(page)
    expect(page.locator("#compare-swap-list dd")).to_have_count(2)
    page.keyboard.press("Escape")
    walk.confirm_order(page)
    assert asked == []


def hide_policy(route: Any) -> None:
    """The page as a server with IRLFR_SHOW_POLICY=false makes it."""
    answer = route.fetch()
    text, n_options = re.subn(r'"show_policy": ?true', '"show_policy": false', answer.text())
    text, n_parts = re.subn(r'<details class="policy".*?</details>', "", text, flags=re.DOTALL)
    assert (n_options, n_parts) == (1, 1)
    route.fulfill(response=answer, body=text)
