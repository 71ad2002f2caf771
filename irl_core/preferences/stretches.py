"""Good and bad stretches: runs of steps of one attempt that a person marked, and the order that follows.

An attempt of T steps with g of them marked good and b marked bad has the score

    (g − b) / T,   from −1 (all bad) to 1 (all good), 0 where nothing is marked,

so a long attempt is not better for its length. Successes are ordered from the highest score and failures from the
lowest, the worst first; equal scores tie. To call behaviour good or bad while it passes is the feedback of W. B. Knox
and P. Stone, "Interactively shaping agents via human reinforcement: the TAMER framework" (K-CAP 2009); here it is said
afterwards, of runs of steps, and can be taken back.
"""

from collections.abc import Iterable, Mapping
from itertools import groupby
from typing import Literal, TypedDict

from irl_core.checks import Refused, shown, whole_number
from irl_core.errors import InvalidRanking
from irl_core.world_checks import is_list

# A field called "from" cannot be written as a class's.
Stretch = TypedDict("Stretch", {"from": int, "to": int, "kind": Literal["good", "bad"]})
"""Steps `from` … `to` of an attempt, counted from 1, both inclusive; as rankings in demonstration files write it."""


def score_of_stretches(stretches: Iterable[Stretch], n_steps: int) -> float:
    """(good − bad) / steps; an attempt without any step has 0."""
    steps = _step_count(n_steps)
    counted: set[int] = set()
    balance = 0
    for stretch in _checked(stretches, n_steps=steps):
        run = range(stretch["from"], stretch["to"] + 1)
        if not counted.isdisjoint(run):
            raise InvalidRanking(f"Step {min(counted & set(run))} is marked twice.", field="stretches")
        counted |= set(run)
        balance += len(run) if stretch["kind"] == "good" else -len(run)
    return balance / steps if steps else 0.0


def order_from_stretches(
    stretches: Mapping[str, Iterable[Stretch]], n_steps: Mapping[str, int], *, outcome: Literal["success", "failure"]
) -> tuple[tuple[str, ...], ...]:
    """Groups in display order of the attempts in `n_steps` (id → steps), which need not all have stretches.

    Those that tie stand as they do in `n_steps`. What is marked on other attempts is left aside.
    """
    if outcome not in {"success", "failure"}:
        raise InvalidRanking(f'An outcome is "success" or "failure", not {shown(outcome)}.', field="outcome")
    score = {id_: score_of_stretches(stretches.get(id_, ()), steps) for id_, steps in n_steps.items()}
    ranked = sorted(score, key=lambda id_: score[id_], reverse=outcome == "success")
    return tuple(tuple(tied) for _, tied in groupby(ranked, key=lambda id_: score[id_]))


def _step_count(n_steps: object) -> int:
    try:
        return whole_number(n_steps, minimum=0, maximum=10**9)
    except Refused as refused:
        raise InvalidRanking(f"The number of steps {refused}.", field="n_steps") from None


def _checked(stretches: Iterable[Stretch], *, n_steps: int) -> list[Stretch]:
    if not is_list(stretches):
        raise InvalidRanking("Stretches are a list of {from, to, kind}.", field="stretches")
    return [_checked_stretch(stretch, n_steps=n_steps) for stretch in stretches]


def _checked_stretch(stretch: object, *, n_steps: int) -> Stretch:
    if not isinstance(stretch, Mapping) or stretch.get("kind") not in ("good", "bad"):
        raise InvalidRanking('A stretch is {from, to, kind}, its kind "good" or "bad".', field="stretches")
    try:
        first = whole_number(stretch.get("from"), minimum=1, maximum=n_steps)
        last = whole_number(stretch.get("to"), minimum=first, maximum=n_steps)
    except Refused as refused:
        raise InvalidRanking(f"An end of a stretch {refused}.", field="stretches") from None
    return {"from": first, "to": last, "kind": stretch["kind"]}
