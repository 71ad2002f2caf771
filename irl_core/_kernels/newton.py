"""Newton's method for maximum-entropy fits, LANES worlds side by side; `irl_core.maxent` has the mathematics.

Arrays are [square, lane]. `law` has the five moves of the path measure, [square, UP … STAY, lane]; the Newton matrix is
banded with 2 · cols, band[s, k, lane] = A(s, s + k).
"""

import math

import numpy as np
from numba import njit

from irl_core._kernels.banded import LANES, factorise_lanes, fill_lane, solve_lanes
from irl_core._kernels.lines import GOAL, ON_THE_WAY, WALL

_STAY = 4
_ARMIJO, _SHRINK = 0.4, 0.3
"""A strict test and large reductions keep off the barrier, from where Newton only doubles its distance at each step."""

_SLACK = 1e-13
"""Near the minimum the objective no longer tells two points apart; a step may raise it by this share."""

_SMALLEST_STEP = 1e-10


@njit(cache=True, error_model="numpy")
def fit_worlds(kinds, counts, starts, first_weight, l2, tolerance, max_iterations, weights, iterations, gaps, values):
    """Fill weights (B, S), iterations, gaps and log-likelihoods (B,). `kinds`, `counts`, `starts`: (B, rows, cols)."""
    n_worlds, rows, cols = kinds.shape
    n = rows * cols
    observed, begun = counts.reshape(n_worlds, n), starts.reshape(n_worlds, n)
    band, wide = np.zeros((n, cols + 1, LANES)), np.zeros((n, 2 * cols + 1, LANES))
    z, x, visits = np.zeros((n, LANES)), np.zeros((n, LANES)), np.zeros((n, LANES))
    law, gradient = np.zeros((n, 5, LANES)), np.zeros((n, LANES))
    tried, step = np.zeros((n, LANES)), np.zeros((n, LANES))
    is_positive, is_open = np.ones(LANES, dtype=np.bool_), np.ones(LANES, dtype=np.bool_)
    is_better = np.ones(LANES, dtype=np.bool_)
    best, slope, size = np.zeros(LANES), np.zeros(LANES), np.zeros(LANES)
    for first in range(0, n_worlds, LANES):
        n_live = min(LANES, n_worlds - first)
        for lane in range(LANES):
            world = first + min(lane, n_live - 1)
            is_open[lane] = lane < n_live
            best[lane], slope[lane], size[lane] = np.inf, 0.0, 0.0
            for s in range(n):
                on_the_way = kinds[world, s // cols, s % cols] == ON_THE_WAY
                tried[s, lane] = first_weight if on_the_way else 0.0
                step[s, lane] = 0.0
        while is_open.any():
            band[:] = 0.0
            for lane in range(n_live):
                world = first + lane
                _prepare_lane(kinds[world], tried, band, z, lane)
            factorise_lanes(band, is_positive)
            solve_lanes(band, z)
            for lane in range(n_live):
                _adjoint_source(begun[first + lane], z, x, is_positive, lane)
            solve_lanes(band, x)
            for lane in range(n_live):
                world = first + lane
                is_better[lane] = False
                if not is_open[lane]:
                    continue
                value = np.inf
                if is_positive[lane]:
                    value = _value(observed[world], begun[world], tried, z, l2, lane)
                bound = best[lane] + _ARMIJO * size[lane] * slope[lane] + _SLACK * (1.0 + abs(best[lane]))
                if value <= bound or (best[lane] == np.inf and value < np.inf):
                    is_better[lane] = True
                    best[lane] = value
                    _visits_and_law(kinds[world], tried, z, x, visits, law, lane)
                    gap = _gradient(observed[world], tried, visits, l2, gradient, lane)
                    for s in range(n):
                        weights[world, s] = tried[s, lane]
                    gaps[world] = gap
                    values[world] = value
                    is_open[lane] = gap > tolerance and iterations[world] < max_iterations
                else:
                    size[lane] *= _SHRINK
                    is_open[lane] = size[lane] > _SMALLEST_STEP
            if not is_open.any():
                break
            _newton_matrix(visits, law, l2, cols, wide, n_live)
            for lane in range(n_live):
                if is_better[lane] and is_open[lane]:
                    _newton_source(gradient, law, cols, x, lane)
            factorise_lanes(wide, is_positive)
            solve_lanes(wide, x)
            for lane in range(n_live):
                world = first + lane
                if not is_open[lane]:
                    continue
                if is_better[lane]:
                    slope[lane] = _newton_step(gradient, law, cols, x, step, lane)
                    size[lane] = 1.0
                    iterations[world] += 1
                for s in range(n):
                    tried[s, lane] = weights[world, s] + size[lane] * step[s, lane]


@njit(cache=True, error_model="numpy")
def _prepare_lane(kind, tried, band, z, lane):
    rows, cols = kind.shape
    pay, inverse = np.empty((rows, cols)), np.empty((rows, cols))
    for i in range(rows):
        for j in range(cols):
            w = tried[i * cols + j, lane]
            pay[i, j], inverse[i, j] = math.exp(w), math.exp(-w)
    fill_lane(kind, pay, inverse, band, z, lane)


@njit(cache=True, error_model="numpy")
def _adjoint_source(starts, z, x, is_positive, lane):
    for s in range(len(z)):
        begins = starts[s]
        x[s, lane] = begins / z[s, lane] if begins > 0.0 and is_positive[lane] else 0.0


@njit(cache=True, error_model="numpy")
def _value(counts, starts, tried, z, l2, lane):
    """Σ ρ_0 log z − w·μ̃ + l2/2 |w|²; infinite where numbers left the floats."""
    value = 0.0
    for s in range(len(z)):
        begins, w = starts[s], tried[s, lane]
        if begins > 0.0:
            value += begins * math.log(z[s, lane]) if z[s, lane] > 0.0 else np.inf
        value += 0.5 * l2 * w * w - counts[s] * w
    return value if not np.isnan(value) else np.inf


@njit(cache=True, error_model="numpy")
def _visits_and_law(kind, tried, z, x, visits, law, lane):
    """Visits μ, and the chance of each of the moves UP, RIGHT, DOWN, LEFT, STAY from each square."""
    rows, cols = kind.shape
    for s in range(rows * cols):
        visits[s, lane] = 0.0
        for d in range(5):
            law[s, d, lane] = 0.0
    for i in range(rows):
        for j in range(cols):
            if kind[i, j] != ON_THE_WAY:
                continue
            s = i * cols + j
            visits[s, lane] = math.exp(-tried[s, lane]) * z[s, lane] * x[s, lane]
            share = math.exp(tried[s, lane]) / z[s, lane]
            for d in range(4):
                k, m = i + (d == 2) - (d == 0), j + (d == 1) - (d == 3)
                if not (0 <= k < rows and 0 <= m < cols) or kind[k, m] == WALL:
                    law[s, _STAY, lane] += share * z[s, lane]
                    continue
                law[s, d, lane] = share * z[k * cols + m, lane]
                if kind[k, m] == GOAL:
                    visits[k * cols + m, lane] += x[s, lane] * z[k * cols + m, lane]


@njit(cache=True, error_model="numpy")
def _gradient(counts, tried, visits, l2, gradient, lane):
    """Fill g = μ − μ̃ + l2 w; answers ‖g‖∞."""
    gap = 0.0
    for s in range(len(visits)):
        gradient[s, lane] = visits[s, lane] - counts[s] + l2 * tried[s, lane]
        gap = max(gap, abs(gradient[s, lane]))
    return gap


@njit(cache=True, error_model="numpy")
def _newton_matrix(visits, law, l2, cols, band, n_live):
    """A = Σ_s μ_s Var_s + l2 (1 − P)ᵀ(1 − P), both as sums over the pairs of moves from s."""
    n = len(visits)
    offsets = np.array([-cols, 1, cols, -1, 0])
    band[:] = 0.0
    for lane in range(n_live):
        for s in range(n):
            band[s, 0, lane] += l2 * (1.0 - 2.0 * law[s, _STAY, lane])
            for a in range(5):
                p = law[s, a, lane]
                if p == 0.0:
                    continue
                to = s + offsets[a]
                band[to, 0, lane] += l2 * p * p
                if a != _STAY:
                    band[min(s, to), abs(offsets[a]), lane] -= l2 * p
                for b in range(a):
                    if law[s, b, lane] == 0.0:  # it may lie beyond the grid
                        continue
                    both, other = p * law[s, b, lane], s + offsets[b]
                    spread = visits[s, lane] * both
                    band[to, 0, lane] += spread
                    band[other, 0, lane] += spread
                    band[min(to, other), abs(to - other), lane] += l2 * both - spread


@njit(cache=True, error_model="numpy")
def _newton_source(gradient, law, cols, x, lane):
    """−(1 − Pᵀ) g."""
    n = len(gradient)
    offsets = np.array([-cols, 1, cols, -1, 0])
    for s in range(n):
        x[s, lane] = -gradient[s, lane]
    for s in range(n):
        for d in range(5):
            if law[s, d, lane] != 0.0:
                x[s + offsets[d], lane] += law[s, d, lane] * gradient[s, lane]


@njit(cache=True, error_model="numpy")
def _newton_step(gradient, law, cols, eta, step, lane):
    """δw = (1 − P) η; answers the slope g·δw."""
    slope = 0.0
    offsets = np.array([-cols, 1, cols, -1, 0])
    for s in range(len(eta)):
        step[s, lane] = eta[s, lane]
        for d in range(5):
            if law[s, d, lane] != 0.0:
                step[s, lane] -= law[s, d, lane] * eta[s + offsets[d], lane]
        slope += gradient[s, lane] * step[s, lane]
    return slope
