"""The slow, obvious twin of path inference without a horizon: K as a dense matrix, as the formula reads."""

import numpy as np

from tests.naive import step


def on_the_way(mdp):
    """Squares that a start leads to before a goal, in no order of importance."""
    found, ahead = set(), [int(s) for s in mdp.start_states]
    while ahead:
        s = ahead.pop()
        if s in found or s in mdp.goals:
            continue
        found.add(s)
        ahead += [step(mdp, s, d) for d in range(4)]
    return sorted(found)


def solve(mdp, reward):
    """(log z, visits) of shape (S,), or None where K is not positive definite."""
    inside = on_the_way(mdp)
    n = len(inside)
    K, beside_goals = np.diag(np.exp(-reward[inside])), np.zeros(n)
    for i, s in enumerate(inside):
        for d in range(4):
            t = step(mdp, s, d)
            if t in mdp.goals:
                beside_goals[i] += np.exp(reward[t])
            else:
                K[i, inside.index(t)] -= 1.0
    if np.linalg.eigvalsh(K)[0] <= 0.0:
        return None
    z = np.linalg.solve(K, beside_goals)
    x = np.linalg.solve(K, mdp.starts[inside] / z)
    log_z, visits = np.full(mdp.n_states, -np.inf), np.zeros(mdp.n_states)
    log_z[inside] = np.log(z)
    visits[inside] = np.exp(-reward[inside]) * z * x
    for i, s in enumerate(inside):
        for d in range(4):
            t = step(mdp, s, d)
            if t in mdp.goals:
                visits[t] += np.exp(reward[t]) * x[i]
    return log_z, visits
