"""Why, on the Compare page: which attempt mattered, what if, what is not known; by keyboard, by mouse, by a link."""

import json
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, BrowserContext, Locator, Page, Request, Route, expect

from tests import journey
from tests.browser import walk
from tests.browser.conftest import scripts_watched

ASKING = ("/influence", "/what-ifs", "/uncertainty")
ANSWERED_MS = 60_000  # a machine of CI may be busy when the learner that answers at once is started


def test_a_person_asks_why(browser: Browser, visitor: BrowserContext, base_url: str) -> None:
    page = visitor.new_page()
    client = walk.ContextClient(page, base_url)
    run_id = small_run(page, client)
    asked: list[Request] = []
    page.on("request", lambda request: asked.append(request) if is_question(request) else None)
    page.goto(f"/runs/{run_id}/comparison")
    expect(page.locator("#why")).to_be_visible()
    assert asked == [], "nothing is computed before somebody opens a question"

    first = check_which_mattered(page, client, run_id)
    check_what_if_it_were_gone(page, first)
    check_changes_by_keyboard(page, asked)
    check_the_newest_wins(page)
    check_trouble_is_said_and_passes(page)
    check_what_is_not_known(page, client, run_id)
    check_a_board_is_saved_with_its_sentence(page)
    check_a_link_shows_the_same(browser, page, base_url)


def small_run(page: Page, client: walk.ContextClient) -> str:
    """A run that is learned again in no time."""
    world = client.post("/worlds", {"seed": 12, "rows": 5, "cols": 5})
    successes, failures = journey.play(client, journey.Grid(world), world["id"])
    journey.rank(client, world["id"], successes, failures)
    asked = {"learners": ["irlfr", "birlfr"], "settings": {"iterations": 40}, "seed": 7}
    run_id: str = client.post(f"/worlds/{world['id']}/runs", asked)["id"]
    page.goto(f"/runs/{run_id}")
    expect(page.locator("learn-page")).to_have_attribute("data-status", "done", timeout=walk.LEARNING_MS)
    return run_id


def check_which_mattered(page: Page, client: walk.ContextClient, run_id: str) -> Locator:
    """By keyboard; the rows are the API's, the greatest change first. Returns the first."""
    part(page, "mattered").locator("> summary").focus()
    page.keyboard.press("Enter")
    answered(page, "mattered")
    rows = page.locator(".why-row")
    expect(rows).to_have_count(6)
    found = {one["id"]: one for one in client.get(f"/runs/{run_id}/influence?learner=irlfr")["influences"]}
    shown = [found[row.get_attribute("data-id") or ""] for row in rows.all()]
    changes = [one["policy_change"] for one in shown]
    assert changes == sorted(changes, reverse=True)
    for row, one in zip(rows.all(), shown, strict=True):
        expect(row.locator('[data-why="policy"]')).to_have_text(f"{100 * one['policy_change']:.0f} %")
    expect(sentence(page, "mattered")).to_contain_text("mattered most")
    return rows.first


def check_what_if_it_were_gone(page: Page, row: Locator) -> None:
    """From the attempt that mattered most to what would be without it: in the same words."""
    attempt = row.get_attribute("data-id")
    row.get_by_role("button").click()
    turned = (row.locator('[data-why="words"]').text_content() or "").partition(", ")[2].partition(" and ")[0]
    expect(sentence(page, "what-if")).to_contain_text(turned, timeout=ANSWERED_MS)
    expect(page.locator(f'input[name="why-attempt"][value="{attempt}"]')).to_be_focused()
    expect(page.locator('[data-why="drop"]')).to_have_attribute("aria-pressed", "true")
    expect(part(page, "what-if").locator(".why-board")).to_have_count(3)
    assert page.url.endswith(f"#why=irlfr&open=mattered,what-if&drop={attempt}")


def check_changes_by_keyboard(page: Page, asked: list[Request]) -> None:
    """Another attempt by an arrow key, another change by Tab and Enter, a swap by letter keys."""
    page.locator('input[name="why-attempt"]').first.focus()
    page.keyboard.press("ArrowDown")
    second = page.locator('input[name="why-attempt"]').nth(1).get_attribute("value")
    expect(page.locator('[data-why="chosen"]')).to_have_text("What if your 2nd success …")
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(sentence(page, "what-if")).to_contain_text("With your 2nd success called a failure, ")
    assert asked[-1].post_data_json == {"learner": "irlfr", "change": {"relabel": second}}
    page.keyboard.press("Tab")
    page.keyboard.type("the 1st")
    expect(sentence(page, "what-if")).to_contain_text("With your 2nd success and 1st success trading places, ")
    assert asked[-1].post_data_json["change"]["swap"][0] == second
    expect(page.locator("#announcer")).to_contain_text("trading places")


