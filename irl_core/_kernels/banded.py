"""Direct solves of grids in band form; `inference.path_infinite` has the mathematics.

One grid: M = 1 − W in potentials, by LU, band[s, b + t − s] = M(s, t) with b = cols. Many grids of one shape: K by
LDLᵀ, LANES worlds side by side so that each step is a vector instruction, band[s, k, lane] = K(s, s + k). Eliminating
an M-matrix needs no pivoting, and its pivots are all positive exactly when it is positive definite.
"""

import math

import numpy as np
from numba import njit

from irl_core._kernels.lines import FUSED, GOAL, ON_THE_WAY, WALL, mark_the_way

LANES = 32
_SMALLEST, _LARGEST = 1e-200, 1e200
"""Beyond these z and x are left to the solver in potentials."""


@njit(cache=True, error_model="numpy")
def solve_in_potentials(kind, reward, u, starts, y, x):
    """Solve M y = (1 off the way, 0 on it) and Mᵀ x = starts / y by LU. False if a pivot is not positive."""
    rows, cols = kind.shape
    n = rows * cols
    band = np.zeros((n, 2 * cols + 1))
    for s in range(n):
        _fill_row(kind, reward, u, band, s // cols, s % cols)
    if not _factorise(band, cols):
        return False
    y[:] = 0.0
    for s in range(n):
        y[s] = 0.0 if kind[s // cols, s % cols] == ON_THE_WAY else 1.0
    _solve(band, y, cols)
    for s in range(n):
        x[s] = starts[s] / y[s] if starts[s] > 0.0 else 0.0
    _solve_transposed(band, x, cols)
    return True


@njit(cache=True, error_model="numpy")
def _fill_row(kind, reward, u, band, i, j):
    rows, cols = kind.shape
    s = i * cols + j
    band[s, cols] = 1.0
    if kind[i, j] != ON_THE_WAY:
        return
    for d in range(4):
        k, m = i + (d == 2) - (d == 0), j + (d == 1) - (d == 3)
        if not (0 <= k < rows and 0 <= m < cols) or kind[k, m] == WALL:
            band[s, cols] -= math.exp(reward[i, j])
        else:
            band[s, cols + (k - i) * cols + m - j] -= math.exp(reward[i, j] + u[k, m] - u[i, j])


@njit(cache=True, error_model="numpy")
def _factorise(band, b):
    n = len(band)
    for i in range(n):
        row = band[i]
        for k in range(max(0, i - b), i):
            at = b + k - i
            if row[at] != 0.0:
                row[at] /= band[k, b]
                factor, above = row[at], band[k]
                for j in range(1, b + 1):
                    row[at + j] -= factor * above[b + j]
        if not row[b] > 0.0:
            return False
    return True


@njit(cache=True, error_model="numpy")
def _solve(band, y, b):
    n = len(band)
    for i in range(n):
        for k in range(max(0, i - b), i):
            y[i] -= band[i, b + k - i] * y[k]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, min(i + b + 1, n)):
            y[i] -= band[i, b + k - i] * y[k]
        y[i] /= band[i, b]


@njit(cache=True, error_model="numpy")
def _solve_transposed(band, x, b):
    n = len(band)
    for i in range(n):
        x[i] /= band[i, b]
        for k in range(i + 1, min(i + b + 1, n)):
            x[k] -= band[i, b + k - i] * x[i]
    for i in range(n - 1, -1, -1):
        for k in range(max(0, i - b), i):
            x[k] -= band[i, b + k - i] * x[i]


@njit(cache=True, error_model="numpy")
def mark_each_way(kinds, starts):
    """`mark_the_way` for B grids, (B, rows, cols). One laid out and started as the one before it is copied."""
    stack = np.empty(starts[0].size, dtype=np.int32)
    before = np.empty_like(kinds[0])
    for world in range(len(kinds)):
        if world > 0 and _is_equal(kinds[world], before) and _is_equal(starts[world], starts[world - 1]):
            kinds[world] = kinds[world - 1]
            continue
        before[:] = kinds[world]
        mark_the_way(kinds[world], starts[world], stack)


@njit(cache=True, error_model="numpy")
def _is_equal(one, other):
    for i in range(one.shape[0]):
        for j in range(one.shape[1]):
            if one[i, j] != other[i, j]:
                return False
    return True


@njit(cache=True, error_model="numpy")
def solve_worlds(kinds, pays, inverse, starts, slips, log_partition, policy, visits):
    """Fill the three results of B worlds, (B,), (B, S, 4), (B, S); answers which of them can be trusted, (B,).

    `kinds`, `pays` = e^R, `inverse` = e^{−R} and `starts` are (B, rows, cols). Not trusted: a pivot that is not
    positive, or numbers beyond the range of plain floats.
    """
    n_worlds, rows, cols = kinds.shape
    n = rows * cols
    begun = starts.reshape(n_worlds, n)
    band, z, x = np.zeros((n, cols + 1, LANES)), np.zeros((n, LANES)), np.zeros((n, LANES))
    trusted = np.ones(n_worlds, dtype=np.bool_)
    is_positive = np.ones(LANES, dtype=np.bool_)
    for first in range(0, n_worlds, LANES):
        n_live = min(LANES, n_worlds - first)
        band[:] = 0.0
        for lane in range(LANES):
            world = first + min(lane, n_live - 1)  # the last world fills the lanes left over
            fill_lane(kinds[world], pays[world], inverse[world], band, z, lane)
        factorise_lanes(band, is_positive)
        solve_lanes(band, z)
        for lane in range(n_live):
            world = first + lane
            trusted[world] = is_positive[lane]
            for s in range(n):
                begins = begun[world, s]
                x[s, lane] = 0.0
                if begins > 0.0 and trusted[world]:
                    x[s, lane] = begins / z[s, lane]
        solve_lanes(band, x)
        for lane in range(n_live):
            world = first + lane
            if trusted[world]:
                trusted[world] = _read_lane(
                    kinds[world], pays[world], inverse[world], z, x, lane, policy[world], visits[world], slips[world]
                )
            log_partition[world] = 0.0
            for s in range(n):
                begins = begun[world, s]
                if begins > 0.0 and trusted[world]:
                    log_partition[world] += begins * math.log(z[s, lane])
    return trusted


@njit(cache=True, error_model="numpy")
def fill_lane(kind, pay, inverse, band, z, lane):
    """K into band[:, :, lane], 0 before, and its right-hand side into z: the e^R of goals, and of goals beside."""
    rows, cols = kind.shape
    for i in range(rows):
        for j in range(cols):
            s = i * cols + j
            band[s, 0, lane] = 1.0
            z[s, lane] = pay[i, j] if kind[i, j] == GOAL else 0.0
            if kind[i, j] != ON_THE_WAY:
                continue
            loops = 0
            for d in range(4):
                k, m = i + (d == 2) - (d == 0), j + (d == 1) - (d == 3)
                if not (0 <= k < rows and 0 <= m < cols) or kind[k, m] == WALL:
                    loops += 1
                elif kind[k, m] == GOAL:
                    z[s, lane] += pay[k, m]
                elif d == 1:
                    band[s, 1, lane] -= 1.0
                elif d == 2:
                    band[s, cols, lane] -= 1.0
            band[s, 0, lane] = inverse[i, j] - loops


@njit(cache=True, error_model="numpy", fastmath=FUSED)
def factorise_lanes(band, is_positive):
    """LDLᵀ in place: D in band[:, 0], L beside. A pivot that is not positive is noted for its lane and made 1."""
    n, width, lanes = band.shape
    is_positive[:] = True
    column, factor = np.empty((width, lanes)), np.empty(lanes)
    for j in range(n):
        height = min(width, n - j)
        for lane in range(lanes):
            if not band[j, 0, lane] > 0.0:
                is_positive[lane] = False
                band[j, 0, lane] = 1.0
        for i in range(height):
            for lane in range(lanes):
                column[i, lane] = band[j, i, lane]
        for i in range(1, height):
            below, pivot, of_row = band[j, i], column[0], column[i]
            for lane in range(lanes):
                factor[lane] = of_row[lane] / pivot[lane]
                below[lane] = factor[lane]
            for m in range(i, height):
                reduced, of_column = band[j + i, m - i], column[m]
                for lane in range(lanes):
                    reduced[lane] -= factor[lane] * of_column[lane]


@njit(cache=True, error_model="numpy", fastmath=FUSED)
def solve_lanes(band, x):
    """Solve L D Lᵀ x = x in place, (S, LANES)."""
    n, width, lanes = band.shape
    for j in range(n):
        here = x[j]
        for i in range(1, min(width, n - j)):
            below, factor = x[j + i], band[j, i]
            for lane in range(lanes):
                below[lane] -= factor[lane] * here[lane]
    for j in range(n - 1, -1, -1):
        here, pivot = x[j], band[j, 0]
        for lane in range(lanes):
            here[lane] /= pivot[lane]
        for i in range(1, min(width, n - j)):
            below, factor = x[j + i], band[j, i]
            for lane in range(lanes):
                here[lane] -= factor[lane] * below[lane]


@njit(cache=True, error_model="numpy")
def _read_lane(kind, pay, inverse, z, x, lane, policy, visits, slip):
    """Visits and policy of one world; False if a number left the range in which it keeps its digits."""
    rows, cols = kind.shape
    aside = slip / 3.0
    for s in range(rows * cols):
        visits[s] = 0.0
        policy[s] = 0.25
    for i in range(rows):
        for j in range(cols):
            if kind[i, j] != ON_THE_WAY:
                continue
            s = i * cols + j
            here = z[s, lane]
            if not (_SMALLEST < here < _LARGEST and _SMALLEST < x[s, lane] < _LARGEST):
                return False
            visits[s] = inverse[i, j] * here * x[s, lane]
            share = pay[i, j] / here  # 1 / Σ_d z(s′_d)
            for d in range(4):
                k, m = i + (d == 2) - (d == 0), j + (d == 1) - (d == 3)
                ahead = here
                if 0 <= k < rows and 0 <= m < cols and kind[k, m] != WALL:
                    ahead = z[k * cols + m, lane]
                    if kind[k, m] == GOAL:
                        visits[k * cols + m] += x[s, lane] * ahead
                policy[s, d] = (1.0 - slip - aside) * ahead * share + aside
    return True
