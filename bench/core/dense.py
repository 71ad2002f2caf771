"""The dense reference: planning with the full tensor T[S, A, S] in readable, vectorised NumPy.

It needs NumPy alone: bench/core/beside_imitation.py runs it in an environment that has nothing of ours.
"""

from typing import Any, NamedTuple

import numpy as np

Array = np.ndarray[Any, np.dtype[np.float64]]


class Model(NamedTuple):
    """T[s, a, s'], Σ_a T[s, a, s'], the goals and the distribution of starts."""

    tensor: Array
    flow: Array
    goals: list[int]
    starts: Array


class Gradient(NamedTuple):
    """The log partition, P_n(a | s) for n = 1, …, N, shape (N, S, A), and the expected visits, shape (S,)."""

    log_partition: float
    policies: Array
    visits: Array


def model_of(next_states: Array, *, goals: list[int], slip: float, start: int) -> Model:
    """The tensor of a gridworld: each other direction has a third of the slip. Nothing is taught about goals."""
    n_states = len(next_states)
    tensor = np.zeros((n_states, 4, n_states))
    for state in range(n_states):
        for action in range(4):
            for direction in range(4):
                chance = 1 - slip if direction == action else slip / 3
                tensor[state, action, int(next_states[state][direction])] += chance
    return Model(tensor, tensor.sum(axis=1), goals, np.eye(n_states)[start])


def gradient(model: Model, reward: Array, *, horizon: int) -> Gradient:
    """Of the paths that end at a goal within the horizon, P(ζ) ∝ Π T · exp(Σ R)."""
    tensor, flow, goals, starts = model
    pay = np.exp(reward)
    Z = np.zeros((horizon + 1, len(reward)))  # Z_n(s), rescaled at each step
    Z[0, goals] = pay[goals]
    policies = np.full((horizon, *tensor.shape[:2]), 1 / tensor.shape[1])
    log_scale = 0.0
    for n in range(1, horizon + 1):
        moves = tensor @ Z[n - 1]
        total = moves.sum(axis=1)
        np.divide(moves, total[:, None], out=policies[n - 1], where=total[:, None] > 0)
        Z[n] = pay * total
        Z[n, goals] = Z[n - 1, goals]
        top = Z[n].max()
        Z[n] /= top
        log_scale += np.log(top)
    policies[:, goals] = 1 / tensor.shape[1]
    here = starts.copy()
    visits = here.copy()
    for n in range(horizon, 0, -1):
        here[goals] = 0.0
        total = flow @ Z[n - 1]
        here = np.divide(here, total, out=np.zeros_like(here), where=total > 0) @ flow * Z[n - 1]
        visits += here
    begun = starts > 0
    return Gradient(float(starts[begun] @ np.log(Z[horizon, begun]) + log_scale), policies, visits)
