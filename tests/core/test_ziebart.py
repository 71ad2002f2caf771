"""Algorithm 1 to the letter: as written, and how far its visits are from the gradient."""

import numpy as np
import pytest

from irl_core import generate_world, infer
from irl_core.inference.ziebart import infer_ziebart
from irl_core.mdp import GridMdp
from tests.core.examples import SMALL_WORLDS, make_world
from tests.core.naive_models import random_model, ziebart


def some_reward(mdp, seed=0):
    return np.random.default_rng(seed).normal(0.0, 1.0, mdp.n_states)


@pytest.mark.parametrize("seed", range(5))
def test_it_is_the_algorithm_loop_by_loop(seed):
    mdp = random_model(seed, n_terminal=1 + seed % 2, two_starts=seed % 2 == 0)
    reward = some_reward(mdp, seed)
    found = infer_ziebart(mdp, reward, horizon=6, starts=mdp.starts)
    policy, visits, Z = ziebart(mdp, reward, horizon=6)
    np.testing.assert_allclose(found.policy, policy, atol=1e-12)
    np.testing.assert_allclose(found.visitation, visits, atol=1e-12)
    begun = mdp.starts > 0.0
    assert found.log_partition == pytest.approx(mdp.starts[begun] @ np.log(np.array(Z)[begun]), abs=1e-12)


@pytest.mark.parametrize("world", [SMALL_WORLDS["3x3 two goals slip"], SMALL_WORLDS["2x3 wall"]])
def test_grids_follow_it_too(world):
    reward = some_reward(world)
    found = infer_ziebart(world.mdp, reward, horizon=8, starts=world.mdp.starts)
    policy, visits, _ = ziebart(world.mdp.to_sparse(), reward, horizon=8)
    np.testing.assert_allclose(found.visitation, visits, atol=1e-12)
    np.testing.assert_allclose(found.policy, policy, atol=1e-12)


def test_its_visits_are_no_gradient():
    """On 3×3 with N = 6 and rewards of the world's kind they miss by up to half a visit and more."""
    errors = []
    for seed in range(20):
        mdp, reward = GridMdp(3, 3, (8,)), np.random.default_rng(seed).uniform(-2.0, 0.0, 9)
        exact = infer(mdp, reward, horizon=6).visitation
        errors.append(np.abs(infer_ziebart(mdp, reward, horizon=6, starts=mdp.starts).visitation - exact).max())
    assert 0.3 < np.median(errors) < 1.5
    assert min(errors) > 0.05


def test_with_slip_it_stays_off_however_many_steps():
    world = make_world(3, 3, slip=0.4)
    reward = np.full(9, -3.0)
    exact = infer(world.mdp, reward, horizon=300).visitation
    found = infer_ziebart(world.mdp, reward, horizon=300, starts=world.mdp.starts).visitation
    assert np.abs(found - exact).max() > 0.5


def test_without_slip_and_with_a_sum_that_converges_it_becomes_the_gradient():
    world = generate_world(8, rows=4, cols=4)
    reward = np.full(16, -2.5)
    exact = infer(world.mdp, reward, horizon=400).visitation
    found = infer_ziebart(world.mdp, reward, horizon=400, starts=world.mdp.starts).visitation
    np.testing.assert_allclose(found, exact, atol=1e-9)
