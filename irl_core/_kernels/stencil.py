"""The finite-horizon path recursion on grids as one contiguous loop; `irl_core.inference.path` has the mathematics.

Squares are laid out row by row with an empty row above and below and one empty square after each row, which is also the
one before the next; `lanes` worlds are interleaved, [square, lane]. The neighbours of cell i are then i ± lane and
i ± width, for one world or for several, and one step of the recursion is

    z′[i] = weight[i] · ((z[i − width] + z[i + width]) + (z[i − lane] + z[i + lane])) + keep[i] · z[i],

a loop that the compiler turns into vector instructions. `weight` is e^R, and 0 in empty squares, walls and goals:
nothing moves on from there. `loops` counts the directions that lead back, to a square that is `shut`; `keep` is e^R
times that many, and 1 at goals, whose Z stays. Worlds never mix, whatever their numbers. Offsets are unsigned: each use
of a signed one would first be tested for counting from the end. Functions take arrays one by one: in tuples, the
references would be counted at each call. And a loop of more than three or four arrays is split in two, since the
compiler gives up proving that they do not overlap.

The rows of `chain` are the memory of a block of worlds: Z_n in row n mod `every`; Z_0, Z_every, Z_2·every, … once more
behind these; then two rows for the forward pass. `shifts[n]` is by how many bits Z_n was scaled down, world by world.
"""

import math
from typing import TypeAlias

import numpy as np
from numba import njit

from irl_core.arrays import BoolVector, IntMatrix, IntVector, Matrix, Vector

Cube: TypeAlias = np.ndarray[tuple[int, int, int], np.dtype[np.float64]]
BoolMatrix: TypeAlias = np.ndarray[tuple[int, int], np.dtype[np.bool_]]
Offsets: TypeAlias = np.ndarray[tuple[int], np.dtype[np.uint64]]

SCALE_BITS, GROWTH_BITS, FORWARD_BITS = 700, 200, 800
"""A row that is looked at is scaled down to 2^700, where Z_0 starts; it is looked at before it can have grown by 2^200
more. The forward pass may have reached 2^800 then: 2^1000 times what the smallest numbers lose, 2^−1075, is nothing."""

LEAST = 2.0**-800
"""What counts for a policy may not weigh less, on the scale of its row."""

LOWEST_REWARD, HIGHEST_REWARD, GOAL_SPREAD = -600.0, 136.0, 600.0
"""Within these e^R keeps its digits and one step cannot grow a row by more than 2^200."""

LOST = -1

_LOG_2, _LOG_4 = math.log(2.0), math.log(4.0)


