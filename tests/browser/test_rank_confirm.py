"""Confirming an order, and whatever may come in between: nothing is lost, and the page says what counts."""

import itertools
import json
import re
import uuid
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, BrowserContext, Page, expect
from scipy.stats import kendalltau

from tests import journey
from tests.browser import walk
from tests.browser.conftest import WATCH_FOR_VIOLATIONS
from tests.live_server import LiveServer

Json = dict[str, Any]
Outcome = Literal["success", "failure"]
SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
RANDOM_BOTH = (
    "You have not moved anything in your successes or your failures."
    " Both lists stand in a random order. Are they yours?"
)
CONFIRMED = "Confirmed: version 1 of your successes and of your failures counts. Next: Learn."
LOOK_AGAIN = "The order of the others is as you left it. Look at it, then confirm again."


@pytest.fixture
def visitor(browser: Browser, base_url: str) -> Iterator[BrowserContext]:
    """A new visitor. The browser itself reports a refusal on its console, so only scripts are watched."""
    context = browser.new_context(base_url=base_url, reduced_motion="reduce")
    yield from watched(context)


def watched(context: BrowserContext) -> Iterator[BrowserContext]:
    faults: list[str] = []
    context.add_init_script(WATCH_FOR_VIOLATIONS)
    context.on("weberror", lambda error: faults.append(str(error.error)))
    context.on("console", lambda message: faults.append(message.text) if message.text.startswith("CSP") else None)
    yield context
    context.close()
    assert not faults, "\n".join(faults)


def rank_page(context: BrowserContext, world_id: str) -> Page:
    page = context.new_page()
    page.goto(f"/worlds/{world_id}/rank")
    expect(page.locator("#rank-state")).not_to_be_empty()
    return page


def played(context: BrowserContext, address: str, *, seed: int = 5) -> str:
    """Three successes and three failures, by the API; the id of the world."""
    client = Api(context, address)
    world = client.post("/worlds", {"seed": seed})
    journey.play(client, journey.Grid(world), world["id"])
    return str(world["id"])


class Api(walk.ContextClient):
    """The API, asked with a visitor's cookies."""

    def __init__(self, context: BrowserContext, address: str) -> None:
        journey.Client.__init__(self, address)
        self._requests = context.request


def play_more(context: BrowserContext, address: str, world_id: str, *, n: int = 1) -> list[Json]:
    """Failures of one and two and three … steps, given up."""
    client = Api(context, address)
    told = [{"actions": [1] * steps, "step_ms": [1.0] * steps, "ending": "gave_up"} for steps in range(1, n + 1)]
    return [client.post(f"/worlds/{world_id}/demonstrations", {"id": str(uuid.uuid4())} | one) for one in told]


def versions(context: BrowserContext, address: str, world_id: str, outcome: Outcome) -> list[Json]:
    found: list[Json] = Api(context, address).get(f"/worlds/{world_id}/rankings/{outcome}/versions")
    return found


def move_first_down(page: Page, outcome: Outcome) -> list[str]:
    before = walk.order_of(page, outcome)
    page.locator(f'#list-{outcome} .card[data-position="1"] [data-act="down"]').click()
    after = walk.order_of(page, outcome)
    assert after == [before[1], before[0], *before[2:]]
    return after


def touch_both(page: Page) -> None:
    for outcome in ("success", "failure"):
        move_first_down(page, outcome)


def expect_said(page: Page, sentence: str) -> None:
    expect(page.locator("#announcer")).to_have_text(sentence)


def expect_confirmed(page: Page) -> None:
    expect(page.locator("#rank")).to_have_attribute("data-confirmed", "true")


def flat(order: list[list[str]]) -> list[str]:
    return list(itertools.chain(*order))


# An untouched order


def test_an_untouched_random_order_is_asked_about_and_going_on_sends_nothing(
    visitor: BrowserContext, base_url: str
) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    expect(page.locator("#rank-state")).to_have_text("An order counts once you confirm it.")
    page.locator("#confirm").focus()
    page.keyboard.press("Enter")
    dialog = page.get_by_role("dialog", name="Is this your order?")
    expect(dialog).to_have_accessible_description(RANDOM_BOTH)
    expect(page.locator("#untouched-title")).to_be_focused()
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    expect(page.locator("#confirm")).to_be_focused()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    expect(dialog.get_by_role("button", name="Go on ordering")).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.locator('#list-success .card[data-position="1"]')).to_be_focused()
    assert versions(visitor, base_url, world_id, "success") == []


