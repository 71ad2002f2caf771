"""What is taken away from a comparison: its figure, its film, its link, what to cite.

With `--screenshots` the figure is kept as docs/comparison.svg, and printed as docs/comparison.pdf.
"""

import re
import struct
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from PIL import Image, ImageSequence
from playwright.sync_api import Browser, BrowserContext, Locator, Page, expect

from tests import journey
from tests.browser import walk
from tests.browser.conftest import watched
from tests.browser.test_pages import check_axe

SVG = "{http://www.w3.org/2000/svg}"
SEED = 3
EPISODE = 11
"""One of the fifty in which the learners went different ways."""


@pytest.fixture(scope="module")
def played(browser: Browser, base_url: str) -> Iterator[tuple[BrowserContext, str]]:
    """The browser of somebody who has been all the way, and their run."""
    context = browser.new_context(base_url=base_url, reduced_motion="reduce")
    client = walk.ContextClient(context.new_page(), base_url)
    world = client.post("/worlds", {"seed": SEED})
    successes, failures = journey.play(client, journey.Grid(world), world["id"])
    journey.rank(client, world["id"], successes, failures)
    run = client.post(f"/worlds/{world['id']}/runs", {"seed": 7})
    # The stream ends when the run does.
    events = context.request.get(f"/api/v1/runs/{run['id']}/events", timeout=walk.LEARNING_MS).text()
    assert "event: done" in events
    yield context, run["id"]
    context.close()


@pytest.fixture
def page(played: tuple[BrowserContext, str], base_url: str) -> Iterator[Page]:
    """A watched page on that comparison."""
    context, run_id = played
    page = context.new_page()
    with watched(page, base_url):
        page.goto(f"/runs/{run_id}/comparison")
        yield page
    page.close()


@pytest.fixture
def compared(played: tuple[BrowserContext, str]) -> str:
    return played[1]


def test_a_comparison_becomes_a_figure_and_a_film(
    page: Page, compared: str, browser: Browser, tmp_path: Path, screenshots: Path | None
) -> None:
    page.locator("select[name=episode]").select_option(str(EPISODE - 1))
    expect(page.locator("compare-page")).to_have_attribute("data-episode", str(EPISODE))
    menu = page.locator(".take-away save-menu")
    menu.locator("summary").press("Enter")
    svg = saved(page, menu, "svg", tmp_path)
    assert svg.name == f"irlfr-{compared[:8]}-comparison.svg"
    check_figure(page, svg, compared)
    png = saved(page, menu, "png", tmp_path).read_bytes()
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    assert struct.unpack(">I", png[16:20])[0] == pytest.approx(3 * 692, abs=3)
    check_film(page, saved(page, menu, "gif", tmp_path))
    if menu.locator("[data-kind=webm]").count():
        assert saved(page, menu, "webm", tmp_path).read_bytes()[:4] == b"\x1a\x45\xdf\xa3"
    # Both in one task: however fast the machine is, the film is not done yet.
    menu.evaluate(
        "menu => ['gif', 'cancel'].forEach((name) => menu.querySelector(`[data-kind=${name}], [data-${name}]`).click())"
    )
    expect(menu.get_by_role("status")).to_have_text("The film was not made.")
    expect(menu.locator("summary")).to_be_focused()
    check_axe(page, "an open Save menu")
    page.keyboard.press("Escape")
    expect(menu.locator("details")).not_to_have_attribute("open", "")
    if screenshots is not None:
        keep_in_docs(browser, svg, screenshots.parent)


def test_a_link_opens_a_comparison_for_others_until_it_is_taken_back(
    page: Page, compared: str, browser: Browser, base_url: str, tmp_path: Path
) -> None:
    section = page.locator(".take-away")
    expect(section).to_contain_text("The address in the bar opens in this browser only.")
    section.get_by_role("button", name="Make a link to share").click()
    link = section.get_by_label("Link to this comparison")
    expect(link).to_have_value(re.compile(rf"^{re.escape(base_url)}/runs/{compared}/comparison\?key=\S+$"))
    address = link.input_value()
    page.reload()
    expect(link).to_have_value(address)
    with browser.new_context(base_url=base_url) as context:
        stranger = context.new_page()
        stranger.goto(address)
        theirs = stranger.locator(".take-away")
        expect(theirs).to_contain_text("The player shared this comparison by a link")
        expect(theirs.get_by_role("button", name="Make a link")).to_have_count(0)
        expect(theirs.locator("code")).to_contain_text(
            f"irlfr learn irlfr-{compared[:8]}.jsonl --seed 7 --learners meirl,"
        )
        saved_file(stranger, theirs.get_by_role("link", name="Download the file"), tmp_path)
        cited = saved_file(stranger, theirs.get_by_role("button", name="Download irlfr.bib"), tmp_path).read_text()
        assert "@inproceedings{ziebart2008," in cited
        assert "brown2019" not in cited, "nobody compared by T-REX here"
        section.get_by_role("button", name="Take it back").click()
        expect(section.get_by_role("button", name="Make a link to share")).to_be_focused()
        answer = stranger.goto(address)
        assert answer is not None
        assert answer.status == 404


def saved(page: Page, menu: Locator, kind: str, folder: Path) -> Path:
    return saved_file(page, menu.locator(f"[data-kind={kind}]"), folder)


def saved_file(page: Page, control: Locator, folder: Path) -> Path:
    with page.expect_download() as download:
        control.click()
    path = folder / download.value.suggested_filename
    download.value.save_as(path)
    return path


def check_figure(page: Page, svg: Path, run_id: str) -> None:
    """It parses, is as wide as two columns of a paper, and lacks nothing that the page compares."""
    root = ET.parse(svg).getroot()
    assert float(root.attrib["width"].removesuffix("mm")) == pytest.approx(183, abs=0.05)
    words = " ".join(text.text or "" for text in root.iter(f"{SVG}text"))
    data = walk.page_data(page)
    names = [entry["title"] for entry in data["comparison"]["entries"] if entry["who"] != "human"]
    for part in [
        *names, "Player, best attempt", "Player, mean attempt", "Run " + run_id[:8], f"seed {SEED}.", "seed 7",
        f"episode {EPISODE} of 50", "goal +14", "learned reward", "no attempt came here", "Ziebart et al. 2008",
    ]:  # fmt: skip
        assert part in words, f"{part} in {words}"


def check_film(page: Page, gif: Path) -> None:
    """A frame for the start and for each step of the longest walk, no larger and no longer than is polite."""
    rollouts = walk.page_data(page)["rollouts"]
    longest = max(
        len(walks[(EPISODE - 1) % len(walks)]["states"]) - 1 for who, walks in rollouts.items() if who != "human"
    )
    with Image.open(gif) as film:
        assert (film.format, film.width <= 640) == ("GIF", True)
        stays = [frame.info["duration"] for frame in ImageSequence.Iterator(film)]
    assert len(stays) >= longest + 1
    assert sum(stays) <= 12_500


def keep_in_docs(browser: Browser, svg: Path, docs: Path) -> None:
    text = svg.read_text("utf-8")
    (docs / "comparison.svg").write_text(text + "\n", "utf-8")
    width, height = re.findall(r'(?:width|height)="([\d.]+mm)"', text)[:2]
    with browser.new_page() as sheet:
        sheet.set_content(f"<style>@page {{ margin: 0 }} body {{ margin: 0 }} svg {{ display: block }}</style>{text}")
        sheet.pdf(path=docs / "comparison.pdf", width=width, height=height, print_background=True, page_ranges="1")
