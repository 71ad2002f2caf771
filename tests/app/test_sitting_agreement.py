"""The browser and the server make the same of thousands of random sittings, event by event.

Every event goes through the page's own state (tests/js/sittings.js, one Node process for all) and through the server's
replay: moves, swaps, whole orders, lifting and putting back, undo and redo, answers, gaps, stretches, cards that come
and go; and events that cannot be, which both must refuse. After each the whole states are compared: past, present,
future.
"""

import json
import os
import random
import subprocess
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from app.rankings import replay
from app.rankings.content import OUTCOMES, flat
from hatch_build import node_command

ROOT = Path(__file__).resolve().parents[2]
N_SITTINGS = 3000
MOST_EVENTS = 40
SEEN_AT_LEAST = {
    "valid": 30_000, "refused": 10_000, "nothing came of it": 1000, "tied": 10_000, "lifted": 5000,
    "put back": 100, "undone": 1000, "done again": 300, "answered": 1000, "gap": 1000, "marked": 1000,
    "cards with a past": 300, "a lift of several steps": 100, "an empty list": 100,
}  # fmt: skip

Json = dict[str, Any]


class Hand:
    """Does something at random that could be, or could almost be, done to a sitting that stands so."""

    def __init__(self, rng: random.Random) -> None:
        self._rng = rng
        self._n_cards = 0
        self.orders = {outcome: self._groups(self._new(rng.choice([0, 1, 2, 3, 5]))) for outcome in OUTCOMES}

    def begin(self) -> Json:
        return {"type": "begin", "means": "page", "orders": self.orders, "way": "lists"}

    def do(self, state: replay.State) -> Json:
        rng = self._rng
        self._state = state
        # Mostly in a list that has cards; sometimes with a card of the other list, or one that never was.
        self._outcome = rng.choice(OUTCOMES)
        ids = flat(state.orders[self._outcome])
        self._pool = ids * 8 + flat(state.orders[rng.choice(OUTCOMES)]) + ["nobody"]
        return {"means": "mouse"} | rng.choice(self._moves)(self)

    def _place(self) -> Json:
        n_groups = len(self._state.orders[self._outcome])
        group, joins = self._rng.randint(-1, n_groups + 1), self._rng.random() < 0.5
        return self._here("place", id=self._card(), group=group, joins=joins)

    def _swap(self) -> Json:
        return self._here("swap", id=self._card(), **{"with": self._card()})

    def _set(self) -> Json:
        ids = flat(self._state.orders[self._outcome])
        if self._rng.random() < 0.15:
            ids = self._rng.choice([ids[1:], [*ids, "nobody"], ids + ids[:1]])
        return self._here("set", order=self._groups(ids), by="score")

    def _lift(self) -> Json:
        return self._here("lift", id=self._card())

    def _answer(self) -> Json:
        return self._here("answer", a=self._card(), b=self._card(), said=self._rng.choice(["a", "b", "alike"]))

    def _gap(self) -> Json:
        said = self._state.history.present.gaps[self._outcome]
        if said and self._rng.random() < 0.4:
            above, below = self._rng.choice([(one.above, one.below) for one in said])
        else:
            above, below = self._card(), self._card()
        return self._here("gap", above=above, below=below, value=self._rng.choice([None, 1, 50, 50, 100]))

    def _stretch(self) -> Json:
        first, last = self._rng.randint(0, 9), self._rng.randint(1, 12)
        kind = self._rng.choice(["good", "good", "bad", "bad", None])
        return {"type": "stretch", "id": self._card(), "from": first, "to": last, "kind": kind}

    def _cards(self) -> Json:
        ids = flat(self._state.orders[self._outcome])
        removed = self._rng.sample(ids, self._rng.randint(0, min(2, len(ids))))
        added = self._new(self._rng.choice([0, 1, 2]))
        if self._rng.random() < 0.2:
            (removed if self._rng.random() < 0.5 else added).append(self._card())
        return self._here("cards", added=added, removed=removed)

    def _way(self) -> Json:
        return {"type": "way", "way": self._rng.choice(["lists", "pairwise", "magnitude", "segments"])}

    def _plain(self) -> Json:
        kinds = ["drop", "put_back", "put_back", "undo", "undo", "undo", "redo", "redo", "redo", "hidden", "begin"]
        return {"type": self._rng.choice(kinds)}

    def _silent(self) -> Json:
        watch = {"type": "watch", "id": self._card()}
        compare = {"type": "compare", "a": self._card(), "b": self._card()}
        resumed = {"type": "resumed", "away_ms": None}
        return self._rng.choice([watch, compare, resumed, self._here("confirm", untouched=False)])

    _moves = (
        _place, _place, _place, _place, _swap, _set, _lift, _answer, _gap, _stretch, _stretch, _plain, _plain, _plain,
        _cards, _way, _silent,
    )  # fmt: skip

    def _here(self, kind: str, **fields: Any) -> Json:
        return {"type": kind, "outcome": self._outcome, **fields}

    def _card(self) -> str:
        return self._rng.choice(self._pool)

    def _new(self, n: int) -> list[str]:
        self._n_cards += n
        return [f"c{self._n_cards - k}" for k in range(n)]

    def _groups(self, ids: list[str]) -> list[list[str]]:
        groups: list[list[str]] = []
        for one in self._rng.sample(ids, len(ids)):
            if groups and self._rng.random() < 0.3:
                groups[-1].append(one)
            else:
                groups.append([one])
        return groups


