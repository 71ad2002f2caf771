"""What a person does on the pages, step by step, for the walks."""

import json
from typing import Any

from playwright.sync_api import Locator, Page, expect

from tests import journey

KEYS = ("ArrowUp", "ArrowRight", "ArrowDown", "ArrowLeft")
WAYS = ("up", "right", "down", "left")
LEARNING_MS = 120_000

Json = dict[str, Any]


class ContextClient(journey.Client):
    """The API, asked with the cookies of the page's browser."""

    def __init__(self, page: Page, address: str) -> None:
        super().__init__(address)
        self._requests = page.context.request

    def _call(self, method: str, path: str, body: Json | None = None) -> Any:
        answer = self._requests.fetch(self.base + path, method=method, data=body)
        assert answer.ok, f"{method} {path}: {answer.status} {answer.text()[:500]}"
        return answer.json()


def page_data(page: Page) -> Json:
    data: Json = json.loads(page.locator("#page-data").text_content() or "null")
    return data


def attempts_for(page: Page) -> list[list[int]]:
    """Three attempts that succeed in the world on the page, and three that reach its goal and fail."""
    grid = journey.Grid(page_data(page)["world"])
    wise = grid.cheapest_path([max(-reward, 0.0) for reward in grid.rewards])
    blind = grid.cheapest_path([1.0 for _ in grid.rewards])
    return journey.three_of(grid, wise, success=True) + journey.three_of(grid, blind, success=False)


def play_by_keys(page: Page, actions: list[int]) -> None:
    for action in actions:
        page.keyboard.press(KEYS[action])
    finish_attempt(page, lambda: page.keyboard.press("Enter"))


def play_by_pad(page: Page, actions: list[int]) -> None:
    for action in actions:
        page.locator(f'.pad [data-move="{action}"]').tap()
    finish_attempt(page, lambda: page.locator('[data-command="again"]').tap())


def play_by_swipes(page: Page, actions: list[int]) -> None:
    for action in actions:
        swipe(page, page.locator("#board"), action)
    finish_attempt(page, lambda: page.locator('[data-command="again"]').tap())


def finish_attempt(page: Page, again: Any) -> None:
    """The result is told; go on to the next attempt."""
    expect(page.locator("#now")).to_have_attribute("data-shows", "result")
    again()
    expect(page.locator("#now")).to_have_attribute("data-shows", "playing")


def swipe(page: Page, board: Locator, action: int) -> None:
    box = board.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    dx, dy = journey.MOVES[action][1] * 60, journey.MOVES[action][0] * 60
    finger = page.context.new_cdp_session(page)
    finger.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]})
    for part in (0.3, 0.7, 1.0):
        points = [{"x": x + part * dx, "y": y + part * dy}]
        finger.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": points})
    page.wait_for_timeout(120)  # a finger lifted in full motion is a fling, which swallows the next tap
    finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    finger.detach()


def order_of(page: Page, outcome: str) -> list[str]:
    cards = page.locator(f"#list-{outcome} .card[data-demonstration-id]")
    expect(cards.first).to_be_visible()
    return [card.get_attribute("data-demonstration-id") or "" for card in cards.all()]


def drag_by_mouse(page: Page, card: Locator, target: Locator) -> None:
    """Straight up or down, to stand above another card; `tests/browser/ranking.py` does all else."""
    (x, y), drop = drag_line(card, target)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, drop, steps=5)
    page.mouse.up()


def drag_by_touch(page: Page, card: Locator, target: Locator) -> None:
    (x, y), drop = drag_line(card, target)
    finger = page.context.new_cdp_session(page)
    finger.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]})
    for part in range(1, 6):
        points = [{"x": x, "y": y + (drop - y) * part / 5}]
        finger.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": points})
    page.wait_for_timeout(120)  # as in `swipe`
    finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    finger.detach()


def drag_line(card: Locator, target: Locator) -> tuple[tuple[float, float], float]:
    """Where the small board of a card is, and how high its hand goes."""
    card.scroll_into_view_if_needed()
    start, end = card.locator(".card-grip").bounding_box(), target.bounding_box()
    assert start is not None
    assert end is not None
    return (start["x"] + start["width"] / 2, start["y"] + start["height"] / 2), end["y"] + end["height"] * 0.25


def confirm_order(page: Page) -> None:
    """Confirm; where nothing was moved, the order is theirs as it stands."""
    page.locator("#confirm").click()
    yes = page.locator('#untouched [value="yes"]')
    if yes.is_visible():
        yes.click()
    expect(page.locator("#rank")).to_have_attribute("data-confirmed", "true")


def preselected(page: Page) -> list[str]:
    """The learners that the learn page on screen chooses by itself."""
    return [one["name"] for one in page_data(page)["learners"] if one["preselected"]]


def add_learner(page: Page, name: str) -> None:
    """Choose one of the others, by keyboard; it gets a board like everybody."""
    page.locator('[data-part="more"]').evaluate("more => { more.open = true; }")
    page.locator(f'input[name="more-learner"][value="{name}"]').focus()
    page.keyboard.press("Space")
    expect(page.locator(f'.agent-panel[data-learner="{name}"] input[name="learner"]')).to_be_checked()


def learn(page: Page) -> int:
    """Press Learn and watch; return how many different states of the frames were seen before the end."""
    place = page.locator("learn-page")
    page.locator('[data-action="learn"]').click()
    seen: set[str] = set()
    expect(place).to_have_attribute("data-status", "running", timeout=LEARNING_MS)
    while place.get_attribute("data-status") == "running":
        frames = place.get_attribute("data-frames") or "0"
        if place.get_attribute("data-status") == "running" and frames != "0":
            seen.add(frames)
        page.wait_for_timeout(30)
    expect(place).to_have_attribute("data-status", "done", timeout=LEARNING_MS)
    return len(seen)


def learn_to_the_end(page: Page) -> None:
    """Press Learn and wait; some learners are too quick to be watched."""
    earlier = page.locator("learn-page").get_attribute("data-run") or ""
    page.locator('[data-action="learn"]').click()
    expect(page.locator("learn-page")).not_to_have_attribute("data-run", earlier)
    expect(page.locator("learn-page")).to_have_attribute("data-status", "done", timeout=LEARNING_MS)


def prepared(page: Page, address: str, *, seed: int = 5) -> tuple[str, str]:
    """A visitor who has been all the way, by the API: the ids of the world and the run."""
    client = ContextClient(page, address)
    world = client.post("/worlds", {"seed": seed})
    successes, failures = journey.play(client, journey.Grid(world), world["id"])
    journey.rank(client, world["id"], successes, failures)
    run = client.post(f"/worlds/{world['id']}/runs", {"seed": 7})
    page.goto(f"/runs/{run['id']}")
    expect(page.locator("learn-page")).to_have_attribute("data-status", "done", timeout=LEARNING_MS)
    return world["id"], run["id"]