def test_an_untouched_order_that_is_theirs_counts_and_says_so(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    page.locator("#confirm").focus()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect_confirmed(page)
    expect_said(page, CONFIRMED)
    expect(page.locator("#rank-state")).to_have_text(
        "✓ Confirmed: version 1 of your successes and of your failures counts. You can still change it."
    )
    expect(page.locator("#learn")).to_be_focused()
    expect(page.locator('.path-step[data-step="rank"]')).to_have_attribute("data-done", "true")
    for outcome in ("success", "failure"):
        (only,) = versions(visitor, base_url, world_id, outcome)
        assert only["untouched"] is True
        assert flat(only["order"]) == walk.order_of(page, outcome)


def test_only_what_is_untouched_is_asked_about(visitor: BrowserContext, base_url: str) -> None:
    page = rank_page(visitor, played(visitor, base_url))
    move_first_down(page, "success")
    page.locator("#confirm").click()
    expect(page.locator("#untouched-text")).to_have_text(
        "You have not moved anything in your failures. They stand in a random order. Is it yours?"
    )
    page.locator('#untouched [value="no"]').click()
    move_first_down(page, "failure")
    page.locator("#confirm").click()
    expect_confirmed(page)
    expect_said(page, CONFIRMED)


def test_confirming_twice_in_a_hurry_makes_one_version(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    page.locator("#confirm").evaluate("button => { button.click(); button.click(); button.click(); }")
    expect_confirmed(page)
    page.reload()
    expect_confirmed(page)
    for outcome in ("success", "failure"):
        assert [one["version"] for one in versions(visitor, base_url, world_id, outcome)] == [1]


def test_a_change_has_to_be_confirmed_again_unless_it_is_undone(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    walk.confirm_order(page)
    move_first_down(page, "failure")
    expect(page.locator("#rank")).to_have_attribute("data-confirmed", "false")
    expect(page.locator("#rank-state")).to_have_text(
        "Your failures have changed since version 1. The new order counts once you confirm it."
    )
    expect(page.locator("#learn")).to_be_hidden()
    page.locator("#undo").click()
    expect_confirmed(page)
    page.locator("#redo").click()
    walk.confirm_order(page)
    expect_said(page, "Confirmed: version 2 of your failures counts. Next: Learn.")
    assert len(versions(visitor, base_url, world_id, "success")) == 1


# Two tabs


def two_orders(context: BrowserContext, address: str) -> tuple[Page, str, list[str], list[str]]:
    """A page whose successes were confirmed elsewhere in another order: it, the world, this order, that one."""
    world_id = played(context, address)
    page = rank_page(context, world_id)
    theirs = walk.order_of(page, "success")[::-1]
    order = {"order": [[id_] for id_ in theirs], "confirmed": True}
    Api(context, address).put(f"/worlds/{world_id}/rankings/success", order)
    touch_both(page)
    page.locator("#confirm").click()
    expect_asked(page)
    return page, world_id, walk.order_of(page, "success"), theirs


def expect_asked(page: Page) -> None:
    dialog = page.get_by_role("dialog", name="Two orders of your successes")
    expect(dialog).to_have_accessible_description(
        re.compile(r"^Version 1 was confirmed at \d\d:\d\d, after this page was opened, perhaps in another tab\. ")
    )
    expect(page.locator("#conflict-title")).to_be_focused()


def test_what_another_tab_confirms_is_told_and_weighed_and_both_versions_are_kept(
    visitor: BrowserContext, base_url: str
) -> None:
    world_id = played(visitor, base_url)
    page, other = rank_page(visitor, world_id), rank_page(visitor, world_id)
    touch_both(page)
    page.locator('#list-success .card[data-position="3"] [data-act="up"]').click()
    mine = walk.order_of(page, "success")
    touch_both(other)
    walk.confirm_order(other)
    theirs = walk.order_of(other, "success")
    expect(page.locator("#rank-told-text")).to_contain_text("was confirmed in another tab just now, and it counts.")
    page.locator("#confirm").click()
    expect_asked(page)
    page.get_by_role("button", name="Mine counts").press("Enter")
    expect_confirmed(page)
    said = "Version 2 of your successes counts, the one on this page. Version 1 is kept beside it."
    expect(page.locator("#rank-told-text")).to_contain_text(said)
    expect(page.locator("#announcer")).to_contain_text(said)
    orders = [flat(one["order"]) for one in versions(visitor, base_url, world_id, "success")]
    assert orders == [mine, theirs]


def test_two_orders_stand_side_by_side_with_what_differs_marked(visitor: BrowserContext, base_url: str) -> None:
    page, _, mine, theirs = two_orders(visitor, base_url)
    for list_id, order, other in (("#orders-mine", mine, theirs), ("#orders-theirs", theirs, mine)):
        cards = page.locator(f"{list_id} .mini").all()
        assert [card.get_attribute("data-id") for card in cards] == order
        higher = [other.index(id_) - place for place, id_ in enumerate(order)]
        assert [int(card.get_attribute("data-moved") or "") for card in cards] == higher
        for card, by in zip(cards, higher, strict=True):
            sign = "" if by == 0 else f"{'▲' if by > 0 else '▼'} {abs(by)}"
            expect(card.locator(".mini-mark")).to_have_text(sign)


def test_mine_counts_and_the_other_order_is_kept_beside_it(visitor: BrowserContext, base_url: str) -> None:
    page, world_id, mine, theirs = two_orders(visitor, base_url)
    page.get_by_role("button", name="Mine counts").press("Enter")
    expect(page.locator("#rank-told-text")).to_contain_text(
        "Version 2 of your successes counts, the one on this page. Version 1 is kept beside it."
    )
    newest, first = versions(visitor, base_url, world_id, "success")
    assert (newest["version"], flat(newest["order"])) == (2, mine)
    assert (first["version"], flat(first["order"])) == (1, theirs)
    move_first_down(page, "success")
    page.locator("#confirm").click()
    expect_confirmed(page)
    assert len(versions(visitor, base_url, world_id, "success")) == 3


def test_the_other_order_is_taken_and_undo_brings_mine_back(visitor: BrowserContext, base_url: str) -> None:
    page, world_id, mine, theirs = two_orders(visitor, base_url)
    page.get_by_role("button", name="Take the other one").press("Enter")
    expect(page.locator("#rank-told-text")).to_contain_text(
        "Version 1 of your successes counts, and your list stands as in it. Undo brings your own order back."
    )
    assert walk.order_of(page, "success") == theirs
    assert len(versions(visitor, base_url, world_id, "success")) == 1
    page.locator("#undo").click()
    assert walk.order_of(page, "success") == mine


def test_who_decides_later_is_asked_again(visitor: BrowserContext, base_url: str) -> None:
    page, world_id, mine, _ = two_orders(visitor, base_url)
    page.keyboard.press("Escape")
    expect(page.locator("#rank-told-text")).to_contain_text(
        "Version 1 of your successes counts for now. Yours is as you left it; confirm again to decide."
    )
    assert walk.order_of(page, "success") == mine
    page.locator("#confirm").click()
    page.get_by_role("button", name="Mine counts").click()
    expect_confirmed(page)
    assert [one["version"] for one in versions(visitor, base_url, world_id, "success")] == [2, 1]


def test_the_same_order_confirmed_in_two_tabs_is_one_version(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page, other = rank_page(visitor, world_id), rank_page(visitor, world_id)
    for tab in (page, other):
        touch_both(tab)
    walk.confirm_order(other)
    expect_confirmed(page)
    expect(page.locator("#rank-told")).to_be_hidden()
    assert len(versions(visitor, base_url, world_id, "failure")) == 1


# Attempts that come and go


def test_attempts_that_came_meanwhile_join_last_and_the_rest_counts(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    failures = walk.order_of(page, "failure")
    (late,) = play_more(visitor, base_url, world_id)
    page.locator("#confirm").click()
    total = f"{late['total']:+.1f}".replace("-", "−")
    said = (
        "Confirmed: version 1 of your successes counts."
        f" 1 new failure since this page was opened: {total} in 1 step. It stands last: move it to its place."
        f" {LOOK_AGAIN}"
    )
    expect(page.locator("#rank-told-text")).to_have_text(said)
    expect_said(page, said)
    assert walk.order_of(page, "failure") == [*failures, late["id"]]
    page.get_by_role("button", name="Go to the new one").press("Enter")
    expect(page.locator(f'[data-demonstration-id="{late["id"]}"]')).to_be_focused()
    page.locator(f'[data-demonstration-id="{late["id"]}"] [data-act="up"]').click()
    walk.confirm_order(page)
    expect(page.locator("#rank-told")).to_be_hidden()
    assert flat(versions(visitor, base_url, world_id, "failure")[0]["order"]) == walk.order_of(page, "failure")


def test_an_attempt_discarded_meanwhile_leaves_and_the_order_of_the_others_stays(
    visitor: BrowserContext, base_url: str
) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    first, second, third = walk.order_of(page, "success")
    Api(visitor, base_url).put(f"/demonstrations/{second}/discard", {})
    page.locator("#confirm").click()
    said = (
        "Confirmed: version 1 of your failures counts."
        f" 1 success was discarded meanwhile and has left its list. {LOOK_AGAIN}"
    )
    expect(page.locator("#rank-told-text")).to_have_text(said)
    assert walk.order_of(page, "success") == [first, third]
    page.get_by_role("button", name="Understood").press("Enter")
    expect(page.locator("#rank-told")).to_be_hidden()
    expect(page.locator("#confirm")).to_be_focused()
    walk.confirm_order(page)


def test_an_attempt_played_in_another_tab_joins_the_list_by_itself(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page, other = rank_page(visitor, world_id), visitor.new_page()
    touch_both(page)
    failures = walk.order_of(page, "failure")
    other.goto(f"/worlds/{world_id}")
    other.keyboard.press("ArrowRight")
    other.keyboard.press("g")
    expect(page.locator("#rank-told-text")).to_contain_text("1 new failure since this page was opened: ")
    assert walk.order_of(page, "failure")[:-1] == failures
    walk.confirm_order(page)


# A server that does not answer, or not this browser


def test_an_order_confirmed_offline_waits_says_so_and_is_sent_by_itself(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    visitor.set_offline(True)
    page.locator("#confirm").click()
    waiting = (
        "The server cannot be reached just now. The order of your successes and your failures is kept in this browser"
        " and sent by itself; then it counts."
    )
    expect(page.locator("#rank-state")).to_have_text(waiting)
    expect_said(page, waiting)
    expect(page.locator("#rank")).to_have_attribute("data-confirmed", "false")
    expect(page.locator("#confirm")).to_have_attribute("aria-disabled", "true")
    page.locator("#confirm").click(force=True)
    visitor.set_offline(False)
    expect_confirmed(page)
    expect_said(page, CONFIRMED)
    assert [one["version"] for one in versions(visitor, base_url, world_id, "success")] == [1]


def test_an_order_that_waited_through_a_reload_is_sent_and_told(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    page.route("**/rankings/*", lambda route: route.abort())
    page.locator("#confirm").click()
    expect(page.locator("#rank-state")).to_contain_text("The server cannot be reached just now.")
    page.unroute_all()
    page.reload()
    expect_confirmed(page)
    expect(page.locator("#rank-state")).to_contain_text("✓ Confirmed: version 1")
    assert len(versions(visitor, base_url, world_id, "success")) == 1


def test_a_busy_server_gets_the_order_later(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    busy = {"error": {"code": "busy", "message": "Too many writes are waiting.", "fields": {}}}
    page.route("**/rankings/*", lambda route: route.fulfill(status=503, json=busy))
    page.locator("#confirm").click()
    expect(page.locator("#rank-state")).to_have_text(
        "The server is busy just now. The order of your successes and your failures is kept in this browser"
        " and sent by itself; then it counts."
    )
    page.unroute_all()
    expect_confirmed(page)
    assert len(versions(visitor, base_url, world_id, "failure")) == 1


def test_a_browser_whose_cookie_is_gone_keeps_its_order_and_can_save_it(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    orders = {outcome: walk.order_of(page, outcome) for outcome in ("success", "failure")}
    visitor.clear_cookies()
    page.locator("#confirm").click()
    expect(page.locator("#rank-told-text")).to_have_text(
        re.compile("^The server does not know this browser any more as the one that played these attempts: ")
    )
    assert {outcome: walk.order_of(page, outcome) for outcome in orders} == orders
    with page.expect_download() as download:
        page.get_by_role("button", name="Save my order as a file").click()
    lines = [json.loads(line) for line in Path(download.value.path()).read_text().splitlines()]
    assert {line["outcome"]: flat(line["order"]) for line in lines} == orders
    expect(page.locator("#rank")).to_have_attribute("data-confirmed", "false")


# Versions


def test_an_earlier_order_can_be_looked_at_and_taken_again(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    touch_both(page)
    walk.confirm_order(page)
    first = walk.order_of(page, "success")
    move_first_down(page, "success")
    walk.confirm_order(page)
    panel = page.locator("#versions")
    expect(panel.locator("summary").first).to_contain_text(
        re.compile(r"Successes: version 2 counts, confirmed \d\d:\d\d · 1 earlier one is kept")
    )
    panel.locator("summary").first.press("Enter")
    successes = panel.locator("section").filter(has=page.get_by_role("heading", name="Successes"))
    expect(successes.locator(".version")).to_have_count(2)
    newest, older = successes.locator(".version").all()
    expect(newest.locator(".version-words")).to_have_text(
        re.compile(r"^Version 2 · \d\d:\d\d · in two lists · counts$")
    )
    expect(newest.locator("button")).to_have_text("Stands so now")
    older.locator("summary").press("Enter")
    expect(older.locator(".mini")).to_have_count(3)
    assert [card.get_attribute("data-id") for card in older.locator(".mini").all()] == first
    older.get_by_role("button", name="Take version 1 of your successes again").press("Enter")
    expect_said(page, "Your successes stand as in version 1 again. It counts once you confirm it.")
    assert walk.order_of(page, "success") == first
    walk.confirm_order(page)
    assert [flat(one["order"]) for one in versions(visitor, base_url, world_id, "success")][::2] == [first, first]


# How good is my ranking


def test_agreement_is_told_after_confirming_as_scipy_reckons_it(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    play_more(visitor, base_url, world_id, n=4)
    page = rank_page(visitor, world_id)
    panel = page.locator("#agreement")
    expect(panel).to_be_hidden()
    touch_both(page)
    walk.confirm_order(page)
    panel.locator("summary").first.press("Enter")
    titles: dict[Outcome, str] = {"success": "Successes", "failure": "Failures"}
    for outcome, title in titles.items():
        part = panel.locator("section").filter(has=page.get_by_role("heading", name=title))
        figures = agreement_by_hand(page, outcome)
        told = part.locator(".agreement-words")
        expect(told).to_contain_text(
            f"Of {figures['n_pairs']} pairs you put {figures['n_agreeing']} as their totals would"
        )
        expect(told).to_contain_text("Kendall’s tau-b: " + f"{figures['tau_b']:.2f}.".replace("-", "−"))
        assert part.locator(".swap").count() == min(6, figures["n_swapped"])
    move_first_down(page, "success")
    expect(panel).to_be_hidden()


def agreement_by_hand(page: Page, outcome: Outcome) -> Json:
    """Of untied places, against the totals: worth more stands higher among successes, lower among failures."""
    totals = {one["id"]: one["total"] for one in walk.page_data(page)["demonstrations"]}
    sign = 1 if outcome == "success" else -1
    worth = [sign * totals[id_] for id_ in walk.order_of(page, outcome)]
    pairs = list(itertools.combinations(worth, 2))
    return {
        "n_pairs": len(pairs),
        "n_agreeing": sum(above > below for above, below in pairs),
        "n_swapped": sum(above < below for above, below in pairs),
        "tau_b": kendalltau(range(len(worth), 0, -1), worth).statistic,
    }


def test_a_swapped_pair_can_be_watched(visitor: BrowserContext, base_url: str) -> None:
    world_id = played(visitor, base_url)
    page = rank_page(visitor, world_id)
    page.locator('[data-sort="success"]').click()
    best_last = walk.order_of(page, "success")
    page.locator('#list-success .card[data-position="1"] [data-act="down"]').click()
    move_first_down(page, "failure")
    walk.confirm_order(page)
    page.locator("#agreement > summary").click()
    pair = page.locator("#agreement section").first.locator(".swap").first
    expect(pair.locator(".mini")).to_have_count(2)
    assert {card.get_attribute("data-id") for card in pair.locator(".mini").all()} == set(best_last[:2])
    watch = pair.get_by_role("button")
    expect(watch).to_have_accessible_name("Watch both: success at place 1 and at place 2")
    watch.press("Enter")
    expect(page.locator("dialog[open]")).to_be_visible()


def test_where_totals_are_hidden_agreement_names_none(browser: Browser, discreet: LiveServer) -> None:
    for context in watched(browser.new_context(base_url=discreet.address)):
        page = rank_page(context, played(context, discreet.address))
        touch_both(page)
        walk.confirm_order(page)
        panel = page.locator("#agreement")
        panel.locator("summary").first.press("Enter")
        expect(panel.locator(".agreement-words").first).to_contain_text("Kendall’s tau-b: ")
        page.locator("#versions > summary").click()
        page.locator(".version summary").first.click()
        expect(page.locator(".version .mini").first).to_contain_text(re.compile(r"\d+ steps"))
        for part in (panel, page.locator("#versions")):
            assert re.search(r"[+−]\d+\.\d in ", part.text_content() or "") is None


def test_where_agreement_is_not_allowed_the_page_has_no_word_of_it(browser: Browser, base_url: str) -> None:
    for context in watched(browser.new_context(base_url=base_url)):
        world_id = played(context, base_url)
        context.route("**/rank", forbid_agreement)
        page = rank_page(context, world_id)
        touch_both(page)
        walk.confirm_order(page)
        expect(page.locator("#versions")).to_be_visible()
        expect(page.locator("#agreement")).to_be_hidden()


def forbid_agreement(route: Any) -> None:
    answer = route.fetch()
    text = answer.text()
    assert '"show_agreement": true' in text or '"show_agreement":true' in text
    route.fulfill(response=answer, body=re.sub(r'"show_agreement": ?true', '"show_agreement": false', text))


# Seen


def test_axe_finds_nothing_in_any_state_of_confirming(browser: Browser, base_url: str) -> None:
    for context in watched(browser.new_context(base_url=base_url, reduced_motion="reduce")):
        world_id = played(context, base_url)
        page = rank_page(context, world_id)
        page.locator("#confirm").click()
        check_axe(page, "an untouched order")
        page.locator('#untouched [value="yes"]').click()
        expect_confirmed(page)
        for panel in ("#agreement", "#versions"):
            page.locator(f"{panel} > summary").click()
        page.locator(".version summary").first.click()
        expect(page.locator(".version .mini").first).to_be_visible()
        check_axe(page, "confirmed")
        move_first_down(page, "success")
        client = Api(context, base_url)
        order = [[id_] for id_ in reversed(walk.order_of(page, "success"))]
        client.put(f"/worlds/{world_id}/rankings/success", {"order": order, "confirmed": True})
        page.locator("#confirm").click()
        expect(page.locator("#conflict")).to_be_visible()
        check_axe(page, "two orders")
        page.keyboard.press("Escape")
        expect(page.locator("#rank-told")).to_be_visible()
        check_axe(page, "a notice")


def test_forty_cards_can_be_compared(visitor: BrowserContext, base_url: str) -> None:
    client = Api(visitor, base_url)
    world_id = str(client.post("/worlds", {"seed": 5})["id"])
    for n in range(40):
        actions = [1, 2, 1, 2, 3, 0][: 1 + n % 6] + [3] * (n // 6)
        body = {"id": str(uuid.uuid4()), "actions": actions, "step_ms": [1.0] * len(actions), "ending": "gave_up"}
        client.post(f"/worlds/{world_id}/demonstrations", body)
    page = rank_page(visitor, world_id)
    move_first_down(page, "failure")
    order = walk.order_of(page, "failure")
    other = [[order[1]], [order[0]], [order[2], order[3]], *([id_] for id_ in order[4:])]
    client.put(f"/worlds/{world_id}/rankings/failure", {"order": other, "confirmed": True})
    page.locator("#confirm").click()
    expect(page.locator("#conflict-text")).to_contain_text("3 of 40 stand elsewhere.")
    expect(page.locator("#orders-mine .mini:visible")).to_have_count(40)
    page.get_by_label("Show only what stands elsewhere").check()
    expect(page.locator("#orders-mine .mini:visible")).to_have_count(3)
    page.get_by_label("Show only what stands elsewhere").uncheck()
    page.locator("#orders").focus()
    page.keyboard.press("End")
    expect(page.locator("#orders-theirs .mini").last).to_be_in_viewport()
    expect(page.get_by_role("button", name="Mine counts")).to_be_in_viewport()
    page.locator("#orders-mine .mini").last.hover()
    expect(page.locator("#orders-theirs .mini").last).to_have_attribute("data-twin", "true")


def check_axe(page: Page, where: str) -> None:
    for scheme in SCHEMES:
        page.emulate_media(color_scheme=scheme)
        results = Axe().run(page)
        assert results.violations_count == 0, f"{where}, {scheme}:\n{results.generate_report()}"
