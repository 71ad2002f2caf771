"""Distances and marked stretches, and what follows from them; the page's JavaScript keeps to the same vectors."""

import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from irl_core import InvalidRanking
from irl_core.preferences.gaps import positions_from_gaps, said_gaps
from irl_core.preferences.stretches import order_from_stretches, score_of_stretches

VECTORS = json.loads(Path(__file__).with_name("gap_and_stretch_vectors.json").read_text(encoding="utf-8"))
GOOD = {"from": 1, "to": 2, "kind": "good"}


@pytest.mark.parametrize("vector", VECTORS["gaps"], ids=lambda vector: vector["what"])
def test_gaps_stand_where_the_vectors_say(vector):
    assert said_gaps(vector["order"], vector["gaps"]) == tuple(vector["said"])
    if vector["positions"] is None:
        with pytest.raises(InvalidRanking, match="Nothing was said of the gap right below"):
            positions_from_gaps(vector["order"], vector["gaps"])
    else:
        positions = positions_from_gaps(vector["order"], vector["gaps"])
        assert positions == vector["positions"]
        assert list(positions) == [id_ for group in vector["order"] for id_ in group]


@pytest.mark.parametrize("vector", VECTORS["stretches"], ids=lambda vector: vector["what"])
def test_stretches_give_the_scores_and_the_order_of_the_vectors(vector):
    steps, stretches = vector["steps"], vector["stretches"]
    scores = {id_: score_of_stretches(stretches.get(id_, []), n) for id_, n in steps.items()}
    assert scores == vector["scores"]
    order = order_from_stretches(stretches, steps, outcome=vector["outcome"])
    assert order == tuple(map(tuple, vector["order"]))


@given(st.lists(st.integers(1, 100), min_size=1, max_size=12))
def test_neighbours_stand_as_far_apart_as_was_said(values):
    order = [[f"{k}"] for k in range(len(values) + 1)]
    gaps: list[Any] = [{"above": f"{k}", "below": f"{k + 1}", "value": value} for k, value in enumerate(values)]
    positions = list(positions_from_gaps(order, gaps).values())
    assert [high - low for high, low in pairwise(positions)] == values
    assert positions[-1] == 0


@given(st.lists(st.sampled_from(["good", "bad", None]), min_size=1, max_size=30))
def test_a_score_is_the_share_of_good_steps_less_the_share_of_bad_ones(kinds):
    stretches: list[Any] = [{"from": k, "to": k, "kind": kind} for k, kind in enumerate(kinds, 1) if kind]
    balance = kinds.count("good") - kinds.count("bad")
    assert score_of_stretches(stretches, len(kinds)) == balance / len(kinds)


@given(st.dictionaries(st.text("abcdef", min_size=1), st.lists(st.sampled_from(["good", "bad", None]), max_size=9)))
def test_the_worst_failures_stand_where_the_best_successes_would(marked):
    steps = {id_: len(kinds) for id_, kinds in marked.items()}
    stretches: dict[str, list[Any]] = {
        id_: [{"from": k, "to": k, "kind": kind} for k, kind in enumerate(kinds, 1) if kind]
        for id_, kinds in marked.items()
    }
    best_first = order_from_stretches(stretches, steps, outcome="success")
    assert order_from_stretches(stretches, steps, outcome="failure") == tuple(reversed(best_first))
    assert sorted(id_ for group in best_first for id_ in group) == sorted(steps)


@pytest.mark.parametrize(
    "gap",
    [
        {"above": "a", "below": "b", "value": 0},
        {"above": "a", "below": "b", "value": 101},
        {"above": "a", "below": "b", "value": None},
        {"above": "a", "below": "b", "value": 2.5},
        {"above": "a", "value": 5},
        {"above": 1, "below": "b", "value": 5},
        "ab",
    ],
)
def test_what_is_no_gap_is_refused(gap):
    with pytest.raises(InvalidRanking) as refusal:
        said_gaps([["a"], ["b"]], [gap])
    assert refusal.value.field == "gaps"


@pytest.mark.parametrize(
    "stretches",
    [
        [{"from": 0, "to": 1, "kind": "good"}],
        [{"from": 2, "to": 1, "kind": "good"}],
        [{"from": 1, "to": 4, "kind": "good"}],
        [{"from": 1, "to": 2, "kind": "fine"}],
        [{"from": 1, "to": 2, "kind": ["good"]}],
        [{"from": 1, "kind": "good"}],
        [GOOD, {"from": 2, "to": 3, "kind": "bad"}],
        ["good"],
        None,
    ],
)
def test_what_is_no_stretch_of_three_steps_is_refused(stretches):
    with pytest.raises(InvalidRanking) as refusal:
        score_of_stretches(stretches, 3)
    assert refusal.value.field == "stretches"


@pytest.mark.parametrize("steps", [-1, 2.5, None, True])
def test_an_attempt_has_a_whole_number_of_steps(steps):
    with pytest.raises(InvalidRanking) as refusal:
        order_from_stretches({}, {"a": steps}, outcome="success")
    assert refusal.value.field == "n_steps"


def test_an_order_is_of_successes_or_failures():
    with pytest.raises(InvalidRanking, match='"success" or "failure"'):
        order_from_stretches({}, {"a": 3}, outcome="wins")  # type: ignore[arg-type]  # what the test is about
