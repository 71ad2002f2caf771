"""Line relaxation in potentials for grids too large to factorise; `inference.path_infinite` has the mathematics.

All arrays are grids, shape (rows, cols); those that a sweep updates have a row of zeros above and below, (rows + 2,
cols). `kind` says what a square is: WALL, FREE, GOAL or ON_THE_WAY, a free square that a start leads to.

A row of M y = c is tridiagonal, T_i y_i = c_i + up_i y_{i−1} + down_i y_{i+1}. Let T_i = L_i U_i, U_i of unit diagonal
and `pivot` the inverse of the diagonal of L_i. All is stored multiplied by it (up, left, down), so that a row costs two
recursions of one multiply-add: forward with `left`, backward with `right`, the upper diagonal of U_i. The transposed
system uses the same arrays: its unknown is ξ = x / pivot.
"""

import math

import numpy as np
from numba import njit

WALL, FREE, GOAL, ON_THE_WAY = 0, 1, 2, 3

_HUGE = 1e250
FUSED = {"contract"}
"""A multiplication and an addition in one instruction: half the time of a recursion. It takes nothing from NaN."""

_STEEP, _HIGH = -20.0, 50.0
"""Among steep rewards a first pass may miss the best way by more than floats can hold: passes go on while a value rises
by more than e^50."""

_FAR = 40.0
"""What weighs e^−40 of another does not count for a first guess."""

_STEP, _SWEEPS = 32, 16
"""A strip has twice as many rows as the step from one to the next; at most so many sweeps at each visit."""


@njit(cache=True, error_model="numpy")
def mark_the_way(kind, starts, stack):
    """Turn each FREE square that a start (starts > 0) leads to into ON_THE_WAY; `stack` is room for S numbers."""
    rows, cols = kind.shape
    n = 0
    for i in range(rows):
        for j in range(cols):
            if starts[i, j] > 0.0 and kind[i, j] == FREE:
                kind[i, j] = ON_THE_WAY
                stack[n] = i * cols + j
                n += 1
    while n > 0:
        n -= 1
        i, j = stack[n] // cols, stack[n] % cols
        for d in range(4):
            k, m = i + (d == 2) - (d == 0), j + (d == 1) - (d == 3)
            if 0 <= k < rows and 0 <= m < cols and kind[k, m] == FREE:
                kind[k, m] = ON_THE_WAY
                stack[n] = k * cols + m
                n += 1


@njit(cache=True, error_model="numpy")
def first_potential(kind, reward, u):
    """A lower bound of log z: Gauss–Seidel in logs from −∞, in rows forth and back until no more squares have a way.

    Far too low a value rises to its place in one sweep, far too high a one sinks only slowly: hence from below. `u` is
    −∞ where there is no way to a goal. False if standing still somewhere, or stepping back and forth, weighs 1 or more.
    """
    rows, cols = kind.shape
    n_on_the_way, is_steep = 0, False
    for i in range(rows):
        for j in range(cols):
            u[i, j] = reward[i, j] if kind[i, j] == GOAL else -np.inf
            if kind[i, j] == ON_THE_WAY:
                n_on_the_way += 1
                is_steep |= reward[i, j] < _STEEP
                if _gains_back_and_forth(kind, reward, i, j):
                    return False
    n_reached, n_before, rise = 0, -1, 0.0
    for _ in range(rows * cols):
        n_before, n_reached, rise = n_reached, 0, 0.0
        for n in range(2 * rows):
            i = n if n < rows else 2 * rows - 1 - n
            for m in range(cols):
                j = m if n < rows else cols - 1 - m
                if kind[i, j] == ON_THE_WAY:
                    before, u[i, j] = u[i, j], _log_z_here(kind, reward, u, i, j)
                    if np.isnan(u[i, j]):
                        return False
                    n_reached += n >= rows and u[i, j] > -np.inf
                    if before > -np.inf:
                        rise = max(rise, u[i, j] - before)
        if (not is_steep and n_reached == n_on_the_way) or (n_reached == n_before and rise <= _HIGH):
            break
    return True


