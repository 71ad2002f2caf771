"""A person with many attempts who puts them in order: by mouse, by finger, by keyboard."""

import random
import uuid
from collections import deque
from typing import Final, Literal, NamedTuple, Protocol, TypeAlias

from playwright.sync_api import CDPSession, Cookie, Page, expect

from tests import journey
from tests.browser import walk

Order: TypeAlias = list[list[str]]
Outcome: TypeAlias = Literal["success", "failure"]
Side: TypeAlias = Literal["above", "below", "beside"]
Point: TypeAlias = tuple[float, float]

#: The groups of a list as they stand on the page.
ORDER_SHOWN: Final = """outcome => [...document.querySelectorAll(`#list-${outcome} > .group`)].map((group) =>
  [...group.querySelectorAll(".card")].map((card) => card.dataset.demonstrationId))"""
#: The middle of a card's small board, brought into sight.
GRIP: Final = """id => {
  const grip = document.querySelector(`.card[data-demonstration-id="${id}"] .card-grip`);
  grip.scrollIntoView({ block: "center", behavior: "instant" });
  const { left, top, width, height } = grip.getBoundingClientRect();
  return [left + width / 2, top + height / 2];
}"""
#: A point at this side of the group that holds a card, brought into sight.
SIDE: Final = """([id, side]) => {
  const group = document.querySelector(`.card[data-demonstration-id="${id}"]`).closest(".group-cards");
  const { height } = group.getBoundingClientRect();
  const y = { above: -1, below: height + 1, beside: height / 2 }[side];
  window.scrollTo({ top: scrollY + group.getBoundingClientRect().top + y - innerHeight / 2, behavior: "instant" });
  const { left, top, width } = group.getBoundingClientRect();
  return [left + width * (side === "beside" ? 0.8 : 0.3), top + y];
}"""


def world_with(page: Page, address: str, *, successes: int = 0, failures: int = 0, seed: int = 5) -> str:
    """A world in which the page's visitor has made so many attempts, by the API; its id."""
    client = walk.ContextClient(page, address)
    world = client.post("/worlds", {"seed": seed})
    grid, rng = journey.Grid(world), random.Random(seed)
    for _ in range(successes):
        send(client, world["id"], a_success(grid, rng), "goal", rng)
    for _ in range(failures):
        send(client, world["id"], a_failure(grid, rng), "gave_up", rng)
    return str(world["id"])


#: Who played what before, at which address: the world and the cookies that tell who it was.
_PLAYED: dict[tuple[str, int, int, int], tuple[str, list[Cookie]]] = {}


def played_before(page: Page, address: str, *, successes: int = 0, failures: int = 0, seed: int = 5) -> str:
    """As `world_with`, but made once for all who ask for as much: for those whom nobody else's order disturbs."""
    key = (address, successes, failures, seed)
    if key in _PLAYED:
        world_id, cookies = _PLAYED[key]
        page.context.add_cookies([{"name": one["name"], "value": one["value"], "url": address} for one in cookies])
        return world_id
    world_id = world_with(page, address, successes=successes, failures=failures, seed=seed)
    _PLAYED[key] = (world_id, page.context.cookies())
    return world_id


def a_success(grid: journey.Grid, rng: random.Random) -> list[int]:
    """The cheapest path with some bumps and steps there and back, as many as it can pay for."""
    best = grid.cheapest_path([max(-reward, 0.0) for reward in grid.rewards])
    while True:
        actions = list(best)
        for _ in range(rng.randrange(5)):
            at, action = rng.randrange(len(actions)), rng.randrange(4)
            actions[at:at] = [action, (action + 2) % 4]
        states, total = grid.walk(actions)
        ends_there = states[-1] in grid.goals and not grid.goals & set(states[:-1])
        if ends_there and total >= 0 and len(actions) <= grid.horizon:
            return actions


def a_failure(grid: journey.Grid, rng: random.Random) -> list[int]:
    """Some steps about, and given up."""
    while True:
        actions = [rng.randrange(4) for _ in range(rng.randrange(3, 20))]
        if not grid.goals & set(grid.walk(actions)[0]):
            return actions


def send(client: journey.Client, world_id: str, actions: list[int], ending: str, rng: random.Random) -> None:
    step_ms = [float(rng.randrange(90, 900)) for _ in actions]
    body = {"id": str(uuid.uuid4()), "actions": actions, "step_ms": step_ms, "ending": ending}
    client.post(f"/worlds/{world_id}/demonstrations", body)


def open_lists(page: Page, world_id: str, *, n_cards: int) -> None:
    """Go to the rank page and wait for the cards, which are drawn by the script."""
    page.goto(f"/worlds/{world_id}/rank")
    expect(page.locator(".card")).to_have_count(n_cards)