def a_sitting(rng: random.Random) -> tuple[list[Json], list[Json | None], list[replay.State]]:
    """Events, what the server makes of each (None: refused), and how it stood before each."""
    hand = Hand(rng)
    events = [hand.begin()]
    state = replay.begin(events[0])
    told: list[Json | None] = [replay.state_json(state)]
    stood = [state]
    for _ in range(rng.randint(1, MOST_EVENTS)):
        events.append(hand.do(state))
        stood.append(state)
        try:
            state = replay.apply(state, events[-1])
        except replay.InvalidEvent:
            told.append(None)
        else:
            told.append(replay.state_json(state))
    return events, told, stood


def what_was_seen(events: list[Json], told: list[Json | None], stood: list[replay.State]) -> Iterator[str]:
    for event, after, before in zip(events[1:], told[1:], stood[1:], strict=True):
        if after is None:
            yield "refused"
            continue
        kind, present = event["type"], after["present"]
        yield "valid"
        if after == replay.state_json(before):
            yield "nothing came of it"
        yield from (word for word, is_so in {
            "tied": any(len(group) > 1 for order in present["orders"].values() for group in order),
            "an empty list": not all(present["orders"].values()),
            "lifted": after["lifted"] is not None,
            "put back": kind == "put_back" and before.history != before.mark,
            "undone": kind == "undo", "done again": kind == "redo",
            "answered": any(present["answers"].values()), "gap": any(present["gaps"].values()),
            "marked": any(present["stretches"].values()),
            "cards with a past": kind == "cards" and bool(after["past"]) and event["added"] + event["removed"] != [],
            "a lift of several steps": kind == "place" and before.mark is not None and before.mark != before.history,
        }.items() if is_so)  # fmt: skip


@pytest.fixture(scope="module")
def node() -> Iterator[subprocess.Popen[str]]:
    """The browser's side, waiting for sittings."""
    command = [*node_command(), "tests/js/sittings.js"]
    environment = os.environ | {"NODE_OPTIONS": ""}
    with subprocess.Popen(
        command, cwd=ROOT, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        yield process
        process.communicate()


def told_by_the_browser(node: subprocess.Popen[str], events: list[Json]) -> list[Json | None]:
    assert node.stdin is not None
    assert node.stdout is not None
    node.stdin.write(json.dumps(events) + "\n")
    node.stdin.flush()
    line = node.stdout.readline()
    assert line, "the browser's side has ended; its last words stand above"
    told: list[Json | None] = json.loads(line)
    return told


def test_browser_and_server_agree_on_every_event_of_every_sitting(node: subprocess.Popen[str]) -> None:
    seen: Counter[str] = Counter()
    for seed in range(N_SITTINGS):
        events, told, stood = a_sitting(random.Random(seed))
        answers = told_by_the_browser(node, events)
        for n, (here, there) in enumerate(zip(told, answers, strict=True)):
            assert there == here, f"sitting {seed}, event {n}: {events[n]}\nafter {events[: n + 1]}"
        seen.update(what_was_seen(events, told, stood))
    # Agreement about little would be easy: the sittings went everywhere.
    assert {name: seen[name] for name, least in SEEN_AT_LEAST.items() if seen[name] < least} == {}
