"""Exact returns, rollouts, the optimum."""

import numpy as np
import pytest

from irl_core import (
    World,
    expected_return,
    expected_visits,
    generate_world,
    greedy_plan,
    optimal_plan,
    optimum,
    rollouts,
    soft_plan,
    visitation,
)
from tests import naive
from tests.core.examples import SMALL_WORLDS, make_world


def some_policy(world, seed=0):
    return np.random.default_rng(seed).dirichlet(np.ones(4), world.n_states)


@pytest.mark.parametrize("world", SMALL_WORLDS.values(), ids=SMALL_WORLDS)
def test_the_expected_return_agrees_with_the_dense_twin(world):
    policy = some_policy(world)
    expected = naive.policy_value(world, world.reward, policy, horizon=world.horizon)[world.start]
    assert expected_return(world, policy) == pytest.approx(expected, abs=1e-12)
    assert optimum(world) == pytest.approx(
        naive.value_iteration(world, world.reward, horizon=world.horizon)[world.start], abs=1e-12
    )


@pytest.mark.parametrize("world", SMALL_WORLDS.values(), ids=SMALL_WORLDS)
def test_the_best_plan_earns_the_optimum_and_no_policy_more(world):
    assert expected_return(world, optimal_plan(world)) == pytest.approx(optimum(world), abs=1e-12)
    for seed in range(5):
        assert expected_return(world, some_policy(world, seed)) <= optimum(world) + 1e-12


def test_by_hand_the_optimum_pays_the_squares_reached_and_the_goal_once():
    world = World(2, 2, np.array([[-9.0, -3.0], [-1.0, 4.0]]), 0, (3,))
    assert optimum(world) == 3.0  # −1 + 4; the start's −9 is not paid


def test_by_hand_standing_still_is_best_where_arriving_does_not_pay():
    world = World(2, 2, np.array([[0.0, -3.0], [-3.0, 1.0]]), 0, (3,))
    assert optimum(world) == 0.0
    assert expected_return(world, greedy_plan(world, world.reward)) == -2.0


def test_by_hand_a_slip_costs():
    """One square from the goal, one step, slip 0.3: 0.7 · 4 + 0.1 · (−1) · 2 bumps + 0.1 · (−2)."""
    world = World(2, 2, np.array([[-2.0, -1.0], [0.0, 4.0]]), 1, (3,), slip=0.3)
    down = np.zeros((4, 4))
    down[:, 2] = 1.0
    assert expected_return(world, down, horizon=1) == pytest.approx(0.7 * 4 - 0.1 * 2 - 0.2)


@pytest.mark.parametrize("slip", [0.0, 0.3])
def test_rollouts_earn_what_is_expected(slip):
    world = generate_world(12, rows=4, cols=4, slip=slip)
    policy = soft_plan(world, 2 * world.reward).policy
    episodes = rollouts(world, policy, 4000, np.random.default_rng(0))
    totals = np.array([episode.total for episode in episodes])
    assert totals.mean() == pytest.approx(expected_return(world, policy), abs=5 * totals.std() / np.sqrt(4000))
    visits = sum(np.bincount(episode.states, minlength=16) for episode in episodes) / 4000
    np.testing.assert_allclose(visits, expected_visits(world, policy), atol=0.15)
    for episode in episodes[:50]:
        assert episode.total == pytest.approx(world.reward[list(episode.states[1:])].sum())
        assert episode.reached_goal == (episode.states[-1] == 15)
        assert 15 not in episode.states[:-1]
        assert len(episode.states) <= world.horizon + 1


def test_rollouts_of_a_plan_follow_its_steps_to_go():
    world = generate_world(7)
    episodes = rollouts(world, optimal_plan(world), 3, np.random.default_rng(0))
    assert [episode.total for episode in episodes] == pytest.approx([optimum(world)] * 3)


def test_the_same_seed_plays_the_same_episodes():
    world, policy = make_world(3, 3, slip=0.3), some_policy(make_world(3, 3))
    first, again = (rollouts(world, policy, 20, np.random.default_rng(5)) for _ in range(2))
    assert first == again


def test_a_policy_that_never_arrives_plays_to_the_horizon():
    world = make_world(3, 3)
    up = np.zeros((9, 4))
    up[:, 0] = 1.0
    episode = rollouts(world, up, 1, np.random.default_rng(0))[0]
    assert len(episode.states) == world.horizon + 1
    assert not episode.reached_goal


def test_without_slip_and_with_a_long_horizon_the_executed_policy_visits_what_was_learned():
    world = make_world(3, 3, horizon=18)
    plan = soft_plan(world, np.full(9, -3.0))
    np.testing.assert_allclose(expected_visits(world, plan.policy), visitation(world, plan), atol=1e-6)
