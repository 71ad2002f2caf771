"""Small worlds, and people who play them, for the tests of irl_core."""

from itertools import pairwise

import numpy as np

from irl_core import (
    Demonstration,
    LearningProblem,
    Ranking,
    Settings,
    World,
    generate_world,
    hard_plan,
    rollouts,
    simulate,
)

UP, RIGHT, DOWN, LEFT = range(4)


def make_world(rows=3, cols=3, *, seed=0, goals=None, walls=(), slip=0.0, start=0, horizon=None):
    """A small world of random rewards, goals paying 2."""
    goals = (rows * cols - 1,) if goals is None else goals
    rewards = np.random.default_rng(seed).uniform(-2.0, 0.0, (rows, cols))
    rewards.flat[list(goals)] = 2.0
    return World(rows, cols, rewards, start, goals, walls, slip, horizon=horizon or 0)


SMALL_WORLDS = {
    "2x2": make_world(2, 2),
    "2x2 slip": make_world(2, 2, slip=0.3),
    "2x3 wall": make_world(2, 3, walls=(1,)),
    "2x3 wall slip": make_world(2, 3, walls=(4,), slip=0.2),
    "3x3": make_world(3, 3, seed=1),
    "3x3 slip": make_world(3, 3, seed=2, slip=0.4),
    "3x3 walls": make_world(3, 3, walls=(4, 2), seed=3),
    "3x3 two goals": make_world(3, 3, goals=(8, 2), seed=4),
    "3x3 two goals slip": make_world(3, 3, goals=(8, 2), seed=5, slip=0.3),
    "3x3 start in the middle": make_world(3, 3, start=4, seed=6),
    "2x3 closed corner": make_world(2, 3, start=0, goals=(3,), walls=(1, 4), seed=7),
}


def attempt(world, states, *, id_):
    """The demonstration that walks these squares (no slip)."""
    actions = [int(np.flatnonzero(world.next_states[s] == t)[0]) for s, t in pairwise(states)]
    return simulate(world, actions, attempt_id=id_)


def play_like_a_person(world, *, seed=0, n_successes=3, n_failures=3):
    """Attempts of somebody who overlooks half of the rewards: best success first, worst failure first."""
    rng = np.random.default_rng(seed)
    successes: list[Demonstration] = []
    failures: list[Demonstration] = []
    for k in range(500):
        seen = np.where(rng.random(world.n_states) < 0.5, world.reward, -1.0)
        plan = hard_plan(world, seen, must_reach_goal=True)
        actions = [int(a) for a in _plan_actions(world, plan, rng)]
        one = simulate(world, actions, attempt_id=f"attempt-{k}")
        if one.reached_goal:
            (successes if one.outcome == "success" else failures).append(one)
        if len(successes) >= n_successes and len(failures) >= n_failures:
            break
    successes, failures = successes[:n_successes], failures[:n_failures]
    assert len(successes) == n_successes
    assert len(failures) == n_failures
    return sorted(successes, key=lambda one: -one.total), sorted(failures, key=lambda one: one.total)


def ranked(successes, failures):
    """Both rankings, in the order given."""
    return [
        *([Ranking("success", tuple((one.id,) for one in successes))] if successes else []),
        *([Ranking("failure", tuple((one.id,) for one in failures))] if failures else []),
    ]


def make_problem(*, seed=0, world=None, rankings=None, **settings):
    """Three successes and three failures in a 7×7 world, ranked by what they earned."""
    world = generate_world(7) if world is None else world
    successes, failures = play_like_a_person(world, seed=seed)
    rankings = ranked(successes, failures) if rankings is None else rankings
    return LearningProblem.build(world, [*successes, *failures], rankings, Settings(**settings), seed)


def _plan_actions(world, plan, rng):
    episode = rollouts(world, plan, 1, rng)[0]
    for s, t in pairwise(episode.states):
        yield np.flatnonzero(world.next_states[s] == t)[0]
