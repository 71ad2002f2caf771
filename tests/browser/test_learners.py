"""More learners than the page begins with: they are chosen, learn, are compared, and go again."""

from playwright.sync_api import Page, expect

from tests.browser import walk


def test_a_run_of_chosen_learners_alone_is_shown_and_compared_as_it_was(page: Page, base_url: str) -> None:
    world_id, _ = walk.prepared(page, base_url, seed=37)
    page.goto(f"/worlds/{world_id}/learn")
    for box in page.locator("input[name=learner]").all():
        box.uncheck()
    for name in ("score_irl", "random"):
        walk.add_learner(page, name)
    page.locator('[data-part="figures-box"] summary').click()
    walk.learn_to_the_end(page)
    expect(page.locator('[data-part="sentence"]')).to_have_text("Both learners are done.")
    expect(page.locator('[data-part="figures"] th')).to_have_count(3)
    expect(page.locator('[data-part="measure-help"]')).to_contain_text("seek something else")

    page.reload()
    expect(page.locator('.agent-panel[data-stage="learned"]')).to_have_count(2)
    assert boards(page) == ["score_irl", "random"]
    expect(page.locator("input[name=more-learner]")).to_have_count(len(walk.page_data(page)["learners"]) - 2)
    expect(page.locator(".chart-key li")).to_have_text(["Score-based IRL (uses scores)", "Random"])

    page.locator('[data-part="compare"]').click()
    expect(page.locator('[data-part="rows"] tr')).to_have_count(4)
    expect(page.locator(".belief")).to_have_count(3)
    expect(page.locator('[data-part="failure-words"]')).to_be_hidden()
    expect(page.locator('[data-part="soft-words"]')).to_contain_text("Score-based IRL (uses scores) plans")


def test_a_learner_that_is_no_longer_chosen_gives_its_board_back_and_the_focus_with_it(
    page: Page, base_url: str
) -> None:
    world_id, _ = walk.prepared(page, base_url, seed=38)
    page.goto(f"/worlds/{world_id}/learn")
    before = boards(page)
    walk.add_learner(page, "bc")
    assert boards(page) == [*before, "bc"]
    page.locator('.agent-panel[data-learner="bc"] input').focus()
    page.keyboard.press("Space")
    assert boards(page) == before
    expect(page.locator('input[name="more-learner"][value="bc"]')).to_be_focused()
    expect(page.locator('input[name="more-learner"][value="bc"]')).not_to_be_checked()


def boards(page: Page) -> list[str | None]:
    return [panel.get_attribute("data-learner") for panel in page.locator(".agent-panel[data-learner]").all()]
