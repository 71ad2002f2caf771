"""Slow, obvious twins of the sampled inference: one episode after the other, as the formulas read."""

import math

import numpy as np


def weigh(episodes, reward, policy):
    """Weights w_i of the episodes, Ẑ = Σ w / n, μ̂ = Σ w visits / Σ w, and Ẑ(s, a), the mean over tries (one start)."""
    n_states, n_actions = policy.shape
    weights, visits = [], np.zeros(n_states)
    sums, tries = np.zeros((n_states, n_actions)), np.zeros((n_states, n_actions))
    for i, length in enumerate(episodes.lengths):
        states, actions = episodes.states[i, : length + 1], episodes.actions[i, :length]
        weights.append(weight_of(states, actions, reward, policy) if episodes.arrived[i] else 0.0)
        visits += weights[-1] * np.bincount(states, minlength=n_states)
        for t in range(length):
            s, a = states[t], actions[t]
            tries[s, a] += 1
            if episodes.arrived[i]:
                sums[s, a] += weight_of(states[t:], actions[t:], reward, policy) * policy[s, a]
    return np.array(weights), visits / sum(weights), sums, tries


def weight_of(states, actions, reward, policy):
    """The factor e^{R(ζ)} / Π_t π(a_t | s_t)."""
    chance = math.prod(policy[s, a] for s, a in zip(states, actions, strict=False))
    return math.exp(sum(reward[s] for s in states)) / chance


def covariance(episodes, shares, n_states):
    """Of the visits, each episode counting as its share."""
    counts = np.array([
        np.bincount(path[: length + 1], minlength=n_states)
        for path, length in zip(episodes.states, episodes.lengths, strict=True)
    ])  # fmt: skip
    mean = shares @ counts
    return (counts - mean).T @ ((counts - mean) * shares[:, None])
