"""Finite-horizon path inference against all paths added up, finite differences, a solver in logs, and by hand."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from irl_core import InvalidWorld, generate_world
from irl_core.errors import InvalidModel
from irl_core.inference import path
from irl_core.inference.path import infer_path, infer_path_batch
from irl_core.inference.path_log import infer_path_in_logs
from irl_core.mdp import GridMdp
from tests import naive

TWO_STARTS = np.array([0.25, 0, 0, 0.75, 0, 0, 0, 0, 0])
SMALL = {
    "2x2": (GridMdp(2, 2, (3,)), 7),
    "1x4": (GridMdp(1, 4, (3,), start=1), 7),
    "4x1, slip": (GridMdp(4, 1, (0,), slip=0.5, start=3), 4),
    "2x3, wall": (GridMdp(2, 3, (5,), walls=(1,)), 6),
    "3x3": (GridMdp(3, 3, (8,)), 6),
    "3x3, slip": (GridMdp(3, 3, (8,), slip=0.3), 4),
    "3x3, two goals, wall": (GridMdp(3, 3, (2, 8), walls=(4,)), 6),
    "3x3, two starts": (GridMdp(3, 3, (8,), start=TWO_STARTS), 6),
    "3x3, two goals, two starts, slip": (GridMdp(3, 3, (2, 8), slip=0.3, start=TWO_STARTS), 4),
    "3x3, a pocket": (GridMdp(3, 3, (6,), walls=(1, 5)), 6),  # square 2 sees no goal
}
small_worlds = pytest.mark.parametrize(("mdp", "horizon"), SMALL.values(), ids=SMALL)


def some_reward(mdp, *, seed=0, size=1.5):
    return np.random.default_rng(seed).normal(-0.5, size, mdp.n_states)


def infer_own(mdp, reward, *, horizon=None, step_policies=False):
    return infer_path(mdp, reward, horizon=horizon or mdp.horizon, starts=mdp.starts, step_policies=step_policies)


@small_worlds
def test_log_partition_and_visits_are_those_of_all_paths_added_up(mdp, horizon):
    reward = some_reward(mdp)
    found = infer_own(mdp, reward, horizon=horizon)
    log_partition, visits = 0.0, np.zeros(mdp.n_states)
    for start in mdp.start_states:
        paths = naive.enumerate_paths(mdp, reward, start=start, horizon=horizon)
        log_partition += mdp.starts[start] * paths.log_partition
        visits += mdp.starts[start] * paths.visits
    assert found.log_partition == pytest.approx(log_partition, abs=1e-12)
    np.testing.assert_allclose(found.visitation, visits, rtol=0, atol=1e-12)


@small_worlds
def test_each_policy_is_the_first_action_of_all_paths_from_every_square(mdp, horizon):
    reward = some_reward(mdp, seed=1)
    found = infer_own(mdp, reward, horizon=horizon, step_policies=True)
    assert found.step_policies.shape == (horizon, mdp.n_states, 4)
    np.testing.assert_array_equal(found.policy, found.step_policies[-1])
    for n in (1, 2, horizon):
        for s in range(mdp.n_states):
            first_action = np.full(4, 0.25)
            if s not in mdp.goals and s not in mdp.walls:
                first_action = naive.enumerate_paths(mdp, reward, start=s, horizon=n).first_action
            np.testing.assert_allclose(found.step_policies[n - 1, s], first_action, rtol=0, atol=1e-12)


@small_worlds
def test_the_visits_are_the_gradient_of_the_log_partition(mdp, horizon):
    reward, h = some_reward(mdp, seed=2), 1e-4
    visits = infer_own(mdp, reward, horizon=horizon).visitation

    def log_z(state, by):
        return infer_own(mdp, reward + by * (np.arange(mdp.n_states) == state), horizon=horizon).log_partition

    for s in range(mdp.n_states):  # five points: the error is of order h⁴, below rounding
        slope = (8 * (log_z(s, h) - log_z(s, -h)) - (log_z(s, 2 * h) - log_z(s, -2 * h))) / (12 * h)
        assert slope == pytest.approx(visits[s], abs=1e-8)


@pytest.mark.parametrize("slip", [0.0, 0.25])
def test_a_7x7_world_agrees_with_the_dense_twin(slip):
    mdp = generate_world(11, slip=slip).mdp
    reward = some_reward(mdp)
    log_partition, visits = naive.dense_gradient(mdp, reward, horizon=mdp.horizon)
    found = infer_own(mdp, reward)
    assert found.log_partition == pytest.approx(log_partition, rel=1e-13)
    np.testing.assert_allclose(found.visitation, visits, rtol=1e-12, atol=1e-12)


def test_by_hand_a_2x2_world_with_two_steps():
    """From square 0 two paths of two steps reach square 3: right-down (e^{b}) and down-right (e^{c})."""
    a, b, c, d = -0.5, -1.0, -2.0, 0.3
    found = infer_own(GridMdp(2, 2, (3,)), np.array([a, b, c, d]), horizon=2)
    both = math.exp(b) + math.exp(c)
    assert found.log_partition == pytest.approx(a + d + math.log(both), abs=1e-15)
    np.testing.assert_allclose(found.policy[0], [0, math.exp(b) / both, math.exp(c) / both, 0], atol=1e-15)
    np.testing.assert_allclose(found.visitation, [1, math.exp(b) / both, math.exp(c) / both, 1], atol=1e-15)


def test_by_hand_a_corridor_with_one_way_and_slip():
    """Two squares: the goal is one step right, every other direction leads back; N = 2 allows one step of waiting."""
    a = -1.0
    found = infer_own(GridMdp(1, 2, (1,), slip=0.3), np.array([a, 0.0]), horizon=2)
    assert found.log_partition == pytest.approx(a + math.log(1 + 3 * math.exp(a)), abs=1e-15)
    waits = 3 * math.exp(a) / (1 + 3 * math.exp(a))
    np.testing.assert_allclose(found.visitation, [1 + waits, 1], atol=1e-15)
    right = 0.7 * (1 - waits) + 0.1 * waits
    np.testing.assert_allclose(found.policy[0], [(1 - right) / 3, right, (1 - right) / 3, (1 - right) / 3], atol=1e-15)


def grids():
    """Grids of up to 12×12 with walls, up to three goals, slip and up to three starts; each start sees a goal."""
    return st.builds(random_grid, st.integers(0, 2**32), st.integers(1, 12), st.integers(1, 12)).filter(bool)


def random_grid(seed, rows, cols):
    rng = np.random.default_rng(seed)
    squares = rng.permutation(rows * cols).tolist()
    n_goals, n_starts = rng.integers(1, 4, 2)
    n_walls = rng.integers(0, rows * cols // 4 + 1)
    starts = np.zeros(rows * cols)
    begun = squares[n_goals + n_walls :][:n_starts]
    if not begun:
        return None
    starts[begun] = rng.dirichlet(np.ones(len(begun)))
    goals, walls = tuple(squares[:n_goals]), tuple(squares[n_goals : n_goals + n_walls])
    try:
        mdp = GridMdp(rows, cols, goals, walls, slip=float(rng.choice([0.0, 0.3])), start=starts)
    except InvalidModel:  # the walls close the way
        return None
    return mdp if sees_a_goal(mdp) else None


def sees_a_goal(mdp):
    found = infer_path_in_logs(mdp, np.zeros(mdp.n_states), horizon=mdp.horizon, starts=mdp.starts)
    return np.isfinite(found.log_z[mdp.start_states]).all()


@given(mdp=grids(), size=st.sampled_from([1e-3, 1.0, 10.0, 100.0, 1e3]), seed=st.integers(0, 2**32))
@settings(max_examples=60, deadline=None)
def test_any_finite_reward_gives_probabilities_and_no_nan(mdp, size, seed):
    reward = np.random.default_rng(seed).uniform(-size, size, mdp.n_states)
    found = infer_own(mdp, reward, step_policies=True)
    assert math.isfinite(found.log_partition)
    for policy in (found.policy, found.step_policies):
        assert (policy >= 0).all()
        np.testing.assert_allclose(policy.sum(axis=-1), 1.0, atol=1e-12)
    assert found.visitation[mdp.terminal].sum() == pytest.approx(1.0, abs=1e-9)
    assert (found.visitation >= 0).all()
    assert found.visitation.sum() <= mdp.horizon + 1 + 1e-6
    assert (found.visitation[mdp.blocked] == 0).all()


@given(mdp=grids(), size=st.sampled_from([0.1, 1.0, 10.0, 100.0]), seed=st.integers(0, 2**32), times=st.integers(1, 3))
@settings(max_examples=60, deadline=None)
def test_plain_numbers_and_logs_find_the_same(mdp, size, seed, times):
    reward = np.random.default_rng(seed).uniform(-size, size, mdp.n_states)
    horizon = times * mdp.horizon
    found = infer_path(mdp, reward, horizon=horizon, starts=mdp.starts, step_policies=True)
    logs = infer_path_in_logs(mdp, reward, horizon=horizon, starts=mdp.starts, step_policies=True)
    begun = mdp.start_states
    assert found.log_partition == pytest.approx(mdp.starts[begun] @ logs.log_z[begun], rel=1e-12, abs=1e-12)
    np.testing.assert_allclose(found.policy, logs.policy, rtol=0, atol=1e-9)
    assert found.step_policies is not None
    assert logs.step_policies is not None
    np.testing.assert_allclose(found.step_policies, logs.step_policies, rtol=0, atol=1e-9)
    np.testing.assert_allclose(found.visitation, logs.visitation, rtol=1e-9, atol=1e-9)


@given(mdp=grids(), seed=st.integers(0, 2**32))
@settings(max_examples=25, deadline=None)
def test_turning_a_world_over_turns_over_what_is_found(mdp, seed):
    shape = (mdp.rows, mdp.cols)
    reward = some_reward(mdp, seed=seed)
    found = infer_own(mdp, reward)
    turned = np.arange(mdp.n_states).reshape(shape).T.ravel()  # square i of the turned grid was turned[i]
    place = np.argsort(turned)
    goals, walls = (tuple(place[list(squares)].tolist()) for squares in (mdp.goals, mdp.walls))
    twin = GridMdp(mdp.cols, mdp.rows, goals, walls, slip=mdp.slip, start=mdp.starts[turned], horizon=mdp.horizon)
    again = infer_own(twin, reward[turned])
    assert again.log_partition == pytest.approx(found.log_partition, rel=1e-13, abs=1e-13)
    np.testing.assert_allclose(again.visitation, found.visitation[turned], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(again.policy, found.policy[turned][:, [3, 2, 1, 0]], rtol=1e-12, atol=1e-12)


@given(seed=st.integers(0, 2**32), n_worlds=st.integers(1, 20), size=st.sampled_from([1.0, 30.0, 1e3]))
@settings(max_examples=25, deadline=None)
def test_a_batch_finds_what_its_worlds_find_alone(seed, n_worlds, size):
    rng = np.random.default_rng(seed)
    mdps = [generate_world(int(s), rows=4, cols=5, slip=float(rng.choice([0, 0.2]))).mdp for s in range(n_worlds)]
    mdps[0] = GridMdp(4, 5, (19, 4), walls=(7, 13), start=2)
    rewards = rng.uniform(-size, size, (n_worlds, 20))
    starts = np.stack([mdp.starts for mdp in mdps])
    found = infer_path_batch(mdps, rewards, horizon=40, starts=starts)
    for b, mdp in enumerate(mdps):
        alone = infer_path(mdp, rewards[b], horizon=40, starts=starts[b])
        assert found.log_partition[b] == pytest.approx(alone.log_partition, rel=1e-14)
        np.testing.assert_allclose(found.policy[b], alone.policy, rtol=1e-13, atol=1e-15)
        np.testing.assert_allclose(found.visitation[b], alone.visitation, rtol=1e-13, atol=1e-15)


def test_one_grid_serves_a_whole_batch_of_any_size(monkeypatch):
    mdp = generate_world(4).mdp
    rewards = np.random.default_rng(0).normal(-1, 1, (30, 49))
    starts = np.tile(mdp.starts, (30, 1))
    whole = infer_path_batch([mdp] * 30, rewards, horizon=60, starts=starts)
    monkeypatch.setattr(path, "_CHUNK", 7)
    once = infer_path_batch([mdp], rewards, horizon=60, starts=starts)
    for field in ("log_partition", "policy", "visitation"):
        np.testing.assert_array_equal(getattr(once, field), getattr(whole, field))


def test_grids_of_two_shapes_make_no_batch():
    mdps = [GridMdp(2, 3, (5,)), GridMdp(3, 2, (5,))]
    with pytest.raises(InvalidModel, match="2 grids of one shape"):
        infer_path_batch(mdps, np.zeros((2, 6)), horizon=6, starts=np.eye(6)[:2])


@pytest.mark.parametrize("horizon", [1, 2, 3, 50, 200])
def test_keeping_only_every_so_many_steps_changes_no_bit(monkeypatch, horizon):
    mdp = GridMdp(5, 6, (1, 29), walls=(8, 9), slip=0.1)
    reward = some_reward(mdp, size=3.0)
    whole = infer_own(mdp, reward, horizon=horizon, step_policies=True)
    monkeypatch.setattr(path, "_ROW_BYTES", 0)
    thrifty = infer_own(mdp, reward, horizon=horizon, step_policies=True)
    assert whole.log_partition == thrifty.log_partition
    np.testing.assert_array_equal(whole.visitation, thrifty.visitation)
    np.testing.assert_array_equal(whole.step_policies, thrifty.step_policies)


def test_the_same_inputs_give_the_same_bits_again():
    mdp = generate_world(8, rows=9, cols=11, slip=0.1).mdp
    first, again = (infer_own(mdp, some_reward(mdp)) for _ in range(2))
    assert first.log_partition == again.log_partition
    np.testing.assert_array_equal(first.visitation, again.visitation)


def test_a_large_world_with_a_long_horizon_neither_underflows_nor_needs_logs(monkeypatch):
    monkeypatch.setattr(path, "infer_path_in_logs", None)
    world = generate_world(3, rows=60, cols=60)
    found = infer_own(world.mdp, world.reward - 7.0)
    assert found.log_partition < -730  # 1e-317 in plain numbers
    assert found.visitation[world.goal] == pytest.approx(1.0, abs=1e-10)


def test_what_plain_numbers_cannot_hold_goes_to_logs(monkeypatch):
    calls = []

    def in_logs(*arguments, **named):
        calls.append(arguments)
        return infer_path_in_logs(*arguments, **named)

    monkeypatch.setattr(path, "infer_path_in_logs", in_logs)
    mdp = generate_world(2).mdp
    for reward in (np.full(49, -700.0), np.full(49, 200.0), np.full(49, -100.0)):
        found = infer_own(mdp, reward)
        assert found.visitation[48] == pytest.approx(1.0, abs=1e-9)
    assert len(calls) == 3


def test_no_warning_and_no_nan_where_walls_have_any_reward():
    mdp = GridMdp(3, 3, (8,), walls=(4,))
    reward = np.zeros(9)
    plain = infer_own(mdp, reward)
    reward[4] = 1e300
    np.testing.assert_array_equal(infer_own(mdp, reward).visitation, plain.visitation)


@pytest.mark.parametrize("inside", [True, False])
def test_a_start_without_a_way_in_time_is_refused(inside):
    mdp = GridMdp(3, 3, (8,), walls=() if inside else (1, 4, 5), start=0 if inside else np.eye(9)[[0, 2]].sum(0) / 2)
    with pytest.raises(InvalidModel, match=r"From state \d no goal can be reached within"):
        infer_path(mdp, np.zeros(9), horizon=3 if inside else 9, starts=mdp.starts)
    assert issubclass(InvalidWorld, InvalidModel)


def test_what_is_found_cannot_be_changed():
    found = infer_own(GridMdp(2, 2, (3,)), np.zeros(4))
    with pytest.raises(ValueError, match="read-only"):
        found.policy[0, 0] = 1.0


def test_the_kernel_is_compiled_once_whatever_the_arrays_are():
    from irl_core import _kernels

    world = generate_world(1)
    infer_own(world.mdp, world.reward)  # read-only
    infer_own(world.mdp, world.reward.copy())
    infer_path_batch([world.mdp], np.asfortranarray(np.tile(world.reward, (3, 1))), horizon=50, starts=np.eye(49)[:3])
    assert len(getattr(_kernels.stencil.path_gradient, "signatures", [1])) == 1
