"""Every page and state: nothing for axe to find, in light and dark; and its pictures for the docs."""

from pathlib import Path
from typing import Literal

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, ViewportSize, expect

from tests.browser import walk
from tests.browser.conftest import watched

Scheme = Literal["light", "dark"]

SIZES: dict[str, ViewportSize] = {"desktop": {"width": 1280, "height": 800}, "phone": {"width": 360, "height": 740}}
SCHEMES: tuple[Scheme, ...] = ("light", "dark")


@pytest.mark.parametrize("scheme", SCHEMES)
def test_axe_finds_nothing_on_pages_without_a_past(page: Page, scheme: Scheme) -> None:
    page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
    page.goto("/?seed=5")
    check_axe(page, "home")
    page.keyboard.press("?")
    check_axe(page, "keys")
    page.keyboard.press("Escape")
    page.locator("#new-world summary").click()
    check_axe(page, "new world")
    page.goto("/?seed=5")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("g")
    expect(page.locator("#now")).to_have_attribute("data-shows", "result")
    check_axe(page, "result of a failure")
    expect(page.locator("#sync")).to_be_visible()
    expect(page.locator("#sync")).to_have_attribute("data-sync", "saved")
    world_id = walk.page_data(page)["world"]["id"]
    for path in (f"/worlds/{world_id}/rank", f"/worlds/{world_id}/learn", "/docs"):
        page.goto(path)
        check_axe(page, path)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_axe_finds_nothing_on_pages_with_a_past(page: Page, base_url: str, scheme: Scheme) -> None:
    page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
    world_id, run_id = walk.prepared(page, base_url)
    for path in paths(world_id, run_id).values():
        page.goto(path)
        page.locator("main details:not(.why-part)").evaluate_all("all => all.forEach((one) => { one.open = true; })")
        check_axe(page, path)
    page.goto(f"/worlds/{world_id}/rank")
    page.locator("#list-success .card").first.focus()
    page.keyboard.press("Space")
    check_axe(page, "a lifted card")


@pytest.mark.parametrize("scheme", SCHEMES)
def test_axe_finds_nothing_on_the_error_page(browser: Browser, base_url: str, scheme: Scheme) -> None:
    """Not in a watched page: the browser itself reports the 404 on its console."""
    context = browser.new_context(base_url=base_url, color_scheme=scheme)
    page = context.new_page()
    for path in ("/nowhere", "/?seed=minus", "/worlds/00000000-0000-0000-0000-000000000000"):
        page.goto(path)
        check_axe(page, path)
    context.close()


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("device", SIZES)
def test_pictures(browser: Browser, base_url: str, screenshots: Path | None, device: str, scheme: Scheme) -> None:
    if screenshots is None:
        pytest.skip("pictures are written with --screenshots")
    context = browser.new_context(
        base_url=base_url,
        viewport=SIZES[device],
        color_scheme=scheme,
        has_touch=device == "phone",
        reduced_motion="reduce",
    )
    page = context.new_page()
    with watched(page, base_url):
        page.goto("/?seed=5")
        take(page, screenshots / f"home-{device}-{scheme}.png")
        for name, path in paths(*walk.prepared(page, base_url)).items():
            page.goto(path)
            if name == "compare":
                halfway(page)
            if name == "rank" and device == "desktop":  # on a phone it lies below, and asks when one comes near
                expect(page.locator(".policy")).to_have_attribute("data-state", "shown", timeout=walk.LEARNING_MS)
            take(page, screenshots / f"{name}-{device}-{scheme}.png")
            if name == "compare":
                ask_why(page)
                take(page, screenshots / f"why-{device}-{scheme}.png")
            if name == "rank":
                for way in ("pairwise", "segments"):
                    page.locator(f'[name="way"][value="{way}"]').check(force=True)
                    take(page, screenshots / f"rank-{way}-{device}-{scheme}.png")
        page.goto("/worlds/new?rows=7&cols=9&seed=5&walls=12,21,30-32&goals=62,17&painted=24-25:-6")
        take(page, screenshots / f"editor-{device}-{scheme}.png")
        for seed in (6, 7, 8):
            walk.prepared(page, base_url, seed=seed)
        page.goto("/results")
        take(page, screenshots / f"results-{device}-{scheme}.png")
        page.goto("/docs")
        take(page, screenshots / f"docs-{device}-{scheme}.png")
    page.goto("/nowhere")  # no longer watched: the browser itself reports the 404 on its console
    take(page, screenshots / f"error-{device}-{scheme}.png")
    context.close()


def halfway(page: Page) -> None:
    """Everybody well on the way."""
    page.locator('[data-action="start"]').click()
    page.locator('[data-action="forward"]').click(click_count=9)


def ask_why(page: Page) -> None:
    """The attempts by how much they mattered, in the middle of the window."""
    mattered = page.locator('.why-part[data-why="mattered"]')
    mattered.locator("summary").click()
    expect(mattered).to_have_attribute("data-state", "answered", timeout=walk.LEARNING_MS)
    mattered.evaluate("(one) => one.scrollIntoView({ block: 'start' })")


def paths(world_id: str, run_id: str) -> dict[str, str]:
    return {
        "play": f"/worlds/{world_id}",
        "rank": f"/worlds/{world_id}/rank",
        "learn": f"/runs/{run_id}",
        "compare": f"/runs/{run_id}/comparison",
    }


def take(page: Page, path: Path) -> None:
    page.wait_for_load_state("networkidle")
    page.wait_for_timeout(300)  # boards are drawn in the next frames
    page.screenshot(path=path)


#: Resolves when whatever fades or moves has come to its end.
SETTLED = """() => Promise.allSettled(
  document.getAnimations().filter((one) => Number.isFinite(one.effect.getComputedTiming().endTime))
    .map((one) => one.finished)).then(() => {})"""


def check_axe(page: Page, where: str) -> None:
    page.evaluate(SETTLED)  # a colour on its way is no colour to judge
    results = Axe().run(page)
    assert results.violations_count == 0, f"{where}:\n{results.generate_report()}"
