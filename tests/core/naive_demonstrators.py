"""Slow, obvious twins of what simulated people do."""

import numpy as np

from irl_core import slip_direction


def play_one(world, law, id_, draws):
    """One attempt alone: the first action whose cumulated probability exceeds the drawn number, until a goal."""
    here, actions = world.start, []
    for step, drawn in enumerate(draws):
        cumulated = np.cumsum(law[here])
        action = next((a for a in range(3) if drawn < cumulated[a]), 3)
        actions.append(action)
        here = world.next_states[here, slip_direction(id_, step, action, world.slip)]
        if here in world.goals:
            return actions
    return None


def distances_to_goal(world):
    """Fewest steps to a goal from each square, by asking the neighbours until nobody knows better."""
    steps = [0 if s in world.goals else np.inf for s in range(world.n_states)]
    while True:
        better = [
            0 if s in world.goals else min(steps[s], 1 + min(steps[t] for t in world.next_states[s]))
            for s in range(world.n_states)
        ]
        if better == steps:
            return steps
        steps = better


def shortest_paths(world):
    """Every shortest path from the start to a goal, as its (state, action) pairs."""
    steps = distances_to_goal(world)

    def onward(s):
        if s in world.goals:
            return [[]]
        nearer = [a for a in range(4) if steps[world.next_states[s, a]] == steps[s] - 1]
        return [[(s, a), *rest] for a in nearer for rest in onward(world.next_states[s, a])]

    return onward(world.start)


def best_first_steps(world, costs):
    """Which actions start a cheapest path to a goal, shape (S, 4): the cost of each path to each goal, one by one."""
    price = [0.0 if s in world.goals else np.inf for s in range(world.n_states)]
    cost = [0.0 if s in world.goals else costs[s] for s in range(world.n_states)]
    for _ in range(world.n_states):
        price = [
            0.0 if s in world.goals else min(cost[t] + price[t] for t in world.next_states[s])
            for s in range(world.n_states)
        ]
    along = np.array([[cost[t] + price[t] for t in world.next_states[s]] for s in range(world.n_states)])
    return along <= along.min(axis=1, keepdims=True) + 1e-9
