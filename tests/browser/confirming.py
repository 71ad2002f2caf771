"""A visitor who confirms orders, by the API and on the page, for the tests of confirming."""

import itertools
import uuid
from typing import Any, Literal

from playwright.sync_api import BrowserContext, Page, expect

from tests import journey
from tests.browser import test_pages, walk

Json = dict[str, Any]
Outcome = Literal["success", "failure"]
SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
CONFIRMED = "Confirmed: version 1 of your successes and of your failures counts. Next: Learn."


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


def check_axe(page: Page, where: str) -> None:
    for scheme in SCHEMES:
        page.emulate_media(color_scheme=scheme)
        test_pages.check_axe(page, f"{where}, {scheme}")
