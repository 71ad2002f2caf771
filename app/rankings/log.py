"""A sitting's log as far as it has been gone through, and whether an event may come next in it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from hashlib import sha256
from typing import Any, TypeAlias

from app.rankings import replay
from app.rankings.content import OUTCOMES, PLURAL, Content, Outcome, as_order, flat
from app.rankings.queries import Attempt
from app.rankings.replay import InvalidEvent, State

Event: TypeAlias = dict[str, Any]

MOST_HELD = 4_000_000
"""Cards, answers, gaps and stretches, times the steps of undo: 2,000 steps with 80 cards hold 160,000."""
MOST_CARRIED = 40_000_000
"""The same, summed over the times that attempts came or went, each of which goes through every step of undo."""


@dataclass(frozen=True, slots=True)
class Log:
    """The events of a sitting up to `last`, gone through."""

    begin: Event
    last: Event
    state: State
    n_carried: int = 0

    @property
    def n_events(self) -> int:
        """How many there are."""
        return int(self.last["n"]) + 1

    def is_drawn(self, outcome: Outcome) -> bool:
        """Whether the list was first shown in the order drawn at random."""
        return bool(self.begin["from"][outcome] == "random")


def start_order(visitor_id: str, world_id: str, outcome: str, ids: Iterable[str]) -> list[str]:
    """Shuffle for the first showing: at random, yet the same at every reload, and a new attempt disturbs no other."""
    return sorted(ids, key=lambda one: sha256(f"{visitor_id}/{world_id}/{outcome}/{one}".encode()).digest())


def log_after(log: Log | None, event: Event) -> Log:
    """Go on by one event; without a log, begin one. Raises InvalidEvent."""
    if log is None:
        return Log(begin=event, last=event, state=replay.begin(event))
    n_carried = log.n_carried + (n_held(log.state) if event["type"] == "cards" else 0)
    return Log(begin=log.begin, last=event, state=replay.apply(log.state, event), n_carried=n_carried)


def n_held(state: State) -> int:
    """Measure what the steps of undo hold, by the last of them."""
    history = state.history
    return (len(history.past) + 1 + len(history.future)) * _n_said(history.present)


def _n_said(content: Content) -> int:
    lists = (*content.orders.values(), *content.answers.values(), *content.gaps.values(), *content.stretches.values())
    return sum(len(one) for one in lists)


@dataclass(frozen=True, slots=True)
class Owner:
    """Whose log it is, and what they have played: what the ids in its events are held against."""

    visitor_id: str
    world_id: str
    attempts: Mapping[str, Attempt]


def checked_after(log: Log | None, event: Event, owner: Owner) -> Log:
    """Go on by an event that just came. Raises InvalidEvent also where it names what is not theirs, or goes too far."""
    if log is not None and event["at_ms"] < log.last["at_ms"]:
        raise InvalidEvent("its time is before that of the event before it")
    if log is not None:
        _check_is_theirs(event, owner)
    after = log_after(log, event)
    if log is None:
        _check_begin(event, owner)
    if n_held(after.state) > MOST_HELD or after.n_carried > MOST_CARRIED:
        raise InvalidEvent("this sitting has become too long to be kept")
    return after


def _check_begin(event: Event, owner: Owner) -> None:
    for outcome in OUTCOMES:
        order = as_order(event["orders"][outcome])
        _check_outcome(flat(order), outcome, owner)
        drawn = start_order(owner.visitor_id, owner.world_id, outcome, flat(order))
        if event["from"][outcome] == "random" and order != as_order([one] for one in drawn):
            raise InvalidEvent(f"its {PLURAL[outcome]} are not in the order that was drawn")


def _check_is_theirs(event: Event, owner: Owner) -> None:
    """Check the ids that the replay does not hold against the lists."""
    kind = event["type"]
    if kind == "cards":
        _check_outcome(event["added"], event["outcome"], owner)
    if kind == "watch" and event["id"] not in owner.attempts:
        raise InvalidEvent("its attempt is not one of yours in this world")
    if kind == "compare" and not {event["a"], event["b"]} <= owner.attempts.keys():
        raise InvalidEvent("its attempts are not both yours in this world")
    if kind == "stretch" and event["id"] in owner.attempts and event["to"] > owner.attempts[event["id"]].n_steps:
        raise InvalidEvent(f"its attempt has only {owner.attempts[event['id']].n_steps} steps")


def _check_outcome(ids: Iterable[str], outcome: Outcome, owner: Owner) -> None:
    if not all(one in owner.attempts and owner.attempts[one].outcome == outcome for one in ids):
        raise InvalidEvent(f"it names an attempt that is not one of your {PLURAL[outcome]} in this world")
