"""The grid underneath a world: neighbours, distances, best totals.

States are numbered row by row from 0. A move into the edge or into a wall leaves the agent where it is. Walls and goals
are never left: all four of their neighbours are themselves.
"""

from collections.abc import Iterable
from typing import Final

import numpy as np

from irl_core.arrays import BoolVector, IntMatrix, IntVector, Vector

N_ACTIONS: Final = 4
_ROW_STEP: Final = (-1, 0, 1, 0)  # 0 up, 1 right, 2 down, 3 left
_COL_STEP: Final = (0, 1, 0, -1)


def neighbours(rows: int, cols: int, *, goals: Iterable[int], walls: Iterable[int]) -> IntMatrix:
    """The state each of the four directions leads to, shape (S, 4)."""
    n_states = rows * cols
    states = np.arange(n_states)
    is_wall = mask(n_states, walls)
    reached = np.empty((n_states, N_ACTIONS), dtype=np.int64)
    for action in range(N_ACTIONS):
        row = np.clip(states // cols + _ROW_STEP[action], 0, rows - 1)
        col = np.clip(states % cols + _COL_STEP[action], 0, cols - 1)
        ahead = row * cols + col
        reached[:, action] = np.where(is_wall[ahead], states, ahead)
    stays = is_wall | mask(n_states, goals)
    reached[stays] = states[stays, None]
    return reached


def mask(n_states: int, states: Iterable[int]) -> BoolVector:
    """True at the given states, shape (S,)."""
    marked = np.zeros(n_states, dtype=np.bool_)
    marked[list(states)] = True
    return marked


def distances(next_states: IntMatrix, start: int) -> IntVector:
    """Fewest steps from the start to each state, −1 where there is no way, shape (S,)."""
    return distances_from(next_states, np.array([start]))


def distances_from(next_states: IntMatrix, starts: IntVector) -> IntVector:
    """Fewest steps from the nearest start to each state, −1 where there is no way, shape (S,)."""
    steps = np.full(len(next_states), -1, dtype=np.int64)
    steps[starts] = 0
    frontier = starts
    n_steps = 0
    while len(frontier):
        n_steps += 1
        ahead = np.unique(next_states[frontier])
        frontier = ahead[steps[ahead] < 0]
        steps[frontier] = n_steps
    return steps


def default_horizon(rows: int, cols: int, *, shortest: int) -> int:
    """N = min(2·rows·cols, 8·(rows + cols)) steps, never less than twice the shortest path."""
    return max(min(2 * rows * cols, 8 * (rows + cols)), 2 * shortest)


def can_reach_total(
    next_states: IntMatrix, reward: Vector, *, start: int, goals: Iterable[int], horizon: int, total: float
) -> bool:
    """Whether some path from start to a goal within the horizon earns at least `total`.

    Max-plus recursion B_n(s) = max_d (r(s′_d) + B_{n−1}(s′_d)), B(goal) = 0, other B_0 = −∞. It ends early when the
    start has enough or when nothing changes any more.
    """
    at_goal = mask(len(reward), goals)
    best = np.where(at_goal, 0.0, -np.inf)
    first, *others = np.ascontiguousarray(next_states.T)
    for _ in range(horizon):
        value = reward + best
        improved = value.take(first)
        for ahead in others:  # one direction after the other is several times as fast as all of them in one gather
            np.maximum(improved, value.take(ahead), out=improved)
        improved[at_goal] = 0.0
        if improved[start] >= total:
            return True
        if np.array_equal(improved, best):
            return False
        best = improved
    return False
