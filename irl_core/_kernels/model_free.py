"""Playing many episodes of a tabular model, and weighing them. Arrays in, arrays out; randomness comes as uniforms.

The model is CSR: row s·A + a of `indptr` holds where action a leads from s (`ahead`), and `cumulative` the running sums
of the chances, the last of a row taken for 1. An episode i has `lengths[i]` steps through `states[i, : lengths[i] + 1]`
with `actions[i, : lengths[i]]`; the rest of the arrays is not written.
"""

import numpy as np
from numba import njit


@njit(cache=True)
def play(indptr, ahead, cumulative, terminal, thresholds, starts, choices, chances, states, actions, lengths, arrived):
    """Fill in the episodes. `thresholds` (S, A) are running sums of the policy; uniforms (n, N) choose and slip."""
    n_episodes, n_steps = actions.shape
    n_actions = thresholds.shape[1]
    for i in range(n_episodes):
        s = starts[i]
        states[i, 0] = s
        t = 0
        while t < n_steps and not terminal[s]:
            a = 0
            while a < n_actions - 1 and choices[i, t] >= thresholds[s, a]:
                a += 1
            k = indptr[s * n_actions + a]
            last = indptr[s * n_actions + a + 1] - 1
            while k < last and chances[i, t] >= cumulative[k]:
                k += 1
            actions[i, t] = a
            s = ahead[k]
            t += 1
            states[i, t] = s
        lengths[i] = t
        arrived[i] = terminal[s]


@njit(cache=True)
def weigh(states, actions, lengths, arrived, reward, log_policy, log_weights, log_sums, tries):
    """Log weights of the episodes and, for each (s, a) on the way, log Σ of the weights of what followed.

    The log weight is Σ_t R(s_t) − Σ_t log π(a_t | s_t). `log_sums` and `log_weights` come filled with the caller's
    log 0, which stays where nothing arrived; `tries` counts every choice. One pass from the end of each episode, with
    a running log-sum-exp.
    """
    n_states, n_actions = log_policy.shape
    top = np.full((n_states, n_actions), -np.inf)
    total = np.zeros((n_states, n_actions))
    for i in range(len(lengths)):
        log_weight = reward[states[i, lengths[i]]]
        for t in range(lengths[i] - 1, -1, -1):
            s, a = states[i, t], actions[i, t]
            tries[s, a] += 1.0
            log_weight += reward[s]
            if arrived[i]:
                if log_weight <= top[s, a]:
                    total[s, a] += np.exp(log_weight - top[s, a])
                else:
                    total[s, a] = total[s, a] * np.exp(top[s, a] - log_weight) + 1.0
                    top[s, a] = log_weight
            log_weight -= log_policy[s, a]
        if arrived[i]:
            log_weights[i] = log_weight
    for s in range(n_states):
        for a in range(n_actions):
            if total[s, a] > 0.0:
                log_sums[s, a] = top[s, a] + np.log(total[s, a])


@njit(cache=True)
def count(states, lengths, weights, visits):
    """Add to `visits` (S,) each episode's visits times its weight, start and end included."""
    for i in range(len(lengths)):
        if weights[i] != 0.0:
            for t in range(lengths[i] + 1):
                visits[states[i, t]] += weights[i]


@njit(cache=True)
def add_up(states, lengths, weights, values, sums):
    """`sums` (n,) becomes Σ_t of `values` (S,) along each episode that has any weight."""
    for i in range(len(lengths)):
        if weights[i] > 0.0:
            for t in range(lengths[i] + 1):
                sums[i] += values[states[i, t]]
