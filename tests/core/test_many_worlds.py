"""Many comparisons together: places, pairs, shares and Table I, by hand, by counting, and by their coverage."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from irl_core import LEARNERS
from irl_core.many_worlds import Measured, look_over, proportion, share_of_optimum, sign_test
from irl_core.many_worlds.bootstrap import draw
from irl_core.many_worlds.intervals import wilson
from tests.core import naive_many_worlds as naive

PAPER = ("meirl", "irlr", "irlf", "irlfr")


def drawn(seed):
    return lambda n_units: draw(n_units, seed)


def measured(unit, *, optimum=10.0, **scores):
    """A comparison in which the episodes say what the expectation says."""
    return Measured(unit, optimum, scores, scores)


def test_places_and_pairs_of_three_worlds_by_hand():
    """The human and MEIRL share the second place of the first world, as on the Compare page; IRLR missed the third."""
    seen = look_over(
        [
            measured("a", human=2.0, meirl=2.0, irlr=7.0),
            measured("b", human=1.0, meirl=3.0, irlr=2.0),
            measured("c", human=-5.0, meirl=4.0),
        ]
    )
    assert [one.who for one in seen.standings] == ["human", "meirl", "irlr"]
    assert [[place.count for place in one.places] for one in seen.standings] == [[0, 2, 1], [2, 1], [1, 1]]
    assert [one.n for one in seen.standings] == [3, 3, 2]
    assert seen.standing("meirl").share.value == pytest.approx(9.0 / 30.0)
    assert seen.standing("irlr").share.value == pytest.approx(9.0 / 20.0), "of the worlds it took part in"
    pairs = {(one.a, one.b): (one.n, one.wins, one.losses, one.ties) for one in seen.duels}
    assert pairs == {("human", "meirl"): (3, 0, 2, 1), ("human", "irlr"): (2, 0, 2, 0), ("meirl", "irlr"): (2, 1, 1, 0)}
    assert [one.p_value for one in seen.duels] == [0.5, 0.5, 1.0]
    assert [one.p_adjusted for one in seen.duels] == [1.0, 1.0, 1.0]
    assert seen.table_one is None, "IRLF and IRLFR never took part"


def test_equals_within_rounding_share_a_place():
    seen = look_over([measured(0, human=1.0, meirl=5.0, irlr=5.0 + 1e-12)])
    assert [seen.standing(who).places[0].count for who in ("meirl", "irlr")] == [1, 1]


def test_the_sign_test_by_hand():
    """Conover (1999), Sec. 3.4: 8 of 9 shoppers prefer B, P(X ≤ 1) = 10 / 512."""
    assert sign_test(8, 1) == 20 / 512
    assert sign_test(5, 0) == 2 / 32
    assert sign_test(3, 3) == sign_test(0, 0) == 1.0
    assert sign_test(1, 2000) == pytest.approx(0.0, abs=1e-300)
    assert all(sign_test(a, b) == pytest.approx(naive.sign_test(a, b)) for a in range(7) for b in range(6))


def test_a_proportion_has_wilsons_interval():
    """7 of 10: the roots of (p̂ − p)² = 1.96² p (1 − p) / 10 are 0.3968 and 0.8922."""
    found = proportion([True] * 7 + [False] * 3, range(10))
    assert (found.count, found.of) == (7, 10)
    assert (found.low, found.high) == pytest.approx((0.3968, 0.8922), abs=5e-5)
    assert proportion([True] * 4, range(4)).high == 1.0
    assert proportion([True] * 4, range(4)).low == pytest.approx(4 / (4 + 1.959963984540054**2))


def test_below_three_units_there_is_no_interval():
    assert math.isnan(proportion([True, False, True, True], [0, 0, 1, 1]).low)
    assert math.isnan(share_of_optimum(np.ones(4), np.full(4, 5.0), [0, 0, 1, 1], counts=drawn(0)).low)
    assert proportion([True, False, True], [0, 1, 2]).low > 0.0


def test_people_who_are_all_of_a_piece_count_once():
    """Four comparisons each of 10 people, all four alike: as much is known as from 10 comparisons."""
    shows = [person < 7 for person in range(10) for _ in range(4)]
    units = [person for person in range(10) for _ in range(4)]
    clustered = proportion(shows, units)
    assert (clustered.count, clustered.of) == (28, 40)
    assert (clustered.low, clustered.high) == pytest.approx(wilson(0.7, 10), abs=1e-12)
    assert proportion([True] * 40, units).low == pytest.approx(wilson(1.0, 10)[0])


def test_a_person_votes_once_however_many_worlds_they_played():
    """Ann played five worlds and IRLR won all; Ben and Cem one each, MEIRL won: 1 vote to 2, not 5 wins to 2."""
    rows = [measured("ann", meirl=1.0, irlr=2.0)] * 5
    rows += [measured(name, meirl=2.0, irlr=1.0) for name in ("ben", "cem")]
    [duel] = look_over(rows).duels
    assert (duel.n, duel.wins, duel.losses, duel.units_for, duel.units_against) == (7, 2, 5, 2, 1)
    assert duel.p_value == 1.0


def test_a_share_of_few_worlds_has_students_interval():
    """Optima 10 each, returns 4, 6, 8: r = 0.6, residuals −2, 0, 2, s = √(3/2 · 8) / 30 = 0.11547, t(2) = 4.3027."""
    found = share_of_optimum(np.array([4.0, 6.0, 8.0]), np.full(3, 10.0), [0, 1, 2], counts=drawn(0))
    assert found.method == "t"
    assert (found.value, found.low, found.high) == pytest.approx((0.6, 0.6 - 0.49684, 0.6 + 0.49684), abs=1e-4)
    assert math.isnan(share_of_optimum(np.ones(3), np.zeros(3), [0, 1, 2], counts=drawn(0)).value), (
        "nothing could be won"
    )


def test_a_share_of_many_people_is_resampled_by_people():
    """People differ and their worlds do not: drawing rows instead would make the interval half as wide."""
    rng = np.random.default_rng(4)
    skill = rng.normal(5.0, 2.0, 30)
    rows = [measured(person, irlfr=float(skill[person]), optimum=9.0) for person in range(30) for _ in range(4)]
    share = look_over(rows, seed=1).standing("irlfr").share
    assert share.method == "bootstrap"
    assert (share.low, share.high) == pytest.approx(naive.resampled_share(rows, "irlfr", rng), abs=0.01)
    as_rows = share_of_optimum(np.repeat(skill, 4), np.full(120, 9.0), range(120), counts=drawn(1))
    assert share.high - share.low > 1.8 * (as_rows.high - as_rows.low)


@pytest.mark.parametrize("n_people", [6, 25])
def test_intervals_of_people_cover_what_they_should(n_people):
    """Three worlds each, alike within a person: about 95 of 100 samples have the truth, 0.5, within both intervals."""
    rng = np.random.default_rng(2)
    units = np.repeat(np.arange(n_people), 3)
    shares, oftens = 0, 0
    for sample in range(100):
        earned = np.repeat(rng.normal(5.0, 2.0, n_people), 3) + rng.normal(0.0, 0.5, 3 * n_people)
        share = share_of_optimum(earned, np.full(3 * n_people, 10.0), units.tolist(), counts=drawn(sample))
        often = proportion((earned > 5.0).tolist(), units.tolist())
        shares += share.low <= 0.5 <= share.high
        oftens += often.low <= 0.5 <= often.high
    assert 89 <= shares <= 100
    assert 89 <= oftens <= 100


def test_of_too_few_units_nothing_is_told():
    """IRLR took part in two units and IRLFR in three, who met MEIRL in three and IRLF in two."""
    rows = [measured(k, meirl=1.0, irlfr=2.0, **({"irlr": 3.0} if k < 2 else {})) for k in (0, 1, 2, 2)]
    rows += [measured(k, irlf=1.0, **({"irlfr": 2.0} if k < 3 else {})) for k in (1, 2, 3)]
    seen = look_over(rows, least_units=3)
    assert seen.left_out == ("irlr",)
    assert [(one.a, one.b) for one in seen.duels] == [("meirl", "irlfr")]
    assert seen.standing("irlfr").places[0].count == 6, "places are among those who are told of"


def test_table_one_counts_only_comparisons_with_all_of_the_papers_learners():
    full = {"human": 0.0, "meirl": 1.0, "irlr": 4.0, "irlf": 2.0, "irlfr": 4.0}
    rows = [
        measured(0, **full),
        measured(1, **(full | {"meirl": -1.0, "birlfr": 9.0})),
        measured(2, meirl=1.0, irlr=2.0),
    ]
    table = look_over(rows).table_one
    assert table is not None
    assert (table.n, table.below_all.count) == (2, 1)
    assert [[place.count for place in row.placed] for row in table.rows] == [
        [0, 0, 0, 2],
        [2, 0, 0, 0],
        [0, 0, 2, 0],
        [2, 0, 0, 0],
    ], "IRLR and IRLFR share the first place; Bayesian IRLFR has no place in the paper's table"
    assert table.rows[3].beaten == {"meirl": 2, "irlr": 0, "irlf": 2}


SCORES = st.dictionaries(st.sampled_from(["human", *PAPER, "birlfr"]), st.integers(-4, 8).map(float), min_size=1)
ROWS = st.lists(st.builds(lambda unit, scores: measured(unit, **scores), st.integers(0, 4), SCORES), min_size=1)


@given(ROWS)
@settings(max_examples=40)
def test_places_votes_and_pairs_agree_with_counting(rows):
    seen = look_over(rows)
    for one in seen.standings:
        came = [naive.shared_place(row.expected, one.who) for row in rows if one.who in row.expected]
        assert [place.count for place in one.places] == [came.count(place) for place in range(1, max(came) + 1)]
        assert all(place.of == one.n == len(came) for place in one.places)
        assert all(math.isnan(place.low) or place.low <= place.count / place.of <= place.high for place in one.places)
    for duel in seen.duels:
        both = [row.expected for row in rows if {duel.a, duel.b} <= row.expected.keys()]
        assert duel.n == len(both) > 0
        assert duel.wins == sum(row[duel.a] > row[duel.b] for row in both)
        assert (duel.units_for, duel.units_against) == naive.votes(rows, duel.a, duel.b)
        assert duel.p_adjusted >= duel.p_value


@given(ROWS, st.randoms())
@settings(max_examples=25)
def test_the_order_of_comparisons_changes_no_count(rows, random):
    shuffled = list(rows)
    random.shuffle(shuffled)
    one, other = look_over(rows), look_over(shuffled)
    assert [[place.count for place in who.places] for who in one.standings] == [
        [place.count for place in who.places] for who in other.standings
    ]
    assert one.duels == other.duels


def test_nothing_says_nothing_and_strangers_come_last():
    assert look_over([]).standings == ()
    assert [one.who for one in look_over([measured(0, zeta=1.0, alpha=2.0, irlfr=1.0, human=0.0)]).standings] == [
        *("human", "irlfr", "alpha", "zeta")
    ]
    assert set(PAPER) <= set(LEARNERS)
