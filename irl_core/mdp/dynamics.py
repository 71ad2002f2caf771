"""How likely single moves are: T(s′ | s, a), for a grid and for any other model."""

from collections.abc import Iterable

import numpy as np

from irl_core import grid
from irl_core.arrays import IntVector, Vector
from irl_core.mdp.grid import GridMdp
from irl_core.mdp.sparse import SparseMdp


def transition_chances(mdp: GridMdp | SparseMdp, states: IntVector, actions: IntVector) -> Vector:
    """T(s_{t+1} | s_t, a_t) of each step, shape (T,), from T + 1 states and T actions; 0 where there is no such move.

    A terminal state is never left: the chance of a step from one is 0.
    """
    if isinstance(mdp, GridMdp):
        return _on_grid(mdp, states, actions)
    rows = states[:-1] * mdp.n_actions + actions
    chances = [
        float(mdp.probabilities[first:last][mdp.indices[first:last] == reached].sum())
        for first, last, reached in _entries(mdp, rows, states[1:])
    ]
    return np.array(chances, dtype=np.float64)


def _on_grid(mdp: GridMdp, states: IntVector, actions: IntVector) -> Vector:
    """Several directions may lead to the same square; their chances add up."""
    n_steps = len(actions)
    chances = np.full((n_steps, grid.N_ACTIONS), mdp.slip / (grid.N_ACTIONS - 1))
    chances[np.arange(n_steps), actions] = 1.0 - mdp.slip
    led_there = mdp.next_states[states[:-1]] == states[1:, None]
    total: Vector = (chances * led_there).sum(axis=1) * ~mdp.terminal[states[:-1]]
    return total


def _entries(mdp: SparseMdp, rows: IntVector, reached: IntVector) -> Iterable[tuple[int, int, int]]:
    return zip(mdp.indptr[rows].tolist(), mdp.indptr[rows + 1].tolist(), reached.tolist(), strict=True)