@njit(cache=True, error_model="numpy")
def _gains_back_and_forth(kind, reward, i, j):
    rows, cols = kind.shape
    right = j + 1 < cols and kind[i, j + 1] == ON_THE_WAY and reward[i, j] + reward[i, j + 1] >= 0.0
    below = i + 1 < rows and kind[i + 1, j] == ON_THE_WAY and reward[i, j] + reward[i + 1, j] >= 0.0
    return right or below


@njit(cache=True, error_model="numpy")
def _log_z_here(kind, reward, u, i, j):
    """Log Σ_{s′} z(s′) / (e^{−R} − loops); NaN where the divisor is not positive."""
    rows, cols = kind.shape
    above = u[i - 1, j] if i > 0 and kind[i - 1, j] != WALL else np.nan
    after = u[i, j + 1] if j + 1 < cols and kind[i, j + 1] != WALL else np.nan
    below = u[i + 1, j] if i + 1 < rows and kind[i + 1, j] != WALL else np.nan
    before = u[i, j - 1] if j > 0 and kind[i, j - 1] != WALL else np.nan
    n_loops, top = 0, -np.inf
    for ahead in (above, after, below, before):
        if np.isnan(ahead):
            n_loops += 1
        else:
            top = max(top, ahead)
    rest = 1.0 - n_loops * math.exp(min(reward[i, j], 1.0)) if n_loops else 1.0
    if not rest > 0.0:
        return np.nan
    if top == -np.inf:
        return top
    total = 0.0
    for ahead in (above, after, below, before):
        if ahead > top - _FAR:
            total += math.exp(ahead - top)
    return reward[i, j] + top + math.log(total / rest)


@njit(cache=True, error_model="numpy")
def prepare(kind, reward, u, up, right, down, left, pivot):
    """Fill the five arrays from the potential u. False if a pivot is not positive: the sum over paths is infinite."""
    rows, cols = kind.shape
    for i in range(rows):
        for j in range(cols):
            up[i, j] = right[i, j] = down[i, j] = left[i, j] = 0.0
            pivot[i, j] = 1.0
            if kind[i, j] != ON_THE_WAY:
                continue
            n_loops = _weights(kind, reward, u, up, right, down, left, i, j)
            diagonal = 1.0 - n_loops * math.exp(reward[i, j]) if n_loops else 1.0
            if j > 0:
                diagonal -= left[i, j] * right[i, j - 1]
            if not diagonal > 0.0:
                return False
            pivot[i, j] = 1.0 / diagonal
            up[i, j] *= pivot[i, j]
            right[i, j] *= pivot[i, j]
            down[i, j] *= pivot[i, j]
            left[i, j] *= pivot[i, j]
    return True


@njit(cache=True, error_model="numpy")
def _weights(kind, reward, u, up, right, down, left, i, j):
    """W(s, s′) = e^{R(s) + u(s′) − u(s)} in the four directions; answers how many of them lead nowhere."""
    rows, cols = kind.shape
    base, n_loops = reward[i, j] - u[i, j], 4
    if i > 0 and kind[i - 1, j] != WALL:
        up[i, j] = math.exp(base + u[i - 1, j])
        n_loops -= 1
    if j + 1 < cols and kind[i, j + 1] != WALL:
        right[i, j] = math.exp(base + u[i, j + 1])
        n_loops -= 1
    if i + 1 < rows and kind[i + 1, j] != WALL:
        down[i, j] = math.exp(base + u[i + 1, j])
        n_loops -= 1
    if j > 0 and kind[i, j - 1] != WALL:
        left[i, j] = math.exp(base + u[i, j - 1])
        n_loops -= 1
    return n_loops


