"""Path inference in any discrete model against all paths, a dense solve, finite differences, grids, and by hand."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from irl_core import generate_world, infer
from irl_core.errors import DivergentPartition, InvalidModel, InvalidReward
from irl_core.inference.path_log import infer_path_in_logs
from irl_core.inference.sparse import infer_path_infinite_sparse, infer_path_sparse
from irl_core.mdp.radius import spectral_radius_of
from tests.core.examples import SMALL_WORLDS
from tests.core.naive_models import enumerate_paths, infinite_paths, random_model, sparse_from_dense, spectral_radius


def some_reward(mdp, seed=0, size=1.0):
    return np.random.default_rng(seed).normal(0.0, size, mdp.n_states)


@pytest.mark.parametrize("seed", range(8))
def test_it_is_the_sum_over_all_paths(seed):
    mdp = random_model(seed, n_states=4 + seed % 2, n_actions=2, n_terminal=1 + seed % 2, two_starts=seed % 2 == 0)
    reward = some_reward(mdp, seed)
    found = infer_path_sparse(mdp, reward, horizon=5, starts=mdp.starts)
    log_partition, visits, policy = enumerate_paths(mdp, reward, horizon=5)
    assert found.log_partition == pytest.approx(log_partition, abs=1e-12)
    np.testing.assert_allclose(found.visitation, visits, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.policy, policy, rtol=0, atol=1e-12)


@pytest.mark.parametrize("infinite", [False, True])
def test_the_visits_are_the_gradient_of_the_log_partition(infinite):
    mdp, h = random_model(2, n_states=7, n_terminal=2, two_starts=True), 1e-4
    reward = some_reward(mdp) - (3.0 if infinite else 0.0)

    def inferred(changed):
        if infinite:
            return infer_path_infinite_sparse(mdp, changed, starts=mdp.starts)
        return infer_path_sparse(mdp, changed, horizon=11, starts=mdp.starts)

    visits = inferred(reward).visitation
    for state in range(mdp.n_states):
        unit = np.arange(mdp.n_states) == state
        near, far = (inferred(reward + by * unit).log_partition for by in (h, 2 * h))
        back, far_back = (inferred(reward - by * unit).log_partition for by in (h, 2 * h))
        assert (8 * (near - back) - (far - far_back)) / (12 * h) == pytest.approx(visits[state], abs=1e-8)


@pytest.mark.parametrize("world", SMALL_WORLDS.values(), ids=SMALL_WORLDS)
@pytest.mark.parametrize("size", [1.0, 300.0])
def test_a_grid_written_out_gives_what_the_grid_gives(world, size):
    reward = some_reward(world, size=size)
    starts = world.mdp.starts
    found = infer_path_sparse(world.mdp.to_sparse(), reward, horizon=20, starts=starts)
    expected = infer_path_in_logs(world.mdp, reward, horizon=20, starts=starts)
    assert found.log_partition == pytest.approx(float(expected.log_z[world.start]), rel=1e-12)
    np.testing.assert_allclose(found.visitation, expected.visitation, rtol=0, atol=1e-9)
    np.testing.assert_allclose(found.policy, expected.policy, rtol=0, atol=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_paths_of_any_length_are_one_dense_solve(seed):
    mdp = random_model(seed, n_states=8, n_terminal=1 + seed % 3, two_starts=seed % 2 == 0)
    reward = some_reward(mdp, seed) - 3.0
    assert spectral_radius(mdp, reward) < 1.0
    log_partition, visits, policy = infinite_paths(mdp, reward)
    found = infer_path_infinite_sparse(mdp, reward, starts=mdp.starts)
    assert found.log_partition == pytest.approx(log_partition, abs=1e-10)
    np.testing.assert_allclose(found.visitation, visits, rtol=0, atol=1e-10)
    np.testing.assert_allclose(found.policy, policy, rtol=0, atol=1e-10)


@pytest.mark.parametrize("seed", range(4))
def test_many_steps_come_near_paths_of_any_length(seed):
    mdp = random_model(seed, n_states=8)
    reward = some_reward(mdp, seed) - 3.0
    limit = infer_path_infinite_sparse(mdp, reward, starts=mdp.starts)
    found = infer_path_sparse(mdp, reward, horizon=500, starts=mdp.starts)
    assert found.log_partition == pytest.approx(limit.log_partition, abs=1e-10)
    np.testing.assert_allclose(found.visitation, limit.visitation, atol=1e-9)


@given(seed=st.integers(0, 2**32), shift=st.floats(-0.3, 0.3))
@settings(max_examples=60, deadline=None)
def test_the_sum_is_infinite_exactly_where_the_spectral_radius_reaches_1(seed, shift):
    mdp = random_model(seed, n_states=7)
    reward = some_reward(mdp, seed)
    reward += shift - math.log(spectral_radius(mdp, reward))  # now ρ = e^shift
    if abs(shift) < 1e-9:
        return
    if shift > 0.0:
        with pytest.raises(DivergentPartition):
            infer_path_infinite_sparse(mdp, reward, starts=mdp.starts)
    else:
        assert (infer_path_infinite_sparse(mdp, reward, starts=mdp.starts).visitation >= 0.0).all()


def test_a_round_that_gains_is_found_whatever_its_length():
    """0 → 1 → 2 → 0, or from 2 to the end: going round earns 0.1."""
    T = np.zeros((4, 2, 4))
    T[0, :, 1] = T[1, :, 2] = T[2, 0, 0] = T[2, 1, 3] = 1.0
    mdp = sparse_from_dense(T, [False, False, False, True])
    reward = np.array([0.1, -math.log(2.0), -math.log(2.0), 0.0])
    with pytest.raises(DivergentPartition, match="Lower the reward"):
        infer_path_infinite_sparse(mdp, reward, starts=mdp.starts)
    found = infer_path_infinite_sparse(mdp, reward - [0.2, 0, 0, 0], starts=mdp.starts)
    assert found.visitation[0] == pytest.approx(1 / (1 - math.exp(-0.1)), rel=1e-9)


def test_by_hand_a_coin_that_is_tossed_until_it_falls():
    """Each toss ends with chance ½: Z = e^{r} ½ (e^{g} + Z), so Z = e^{r + g} / (2 − e^{r})."""
    T = np.array([[[0.5, 0.5]], [[0.0, 0.0]]])
    mdp, r, g = sparse_from_dense(T, [False, True]), -0.3, 1.2
    found = infer_path_infinite_sparse(mdp, np.array([r, g]), starts=mdp.starts)
    assert found.log_partition == pytest.approx(r + g - math.log(2 - math.exp(r)), abs=1e-14)
    np.testing.assert_allclose(found.visitation, [2 / (2 - math.exp(r)), 1.0], atol=1e-13)


def test_by_hand_luck_counts():
    """A lottery (a win of 4 with 10 %, else −2) against a sure 0: weights 0.1 e⁴ + 0.9 e⁻² against 1."""
    T = np.zeros((4, 2, 4))
    T[0, 0, [1, 2]] = 0.1, 0.9
    T[0, 1, 3] = 1.0
    mdp = sparse_from_dense(T, [False, True, True, True])
    lottery = 0.1 * math.exp(4.0) + 0.9 * math.exp(-2.0)
    found = infer_path_sparse(mdp, np.array([0.0, 4.0, -2.0, 0.0]), horizon=1, starts=mdp.starts)
    assert found.policy[0, 0] == pytest.approx(lottery / (lottery + 1), abs=1e-14)


@given(seed=st.integers(0, 2**32), size=st.sampled_from([1e-3, 1.0, 30.0, 1e3, 1e6]))
@settings(max_examples=40, deadline=None)
def test_any_finite_reward_gives_probabilities_and_no_nan(seed, size):
    mdp, rng = random_model(seed, n_states=9, n_terminal=2), np.random.default_rng(seed)
    reward = rng.uniform(-size, size, mdp.n_states)
    found = infer_path_sparse(mdp, reward, horizon=40, starts=mdp.starts)
    assert math.isfinite(found.log_partition)
    assert (found.policy >= 0.0).all()
    np.testing.assert_allclose(found.policy.sum(axis=1), 1.0, atol=1e-12)
    assert found.visitation[mdp.terminal].sum() == pytest.approx(1.0, abs=1e-9)
    assert found.visitation.sum() <= 41.0 + 1e-9
    try:
        infinite = infer_path_infinite_sparse(mdp, reward - size, starts=mdp.starts)
    except DivergentPartition:
        return
    assert infinite.visitation[mdp.terminal].sum() == pytest.approx(1.0, abs=1e-6)
    np.testing.assert_allclose(infinite.policy.sum(axis=1), 1.0, atol=1e-12)


@given(seed=st.integers(0, 2**32), by=st.floats(-3, 3))
@settings(max_examples=20, deadline=None)
def test_a_constant_at_the_ends_changes_the_log_partition_alone(seed, by):
    """Every path ends once: c at each terminal state multiplies every weight by e^c."""
    mdp = random_model(seed, n_states=7, n_terminal=2, two_starts=True)
    reward = some_reward(mdp, seed)
    here = infer_path_sparse(mdp, reward, horizon=9, starts=mdp.starts)
    there = infer_path_sparse(mdp, reward + by * mdp.terminal, horizon=9, starts=mdp.starts)
    assert there.log_partition == pytest.approx(here.log_partition + by, abs=1e-11)
    np.testing.assert_allclose(there.visitation, here.visitation, atol=1e-11)
    np.testing.assert_allclose(there.policy, here.policy, atol=1e-11)


def test_the_same_inputs_give_the_same_bits():
    mdp = random_model(1, n_states=30, n_terminal=3, reach=6)
    reward = some_reward(mdp)
    first, second = (infer_path_sparse(mdp, reward.copy(), horizon=50, starts=mdp.starts) for _ in range(2))
    assert first.log_partition == second.log_partition
    np.testing.assert_array_equal(first.visitation, second.visitation)
    np.testing.assert_array_equal(first.policy, second.policy)


def test_the_front_door_leads_to_every_kind():
    world = generate_world(2, rows=4, cols=4)
    sparse, reward = world.mdp.to_sparse(), np.full(16, -2.0)
    for kind in ("path", "path_infinite", "causal", "ziebart"):
        on_grid, written_out = infer(world, reward, inference=kind), infer(sparse, reward, inference=kind)
        assert written_out.inference == kind
        np.testing.assert_allclose(written_out.visitation, on_grid.visitation, atol=1e-9)
        np.testing.assert_allclose(written_out.policy, on_grid.policy, atol=1e-9)


def test_where_nothing_arrives_paths_are_refused():
    endless = sparse_from_dense(np.array([[[0.0, 1.0]], [[1.0, 0.0]]]), [False, False])
    with pytest.raises(InvalidModel, match="no terminal state") as refusal:
        infer_path_sparse(endless, np.zeros(2), horizon=5, starts=endless.starts)
    assert refusal.value.field == "terminal"
    with pytest.raises(InvalidModel, match="no terminal state"):
        infer_path_infinite_sparse(endless, np.zeros(2), starts=endless.starts)


def test_a_start_too_far_from_the_end_is_named():
    T = np.zeros((4, 1, 4))
    T[np.arange(3), 0, np.arange(1, 4)] = 1.0
    mdp = sparse_from_dense(T, np.arange(4) == 3, start=2)
    far = np.array([1.0, 0.0, 0.0, 0.0])
    with pytest.raises(InvalidModel, match="From state 0 no terminal state can be reached within 2 steps"):
        infer_path_sparse(mdp, np.zeros(4), horizon=2, starts=far)
    assert infer_path_sparse(mdp, np.zeros(4), horizon=3, starts=far).log_partition == pytest.approx(0.0, abs=1e-12)


def test_rewards_beyond_the_exponents_are_refused():
    mdp = random_model(0)
    with pytest.raises(InvalidReward, match=r"within ±1e\+12 .* it reaches -1e\+13"):
        infer_path_sparse(mdp, np.full(mdp.n_states, -1e13), horizon=5, starts=mdp.starts)


@given(seed=st.integers(0, 2**32), size=st.sampled_from([0.1, 1.0, 5.0]), reach=st.integers(1, 3))
@settings(max_examples=40, deadline=None)
def test_the_spectral_radius_is_the_largest_eigenvalue(seed, size, reach):
    mdp = random_model(seed, n_states=8, n_terminal=2, reach=reach)
    reward = some_reward(mdp, seed, size=size)
    assert spectral_radius_of(mdp, reward) == pytest.approx(spectral_radius(mdp, reward), rel=2e-6)


def test_by_hand_spectral_radii_of_a_round_and_of_none():
    """0 → 1 → 0 alternates, each with weight 1: ρ = √(e^{R₀} e^{R₁}). On a straight way nothing comes back."""
    T = np.zeros((3, 2, 3))
    T[0, 0, 1] = T[1, 0, 0] = T[1, 1, 2] = 1.0
    T[0, 1] = T[0, 0] = [0.0, 0.5, 0.5]
    mdp = sparse_from_dense(T, [False, False, True])
    assert spectral_radius_of(mdp, np.array([0.4, -3.0, 9.0])) == pytest.approx(math.exp(-1.3), rel=1e-6)
    assert spectral_radius_of(mdp, np.array([4000.0, 4000.0, 0.0])) == pytest.approx(math.exp(700), rel=1e-9)
    straight = np.zeros((3, 1, 3))
    straight[0, 0, 1] = straight[1, 0, 2] = 1.0
    assert spectral_radius_of(sparse_from_dense(straight, [False, False, True]), np.zeros(3)) == 0.0