@njit(cache=True, error_model="numpy")
def path_gradient(
    rewards: Matrix,
    pays: Matrix,
    terminal: BoolMatrix,
    blocked: BoolMatrix,
    starts: Matrix,
    slips: Vector,
    cols: int,
    horizon: int,
    every: int,
    lanes: int,
    log_z: Vector,
    policies: Cube,
    visits: Matrix,
    steps: Cube,
) -> IntVector:
    """Fill log_z (B,), policies (B, S, 4), visits (B, S), steps (N or 0, S, 4); answer with the zeros met, int (B,).

    `rewards`, `pays` = e^rewards and `starts` have shape (B, S), `terminal` and `blocked` the same or (1, S), `slips`
    (B,); `every` ≥ 2. `steps` with N rows asks for the policies of all steps, of one world in one lane.
    The answer is LOST where a reward is too large for plain numbers, something was lost, or a start sees no goal. Else
    it counts Z_n(s) = 0 in the rows that policies come from, for the caller to compare with how many there should be.
    """
    n_worlds, n_states = rewards.shape
    n_rows, n_cells = every + horizon // every + 1, (n_states // cols + 2) * (cols + 1) * lanes
    chain = np.zeros((n_rows + 2, n_cells))
    here, there = chain[n_rows], chain[n_rows + 1]
    weight, loops, keep, shut = np.zeros(n_cells), np.zeros(n_cells), np.zeros(n_cells), np.zeros(n_cells)
    share, total = np.zeros(n_cells), np.zeros(n_cells)
    goals = np.empty(n_states * lanes, dtype=np.uint64)
    shifts = np.zeros((horizon + 1, lanes), dtype=np.int64)
    squares = _squares(n_states, cols, lanes)
    width, lane = np.uint64((cols + 1) * lanes), np.uint64(lanes)
    zeros = np.zeros(n_worlds, dtype=np.int64)
    for first in range(0, n_worlds, lanes):
        end = min(first + lanes, n_worlds)
        _clear(weight, keep, shut, total, chain[0], here, shifts)
        n_goals, highest = _lay_out(
            first, end, rewards, pays, terminal, blocked, squares, log_z, zeros, weight, shut, chain[0], goals
        )
        _set_keep(weight, shut, goals[:n_goals], loops, keep, width, lane)
        look = max(1, int(GROWTH_BITS * _LOG_2 / (highest + _LOG_4)))
        chain[every] = chain[0]
        for n in range(len(steps)):
            if zeros[first] != LOST:
                row = chain[n % every]
                _set_shares(row, weight, loops, share, width, lane)
                met = _policy(row, share, squares, weight, shut, width, lane, slips[first], steps[n])
                zeros[first] = LOST if met == LOST else zeros[first] + met
            _backward(chain, weight, keep, shifts, width, lane, every, look, n, n + 1)
        _backward(chain, weight, keep, shifts, width, lane, every, look, len(steps), horizon)
        before, last = chain[(horizon - 1) % every], chain[horizon % every]
        _set_shares(before, weight, loops, share, width, lane)
        for b in range(first, end):
            if zeros[b] != LOST:
                cells = squares + np.uint64(b - first)
                met = _policy(before, share, cells, weight, shut, width, lane, slips[b], policies[b])
                zeros[b] = met if len(steps) == 0 else zeros[b]
                bits = shifts[:, b - first].sum() - SCALE_BITS
                log_z[b] += _begin(starts[b], cells, weight, last, bits, here, total)
                if log_z[b] == -math.inf:
                    zeros[b] = LOST
        _forward(
            chain,
            weight,
            keep,
            goals[:n_goals],
            shifts,
            width,
            lane,
            every,
            look,
            horizon,
            here,
            there,
            total,
            zeros[first:end],
        )
        for b in range(first, end):
            _count_visits(total, weight, squares + np.uint64(b - first), visits[b])
    return zeros


