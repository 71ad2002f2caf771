"""Path inference without a horizon against a dense twin, splu, long horizons, differences and by hand."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import sparse
from scipy.sparse.linalg import splu

from irl_core import DivergentPartition, InvalidModel, InvalidReward, World, soft_plan, spectral_radius, visitation
from irl_core.inference import path_infinite
from irl_core.inference.path_infinite import diverges, infer_path_infinite, infer_path_infinite_batch
from irl_core.mdp.grid import GridMdp
from tests.core import naive_infinite


def spread(n_states, *states):
    """A start distribution, unequal over these states."""
    starts = np.zeros(n_states)
    starts[list(states)] = np.arange(1, len(states) + 1) / (len(states) * (len(states) + 1) / 2)
    return starts


GRIDS = {
    "3x3": GridMdp(3, 3, (8,)),
    "1x5": GridMdp(1, 5, (4,)),
    "5x1 goal in the middle": GridMdp(5, 1, (2,)),
    "4x6 walls and slip": GridMdp(4, 6, (23,), walls=(7, 8, 16), slip=0.3),
    "6x4 two goals, two starts": GridMdp(6, 4, (23, 3), walls=(9, 10), start=spread(24, 0, 20)),
    "5x5 rooms": GridMdp(5, 5, (24, 2), walls=(10, 11, 12, 13), start=spread(25, 0, 4)),
    "4x4 goals part it, one side unreached": GridMdp(4, 4, (2, 6, 10, 14)),
}


def some_reward(mdp, seed=0):
    """Rewards whose sum over paths is finite."""
    return -math.log(4.0) - np.random.default_rng(seed).exponential(0.7, mdp.n_states)


def infer(mdp, reward):
    return infer_path_infinite(mdp, reward, starts=mdp.starts)


@pytest.mark.parametrize("mdp", GRIDS.values(), ids=GRIDS)
@pytest.mark.parametrize("direct_width", [32, 0], ids=["LU", "lines"])
def test_both_solvers_agree_with_the_dense_twin(mdp, direct_width, monkeypatch):
    monkeypatch.setattr(path_infinite, "DIRECT_WIDTH", direct_width)
    reward = some_reward(mdp)
    found = infer(mdp, reward)
    log_z, visits = naive_infinite.solve(mdp, reward)
    begins = mdp.start_states
    assert found.log_partition == pytest.approx(mdp.starts[begins] @ log_z[begins], abs=1e-11)
    np.testing.assert_allclose(found.visitation, visits, rtol=0, atol=1e-10)
    np.testing.assert_allclose(found.policy.sum(axis=1), 1.0, atol=1e-12)


@pytest.mark.parametrize("slip", [0.0, 0.2])
def test_it_is_the_limit_of_long_horizons(slip):
    world = World(5, 5, -np.ones((5, 5)), 0, (24, 4), walls=(7, 12), slip=slip)
    reward = some_reward(world.mdp, seed=2)
    found, plan = infer(world.mdp, reward), soft_plan(world, reward, horizon=600)
    assert found.log_partition == pytest.approx(plan.log_partition, abs=1e-9)
    np.testing.assert_allclose(found.visitation, visitation(world, plan), rtol=0, atol=1e-9)
    np.testing.assert_allclose(found.policy, plan.policy, rtol=0, atol=1e-9)


@pytest.mark.parametrize("name", ["4x6 walls and slip", "6x4 two goals, two starts"])
def test_the_visits_are_the_gradient_of_the_log_partition(name):
    mdp, h = GRIDS[name], 1e-3
    reward = some_reward(mdp, seed=3)
    visits = infer(mdp, reward).visitation

    def log_z(state, by):
        return infer(mdp, reward + by * (np.arange(mdp.n_states) == state)).log_partition

    for s in range(mdp.n_states):
        slope = (8 * (log_z(s, h) - log_z(s, -h)) - (log_z(s, 2 * h) - log_z(s, -2 * h))) / (12 * h)
        assert slope == pytest.approx(visits[s], abs=1e-8)


def test_by_hand_a_corridor_of_three():
    """1×3, goal right: K = [[1/p − 3, −1], [−1, 1/p − 2]] with p = e^R, so z(0) = e^g / ((1/p − 3)(1/p − 2) − 1)."""
    mdp, g = GridMdp(1, 3, (2,)), 0.4
    found = infer(mdp, np.array([-math.log(5.0), -math.log(5.0), g]))
    assert found.log_partition == pytest.approx(g - math.log(2 * 3 - 1), abs=1e-14)
    # det K = 5: x = K⁻¹ (1/z(0), 0) = (3, 1) e^−g, z = (1, 2) e^g / 5, μ = 5 z x
    np.testing.assert_allclose(found.visitation, [3.0, 2.0, 1.0], atol=1e-13)


def test_a_large_grid_by_lines_agrees_with_splu():
    side = 80
    mdp = GridMdp(side, side, (side * side - 1,))
    rng = np.random.default_rng(0)
    n = mdp.n_states
    reward = -math.log(4.0) - np.where(rng.random(n) < 0.3, rng.uniform(0.5, 3.5, n), rng.uniform(0.02, 0.5, n))
    moves = sparse.coo_array((np.ones(4 * n), (np.repeat(np.arange(n), 4), mdp.next_states.reshape(-1))), shape=(n, n))
    K = (sparse.diags_array(np.exp(-reward)) - moves).tocsc()[:-1]
    lu = splu(K[:, :-1].tocsc())
    z = lu.solve(-K[:, [-1]].toarray().ravel() * np.exp(reward[-1]))
    x = lu.solve(np.eye(1, n - 1).ravel() / z[0])
    found = infer(mdp, reward)
    assert found.log_partition == pytest.approx(np.log(z[0]), abs=1e-10)
    np.testing.assert_allclose(found.visitation[:-1], np.exp(-reward[:-1]) * z * x, rtol=0, atol=1e-9)


def test_lines_and_lu_agree_to_1e_9_with_walls_goals_and_starts(monkeypatch):
    rng = np.random.default_rng(5)
    walls = tuple(s for s in range(1, 1599) if rng.random() < 0.2)
    begins = [s for s in (0, 700, 39) if s not in walls]
    mdp = GridMdp(40, 40, (1599, 820), tuple(w for w in walls if w != 820), start=spread(1600, *begins))
    reward = some_reward(mdp, seed=6)
    if not np.isfinite(_log_z_somewhere(mdp, reward)):
        pytest.fail("the drawn walls close a start in; draw others")
    by_lines = infer(mdp, reward)
    monkeypatch.setattr(path_infinite, "DIRECT_WIDTH", 64)
    by_lu = infer(mdp, reward)
    assert by_lines.log_partition == pytest.approx(by_lu.log_partition, abs=1e-9)
    np.testing.assert_allclose(by_lines.visitation, by_lu.visitation, rtol=0, atol=1e-9)
    np.testing.assert_allclose(by_lines.policy, by_lu.policy, rtol=0, atol=1e-9)


def _log_z_somewhere(mdp, reward):
    try:
        return infer(mdp, reward).log_partition
    except InvalidModel:
        return math.nan


def test_a_maze_far_beyond_the_range_of_floats_is_solved():
    """A serpentine of 31×33: some 500 steps at −20 each; every square of it is visited, the goal once."""
    rows, cols = 33, 31
    walls = tuple(r * cols + c for r in range(1, rows, 2) for c in range(cols) if c != (cols - 1 if r % 4 == 1 else 0))
    mdp = GridMdp(rows, cols, (rows * cols - 1,), walls)
    found = infer(mdp, np.full(mdp.n_states, -20.0))
    assert found.log_partition < -9000
    assert found.visitation[-1] == pytest.approx(1.0, abs=1e-10)
    free = np.setdiff1d(np.arange(mdp.n_states), walls)
    assert (found.visitation[free] > 1.0 - 1e-10).all()


@given(seed=st.integers(0, 2**32), rows=st.integers(1, 6), cols=st.integers(2, 6), level=st.floats(-1.5, -0.5))
@settings(max_examples=40, deadline=None)
def test_the_divergence_test_is_the_spectral_radius(seed, rows, cols, level):
    rng = np.random.default_rng(seed)
    mdp = GridMdp(rows, cols, (rows * cols - 1,))
    reward = level + rng.normal(0.0, 0.5, mdp.n_states)
    radius = spectral_radius(mdp, reward)
    reward[:-1] -= math.log(radius) + (0.0 if seed % 3 else rng.uniform(-1e-3, 1e-3))  # now ρ is near 1, or 1
    radius = spectral_radius(mdp, reward)
    if abs(radius - 1.0) > 1e-10:
        assert diverges(mdp, reward) == (radius >= 1.0)


def test_a_reward_of_zero_is_refused_with_its_spectral_radius_and_a_way_out():
    with pytest.raises(DivergentPartition, match="−log 4") as refusal:
        infer(GRIDS["3x3"], np.zeros(9))
    assert refusal.value.spectral_radius == pytest.approx(spectral_radius(GRIDS["3x3"], np.zeros(9)))


def test_a_large_grid_that_diverges_is_refused(monkeypatch):
    mdp = GridMdp(34, 34, (1155,))
    with pytest.raises(DivergentPartition):
        infer(mdp, np.full(1156, -1.2))
    monkeypatch.setattr(path_infinite, "DIRECT_NUMBERS", 0)
    with pytest.raises(DivergentPartition, match="did not settle"):
        infer(mdp, np.full(1156, -1.38))


@given(
    seed=st.integers(0, 2**32),
    shape=st.tuples(st.integers(1, 12), st.integers(2, 12)),
    top=st.sampled_from([1e3, 0.0, -1.5]),
)
@settings(max_examples=60, deadline=None)
def test_any_finite_reward_diverges_or_gives_finite_numbers(seed, shape, top):
    rows, cols = shape
    mdp = GridMdp(rows, cols, (rows * cols - 1,))
    reward = np.random.default_rng(seed).uniform(-1e3, top, mdp.n_states)
    try:
        found = infer(mdp, reward)
    except DivergentPartition:
        assert top > -math.log(4.0)
        return
    assert math.isfinite(found.log_partition)
    assert np.isfinite(found.visitation).all()
    assert found.visitation[-1] == pytest.approx(1.0, abs=1e-9)
    np.testing.assert_allclose(found.policy.sum(axis=1), 1.0, atol=1e-12)


def test_a_batch_is_its_worlds_one_by_one():
    rng = np.random.default_rng(1)
    kinds = [
        GridMdp(5, 4, (19,)),
        GridMdp(5, 4, (3, 19), walls=(9, 10), slip=0.4),
        GridMdp(5, 4, (19,), start=spread(20, 1, 7)),
    ]
    mdps = [kinds[k % 3] for k in range(75)]
    rewards = -math.log(4.0) - rng.exponential(0.5, (75, 20))
    rewards[40] = rng.uniform(-900.0, -300.0, 20)  # beyond plain floats: solved apart
    starts = np.stack([mdp.starts for mdp in mdps])
    batch = infer_path_infinite_batch(mdps, rewards, starts=starts)
    for k, mdp in enumerate(mdps):
        one = infer(mdp, rewards[k])
        assert batch.log_partition[k] == pytest.approx(one.log_partition, abs=1e-11)
        np.testing.assert_allclose(batch.visitation[k], one.visitation, rtol=0, atol=1e-11)
        np.testing.assert_allclose(batch.policy[k], one.policy, rtol=0, atol=1e-11)


def test_a_batch_names_the_worlds_that_diverge():
    mdps, rewards = [GridMdp(3, 3, (8,))] * 40, np.full((40, 9), -2.0)
    rewards[[7, 33]] = 0.0
    with pytest.raises(DivergentPartition, match=r"World 7, 2 worlds of the batch in all: \[7, 33\]"):
        infer_path_infinite_batch(mdps, rewards, starts=np.stack([mdp.starts for mdp in mdps]))


def test_squares_no_start_leads_to_may_diverge_and_have_a_uniform_policy():
    mdp = GRIDS["4x4 goals part it, one side unreached"]
    reward = np.full(16, -2.0)
    reward[[3, 7, 11, 15]] = 5.0
    found = infer(mdp, reward)
    np.testing.assert_array_equal(found.policy[[3, 7, 11, 15]], 0.25)
    np.testing.assert_array_equal(found.visitation[[3, 7, 11, 15]], 0.0)


def test_bad_input_is_refused_by_name():
    closed = GridMdp(3, 3, (8,), walls=(1, 3, 4), start=spread(9, 0, 2))
    with pytest.raises(InvalidModel, match="walled off"):
        infer(closed, np.full(9, -3.0))
    with pytest.raises(InvalidReward, match="finite"):
        infer(GRIDS["3x3"], np.full(9, np.nan))
