"""What a person states about attempts: orders, answers about pairs, gaps, stretches. Values, and how they change."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import chain
from typing import Any, Literal, TypeAlias

Outcome: TypeAlias = Literal["success", "failure"]
Order: TypeAlias = tuple[tuple[str, ...], ...]
"""Groups of ids from top to bottom (best success, worst failure first); a group of several is a tie."""

OUTCOMES: tuple[Outcome, ...] = ("success", "failure")
PLURAL: Mapping[Outcome, str] = {"success": "successes", "failure": "failures"}


@dataclass(frozen=True, slots=True)
class Answer:
    """Which of two belongs higher, or that they are alike."""

    a: str
    b: str
    said: Literal["a", "b", "alike"]


@dataclass(frozen=True, slots=True)
class Gap:
    """How much better (success) or worse (failure) one is than the other below it, from 1 to 100."""

    above: str
    below: str
    value: int


@dataclass(frozen=True, slots=True)
class Stretch:
    """Steps of an attempt, counted from 1, both ends included."""

    first: int
    last: int
    kind: Literal["good", "bad"]


@dataclass(frozen=True, slots=True)
class Content:
    """What the person states."""

    orders: Mapping[Outcome, Order]
    answers: Mapping[Outcome, tuple[Answer, ...]]
    gaps: Mapping[Outcome, tuple[Gap, ...]]
    stretches: Mapping[str, tuple[Stretch, ...]]
    """By attempt; one without any is not in it."""


def as_order(groups: Iterable[Iterable[str]]) -> Order:
    """Freeze what came as lists."""
    return tuple(tuple(group) for group in groups)


def flat(order: Order) -> list[str]:
    """List the ids from top to bottom."""
    return list(chain.from_iterable(order))


def without(order: Iterable[tuple[str, ...]], gone: Collection[str]) -> list[tuple[str, ...]]:
    """Leave cards out, and the groups that are empty then."""
    return [rest for group in order if (rest := tuple(one for one in group if one not in gone))]


def with_gap(gaps: tuple[Gap, ...], above: str, below: str, value: int | None) -> tuple[Gap, ...]:
    """Put a gap in the place of the one between the same two, if there is one; else last."""
    at = next((k for k, one in enumerate(gaps) if (one.above, one.below) == (above, below)), len(gaps))
    return (*gaps[:at], *([] if value is None else [Gap(above, below, value)]), *gaps[at + 1 :])


def paint(
    stretches: tuple[Stretch, ...], first: int, last: int, kind: Literal["good", "bad"] | None
) -> tuple[Stretch, ...]:
    """Paint steps `first` … `last` over what is marked; None wipes them clean."""
    left = [replace(one, last=min(one.last, first - 1)) for one in stretches if one.first < first]
    right = [replace(one, first=max(one.first, last + 1)) for one in stretches if one.last > last]
    return _merged([*left, *([] if kind is None else [Stretch(first, last, kind)]), *right])


def _merged(stretches: Iterable[Stretch]) -> tuple[Stretch, ...]:
    """Make one of neighbours of one kind."""
    whole: list[Stretch] = []
    for one in stretches:
        if whole and whole[-1].kind == one.kind and whole[-1].last + 1 == one.first:
            whole[-1] = replace(whole[-1], last=one.last)
        else:
            whole.append(one)
    return tuple(whole)


def bring_up_to_date(content: Content, outcome: Outcome, added: Iterable[str], gone: Collection[str]) -> Content:
    """Leave out what is gone and what was said of it; put what is new last, each alone."""
    answers = tuple(one for one in content.answers[outcome] if one.a not in gone and one.b not in gone)
    gaps = tuple(one for one in content.gaps[outcome] if one.above not in gone and one.below not in gone)
    return Content(
        orders={**content.orders, outcome: (*without(content.orders[outcome], gone), *((one,) for one in added))},
        answers={**content.answers, outcome: answers},
        gaps={**content.gaps, outcome: gaps},
        stretches={one: marked for one, marked in content.stretches.items() if one not in gone},
    )


def content_json(content: Content) -> dict[str, Any]:
    """Spell all of it as on the wire."""
    return {
        "orders": {name: [list(group) for group in order] for name, order in content.orders.items()},
        "answers": {name: [answer_json(one) for one in said] for name, said in content.answers.items()},
        "gaps": {name: [gap_json(one) for one in gaps] for name, gaps in content.gaps.items()},
        "stretches": {name: [stretch_json(one) for one in marked] for name, marked in content.stretches.items()},
    }


def answer_json(one: Answer) -> dict[str, Any]:
    """Spell an answer as on the wire."""
    return {"a": one.a, "b": one.b, "said": one.said}


def gap_json(one: Gap) -> dict[str, Any]:
    """Spell a gap as on the wire."""
    return {"above": one.above, "below": one.below, "value": one.value}


def stretch_json(one: Stretch) -> dict[str, Any]:
    """Spell a stretch as on the wire."""
    return {"from": one.first, "to": one.last, "kind": one.kind}
