"""Path weights over a compressed sparse row matrix, each kept as mantissa · 2^exponent.

A weight with an exponent of its own neither overflows nor underflows, whatever the rewards and the number of steps, and
adding some up costs a shift where logarithms would cost an exponential. Terms more than 2^100 below the largest of a
sum change no bit of it and are left out. Rows and entries are added up in their order.
"""

import math

import numpy as np
from numba import njit

_N_SHIFTS = 100


@njit(cache=True)
def backward(indptr, indices, weights, factor, factor_exponent, z, exponent):
    """Fill rows 1 … of z and exponent, (n + 1, S), from row 0: Z_n(s) = f(s) Σ W(s, s′) Z_{n−1}(s′).

    f = factor · 2^factor_exponent, (S,). A row of W without entries keeps its weight: Z_n(s) = Z_{n−1}(s).
    """
    shifts = 0.5 ** np.arange(_N_SHIFTS)
    n_states = len(factor)
    for n in range(1, len(z)):
        before, scale = z[n - 1], exponent[n - 1]  # sliced once: in the inner loop it would cost tenfold
        for s in range(n_states):
            first, last = indptr[s], indptr[s + 1]
            if first == last:
                z[n, s], exponent[n, s] = before[s], scale[s]
                continue
            top = _top(indices, before, scale, first, last)
            total = 0.0
            for entry in range(first, last):
                ahead = indices[entry]
                shift = top - scale[ahead]
                if shift < _N_SHIFTS and before[ahead] > 0.0:
                    total += weights[entry] * before[ahead] * shifts[shift]
            mantissa, grown = math.frexp(total * factor[s])
            z[n, s] = mantissa
            exponent[n, s] = top + grown + factor_exponent[s] if mantissa > 0.0 else 0


@njit(cache=True)
def forward(indptr, indices, weights, z, exponent, here, visits):
    """Add to visits the states of the next n steps, and leave in `here`, (S,), where they lead.

    With k = n, …, 1 steps to go the move s → s′ has the chance W(s, s′) Z_{k−1}(s′) / Σ; z and exponent are (n + 1, S).
    """
    shifts = 0.5 ** np.arange(_N_SHIFTS)
    n_states = len(here)
    after = np.empty(n_states)
    for k in range(len(z) - 2, -1, -1):
        later, scale = z[k], exponent[k]
        after[:] = 0.0
        for s in range(n_states):
            first, last = indptr[s], indptr[s + 1]
            if here[s] == 0.0 or first == last:
                continue
            top = _top(indices, later, scale, first, last)
            total = 0.0
            for entry in range(first, last):
                ahead = indices[entry]
                shift = top - scale[ahead]
                if shift < _N_SHIFTS and later[ahead] > 0.0:
                    total += weights[entry] * later[ahead] * shifts[shift]
            if total == 0.0:
                continue
            share = here[s] / total
            for entry in range(first, last):
                ahead = indices[entry]
                shift = top - scale[ahead]
                if shift < _N_SHIFTS and later[ahead] > 0.0:
                    after[ahead] += share * weights[entry] * later[ahead] * shifts[shift]
        for s in range(n_states):
            here[s] = after[s]
            visits[s] += after[s]


@njit(cache=True)
def _top(indices, z, exponent, first, last):
    """The largest exponent among the successors that have any weight; 0 if none has."""
    top, found = 0, False
    for entry in range(first, last):
        ahead = indices[entry]
        if z[ahead] > 0.0 and (not found or exponent[ahead] > top):
            top, found = exponent[ahead], True
    return top
