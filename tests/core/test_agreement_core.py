"""How far an order agrees with true values, against a naive twin and SciPy; ranks and indices."""

from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import kendalltau

from irl_core import InvalidRanking, agreement_of, display_ranks, paper_index, rank_weights

THINGS = st.lists(st.tuples(st.integers(0, 4), st.integers(-3, 3)), max_size=9)
"""A place (the same one for a tie) and a true value of each thing."""


def groups_of(things):
    """The order in which the things stand by their places."""
    places = sorted({place for place, _ in things})
    return [[str(n) for n, (at, _) in enumerate(things) if at == place] for place in places]


def values_of(things):
    return {str(n): value for n, (_, value) in enumerate(things)}


def naive(things):
    """Pairs one by one: how many agree, are swapped, are tied in either."""
    counts = {"agreeing": 0, "swapped": 0, "tied": 0}
    for (place, value), (other_place, other_value) in combinations(things, 2):
        sign = (other_place - place) * (value - other_value)
        counts["agreeing" if sign > 0 else "swapped" if sign < 0 else "tied"] += 1
    return counts


def test_by_hand_two_of_six_pairs_are_swapped_and_one_is_tied():
    # a | b c | d with a = 3, b = 5, c = 1, d = 2. Agreeing: a-c, a-d, b-d. Swapped: a-b (by 2), c-d (by 1). Tied: b-c.
    # n₀ = 6, n₁ = 1, n₂ = 0: τ_b = (3 − 2) / √(5 · 6)
    found = agreement_of([["a"], ["b", "c"], ["d"]], {"a": 3, "b": 5, "c": 1, "d": 2})
    assert found.tau_b == pytest.approx(1 / 30**0.5)
    assert (found.n_pairs, found.n_agreeing, found.n_swapped, found.n_tied) == (6, 3, 2, 1)
    assert found.swapped == (("a", "b"), ("c", "d"))


def test_an_order_like_its_values_agrees_fully_and_one_upside_down_not_at_all():
    values = {"a": 3.5, "b": 2.0, "c": 2.0, "d": -1.0}
    assert agreement_of([["a"], ["b", "c"], ["d"]], values).tau_b == 1.0
    assert agreement_of([["d"], ["c", "b"], ["a"]], values).tau_b == -1.0


def test_failures_stand_worst_first():
    totals = {"worst": -30.0, "bad": -20.0, "hardly": -1.0}
    found = agreement_of([["worst"], ["hardly"], ["bad"]], totals, lowest_first=True)
    assert found.swapped == (("hardly", "bad"),)
    assert agreement_of([["worst"], ["bad"], ["hardly"]], totals, lowest_first=True).tau_b == 1.0


@pytest.mark.parametrize(
    ("groups", "values"),
    [
        ([], {}),
        ([["a"]], {"a": 1}),
        ([["a", "b", "c"]], {"a": 1, "b": 2, "c": 3}),
        ([["a"], ["b"], ["c"]], {"a": 7, "b": 7, "c": 7}),
        ([["a", "b"]], {"a": 7, "b": 7}),
    ],
)
def test_where_nothing_can_be_told_apart_there_is_no_coefficient(groups, values):
    found = agreement_of(groups, values)
    assert found.tau_b is None
    assert found.n_tied == found.n_pairs
    assert found.swapped == ()


@given(THINGS)
def test_it_counts_pairs_like_a_naive_twin_and_is_scipys_coefficient(things):
    found, counted = agreement_of(groups_of(things), values_of(things)), naive(things)
    assert (found.n_agreeing, found.n_swapped, found.n_tied) == tuple(counted.values())
    assert found.n_pairs == len(things) * (len(things) - 1) // 2
    places, values = [-place for place, _ in things], [value for _, value in things]
    if len(set(places)) > 1 and len(set(values)) > 1:
        assert found.tau_b is not None
        assert found.tau_b == pytest.approx(kendalltau(places, values, variant="b").statistic, abs=1e-12)
        assert -1 <= found.tau_b <= 1
    else:
        assert found.tau_b is None


@given(THINGS)
def test_swapped_pairs_are_named_from_the_worst_difference(things):
    values = values_of(things)
    swapped = agreement_of(groups_of(things), values).swapped
    differences = [values[below] - values[above] for above, below in swapped]
    assert all(difference > 0 for difference in differences)
    assert differences == sorted(differences, reverse=True)
    assert len(set(map(frozenset, swapped))) == len(swapped)


@given(THINGS)
def test_negated_values_are_the_lowest_first(things):
    values = values_of(things)
    negated = {id_: -value for id_, value in values.items()}
    assert agreement_of(groups_of(things), values) == agreement_of(groups_of(things), negated, lowest_first=True)


@pytest.mark.parametrize("values", [{}, {"a": 1}, {"a": 1, "b": None}, {"a": 1, "b": float("nan")}, None, [1, 2]])
def test_a_value_that_is_missing_or_no_number_is_refused(values):
    with pytest.raises(InvalidRanking) as refusal:
        agreement_of([["a"], ["b"]], values)
    assert refusal.value.field == "values"


def test_values_of_other_things_do_no_harm():
    assert agreement_of([["a"], ["b"]], {"a": 2, "b": 1, "elsewhere": 9}).tau_b == 1.0


@pytest.mark.parametrize("groups", [[["a"], ["a"]], [[]], "ab", None])
def test_what_is_no_order_is_refused(groups):
    for ask in (display_ranks, paper_index, lambda order: agreement_of(order, {"a": 1})):
        with pytest.raises(InvalidRanking) as refusal:
            ask(groups)
        assert refusal.value.field == "order"


def test_by_hand_people_count_from_the_top_and_the_paper_from_the_bottom():
    groups = [["a"], ["b", "c"], ["d"]]
    assert display_ranks(groups) == {"a": 1, "b": 2, "c": 2, "d": 4}
    assert paper_index(groups) == {"a": 4, "b": 2.5, "c": 2.5, "d": 1}
    assert display_ranks([]) == paper_index([]) == {}


@given(THINGS)
def test_rank_and_index_map_as_the_codebook_says(things):
    groups = groups_of(things)
    ranks, indices, weights, n = display_ranks(groups), paper_index(groups), rank_weights(groups), len(things)
    for group in groups:
        for id_ in group:
            assert indices[id_] == n + 1 - ranks[id_] - (len(group) - 1) / 2
            assert weights[id_] == pytest.approx(2 * indices[id_] / (n * (n + 1)), rel=1e-15)
    places = [place for place, _ in enumerate((id_ for group in groups for id_ in group), start=1)]
    assert sum(indices.values()) == sum(places)
