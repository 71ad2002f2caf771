"""Means with intervals, and tests on pairs of episodes."""

import math

import numpy as np
import pytest
from scipy import stats

from irl_core.paired import MOST_SIGNS, holm, mean_of, paired_tests, t_quantile
from tests import recomputed


@pytest.mark.parametrize("degrees", [1, 2, 3, 4, 5, 10, 49, 199, 1000])
def test_the_quantile_is_students(degrees):
    assert t_quantile(degrees) == pytest.approx(stats.t.ppf(0.975, degrees), rel=1e-12)


def test_the_interval_of_a_mean_is_that_of_the_t_test():
    totals = np.random.default_rng(1).normal(3.0, 2.0, 50)
    found = mean_of(totals)
    low, high = stats.ttest_1samp(totals, 0.0).confidence_interval(0.95)
    assert (found.low, found.high) == pytest.approx((low, high), rel=1e-12)
    assert found.standard_error == pytest.approx(stats.sem(totals), rel=1e-12)


def test_by_hand_three_differences_of_one_sign_have_a_p_value_of_a_quarter():
    """Of the eight ways to sign 1, 2, 3 only +++ and −−− reach 6."""
    [test] = paired_tests({"a": [2.0, 3.0, 4.0], "b": [1.0, 1.0, 1.0]}, rng=np.random.default_rng(0))
    assert (test.mean_difference, test.p_value) == (2.0, 0.25)


def test_episodes_that_end_alike_say_nothing():
    """Forty of fifty differences are 0: what is tried is the ten, all 1,024 ways."""
    [test] = paired_tests({"a": 10 * [1.0] + 40 * [0.0], "b": 50 * [0.0]}, rng=np.random.default_rng(0))
    assert test.p_value == 2 / 2**10


def test_drawn_signs_agree_with_loops_and_nearly_with_all_signs():
    rng = np.random.default_rng(4)
    a, b = rng.normal(0.9, 1.0, 14), rng.normal(0.5, 1.0, 14)
    [test] = paired_tests({"a": a.tolist(), "b": b.tolist()}, rng=np.random.default_rng(9))
    draws = np.random.default_rng(9).random((MOST_SIGNS, 14))
    flips = [np.flatnonzero(row < 0.5).tolist() for row in draws]
    assert test.p_value == recomputed.p_value((a - b).tolist(), flips)
    exact = stats.permutation_test((a, b), lambda x, y: np.mean(x - y), permutation_type="samples", n_resamples=2**14)
    assert test.p_value == pytest.approx(exact.pvalue, abs=0.02)


def test_a_real_difference_is_never_certain_by_drawing():
    """The least p-value that draws can give is one in ten thousand, not 0."""
    [test] = paired_tests({"a": 50 * [9.0], "b": 50 * [0.0]}, rng=np.random.default_rng(0))
    assert test.p_value == 1 / (1 + MOST_SIGNS)
    assert (test.low, test.high) == (9.0, 9.0)


def test_holm_by_hand():
    assert holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])
    assert holm([0.5, 0.9]) == [1.0, 1.0]
    assert holm([]) == []


def test_everybody_is_paired_once_and_one_alone_with_nobody():
    totals = {name: [float(k), 1.0] for k, name in enumerate("abc")}
    tests = paired_tests(totals, rng=np.random.default_rng(0))
    assert [(test.a, test.b) for test in tests] == [("a", "b"), ("a", "c"), ("b", "c")]
    assert all(math.isfinite(test.p_adjusted) and test.p_adjusted >= test.p_value for test in tests)
    assert paired_tests({"a": [1.0]}, rng=np.random.default_rng(0)) == ()


def test_one_episode_has_a_difference_and_no_interval():
    [test] = paired_tests({"a": [2.0], "b": [1.0]}, rng=np.random.default_rng(0))
    assert (test.mean_difference, test.low, test.high, test.p_value) == (1.0, None, None, 1.0)
