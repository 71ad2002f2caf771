"""Slow, obvious twins of irl_core, written as the formulas read; of its code they use the World's plain fields only."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

MOVES = ((-1, 0), (0, 1), (1, 0), (0, -1))


def step(world, state, direction):
    """The square that one clean step leads to."""
    row, col = divmod(state, world.cols)
    row, col = row + MOVES[direction][0], col + MOVES[direction][1]
    if not (0 <= row < world.rows and 0 <= col < world.cols) or row * world.cols + col in world.walls:
        return state
    return row * world.cols + col


def transitions(world):
    """T[s, a, s′]; nothing leaves a goal."""
    n = world.rows * world.cols
    T = np.zeros((n, 4, n))
    for s in range(n):
        for a in range(4):
            for d in range(4):
                chance = 1 - world.slip if d == a else world.slip / 3
                T[s, a, s if s in world.goals else step(world, s, d)] += chance
    return T


@dataclass
class Path:
    states: list[int]
    actions: list[int]
    weight: float  # Π T · exp(Σ R), R of every state visited, start and goal included


def paths(world, reward, *, start, horizon) -> Iterator[Path]:
    """Every path from `start` that ends at a goal within the horizon."""
    T = transitions(world)

    def grow(states, actions, weight):
        if states[-1] in world.goals:
            yield Path(states, actions, weight)
        elif len(actions) < horizon:
            for a in range(4):
                for s in np.flatnonzero(T[states[-1], a]):
                    yield from grow(
                        [*states, int(s)], [*actions, a], weight * T[states[-1], a, s] * math.exp(reward[s])
                    )

    yield from grow([start], [], math.exp(reward[start]))


@dataclass
class Enumeration:
    log_partition: float
    visits: np.ndarray
    first_action: np.ndarray


def enumerate_paths(world, reward, *, start, horizon):
    """The log of Z, expected visits and the distribution of the first action, by adding up all paths."""
    Z, visits, first = 0.0, np.zeros(world.rows * world.cols), np.zeros(4)
    for path in paths(world, reward, start=start, horizon=horizon):
        Z += path.weight
        for s in path.states:
            visits[s] += path.weight
        if path.actions:
            first[path.actions[0]] += path.weight
    if Z == 0.0:
        return Enumeration(-math.inf, visits, np.full(4, 0.25))
    return Enumeration(math.log(Z), visits / Z, first / Z)


def dense_gradient(world, reward, *, horizon):
    """The log of Z and expected visits, in readable NumPy: backward weights, posterior law, forward visits."""
    T, goals = transitions(world), list(world.goals)
    n = len(reward)
    Z = np.zeros((horizon + 1, n))
    Z[0, goals] = np.exp(reward[goals])
    for k in range(1, horizon + 1):
        Z[k] = np.exp(reward) * (T @ Z[k - 1]).sum(axis=1)
        Z[k, goals] = np.exp(reward[goals])
    here = np.zeros(n)
    here[world.start] = 1.0
    visits = here.copy()
    for k in range(horizon, 0, -1):
        flow = T.sum(axis=1) * Z[k - 1]  # (s, s′): Σ_a T(s′ | s, a) Z_{k−1}(s′)
        total = flow.sum(axis=1, keepdims=True)
        law = np.divide(flow, total, out=np.zeros_like(flow), where=total > 0)
        law[goals] = 0.0
        here = here @ law
        visits += here
    return math.log(Z[horizon, world.start]), visits


def value_iteration(world, reward, *, horizon):
    """V_N of the best plan, by T[s, a, s′]."""
    T = transitions(world)
    V = np.zeros(len(reward))
    for _ in range(horizon):
        V = (T @ (reward + V)).max(axis=1)
        V[list(world.goals)] = 0.0
    return V


def policy_value(world, reward, policy, *, horizon):
    """V_N of a stationary policy, by T[s, a, s′]."""
    T = transitions(world)
    V = np.zeros(len(reward))
    for _ in range(horizon):
        V = (policy * (T @ (reward + V))).sum(axis=1)
        V[list(world.goals)] = 0.0
    return V


def best_path(world, reward, *, horizon, must_reach_goal):
    """The largest sum of rewards of squares reached, over all action sequences (no slip), or −∞."""
    best = -math.inf

    def grow(state, total, left):
        nonlocal best
        if state in world.goals or (left == 0 and not must_reach_goal):
            best = max(best, total)
        if state in world.goals or left == 0:
            return
        for d in range(4):
            s = step(world, state, d)
            grow(s, total + reward[s], left - 1)

    grow(world.start, 0.0, horizon)
    return best


def play(world, actions, attempt_id):
    """States and rewards of an attempt; the slip law is spelled out again."""
    states, rewards = [world.start], []
    for t, intended in enumerate(actions):
        direction = slipped(attempt_id, t, intended, world.slip)
        states.append(step(world, states[-1], direction))
        rewards.append(world.rewards[divmod(states[-1], world.cols)])
    return states, rewards


def slipped(attempt_id, t, intended, slip):
    """FNV-1a (32 bit), murmur3's fmix32, then: below `slip` each other direction has a third."""
    h = 2166136261
    for byte in f"{attempt_id}:{t}".encode():
        h = ((h ^ byte) * 16777619) % 2**32
    h ^= h >> 16
    h = (h * 0x85EBCA6B) % 2**32
    h ^= h >> 13
    h = (h * 0xC2B2AE35) % 2**32
    h ^= h >> 16
    u = h / 4294967296
    if u >= slip:
        return intended
    for third in range(3):
        if u < slip * (third + 1) / 3 or third == 2:
            return (intended + 1 + third) % 4
    raise AssertionError
