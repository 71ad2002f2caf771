"""Runs of a world on the learn page: several at once, with other settings, shared, deleted; the time line of one."""

import re

from playwright.sync_api import Browser, BrowserContext, Locator, Page, expect

from tests.browser import walk
from tests.browser.conftest import scripts_watched
from tests.browser.test_learn_live import LONG, asked, expect_truth, place, watching
from tests.live_server import LiveServer


def test_several_runs_go_on_at_once_and_are_cancelled_and_deleted_from_the_list(
    visitor: BrowserContext, server: LiveServer
) -> None:
    page, client, first = watching(visitor, server.address, seed=71)
    streams: list[str] = []
    page.on("request", lambda request: streams.append(request.url) if "/events?" in request.url else None)
    page.locator('[data-action="again"]').click()
    expect(place(page)).to_have_attribute("data-status", "none")
    expect(page.locator('[data-action="learn"]')).to_be_focused()
    assert page.locator('[name="iterations"]').input_value() == str(LONG["settings"]["iterations"])
    expect(page.locator("input[name=learner]:checked")).to_have_count(1)
    page.locator('[name="learning_rate"]').fill("0.05")
    page.locator('[data-action="learn"]').click()
    expect(page.locator(".run-line")).to_have_count(2)
    second = place(page).get_attribute("data-run")
    assert second != first
    mine, other = line(page, str(second)), line(page, first)
    expect(mine).to_have_attribute("aria-current", "true")
    expect(mine).to_contain_text("α 0.05, n 100000")
    expect(page.locator('[data-part="others"]')).to_contain_text("1 other run")
    expect(other.locator('[data-part="run-standing"]')).to_have_text(re.compile(r"learning, \d+ %"))
    assert f"run={second}&run={first}&frames={second}" in streams[-1], "one stream for both"

    other.locator('[data-act="cancel"]').click()
    expect(other).to_have_attribute("data-status", "cancelled", timeout=walk.LEARNING_MS)
    other.locator('[data-act="delete"]').click()
    page.locator('[data-part="question"] [value="no"]').click()
    expect(other).to_be_visible()
    other.locator('[data-act="delete"]').click()
    page.locator('[data-part="question"] [value="yes"]').click()
    expect(other).to_have_count(0)
    expect(page.locator('[data-part="runs-title"]')).to_be_focused()
    mine.locator('[data-act="cancel"]').click()
    expect_truth(page, client, str(second), "cancelled")


def test_a_shared_link_shows_others_the_same_learning_until_it_is_taken_back(
    page: Page, browser: Browser, base_url: str
) -> None:
    run_id = finished(page, base_url, seed=72)
    record = walk.ContextClient(page, base_url).get(f"/runs/{run_id}/frames")["frames"]
    n_frames = len({(frame["learner"], frame["iteration"]) for frame in record})
    expect(place(page)).to_have_attribute("data-frames", str(n_frames))
    page.locator('[data-action="share-run"]').click()
    expect(page.locator('[data-part="sharing"]')).to_be_visible()
    link = page.locator('[data-part="share-link"]').input_value()
    assert link.startswith(f"{base_url}/runs/{run_id}?key=")
    with scripts_watched(browser.new_context(base_url=base_url)) as others:
        guest = others.new_page()
        guest.goto(link)
        expect(place(guest)).to_have_attribute("data-status", "done")
        expect(place(guest)).to_have_attribute("data-frames", str(n_frames))
        for one in (page, guest):
            one.locator('[data-part="range"]').press("Home")
            expect(place(one)).to_have_attribute("data-iteration", "0")
            for _ in range(3):
                one.locator('[data-part="range"]').press("ArrowRight")
            expect(place(one)).to_have_attribute("data-iteration", "3")
        assert shown(guest) == shown(page)
        for action in ("learn", "cancel", "share-run", "again"):
            expect(guest.locator(f'[data-action="{action}"]:visible')).to_have_count(0)
        expect(guest.locator("#runs")).to_be_hidden()
        guest.locator('[data-action="play-back"]').click()
        expect(place(guest)).not_to_have_attribute("data-iteration", "3")
        guest.locator('[data-part="compare"]').click()
        expect(guest).to_have_url(re.compile(r"/comparison\?key="))

        page.locator('[data-action="take-back"]').click()
        expect(page.locator('[data-part="sharing"]')).to_be_hidden()
        answer = guest.goto(link)
        assert answer is not None
        assert answer.status == 404


def test_a_preset_sets_learners_and_settings_and_visits_show_the_difference(page: Page, base_url: str) -> None:
    finished(page, base_url, seed=73)
    presets = {one["name"]: one for one in walk.page_data(page)["presets"]}
    for name, preset in reversed(presets.items()):
        page.locator(f'[data-preset="{name}"]').click()
        expect(page.locator(f'[data-preset="{name}"]')).to_have_attribute("aria-pressed", "true")
        expect(page.locator('[data-part="preset-sentence"]')).to_have_text(preset["sentence"])
        ticked = page.locator("input[name=learner]:checked").evaluate_all("all => all.map((one) => one.value)")
        assert sorted(ticked) == sorted(preset["learners"])
    panel = page.locator('.agent-panel[data-learner="meirl"]')
    reward = panel.locator('[data-part="highest"]').text_content()
    page.locator('input[name="visits"][value="difference"]').check(force=True)
    expect(page.locator('[data-part="colours"]')).to_have_text("visits: the learner’s minus yours")
    expect(panel.locator('[data-part="lowest"]')).to_contain_text("visits")
    largest = (panel.locator('[data-part="highest"]').text_content() or "").removeprefix("+")
    expect(panel.locator('[data-part="line"]')).to_contain_text(f"gap {largest} visits")
    page.locator('input[name="visits"][value="learned"]').check(force=True)
    expect(panel.locator('[data-part="highest"]')).to_have_text(str(reward))


def finished(page: Page, address: str, *, seed: int) -> str:
    """A page that shows a run of two learners that is done; the run's id."""
    run = asked(walk.ContextClient(page, address), {"seed": seed}, {"learners": ["meirl", "irlfr"], "seed": 7})
    page.goto(f"/runs/{run['id']}")
    expect(place(page)).to_have_attribute("data-status", "done", timeout=walk.LEARNING_MS)
    return str(run["id"])


def line(page: Page, run_id: str) -> Locator:
    return page.locator(f'.run-line[data-run="{run_id}"]')


def shown(page: Page) -> list[tuple[str | None, str | None]]:
    """Which iteration each learner shows, and the ends of its scale."""
    panels = page.locator(".agent-panel[data-learner]").all()
    return [(one.get_attribute("data-iteration"), one.locator(".ramp").text_content()) for one in panels]
