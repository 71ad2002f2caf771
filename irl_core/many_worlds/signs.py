"""The sign test.

Of n units that are not tied, k speak for one side. If both sides were equally likely, k were Binomial(n, ½); the
p-value is twice the smaller tail, at most 1 (Conover 1999, Sec. 3.4). A unit is what is independent: a world of one
person's, or a person, who speaks once, by the sign of their wins less their losses, however many worlds they played.
"""

import math
from fractions import Fraction


def sign_test(n_for: int, n_against: int) -> float:
    """The two-sided p-value; 1 where nobody speaks for either side."""
    n = n_for + n_against
    tail: int = sum(math.comb(n, k) for k in range(min(n_for, n_against) + 1))
    return min(1.0, float(Fraction(2 * tail, 2**n)))  # exact until here: 2^n is no float from n = 1024 on
