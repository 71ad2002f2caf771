"""Maximum causal entropy against its formulas, finite differences, `imitation`, path inference, and by hand."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from irl_core import generate_world, infer
from irl_core.errors import InvalidReward
from irl_core.inference.causal import causal_step_policies, infer_causal
from irl_core.mdp import GridMdp
from tests.core.naive_models import causal, random_model, sparse_from_dense

IMITATION = json.loads((Path(__file__).parents[1] / "imitation_agreement" / "imitation_1_0_1.json").read_text())


def some_reward(mdp, seed=0):
    return np.random.default_rng(seed).normal(0.0, 1.0, mdp.n_states)


@pytest.mark.parametrize("case", IMITATION["cases"], ids=[case["name"] for case in IMITATION["cases"]])
def test_imitation_finds_the_same(case):
    """Its figures are on file, with the script that made them and how terminal states are mapped there."""
    T, terminal = np.array(case["transitions"]), np.array(case["terminal"])
    mdp = sparse_from_dense(T, terminal, start=np.array(case["starts"]), horizon=case["horizon"])
    found = infer_causal(
        mdp, np.array(case["reward"]), horizon=case["horizon"], discount=case["discount"], starts=mdp.starts
    )
    assert found.log_partition == pytest.approx(case["log_partition"], abs=1e-12)
    np.testing.assert_allclose(found.policy, case["policy"], rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.visitation, case["visitation"], rtol=0, atol=1e-12)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("discount", [1.0, 0.7])
def test_value_policy_and_visits_are_those_of_the_formulas(seed, discount):
    mdp = random_model(seed, n_terminal=seed % 3, two_starts=seed % 2 == 0, horizon=9)
    reward = some_reward(mdp, seed)
    found = infer_causal(mdp, reward, horizon=9, discount=discount, starts=mdp.starts)
    value, visits, policy = causal(mdp, reward, horizon=9, discount=discount)
    assert found.log_partition == pytest.approx(value, abs=1e-12)
    np.testing.assert_allclose(found.visitation, visits, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.policy, policy, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("seed", "discount"), [(0, 1.0), (1, 0.8)])
def test_the_visits_are_the_gradient_of_the_log_partition(seed, discount):
    mdp, h = random_model(seed, n_terminal=2, two_starts=True), 1e-4
    reward = some_reward(mdp, seed)
    visits = infer_causal(mdp, reward, horizon=8, discount=discount, starts=mdp.starts).visitation

    def value(state, by):
        moved = reward + by * (np.arange(mdp.n_states) == state)
        return infer_causal(mdp, moved, horizon=8, discount=discount, starts=mdp.starts).log_partition

    for state in range(mdp.n_states):
        slope = (8 * (value(state, h) - value(state, -h)) - (value(state, 2 * h) - value(state, -2 * h))) / (12 * h)
        assert slope == pytest.approx(visits[state], abs=1e-8)


def test_by_hand_one_choice_between_an_end_and_staying():
    """From 0: stop at 1, or stay. With one step to go staying is worth 0, stopping R(1)."""
    mdp = sparse_from_dense(np.array([[[0.0, 1.0], [1.0, 0.0]], np.zeros((2, 2))]), [False, True], horizon=1)
    found = infer_causal(mdp, np.array([-1.0, 2.0]), horizon=1, discount=0.5, starts=mdp.starts)
    stop = math.exp(1.0) / (math.exp(1.0) + 1.0)
    assert found.log_partition == pytest.approx(-1.0 + math.log(math.exp(1.0) + 1.0), abs=1e-15)
    np.testing.assert_allclose(found.policy, [[stop, 1 - stop], [0.5, 0.5]], atol=1e-15)
    np.testing.assert_allclose(found.visitation, [1.0, 0.5 * stop], atol=1e-15)


def test_a_grid_is_as_good_as_its_transitions_written_out():
    world = generate_world(4, rows=4, cols=5, slip=0.2, walls=(7,))
    reward = some_reward(world)
    on_grid, written_out = (
        infer_causal(mdp, reward, horizon=20, discount=0.95, starts=world.mdp.starts)
        for mdp in (world.mdp, world.mdp.to_sparse())
    )
    assert on_grid.log_partition == written_out.log_partition
    np.testing.assert_array_equal(on_grid.visitation, written_out.visitation)


def test_where_moves_are_certain_and_all_paths_arrive_it_is_path_inference():
    """A reward so high at the goal that nobody stays out: then both are the same distribution over paths."""
    mdp = GridMdp(3, 3, (8,))
    reward = np.full(9, -3.0)
    reward[8] = 60.0
    path = infer(mdp, reward, horizon=12)
    found = infer_causal(mdp, reward, horizon=12, discount=1.0, starts=mdp.starts)
    assert found.log_partition == pytest.approx(path.log_partition, abs=1e-12)
    np.testing.assert_allclose(found.visitation, path.visitation, atol=1e-12)
    np.testing.assert_allclose(found.policy[:8], path.policy[:8], atol=1e-9)


def test_paths_need_not_arrive():
    """Where staying out costs less than going in, the goal is hardly visited, and nothing is infinite."""
    mdp = GridMdp(2, 2, (3,))
    found = infer_causal(mdp, np.array([1.0, 1.0, 1.0, -5.0]), horizon=20, discount=1.0, starts=mdp.starts)
    assert found.visitation[3] < 0.01
    assert found.visitation.sum() == pytest.approx(20.0, abs=0.1)


def test_it_is_not_led_by_luck_as_path_inference_is():
    """A lottery (a win of 4 with 10 %, else −2) against a sure 0: on average the sure thing is better."""
    T = np.zeros((4, 2, 4))
    T[0, 0, [1, 2]] = 0.1, 0.9
    T[0, 1, 3] = 1.0
    mdp = sparse_from_dense(T, [False, True, True, True])
    found = infer_causal(mdp, np.array([0.0, 4.0, -2.0, 0.0]), horizon=1, discount=1.0, starts=mdp.starts)
    assert found.policy[0, 0] == pytest.approx(1 / (1 + math.exp(1.4)), abs=1e-12)


def test_the_last_step_policy_is_the_one_executed():
    mdp = random_model(3)
    reward = some_reward(mdp)
    steps = causal_step_policies(mdp, reward, horizon=7, discount=0.9)
    assert steps.shape == (7, mdp.n_states, mdp.n_actions)
    np.testing.assert_allclose(steps.sum(axis=2), 1.0, atol=1e-12)
    found = infer_causal(mdp, reward, horizon=7, discount=0.9, starts=mdp.starts)
    np.testing.assert_array_equal(steps[-1], found.policy)
    np.testing.assert_array_equal(
        steps[2], infer_causal(mdp, reward, horizon=3, discount=0.9, starts=mdp.starts).policy
    )


@given(
    seed=st.integers(0, 2**32),
    size=st.sampled_from([1e-3, 1.0, 30.0, 1e3]),
    discount=st.sampled_from([1.0, 0.5]),
    slip=st.sampled_from([0.0, 0.3]),
)
@settings(max_examples=25, deadline=None)
def test_any_finite_reward_gives_probabilities_and_as_many_visits_as_steps(seed, size, discount, slip):
    world = generate_world(seed, rows=1 + seed % 11 + 1, cols=12, slip=slip)
    reward = np.random.default_rng(seed).uniform(-size, size, world.n_states)
    found = infer_causal(world.mdp, reward, horizon=world.horizon, discount=discount, starts=world.mdp.starts)
    assert math.isfinite(found.log_partition)
    np.testing.assert_allclose(found.policy.sum(axis=1), 1.0, atol=1e-12)
    most = (1 - discount ** (world.horizon + 1)) / (1 - discount) if discount < 1 else world.horizon + 1
    assert 1.0 - 1e-9 <= found.visitation.sum() <= most + 1e-9


@given(seed=st.integers(0, 2**32))
@settings(max_examples=15, deadline=None)
def test_other_names_for_the_states_change_nothing(seed):
    mdp, rng = random_model(seed, two_starts=True), np.random.default_rng(seed)
    order = rng.permutation(mdp.n_states)
    T = mdp.transitions.toarray().reshape(mdp.n_states, mdp.n_actions, mdp.n_states)
    renamed = sparse_from_dense(
        T[np.ix_(order, np.arange(mdp.n_actions), order)], mdp.terminal[order], start=mdp.starts[order]
    )
    reward = some_reward(mdp, seed)
    here = infer_causal(mdp, reward, horizon=6, discount=0.9, starts=mdp.starts)
    there = infer_causal(renamed, reward[order], horizon=6, discount=0.9, starts=renamed.starts)
    assert there.log_partition == pytest.approx(here.log_partition, abs=1e-12)
    np.testing.assert_allclose(there.visitation, here.visitation[order], atol=1e-12)


def test_rewards_beyond_all_numbers_are_refused():
    mdp = GridMdp(2, 2, (3,))
    with pytest.raises(InvalidReward, match="too large"):
        infer_causal(mdp, np.full(4, 1e308), horizon=8, discount=1.0, starts=mdp.starts)
