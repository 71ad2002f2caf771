"""How good is my ranking: after confirming, and only where the study shows it."""

import itertools
import re
from typing import Any

from playwright.sync_api import Browser, BrowserContext, Page, expect
from scipy.stats import kendalltau

from tests.browser import walk
from tests.browser.confirming import Json, Outcome, move_first_down, play_more, played, rank_page, touch_both
from tests.browser.conftest import scripts_watched
from tests.live_server import LiveServer


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
    with scripts_watched(browser.new_context(base_url=discreet.address)) as context:
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
    with scripts_watched(browser.new_context(base_url=base_url)) as context:
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
