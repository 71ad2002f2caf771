"""Slow, obvious twins for discrete models, from T[s, a, s′] written out and the formulas as they read."""

import math
from collections.abc import Iterator

import numpy as np

from irl_core.mdp import SparseMdp


def sparse_from_dense(T, terminal, *, pays=None, start=0, horizon=0):
    """A SparseMdp of T[s, a, s′], the rows of terminal states left out; zeros are kept in half of the rows."""
    n_states, n_actions, _ = T.shape
    indptr, indices, probabilities = [0], [], []
    for s in range(n_states):
        for a in range(n_actions):
            for s_next in range(n_states) if not terminal[s] else ():
                if T[s, a, s_next] > 0.0 or a % 2 == 1:
                    indices.append(s_next)
                    probabilities.append(T[s, a, s_next])
            indptr.append(len(indices))
    pays = np.zeros((n_states, n_actions)) if pays is None else pays
    return SparseMdp(
        np.array(indptr),
        np.array(indices, dtype=np.int64),
        np.array(probabilities),
        n_states,
        n_actions,
        pays,
        np.array(terminal, dtype=bool),
        start,
        horizon=horizon,
    )


def dense(mdp):
    """T[s, a, s′] of a SparseMdp; the rows of terminal states are 0."""
    T = np.zeros((mdp.n_states, mdp.n_actions, mdp.n_states))
    for s in range(mdp.n_states):
        for a in range(mdp.n_actions):
            row = s * mdp.n_actions + a
            for e in range(mdp.indptr[row], mdp.indptr[row + 1]):
                T[s, a, mdp.indices[e]] += mdp.probabilities[e]
    return T


def random_model(seed, *, n_states=6, n_actions=3, n_terminal=1, reach=2, two_starts=False, horizon=0):
    """A model of which every state but the terminal ones may move one further, and to `reach` others, at random."""
    rng = np.random.default_rng(seed)
    T = np.zeros((n_states, n_actions, n_states))
    terminal = np.arange(n_states) >= n_states - n_terminal
    for s in range(n_states):
        for a in range(n_actions):
            ahead = rng.choice(n_states, size=reach, replace=False)
            T[s, a, ahead] += rng.random(reach)
            if a == 0:
                T[s, a, (s + 1) % n_states] += 0.5
    T /= T.sum(axis=2, keepdims=True)
    start = np.zeros(n_states)
    start[0] = 1.0
    if two_starts:
        start[:2] = 0.3, 0.7
    pays = rng.normal(size=(n_states, n_actions))
    return sparse_from_dense(T, terminal, pays=pays, start=start, horizon=horizon)


def paths(T, terminal, reward, *, start, horizon) -> Iterator[tuple[list[int], list[int], float]]:
    """Every path from `start` that arrives within the horizon: states, actions, Π T · exp(Σ R)."""

    def grow(states, actions, weight):
        s = states[-1]
        if terminal[s]:
            yield states, actions, weight
        elif len(actions) < horizon:
            for a in range(T.shape[1]):
                for s_next in np.flatnonzero(T[s, a]):
                    yield from grow(
                        [*states, int(s_next)], [*actions, a], weight * T[s, a, s_next] * math.exp(reward[s_next])
                    )

    yield from grow([start], [], math.exp(reward[start]))


def enumerate_paths(mdp, reward, *, horizon):
    """Log partition Σ ρ_0(s) log Z(s), visits, and the first action's distribution in every state, by all paths."""
    T = dense(mdp)
    log_partition, visits = 0.0, np.zeros(mdp.n_states)
    policy = np.full((mdp.n_states, mdp.n_actions), 1 / mdp.n_actions)
    for start in range(mdp.n_states):
        Z, seen, first = 0.0, np.zeros(mdp.n_states), np.zeros(mdp.n_actions)
        for states, actions, weight in paths(T, mdp.terminal, reward, start=start, horizon=horizon):
            Z += weight
            for s in states:
                seen[s] += weight
            if actions:
                first[actions[0]] += weight
        if first.any():
            policy[start] = first / first.sum()
        if mdp.starts[start] > 0.0:
            log_partition += mdp.starts[start] * math.log(Z)
            visits += mdp.starts[start] * seen / Z
    return log_partition, visits, policy


def spectral_radius(mdp, reward):
    """The largest eigenvalue of e^R W between states that are not terminal."""
    inside = ~mdp.terminal
    W = np.exp(reward)[:, None] * dense(mdp).sum(axis=1)
    return max(abs(np.linalg.eigvals(W[np.ix_(inside, inside)])))


def infinite_paths(mdp, reward):
    """The same for paths of any length, by one dense solve (I − e^R W) Z = e^R W e^R(terminal)."""
    T, inside = dense(mdp), ~mdp.terminal
    W = np.exp(reward)[:, None] * T.sum(axis=1)
    M = W[np.ix_(inside, inside)]
    Z = np.exp(reward)
    Z[inside] = np.linalg.solve(np.eye(inside.sum()) - M, W[np.ix_(inside, ~inside)] @ Z[~inside])
    law = np.where(inside[:, None], W * Z[None, :] / Z[:, None], 0.0)
    visits = np.linalg.solve(np.eye(mdp.n_states) - law.T, mdp.starts)
    policy = T @ Z
    policy = np.where(inside[:, None], policy / np.where(inside, policy.sum(axis=1), 1.0)[:, None], 1 / mdp.n_actions)
    return float(mdp.starts @ np.log(Z)), visits, policy


def causal(mdp, reward, *, horizon, discount):
    """Maximum causal entropy by T[s, a, s′]: value of the starts, π_N, discounted visits (the last state not paid)."""
    T, n = dense(mdp), mdp.n_states
    V = np.where(mdp.terminal, reward, 0.0)
    policies = []
    for _ in range(horizon):
        Q = reward[:, None] + discount * (T @ V)
        V = np.log(np.exp(Q).sum(axis=1))
        policies.append(np.exp(Q - V[:, None]))
        V = np.where(mdp.terminal, reward, V)
    here, visits, weight = mdp.starts.copy(), np.zeros(n), 1.0
    for policy in reversed(policies):
        visits += weight * here
        here = np.einsum("s,sa,sat->t", here * ~mdp.terminal, policy, T)
        weight *= discount
    visits += weight * here * mdp.terminal
    policy = np.where(mdp.terminal[:, None], 1 / mdp.n_actions, policies[-1])
    return float(mdp.starts @ V), visits, policy


def ziebart(mdp, reward, *, horizon):
    """Algorithm 1, loop by loop: N backups, one stationary policy, N forward steps."""
    T, n, m = dense(mdp), mdp.n_states, mdp.n_actions
    Z = [1.0 if mdp.terminal[i] else 0.0 for i in range(n)]
    for _ in range(horizon):
        Za = [[sum(T[i, j, k] * math.exp(reward[i]) * Z[k] for k in range(n)) for j in range(m)] for i in range(n)]
        Z = [sum(Za[i]) + (1.0 if mdp.terminal[i] else 0.0) for i in range(n)]
    policy = [[Za[i][j] / Z[i] if Z[i] > 0 and not mdp.terminal[i] else 1 / m for j in range(m)] for i in range(n)]
    D = [mdp.starts.copy()]
    for _ in range(horizon):
        D.append(
            np.array([sum(D[-1][k] * policy[k][j] * T[k, j, i] for j in range(m) for k in range(n)) for i in range(n)])
        )
    return np.array(policy), sum(D), Z