def order_shown(page: Page, outcome: Outcome) -> Order:
    shown: Order = page.evaluate(ORDER_SHOWN, outcome)
    return shown


def any_order(ids: list[str], rng: random.Random) -> Order:
    """Any permutation, some of it tied."""
    order: Order = []
    for id_ in rng.sample(ids, len(ids)):
        if order and rng.random() < 0.3:
            order[-1].append(id_)
        else:
            order.append([id_])
    return order


class Where(NamedTuple):
    """Beside a card: alone above or below its group, or tied with it."""

    other: str
    side: Side


class Hand(Protocol):
    """Whatever takes a card and puts it somewhere."""

    def drag(self, id_: str, where: Where) -> None: ...


class Mouse:
    def __init__(self, page: Page) -> None:
        self._page = page

    def drag(self, id_: str, where: Where) -> None:
        mouse = self._page.mouse
        mouse.move(*self._page.evaluate(GRIP, id_))
        mouse.down()
        mouse.move(*self._page.evaluate(SIDE, list(where)))
        mouse.up()


class Finger:
    def __init__(self, page: Page) -> None:
        self._page = page
        self._finger: CDPSession = page.context.new_cdp_session(page)

    def drag(self, id_: str, where: Where) -> None:
        self.touch("touchStart", self._page.evaluate(GRIP, id_))
        self.touch("touchMove", self._page.evaluate(SIDE, list(where)))
        self.touch("touchEnd")

    def touch(self, kind: Literal["touchStart", "touchMove", "touchEnd"], at: Point | None = None) -> None:
        points = [] if at is None else [{"x": at[0], "y": at[1]}]
        self._finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})


def rank_by_hand(hand: Hand, order: Order, target: Order) -> None:
    """From the top: the first of each group to its place, the others beside it."""
    order = [list(group) for group in order]
    for at, group in enumerate(target):
        if order[at] == group:
            continue
        first, *others = group
        if order[at] != [first]:
            hand.drag(first, Where(order[at][0], "above"))
            order = place(order, first, at, joins=False)
        for other in others:
            hand.drag(other, Where(first, "beside"))
            order = place(order, other, at, joins=True)


def rank_by_keys(page: Page, order: Order, target: Order) -> None:
    """From the top; a card is lifted, moved by the fewest keys, and put down."""
    order = [list(group) for group in order]
    for at, group in enumerate(target):
        if order[at] == group:
            continue
        first, *others = group
        if order[at] != [first]:
            order = carry(page, order, first, at)
        for other in others:
            order = place(carry(page, order, other, at + 1, tie=True), other, at, joins=True)


def carry(page: Page, order: Order, id_: str, at: int, *, tie: bool = False) -> Order:
    page.evaluate("id => document.querySelector(`.card[data-demonstration-id='${id}']`).focus()", id_)
    keys, after = way_to(order, id_, at)
    for key in ["Space", *keys, *(["t"] if tie else []), "Space"]:
        page.keyboard.press(key)
    return after


STEPS: Final = {"ArrowUp": -1, "ArrowDown": 1, "PageUp": -5, "PageDown": 5, "Home": -1000, "End": 1000}


def way_to(order: Order, id_: str, at: int) -> tuple[list[str], Order]:
    """The fewest keys that bring a lifted card to stand alone as group `at`."""
    seen, open_ = set(), deque([(list[str](), order)])
    while open_:
        keys, now = open_.popleft()
        if now[at : at + 1] == [[id_]]:
            return keys, now
        for key, by in STEPS.items():
            after = step(now, id_, by)
            mark = (group_of(after, id_), len(after))
            if mark not in seen:
                seen.add(mark)
                open_.append(([*keys, key], after))
    raise AssertionError("no keys lead there")


def step(order: Order, id_: str, by: int) -> Order:
    """Past so many groups; out of a tie the first step stands alone beside it."""
    at = group_of(order, id_)
    to = at + by + (1 if by < 0 and len(order[at]) > 1 else 0)
    others = without(order, id_)
    return place(order, id_, min(len(others), max(0, to)), joins=False)


def place(order: Order, id_: str, at: int, *, joins: bool) -> Order:
    others = without(order, id_)
    if joins:
        return [[*group, id_] if i == at else group for i, group in enumerate(others)]
    return [*others[:at], [id_], *others[at:]]


def without(order: Order, id_: str) -> Order:
    others = [[one for one in group if one != id_] for group in order]
    return [group for group in others if group]


def group_of(order: Order, id_: str) -> int:
    return next(at for at, group in enumerate(order) if id_ in group)