def check_the_newest_wins(page: Page) -> None:
    """While an answer is under way the one before stands, marked; what is asked meanwhile takes its place."""
    held: list[Route] = []
    page.route("**/what-ifs", lambda route: held.append(route) if '"drop"' in asked_of(route) else route.continue_())
    before = sentence(page, "what-if").text_content() or ""
    page.locator('[data-why="drop"]').click()
    expect(part(page, "what-if").locator('[data-why="body"]')).to_have_attribute("aria-busy", "true")
    expect(sentence(page, "what-if")).to_have_text(before)
    page.locator('[data-why="relabel"]').click()
    expect(part(page, "what-if").locator('[data-why="body"]')).not_to_have_attribute("aria-busy", "true")
    expect(sentence(page, "what-if")).to_contain_text("called a failure, ")
    assert len(held) == 1
    page.unroute_all()


def check_trouble_is_said_and_passes(page: Page) -> None:
    error = {"error": {"code": "superseded", "message": "Something newer was asked for meanwhile.", "fields": {}}}
    page.route("**/what-ifs", lambda route: route.fulfill(status=409, json=error))
    page.locator('[data-why="drop"]').click()
    trouble = part(page, "what-if").locator('[data-why="trouble"]')
    expect(trouble).to_contain_text("Something newer was asked for meanwhile.")
    expect(sentence(page, "what-if")).to_contain_text("called a failure, ")
    page.unroute_all()
    trouble.get_by_role("button", name="Ask again").click()
    expect(trouble).to_be_hidden()
    expect(sentence(page, "what-if")).to_contain_text("Without your 2nd success, ")


def check_what_is_not_known(page: Page, client: walk.ContextClient, run_id: str) -> None:
    part(page, "doubt").locator("> summary").click()
    method = part(page, "doubt").locator('[data-why="method"]')
    answered(page, "doubt")
    found = client.get(f"/runs/{run_id}/uncertainty?learner=irlfr")
    expect(method).to_contain_text(f"(bootstrap, {found['n_draws']} draws, seed 7)")
    expect(part(page, "doubt").locator('[data-why="interval"]')).to_have_text(found["sentence"])
    page.locator('.why-learner input[value="birlfr"]').check()
    expect(method).to_contain_text("posterior", timeout=ANSWERED_MS)
    expect(sentence(page, "what-if")).to_contain_text("Bayesian IRLFR", timeout=ANSWERED_MS)
    page.locator('.why-learner input[value="irlfr"]').check()
    expect(sentence(page, "what-if")).not_to_contain_text("Bayesian")
    part(page, "doubt").locator("irl-board").focus()
    page.keyboard.press("ArrowRight")
    expect(part(page, "doubt").locator('[data-why="reading"]')).to_contain_text("Row 1, column 1: goes ")


def check_a_board_is_saved_with_its_sentence(page: Page) -> None:
    board = part(page, "what-if").locator(".why-board").nth(1)
    board.locator("save-menu summary").click()
    with page.expect_download() as saving:
        board.get_by_role("button", name="SVG").click()
    picture = Path(saving.value.path()).read_text()
    told = sentence(page, "what-if").text_content() or ""
    assert f"<title>{told}</title>" in picture.replace("&#39;", "'")


def check_a_link_shows_the_same(browser: Browser, page: Page, base_url: str) -> None:
    """Who has the link sees the same what-if of somebody else's attempts, and may ask on."""
    told = sentence(page, "what-if").text_content() or ""
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    part(page, "what-if").get_by_role("button", name="Copy the link to this").click()
    expect(part(page, "what-if").locator('[data-why="copied"]')).to_contain_text("The link is copied")
    link: str = page.evaluate("navigator.clipboard.readText()")
    assert "?key=" in link
    with scripts_watched(browser.new_context(base_url=base_url)) as stranger:
        theirs = stranger.new_page()
        theirs.goto(link)
        answered(theirs, "what-if")
        expect(sentence(theirs, "what-if")).to_have_text(told.replace("your", "the player's"))
        expect(theirs.locator('[data-why="chosen"]')).to_have_text("What if the player's 2nd success …")
        answered(theirs, "mattered")
        expect(sentence(theirs, "mattered")).to_contain_text("he player's")
        assert theirs.url == link


def answered(page: Page, name: str) -> None:
    """A machine that does much else may say that it takes too long; whoever asks again is answered."""
    for _ in range(5):
        expect(part(page, name)).to_have_attribute("data-asking", "false", timeout=ANSWERED_MS)
        again = part(page, name).get_by_role("button", name="Ask again")
        if not again.is_visible():
            break
        again.click()
    expect(sentence(page, name)).not_to_be_empty()


def is_question(request: Request) -> bool:
    return any(path in request.url for path in ASKING)


def asked_of(route: Route) -> str:
    body: Any = route.request.post_data_json
    return json.dumps(body)


def part(page: Page, name: str) -> Locator:
    return page.locator(f'#why [data-why="{name}"]').first


def sentence(page: Page, name: str) -> Locator:
    return part(page, name).locator('[data-why="sentence"]')