@njit(cache=True, error_model="numpy")
def settle(y, c, up, right, down, left, transposed, tolerance, max_passes):
    """Pass over M y = c (or the transposed system), from the y given, until it rests, in strips down and up in turn.

    Answers (passes done, change of the last one, its ratio to the one before), changes relative to the larger of 1 and
    the largest value. It rests when the last and what is left to come, change · ratio / (1 − ratio), are below the
    tolerance.
    """
    rows = len(c)
    n_strips = max(1, (rows - 1) // _STEP)
    change, ratio = np.inf, 1.0
    for n in range(1, max_passes + 1):
        last, change = change, 0.0
        for k in range(n_strips):
            strip = k if n % 2 else n_strips - 1 - k
            end = rows if strip == n_strips - 1 else strip * _STEP + 2 * _STEP
            for m in range(_SWEEPS):
                moved = _sweep(y, c, up, right, down, left, transposed, strip * _STEP, end)
                change = max(change, moved) if m == 0 else change
                if moved <= tolerance:
                    break
        ratio = change / last if n > 1 else 1.0
        if change <= tolerance and change * ratio <= tolerance * (1.0 - ratio):
            return n, change, ratio
    return max_passes, change, ratio


@njit(cache=True, error_model="numpy")
def _sweep(y, c, up, right, down, left, transposed, first, end):
    """A symmetric line Gauss–Seidel sweep of the rows first … end − 1, downwards and back; answers the change."""
    rows, cols = c.shape
    line = np.empty(cols)
    change, size = 0.0, 1.0
    for n in range(2 * (end - first) - 1):
        i = first + n if first + n < end else 2 * end - first - 2 - n
        above, below = y[i], y[i + 2]
        if transposed:
            from_above, from_below = down[max(i - 1, 0)], up[min(i + 1, rows - 1)]  # beyond the edge y is 0
        else:
            from_above, from_below = up[i], down[i]
        for j in range(cols):
            line[j] = c[i, j] + from_above[j] * above[j] + from_below[j] * below[j]
        if transposed:
            moved, largest = _solve_transposed(line, y[i + 1], right[i], left[i])
        else:
            moved, largest = _solve(line, y[i + 1], right[i], left[i])
        change, size = max(change, moved), max(size, largest)
    return change / size


@njit(cache=True, error_model="numpy", fastmath=FUSED)
def _solve(line, y, right, left):
    """T y = line by two recursions, y ≤ 1e250 throughout; answers the largest change and the largest value."""
    cols = len(line)
    ahead, change, size = 0.0, 0.0, 0.0
    for j in range(cols):
        ahead = line[j] + left[j] * ahead
        line[j] = ahead
    ahead = 0.0
    for j in range(cols - 1, -1, -1):
        ahead = line[j] + right[j] * ahead
        if not ahead < _HUGE:
            ahead = _HUGE
        change, size = max(change, abs(ahead - y[j])), max(size, ahead)
        y[j] = ahead
    return change, size


@njit(cache=True, error_model="numpy", fastmath=FUSED)
def _solve_transposed(line, y, right, left):
    """The same for the transpose of T, in ξ."""
    cols = len(line)
    ahead, change, size = line[0], 0.0, 0.0
    for j in range(1, cols):
        ahead = line[j] + right[j - 1] * ahead
        line[j] = ahead
    ahead = 0.0
    for j in range(cols - 1, -1, -1):
        ahead = line[j] + (left[j + 1] * ahead if j + 1 < cols else 0.0)
        change, size = max(change, abs(ahead - y[j])), max(size, ahead)
        y[j] = ahead
    return change, size


@njit(cache=True, error_model="numpy")
def path_policy(kind, log_z, slip, policy):
    """P(a | s) = Σ_d T(d | a) q(d | s) with q(d | s) ∝ z(s′_d), shape (rows, cols, 4); uniform off the way."""
    rows, cols = kind.shape
    aside = slip / 3.0
    law = np.empty(4)
    for i in range(rows):
        for j in range(cols):
            policy[i, j] = 0.25
            if kind[i, j] != ON_THE_WAY:
                continue
            top = -np.inf
            for d in range(4):
                k, m = i + (d == 2) - (d == 0), j + (d == 1) - (d == 3)
                stays = not (0 <= k < rows and 0 <= m < cols) or kind[k, m] == WALL
                law[d] = log_z[i, j] if stays else log_z[k, m]
                top = max(top, law[d])
            total = 0.0
            for d in range(4):
                law[d] = math.exp(law[d] - top)
                total += law[d]
            for d in range(4):
                policy[i, j, d] = (1.0 - slip - aside) * law[d] / total + aside
