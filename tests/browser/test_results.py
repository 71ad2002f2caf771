"""Many worlds seen together: one's own and a class's, from the empty page to the picture one takes away."""

import re
from pathlib import Path

from playwright.sync_api import Page, expect

from app.visitors import COOKIE
from tests.browser.test_pages import check_axe
from tests.finished import finish_run, visitor_of
from tests.live_server import LiveServer

SCORES = {"human": -2.0, "meirl": 3.0, "irlr": 5.0, "irlf": 4.0, "irlfr": 6.0, "birlfr": 8.0}


def test_a_class_plays_a_pooled_world_and_sees_its_result_without_names(page: Page, server: LiveServer) -> None:
    page.goto("/results")
    expect(page.get_by_role("heading", level=1)).to_have_text("Your results begin with one world")
    check_axe(page, "no results")
    page.get_by_role("link", name="Play a world").click()
    expect(page.locator("#now")).to_be_visible()

    page.goto("/worlds/new?seed=5")
    page.get_by_label("Pool everybody’s results, without names").check()
    expect(page).to_have_url(re.compile("seed=5&pooled=1$"))
    page.locator("#play-link").click()
    expect(page.locator(".legend-pooled")).to_have_text("What comes out here is pooled, without names.")
    world_id = page.request.post("/api/v1/worlds", data={"seed": 5, "pooled": True}).json()["id"]
    page.goto(f"/worlds/{world_id}")
    page.locator(".legend-pooled").get_by_role("link").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("The result of the class waits for more people")
    expect(page.locator(".results-world")).to_contain_text("3 more to go")
    check_axe(page, "a class that waits")

    for k in range(3):
        finish_run(server.database, world_id, SCORES | {"irlr": 5.0 + k})
    page.reload()
    expect(page.get_by_role("heading", level=1)).to_have_text(
        "Bayesian IRLFR came first most often: in 3 of 3 comparisons."
    )
    places = page.get_by_role("img", name="How often who came at which place.")
    expect(places).to_be_visible()
    expect(places).to_have_attribute(
        "aria-label", re.compile("IRLR, 3 times: 2nd 1, 3rd 2;|IRLR, 3 times: 2nd 2, 3rd 1;")
    )
    expect(places.locator('[data-place="1"] .place-count')).to_have_text("3")


def test_ones_own_worlds_are_seen_together_and_taken_away(page: Page, server: LiveServer, tmp_path: Path) -> None:
    worlds = [page.request.post("/api/v1/worlds", data={"seed": seed}).json()["id"] for seed in range(5, 9)]
    [cookie] = [one for one in page.context.cookies() if one["name"] == COOKIE]
    for k, world_id in enumerate(worlds):
        finish_run(server.database, world_id, SCORES, visitor_id=visitor_of(cookie["value"]), minutes=k)
    page.goto("/")
    page.get_by_role("link", name="Your results").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("Bayesian IRLFR came first most often: in 4 of 4 worlds.")
    expect(page.get_by_role("img", name="Share of the optimum.")).to_have_attribute(
        "aria-label", re.compile("Bayesian IRLFR 80 %, interval 80 % to 80 %;.*You −20 %")
    )
    expect(page.locator(".results-world")).to_have_count(4)
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
        page.locator("main details:not(.menu)").evaluate_all("all => all.forEach((one) => { one.open = true; })")
        check_axe(page, f"results, {scheme}")
    page.locator("save-menu summary").first.click()
    with page.expect_download() as download:
        page.get_by_role("button", name="SVG").click()
    download.value.save_as(tmp_path / "places.svg")
    assert "How often each came at which place" in (tmp_path / "places.svg").read_text("utf-8")
    with page.expect_download() as download:
        page.get_by_role("link", name="These figures").click()
    assert download.value.suggested_filename == "irlfr-own-results.csv"
    page.set_viewport_size({"width": 360, "height": 740})
    page.reload()
    expect(page.locator("#places-chart svg")).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth") == 360
