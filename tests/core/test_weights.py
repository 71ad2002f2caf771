"""Rank weights and feature counts."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from irl_core import InvalidRanking, Ranking, feature_counts, rank_weights, simulate, uniform_weights
from tests.core.examples import DOWN, RIGHT, UP, make_world

ORDERS = st.lists(st.integers(1, 4), max_size=8).map(
    lambda sizes: [[f"{k}-{j}" for j in range(size)] for k, size in enumerate(sizes)]
)


def test_by_hand_three_in_a_row_weigh_a_half_a_third_and_a_sixth():
    assert rank_weights([["a"], ["b"], ["c"]]) == pytest.approx({"a": 1 / 2, "b": 1 / 3, "c": 1 / 6})


def test_by_hand_ties_share_the_mean():
    assert rank_weights([["a", "b"], ["c"]]) == pytest.approx({"a": 5 / 12, "b": 5 / 12, "c": 1 / 6})
    assert rank_weights([["a", "b", "c", "d"]]) == pytest.approx(uniform_weights("abcd"))
    assert rank_weights([]) == uniform_weights([]) == {}


@given(ORDERS)
def test_weights_sum_to_one_and_fall_from_group_to_group(groups):
    weights = rank_weights(groups)
    assert sum(weights.values()) == pytest.approx(1.0 if groups else 0.0)
    heads = [weights[group[0]] for group in groups]
    assert heads == sorted(heads, reverse=True)
    assert len(set(heads)) == len(heads)
    assert all(len({weights[id_] for id_ in group}) == 1 for group in groups)


@pytest.mark.parametrize("groups", [[["a"], ["a"]], [["a", "a"]], [[]], [[1]], ["ab"], "ab", None, [None], [["a"], 3]])
def test_what_is_no_order_is_refused(groups):
    with pytest.raises(InvalidRanking) as refusal:
        rank_weights(groups)
    assert refusal.value.field == "order"


def test_a_ranking_is_of_successes_or_failures():
    with pytest.raises(InvalidRanking, match='"success" or "failure"'):
        Ranking("wins", (("a",),))  # type: ignore[arg-type]
    assert Ranking("success", (("a", "b"), ("c",))).ids == ("a", "b", "c")


def test_by_hand_feature_counts_are_sums_over_time_with_start_and_goal():
    world = make_world(2, 2)
    short = simulate(world, [RIGHT, DOWN], attempt_id="short")
    long = simulate(world, [UP, UP, RIGHT, DOWN], attempt_id="long")
    counts = feature_counts(world, [short, long], {"short": 0.75, "long": 0.25})
    np.testing.assert_allclose(counts, [0.75 + 3 * 0.25, 1, 0, 1])
    np.testing.assert_array_equal(counts, feature_counts(world, [long, short], {"short": 0.75, "long": 0.25}))