@njit(cache=True, error_model="numpy")
def _backward(
    chain: Matrix,
    weight: Vector,
    keep: Vector,
    shifts: IntMatrix,
    width: np.uint64,
    lane: np.uint64,
    every: int,
    look: int,
    first: int,
    last: int,
) -> None:
    """Z_n for n = first + 1, …, last, from Z_first, each in its row."""
    for n in range(first + 1, last + 1):
        row = chain[n % every]
        _step(chain[(n - 1) % every], row, weight, keep, width, lane)
        if n % look == 0:
            _scale_down(row, shifts[n])
        if n % every == 0:
            chain[every + n // every] = row


@njit(cache=True, error_model="numpy")
def _forward(
    chain: Matrix,
    weight: Vector,
    keep: Vector,
    goals: Offsets,
    shifts: IntMatrix,
    width: np.uint64,
    lane: np.uint64,
    every: int,
    look: int,
    horizon: int,
    here: Vector,
    there: Vector,
    total: Vector,
    zeros: IntVector,
) -> None:
    """Follow the weights of the ways from the starts, and add up the visits with N − 1, …, 0 steps to go."""
    for n in range(horizon - 1, -1, -1):
        if (n + 1) % look == 0:
            _follow_scale(here, shifts[n + 1], zeros)
        if (n + 1) % every == 0:
            first = n + 1 - every
            chain[0] = chain[every + first // every]
            _backward(chain, weight, keep, shifts, width, lane, every, look, first, n)
        row = chain[n % every]
        _step(here, there, weight, keep, width, lane)
        for i in range(len(row)):
            total[i] += there[i] * row[i]
        for goal in goals:
            total[goal] += _around(here, goal, width, lane) * row[goal]
        here, there = there, here


@njit(cache=True, error_model="numpy")
def _step(z: Vector, stepped: Vector, weight: Vector, keep: Vector, width: np.uint64, lane: np.uint64) -> None:
    for i in range(width, np.uint64(len(stepped)) - width):
        stepped[i] = weight[i] * _around(z, i, width, lane) + keep[i] * z[i]


@njit(cache=True, error_model="numpy")
def _around(z: Vector, i: int | np.uint64, width: np.uint64, lane: np.uint64) -> np.float64:
    around: np.float64 = (z[i - width] + z[i + width]) + (z[i - lane] + z[i + lane])
    return around


@njit(cache=True, error_model="numpy")
def _scale_down(row: Vector, shift: IntVector) -> None:
    """Scale each world's numbers to at most 2^SCALE_BITS; `shift` says by how many bits."""
    lanes = len(shift)
    for k in range(lanes):
        top = 0.0
        for i in range(k, len(row), lanes):
            top = max(top, row[i])
        shift[k] = max(0, math.frexp(top)[1] - SCALE_BITS)
        if shift[k] > 0:
            for i in range(k, len(row), lanes):
                row[i] *= math.ldexp(1.0, -int(shift[k]))


@njit(cache=True, error_model="numpy")
def _follow_scale(here: Vector, shift: IntVector, zeros: IntVector) -> None:
    """Scale the forward pass as the row was, after seeing that it has not grown out of its numbers."""
    lanes = len(shift)
    for k in range(len(zeros)):
        top = 0.0
        for i in range(k, len(here), lanes):
            top = max(top, here[i])
            here[i] *= math.ldexp(1.0, -int(shift[k]))
        if top > 2.0**FORWARD_BITS:
            zeros[k] = LOST


@njit(cache=True, error_model="numpy")
def _squares(n_states: int, cols: int, lanes: int) -> Offsets:
    """The cell of each state in the first lane, (S,)."""
    squares = np.empty(n_states, dtype=np.uint64)
    for state in range(n_states):
        squares[state] = ((state // cols + 1) * (cols + 1) + state % cols) * lanes
    return squares


@njit(cache=True, error_model="numpy")
def _clear(
    weight: Vector, keep: Vector, shut: Vector, total: Vector, row: Vector, here: Vector, shifts: IntMatrix
) -> None:
    for i in range(len(row)):
        weight[i] = keep[i] = total[i] = row[i] = here[i] = 0.0
        shut[i] = 1.0
    for n in range(len(shifts)):
        for k in range(shifts.shape[1]):
            shifts[n, k] = 0


@njit(cache=True, error_model="numpy")
def _lay_out(
    first: int,
    end: int,
    rewards: Matrix,
    pays: Matrix,
    terminal: BoolMatrix,
    blocked: BoolMatrix,
    squares: Offsets,
    log_z: Vector,
    zeros: IntVector,
    weight: Vector,
    shut: Vector,
    row: Vector,
    goals: Offsets,
) -> tuple[int, float]:
    """Weights, squares shut, and Z_0 / e^{best goal}, whose log is left; answer the number of goals and max R."""
    n_goals, highest = 0, 0.0
    for b in range(first, end):
        m, cells = min(b, len(terminal) - 1), squares + np.uint64(b - first)
        log_z[b], high = _limits(rewards[b], terminal[m], blocked[m])
        if high > HIGHEST_REWARD:
            zeros[b] = LOST
            continue
        highest = max(highest, high)
        for state in range(len(cells)):
            cell = cells[state]
            shut[cell] = 1.0 if blocked[m, state] else 0.0
            if terminal[m, state]:
                row[cell] = math.ldexp(math.exp(rewards[b, state] - log_z[b]), SCALE_BITS)
                goals[n_goals] = cell
                n_goals += 1
            elif not blocked[m, state]:
                weight[cell] = pays[b, state]
    return n_goals, highest


@njit(cache=True, error_model="numpy")
def _limits(reward: Vector, terminal: BoolVector, blocked: BoolVector) -> tuple[float, float]:
    """The highest reward of a goal, and of any other square; the latter infinite where plain numbers would not do."""
    goal_low, goal_high, low, high = math.inf, -math.inf, math.inf, -math.inf
    for state in range(len(reward)):
        if terminal[state]:
            goal_low, goal_high = min(goal_low, reward[state]), max(goal_high, reward[state])
        elif not blocked[state]:
            low, high = min(low, reward[state]), max(high, reward[state])
    if low < LOWEST_REWARD or goal_high - goal_low > GOAL_SPREAD:
        high = math.inf
    return goal_high, high


@njit(cache=True, error_model="numpy")
def _set_keep(
    weight: Vector, shut: Vector, goals: Offsets, loops: Vector, keep: Vector, width: np.uint64, lane: np.uint64
) -> None:
    for i in range(width, np.uint64(len(keep)) - width):
        loops[i] = _around(shut, i, width, lane)
        keep[i] = weight[i] * loops[i]
    for goal in goals:
        keep[goal] = 1.0


@njit(cache=True, error_model="numpy")
def _begin(
    starts: Vector, cells: Offsets, weight: Vector, row: Vector, bits: int, here: Vector, total: Vector
) -> float:
    """Put the starts into the forward pass and its visits; answer Σ_s ρ_0(s) log Z_N(s), of Z_N = 2^bits · row."""
    log_z = 0.0
    for state in range(len(starts)):
        if starts[state] > 0.0:
            cell = cells[state]
            if row[cell] == 0.0:
                return -math.inf
            fraction, exponent = math.frexp(row[cell])
            log_z += starts[state] * (math.log(fraction) + _LOG_2 * (exponent + bits))
            here[cell] = weight[cell] * starts[state] / row[cell]
            total[cell] = weight[cell] * starts[state]
    return log_z


@njit(cache=True, error_model="numpy")
def _set_shares(row: Vector, weight: Vector, loops: Vector, share: Vector, width: np.uint64, lane: np.uint64) -> None:
    """1 / Σ_d Z(s′_d) from Z of the step after; 0 where nothing moves."""
    for i in range(width, np.uint64(len(row)) - width):
        total = _around(row, i, width, lane) + loops[i] * row[i]
        share[i] = 1.0 / total if weight[i] > 0.0 and total > 0.0 else 0.0


@njit(cache=True, error_model="numpy")
def _policy(
    row: Vector,
    share: Vector,
    cells: Offsets,
    weight: Vector,
    shut: Vector,
    width: np.uint64,
    lane: np.uint64,
    slip: float,
    policy: Matrix,
) -> int:
    """P(a | s) from Z of the step after, (S, 4); how many Z are 0, or LOST where one is too small to count on."""
    aside = slip / 3.0
    n_zeros, n_lost = 0, 0
    for state in range(len(cells)):
        cell = cells[state]
        z = row[cell]
        each = share[cell] * (1.0 - slip - aside)
        rest = aside if share[cell] > 0.0 else 0.25
        policy[state, 0] = each * (row[cell - width] + shut[cell - width] * z) + rest
        policy[state, 1] = each * (row[cell + lane] + shut[cell + lane] * z) + rest
        policy[state, 2] = each * (row[cell + width] + shut[cell + width] * z) + rest
        policy[state, 3] = each * (row[cell - lane] + shut[cell - lane] * z) + rest
        if z < LEAST and weight[cell] > 0.0:
            n_zeros += z == 0.0
            n_lost += z > 0.0
    return n_zeros if n_lost == 0 else LOST


@njit(cache=True, error_model="numpy")
def _count_visits(total: Vector, weight: Vector, cells: Offsets, visits: Vector) -> None:
    for state in range(len(cells)):
        pay = weight[cells[state]]
        visits[state] = total[cells[state]] / pay if pay > 0.0 else total[cells[state]]
