"""What a sitting has come to, from its events alone. No database, no clock; every value here is frozen.

`static/js/rankings/sitting-state.js` is the twin in the browser: what one makes of an event, the other does too.

An **order** is groups of ids from top to bottom (best success, worst failure first); a group of several is a tie. The
**content** is what the person states: both orders, answers about pairs, gaps, stretches. Undo and redo go from content
to content: a change puts the present one on the past and forgets the future. While a card is **lifted** everything done
is one step of undo: `mark` is how things stood when it was lifted, and a change that leads back there leaves nothing.

    begin      both orders as they were first shown, and the way
    place      a card is taken out and put among the others: alone before group `group`, or, where it joins, last in it
    swap       two cards change places
    set        the whole order at once: by score, by answers, by stretches, or that of an earlier version
    lift       a card is lifted; one that is lifted already is put down first
    drop       it is put down                                      (needs a lifted card)
    put_back   it is put down, and everything is as before         (needs a lifted card)
    undo       back to the last content; redo: forward again       (both put down first; both need something there)
    answer     which of two is better (success), or worse (failure)
    gap        how much better a place is than the next; null takes that back
    stretch    steps `from` … `to` of an attempt are painted good or bad; null wipes them clean
    cards      attempts came or went meanwhile: in past, present and future alike, so it is no step of undo
    way        another way of saying it is shown
    confirm    an order was confirmed; a lifted card is put down
    watch, compare, hidden, visible, resumed     change nothing

`touched` says of which list the person has ever changed anything. An event that could not happen raises `InvalidEvent`.
That an event has its fields, and of the right kind, is the business of `events.py`; that the ids are theirs and
the times in order, that of `log.py`; the numbers, that of `sittings.py`.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from app.rankings.content import (
    OUTCOMES,
    Answer,
    Content,
    Order,
    Outcome,
    answer_json,
    as_order,
    bring_up_to_date,
    content_json,
    flat,
    gap_json,
    paint,
    stretch_json,
    with_gap,
    without,
)

Event: TypeAlias = Mapping[str, Any]
"""As it crossed the wire."""


class InvalidEvent(Exception):
    """An event that no page makes of what stood before it; says why, in half a sentence."""


@dataclass(frozen=True, slots=True)
class History:
    """The present content with the way back and the way forward again."""

    past: tuple[Content, ...]
    present: Content
    future: tuple[Content, ...]


@dataclass(frozen=True, slots=True)
class State:
    """Where a sitting stands."""

    history: History
    mark: History | None
    lifted: str | None
    way: str
    touched: Mapping[Outcome, bool]

    @property
    def orders(self) -> Mapping[Outcome, Order]:
        """Both orders as they stand."""
        return self.history.present.orders


def rebuild(events: Iterable[Event]) -> State:
    """Go through a log from its first event, which is `begin`."""
    waiting = iter(events)
    state = begin(next(waiting))
    for event in waiting:
        state = apply(state, event)
    return state


def begin(event: Event) -> State:
    """Take the orders as they were first shown."""
    if event["type"] != "begin":
        raise InvalidEvent("a sitting starts with begin")
    orders = {outcome: as_order(event["orders"][outcome]) for outcome in OUTCOMES}
    ids = [one for order in orders.values() for one in flat(order)]
    if len(set(ids)) < len(ids):
        raise InvalidEvent("an attempt is in its orders twice")
    nothing: Mapping[Outcome, tuple[()]] = {"success": (), "failure": ()}
    content = Content(orders=orders, answers=nothing, gaps=nothing, stretches={})
    touched: Mapping[Outcome, bool] = {"success": False, "failure": False}
    return State(History((), content, ()), mark=None, lifted=None, way=event["way"], touched=touched)


def apply(state: State, event: Event) -> State:
    """Return the state after an event; the very same one where nothing came of it. Raises InvalidEvent."""
    if event["type"] not in _CHANGES:
        raise InvalidEvent("a sitting begins only once")
    return _CHANGES[event["type"]](state, event)


def given(state: State, outcome: Outcome) -> list[dict[str, Any]] | dict[str, list[dict[str, Any]]] | None:
    """Tell what the person said of this outcome in the way that is shown, as JSON; None where lists say it all."""
    content = state.history.present
    if state.way == "pairwise":
        return [answer_json(one) for one in content.answers[outcome]]
    if state.way == "magnitude":
        return [gap_json(one) for one in content.gaps[outcome]]
    if state.way == "segments":
        ids = set(flat(content.orders[outcome]))
        return {one: [stretch_json(s) for s in marked] for one, marked in content.stretches.items() if one in ids}
    return None


def state_json(state: State) -> dict[str, Any]:
    """Show the whole state in the words of the twin."""
    mark = state.mark and _history_json(state.mark)
    rest = {"mark": mark, "lifted": state.lifted, "way": state.way, "touched": dict(state.touched)}
    return _history_json(state.history) | rest


def _history_json(history: History) -> dict[str, Any]:
    return {
        "past": [content_json(one) for one in history.past],
        "present": content_json(history.present),
        "future": [content_json(one) for one in history.future],
    }


def _place(state: State, event: Event) -> State:
    outcome, joins, at = event["outcome"], event["joins"], event["group"]
    others = without(_order_with(state, outcome, event["id"]), {event["id"]})
    if not 0 <= at <= len(others) - joins:
        raise InvalidEvent("it places a card beyond the others")
    others[at : at + joins] = [(*others[at], event["id"])] if joins else [(event["id"],)]
    return _reorder(state, outcome, tuple(others))


def _swap(state: State, event: Event) -> State:
    a, b = event["id"], event["with"]
    order = _order_with(state, event["outcome"], a, b)
    instead = {a: b, b: a}
    return _reorder(state, event["outcome"], tuple(tuple(instead.get(one, one) for one in group) for group in order))


def _set(state: State, event: Event) -> State:
    before, order = state.orders[event["outcome"]], as_order(event["order"])
    if sorted(flat(order)) != sorted(flat(before)) or not all(order):
        raise InvalidEvent("its order must hold exactly the cards that are there")
    return _reorder(state, event["outcome"], order)


def _lift(state: State, event: Event) -> State:
    _order_with(state, event["outcome"], event["id"])
    return replace(state, mark=state.history, lifted=event["id"])


def _drop(state: State, _: Event) -> State:
    if state.mark is None:
        raise InvalidEvent("no card is lifted")
    return _put_down(state)


def _put_back(state: State, _: Event) -> State:
    if state.mark is None:
        raise InvalidEvent("no card is lifted")
    return replace(_put_down(state), history=state.mark)


def _undo(state: State, _: Event) -> State:
    past, present, future = state.history.past, state.history.present, state.history.future
    if not past:
        raise InvalidEvent("there is nothing to undo")
    return replace(_put_down(state), history=History(past[:-1], past[-1], (present, *future)))


def _redo(state: State, _: Event) -> State:
    past, present, future = state.history.past, state.history.present, state.history.future
    if not future:
        raise InvalidEvent("there is nothing to do again")
    return replace(_put_down(state), history=History((*past, present), future[0], future[1:]))


def _answer(state: State, event: Event) -> State:
    outcome, content = event["outcome"], state.history.present
    _order_with(state, outcome, event["a"], event["b"])
    said = (*content.answers[outcome], Answer(event["a"], event["b"], event["said"]))
    return _record(state, outcome, replace(content, answers={**content.answers, outcome: said}))


def _gap(state: State, event: Event) -> State:
    outcome, content = event["outcome"], state.history.present
    _order_with(state, outcome, event["above"], event["below"])
    gaps = with_gap(content.gaps[outcome], event["above"], event["below"], event["value"])
    return _record(state, outcome, replace(content, gaps={**content.gaps, outcome: gaps}))


def _stretch(state: State, event: Event) -> State:
    outcome, content = _outcome_of(state, event["id"]), state.history.present
    if outcome is None:
        raise InvalidEvent("its attempt is not on the page")
    if not 1 <= event["from"] <= event["to"]:
        raise InvalidEvent("its stretch ends before it begins")
    painted = paint(content.stretches.get(event["id"], ()), event["from"], event["to"], event["kind"])
    others = {one: marked for one, marked in content.stretches.items() if one != event["id"]}
    stretches = {**others, event["id"]: painted} if painted else others
    return _record(state, outcome, replace(content, stretches=stretches))


def _cards(state: State, event: Event) -> State:
    outcome, added, removed = event["outcome"], event["added"], event["removed"]
    if len(set(added)) < len(added) or any(_outcome_of(state, one) for one in added):
        raise InvalidEvent("it adds a card that is there already")
    if not set(removed) <= set(flat(state.orders[outcome])):
        raise InvalidEvent("it removes a card that is not there")

    def bring(contents: Iterable[Content]) -> tuple[Content, ...]:
        return tuple(bring_up_to_date(one, outcome, added, set(removed)) for one in contents)

    past, present, future = state.history.past, state.history.present, state.history.future
    return replace(_put_down(state), history=History(bring(past), bring([present])[0], bring(future)))


def _way(state: State, event: Event) -> State:
    return replace(state, way=event["way"])


def _confirm(state: State, _: Event) -> State:
    return _put_down(state)


def _nothing(state: State, _: Event) -> State:
    return state


_CHANGES: Mapping[str, Callable[[State, Event], State]] = {
    "place": _place,
    "swap": _swap,
    "set": _set,
    "lift": _lift,
    "drop": _drop,
    "put_back": _put_back,
    "undo": _undo,
    "redo": _redo,
    "answer": _answer,
    "gap": _gap,
    "stretch": _stretch,
    "cards": _cards,
    "way": _way,
    "confirm": _confirm,
    "watch": _nothing,
    "compare": _nothing,
    "hidden": _nothing,
    "visible": _nothing,
    "resumed": _nothing,
}


def _reorder(state: State, outcome: Outcome, order: Order) -> State:
    content = state.history.present
    return _record(state, outcome, replace(content, orders={**content.orders, outcome: order}))


def _record(state: State, outcome: Outcome, content: Content) -> State:
    """Take one step; while a card is lifted, all steps together are one."""
    if content == state.history.present:
        return state
    touched = {**state.touched, outcome: True}
    if state.mark is not None and content == state.mark.present:
        return replace(state, history=state.mark, touched=touched)
    before = state.mark or state.history
    return replace(state, history=History((*before.past, before.present), content, ()), touched=touched)


def _put_down(state: State) -> State:
    return replace(state, mark=None, lifted=None) if state.mark else state


def _order_with(state: State, outcome: Outcome, *ids: str) -> Order:
    """Find the order of an outcome; it must hold these cards, which must differ."""
    order = state.orders[outcome]
    if len(set(ids)) < len(ids):
        raise InvalidEvent("it names one card twice")
    if not set(ids) <= set(flat(order)):
        raise InvalidEvent("it names a card that is not in the list")
    return order


def _outcome_of(state: State, one: str) -> Outcome | None:
    return next((outcome for outcome in OUTCOMES if one in flat(state.orders[outcome])), None)
