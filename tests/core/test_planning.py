"""Soft and hard plans against the enumeration of all paths, dense twins, finite differences and hand calculation."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from irl_core import (
    IrlError,
    World,
    generate_world,
    hard_plan,
    soft_plan,
    spectral_radius,
    visitation,
)
from tests import naive
from tests.core.examples import SMALL_WORLDS, make_world

HORIZONS = {False: (4, 6), True: (4,)}  # with slip there are up to 16 ways on at each step
CASES = [
    pytest.param(world, n, id=f"{name}, {n} steps")
    for name, world in SMALL_WORLDS.items()
    for n in HORIZONS[world.slip > 0]
]


def some_reward(world, seed=0):
    return np.random.default_rng(seed).normal(0.0, 1.5, world.n_states)


@pytest.mark.parametrize(("world", "horizon"), CASES)
def test_the_partition_and_the_visits_are_those_of_all_paths_added_up(world, horizon):
    reward = some_reward(world)
    plan = soft_plan(world, reward, horizon=horizon)
    expected = naive.enumerate_paths(world, reward, start=world.start, horizon=horizon)
    assert plan.log_partition == pytest.approx(expected.log_partition, abs=1e-12)
    np.testing.assert_allclose(visitation(world, plan), expected.visits, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("world", "horizon"), [case for case in CASES if case.values[1] == 4])
def test_the_policy_is_the_first_action_of_all_paths_from_every_square(world, horizon):
    reward = some_reward(world, seed=1)
    plan = soft_plan(world, reward, horizon=horizon)
    for state in range(world.n_states):
        if state in world.goals or state in world.walls:
            np.testing.assert_array_equal(plan.policy[state], 0.25)
            continue
        expected = naive.enumerate_paths(world, reward, start=state, horizon=horizon)
        np.testing.assert_allclose(plan.policy[state], expected.first_action, rtol=0, atol=1e-12)
        np.testing.assert_allclose(plan.step_log_z[horizon, state], expected.log_partition, rtol=0, atol=1e-12)


@pytest.mark.parametrize("world", SMALL_WORLDS.values(), ids=SMALL_WORLDS)
def test_slip_changes_neither_partition_nor_visits_only_the_policy(world):
    slippery = World.from_json({**world.to_json(), "slip": 0.6})
    reward = some_reward(world)
    dry, wet = soft_plan(world, reward), soft_plan(slippery, reward)
    assert dry.log_partition == wet.log_partition
    np.testing.assert_array_equal(visitation(world, dry), visitation(slippery, wet))


@pytest.mark.parametrize("slip", [0.0, 0.25])
def test_a_7x7_world_agrees_with_the_dense_twin(slip):
    world = generate_world(11, slip=slip)
    reward = np.clip(some_reward(world), -3, 0)
    log_partition, visits = naive.dense_gradient(world, reward, horizon=world.horizon)
    plan = soft_plan(world, reward)
    assert plan.log_partition == pytest.approx(log_partition, rel=1e-12)
    np.testing.assert_allclose(visitation(world, plan), visits, rtol=0, atol=1e-11)


@pytest.mark.parametrize("world", [SMALL_WORLDS["3x3 two goals slip"], generate_world(3, rows=4, cols=5)])
def test_the_visits_are_the_gradient_of_the_log_partition(world):
    reward, h = some_reward(world) - 1.0, 1e-4
    visits = visitation(world, soft_plan(world, reward))

    def log_z(state, by):
        return soft_plan(world, reward + by * (np.arange(world.n_states) == state)).log_partition

    for state in range(world.n_states):
        # five points: the error is of order h⁴, below rounding
        slope = (8 * (log_z(state, h) - log_z(state, -h)) - (log_z(state, 2 * h) - log_z(state, -2 * h))) / (12 * h)
        assert slope == pytest.approx(visits[state], abs=1e-8)


def test_by_hand_a_2x2_world_with_two_steps():
    """From square 0 two paths of two steps reach square 3: right-down (e^{b}) and down-right (e^{c})."""
    a, b, c, d = -0.5, -1.0, -2.0, 0.3
    world = World(2, 2, np.array([[0.0, 0.0], [0.0, 1.0]]), 0, (3,))
    plan = soft_plan(world, np.array([a, b, c, d]), horizon=2)
    both = math.exp(b) + math.exp(c)
    assert plan.log_partition == pytest.approx(a + d + math.log(both), abs=1e-15)
    np.testing.assert_allclose(plan.policy[0], [0, math.exp(b) / both, math.exp(c) / both, 0], atol=1e-15)
    np.testing.assert_allclose(visitation(world, plan), [1, math.exp(b) / both, math.exp(c) / both, 1], atol=1e-15)


def test_by_hand_slip_spreads_the_action_behind_a_certain_direction():
    """With one path only (down, then right is walled off) the direction is certain; T(d | a) = 0.7 or 0.1."""
    world = World(2, 2, np.array([[0.0, 0.0], [0.0, 1.0]]), 0, (3,), walls=(1,), slip=0.3)
    plan = soft_plan(world, np.zeros(4), horizon=2)
    np.testing.assert_allclose(plan.policy[0], [0.1, 0.1, 0.7, 0.1], atol=1e-15)
    np.testing.assert_allclose(visitation(world, plan), [1, 0, 1, 1], atol=1e-15)


@given(
    shape=st.tuples(st.integers(2, 12), st.integers(2, 12)),
    size=st.sampled_from([1e-3, 1.0, 30.0, 1e3]),
    slip=st.sampled_from([0.0, 0.3]),
    seed=st.integers(0, 2**32),
)
@settings(max_examples=25, deadline=None)
def test_any_finite_reward_gives_probabilities_and_no_nan(shape, size, slip, seed):
    world = generate_world(seed, rows=shape[0], cols=shape[1], slip=slip)
    reward = np.random.default_rng(seed).uniform(-size, size, world.n_states)
    plan = soft_plan(world, reward)
    visits = visitation(world, plan)
    assert np.isfinite(plan.log_partition)
    assert not np.isnan(plan.step_log_z).any()
    np.testing.assert_allclose(plan.policy.sum(axis=1), 1.0, atol=1e-12)
    assert (plan.policy >= 0).all()
    assert visits[world.goal] == pytest.approx(1.0, abs=1e-9)
    assert 1.0 <= visits.sum() <= world.horizon + 1 + 1e-9
    assert spectral_radius(world, reward) > 0


def test_adding_a_constant_to_the_only_goal_shifts_log_z_and_nothing_else():
    world, reward = generate_world(5), -np.ones(49)
    before = soft_plan(world, reward)
    after = soft_plan(world, reward + 3.0 * (np.arange(49) == 48))
    assert after.log_partition == pytest.approx(before.log_partition + 3.0)
    np.testing.assert_allclose(after.policy, before.policy, atol=1e-14)


def test_squares_without_a_way_to_a_goal_have_a_uniform_policy():
    world = make_world(3, 3, walls=(5, 7), goals=(2, 8))  # goal 8 is walled in
    plan = soft_plan(world, np.zeros(9))
    np.testing.assert_array_equal(plan.policy[8], 0.25)
    np.testing.assert_array_equal(plan.policy[5], 0.25)
    assert visitation(world, plan)[8] == 0.0


def test_a_large_world_goes_through_the_forward_pass_in_blocks(monkeypatch):
    world = generate_world(2, rows=9, cols=9)
    plan = soft_plan(world, world.reward)
    whole = visitation(world, plan)
    monkeypatch.setattr("irl_core.planning._BLOCK", 1000)
    np.testing.assert_array_equal(visitation(world, plan), whole)


@pytest.mark.parametrize("name", ["2x2", "2x3 wall", "3x3", "3x3 two goals", "3x3 walls"])
@pytest.mark.parametrize("must_reach_goal", [False, True])
def test_the_hard_plan_earns_what_the_best_of_all_paths_earns(name, must_reach_goal):
    world = SMALL_WORLDS[name]
    reward = some_reward(world, seed=8)
    plan = hard_plan(world, reward, horizon=6, must_reach_goal=must_reach_goal)
    best = naive.best_path(world, reward, horizon=6, must_reach_goal=must_reach_goal)
    assert plan.values[6, world.start] == pytest.approx(best, abs=1e-12)


@pytest.mark.parametrize("world", SMALL_WORLDS.values(), ids=SMALL_WORLDS)
def test_the_hard_plan_agrees_with_dense_value_iteration(world):
    plan = hard_plan(world, world.reward)
    expected = naive.value_iteration(world, world.reward, horizon=world.horizon)
    free = [s for s in range(world.n_states) if s not in world.walls]
    np.testing.assert_allclose(plan.values[-1][free], expected[free], atol=1e-12)


def test_a_plan_that_must_arrive_arrives_though_standing_still_pays_more():
    world, reward = make_world(3, 3), np.ones(9) * 5.0
    reward[8] = -100.0
    lingering = hard_plan(world, reward, horizon=10, must_reach_goal=True)
    assert lingering.values[10, 0] == pytest.approx(9 * 5.0 - 100.0)
    assert hard_plan(world, reward, horizon=10).values[10, 0] == pytest.approx(50.0)


def test_ties_go_to_the_action_with_the_lowest_number():
    world = World(2, 2, np.array([[-3.0, -1.0], [-1.0, 1.0]]), 0, (3,))
    assert hard_plan(world, world.reward, horizon=2).actions[1, 0] == 1  # right and down earn the same


def test_the_spectral_radius_is_the_largest_eigenvalue():
    world, reward = generate_world(4, walls=(8, 9)), np.random.default_rng(1).uniform(-4, 0.5, 49)
    inside = [s for s in range(48) if s not in (8, 9)]
    adjacency = np.array([[(world.next_states[s] == t).sum() for t in inside] for s in inside])
    expected = np.abs(np.linalg.eigvals(np.exp(reward[inside])[:, None] * adjacency)).max()
    assert spectral_radius(world, reward) == pytest.approx(expected, rel=1e-6)


def test_at_zero_reward_the_infinite_sum_does_not_exist():
    assert spectral_radius(generate_world(0), np.zeros(49)) == pytest.approx(3.98, abs=0.01)


@pytest.mark.parametrize(
    ("reward", "horizon", "said"),
    [
        (np.zeros(8), None, "must be 9 finite numbers"),
        (np.full(9, np.nan), None, "must be 9 finite numbers"),
        (np.full(9, np.inf), None, "must be 9 finite numbers"),
        (np.zeros(9), 0, "whole number from 1"),
        (np.zeros(9), 3, "No goal can be reached within 3 steps"),
    ],
)
def test_a_reward_or_horizon_that_cannot_be_planned_with_is_refused(reward, horizon, said):
    with pytest.raises(IrlError, match=said):
        soft_plan(make_world(3, 3), reward, horizon=horizon)


@given(seed=st.integers(0, 10**6), rows=st.integers(2, 6), cols=st.integers(2, 6))
@settings(max_examples=15, deadline=None)
def test_mirroring_a_world_mirrors_what_is_expected_of_it(seed, rows, cols):
    world = generate_world(seed, rows=rows, cols=cols)
    mirrored = World(cols, rows, world.rewards.T, 0, world.goals, horizon=world.horizon)
    reward = some_reward(world, seed).reshape(rows, cols)
    plan, twin = soft_plan(world, reward.ravel()), soft_plan(mirrored, reward.T.ravel())
    assert twin.log_partition == pytest.approx(plan.log_partition, abs=1e-10)
    visits = visitation(world, plan).reshape(rows, cols)
    np.testing.assert_allclose(visitation(mirrored, twin).reshape(cols, rows).T, visits, atol=1e-9)
    up_right_down_left = twin.policy.reshape(cols, rows, 4).transpose(1, 0, 2)[:, :, [3, 2, 1, 0]]
    np.testing.assert_allclose(up_right_down_left, plan.policy.reshape(rows, cols, 4), atol=1e-9)


def test_running_the_slip_forward_with_the_policy_would_not_be_the_gradient():
    """Ziebart's forward pass, T with P_n(a | s), is off on 3×3 with slip: the path measure steers its own slips."""
    world = SMALL_WORLDS["3x3 slip"]
    plan = soft_plan(world, some_reward(world), horizon=8)
    T, here = naive.transitions(world), np.eye(9)[0]
    visits = here.copy()
    for n in range(8, 0, -1):
        ahead = np.exp(plan.step_log_z[n - 1])
        action = T @ ahead
        law = action / np.maximum(action.sum(axis=1, keepdims=True), 1e-300)
        law[8] = 0.0
        here = np.einsum("s,sa,sat->t", here, law, T)
        visits += here
    assert np.abs(visits - visitation(world, plan)).max() > 0.3
