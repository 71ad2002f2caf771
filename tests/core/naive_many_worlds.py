"""Slow, obvious twins of irl_core.many_worlds: counting, enumerating, drawing."""

from itertools import product

import numpy as np


def shared_place(scores, who):
    """1 + how many of those who are there earned more."""
    return 1 + sum(one > scores[who] for one in scores.values())


def sign_test(n_for, n_against):
    """Of all ways a fair coin can fall, the share at least as lopsided as this one."""
    n = n_for + n_against
    apart = abs(n_for - n_against)
    falls = [abs(2 * sum(sides) - n) >= apart for sides in product((0, 1), repeat=n)]
    return sum(falls) / len(falls)


def votes(comparisons, a, b):
    """How many units have more comparisons in which a earned more than b, and how many the other way round."""
    n_for = n_against = 0
    for unit in {one.unit for one in comparisons}:
        theirs = [one.expected for one in comparisons if one.unit == unit and {a, b} <= one.expected.keys()]
        won, lost = sum(one[a] > one[b] for one in theirs), sum(one[a] < one[b] for one in theirs)
        n_for, n_against = n_for + (won > lost), n_against + (won < lost)
    return n_for, n_against


def resampled_share(comparisons, who, rng, n_resamples=2000):
    """The 2.5th and 97.5th percentile of Σ returns / Σ optima, unit by unit drawn with replacement."""
    units = sorted({one.unit for one in comparisons if who in one.expected})
    shares = []
    for _ in range(n_resamples):
        drawn = [units[i] for i in rng.integers(len(units), size=len(units))]
        rows = [one for unit in drawn for one in comparisons if one.unit == unit and who in one.expected]
        shares.append(sum(one.expected[who] for one in rows) / sum(one.optimum for one in rows))
    return np.percentile(shares, [2.5, 97.5])
