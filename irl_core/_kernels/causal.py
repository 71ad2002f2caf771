"""Soft value iteration with the steps to go, and the visits of its policy, over transitions in CSR."""

import math

import numpy as np
from numba import njit


@njit(cache=True)
def backward(indptr, indices, chances, reward, terminal, discount, values):
    """Fill rows 1 … of values, (N + 1, S): V_n(s) = log Σ_a exp(R(s) + γ Σ T V_{n−1}); terminal ones keep row 0."""
    n_states = len(reward)
    n_actions = (len(indptr) - 1) // n_states
    q = np.empty(n_actions)
    for n in range(1, len(values)):
        before = values[n - 1]  # sliced once: in the inner loop it would cost tenfold
        for s in range(n_states):
            if terminal[s]:
                values[n, s] = before[s]
                continue
            top = _action_values(indptr, indices, chances, discount, before, s, q)
            total = 0.0
            for a in range(n_actions):
                total += math.exp(q[a] - top)
            values[n, s] = reward[s] + top + math.log(total)


@njit(cache=True)
def forward(indptr, indices, chances, terminal, discount, values, here, visits):
    """Add to visits, (S,), those of N steps from `here`: a visit at step t counts γ^t, the last state only at an end.

    With n steps to go action a has the chance exp(Q_n(s, a) − V_n(s)); values are (N + 1, S).
    """
    n_states = len(here)
    n_actions = (len(indptr) - 1) // n_states
    q, after = np.empty(n_actions), np.empty(n_states)
    weight = 1.0
    for n in range(len(values) - 1, 0, -1):
        later = values[n - 1]
        after[:] = 0.0
        for s in range(n_states):
            visits[s] += weight * here[s]
            if here[s] == 0.0 or terminal[s]:
                continue
            top = _action_values(indptr, indices, chances, discount, later, s, q)
            total = 0.0
            for a in range(n_actions):
                q[a] = math.exp(q[a] - top)
                total += q[a]
            for a in range(n_actions):
                share = here[s] * q[a] / total
                for entry in range(indptr[s * n_actions + a], indptr[s * n_actions + a + 1]):
                    after[indices[entry]] += share * chances[entry]
        for s in range(n_states):
            here[s] = after[s]
        weight *= discount
    for s in range(n_states):
        if terminal[s]:
            visits[s] += weight * here[s]


@njit(cache=True)
def _action_values(indptr, indices, chances, discount, value, s, q):
    """Write γ Σ T(s′ | s, a) V(s′) into q, (A,), and answer with the largest."""
    top = -np.inf
    for a in range(len(q)):
        total = 0.0
        for entry in range(indptr[s * len(q) + a], indptr[s * len(q) + a + 1]):
            total += chances[entry] * value[indices[entry]]
        q[a] = discount * total
        top = max(top, q[a])
    return top
