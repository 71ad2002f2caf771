"""Returns, visits, episodes and best plans in discrete models, against formulas written out, grids, and by hand."""

import math

import numpy as np
import pytest

from irl_core import expected_return, expected_visits, generate_world, greedy_plan, optimal_plan, optimum, rollouts
from irl_core.mdp import SparseMdp
from tests.core.naive_models import dense, random_model, sparse_from_dense


def some_policy(mdp, seed=0):
    return np.random.default_rng(seed).dirichlet(np.ones(mdp.n_actions), size=mdp.n_states)


def paying(world):
    """The world as a discrete model that pays what its squares pay."""
    grid = world.mdp.to_sparse()
    return SparseMdp(
        grid.indptr, grid.indices, grid.probabilities, grid.n_states, 4, world.reward[grid.indices], grid.terminal,
        grid.start, horizon=grid.horizon,
    )  # fmt: skip


@pytest.mark.parametrize("seed", range(4))
def test_the_return_is_the_formula_s(seed):
    mdp = random_model(seed, two_starts=True, horizon=7)
    policy, T, V = some_policy(mdp, seed), dense(mdp), np.zeros(mdp.n_states)
    for _ in range(7):
        V = np.where(mdp.terminal, 0.0, (policy * (mdp.pays + T @ V)).sum(axis=1))
    assert expected_return(mdp, policy) == pytest.approx(mdp.starts @ V, abs=1e-12)


@pytest.mark.parametrize("discount", [1.0, 0.9])
def test_visits_follow_the_chain(discount):
    mdp = random_model(1, two_starts=True)
    policy = some_policy(mdp)
    law = np.einsum("sa,sat->st", policy, dense(mdp))
    expected = sum(discount**t * mdp.starts @ np.linalg.matrix_power(law, t) for t in range(10))
    np.testing.assert_allclose(expected_visits(mdp, policy, horizon=9, discount=discount), expected, atol=1e-12)


@pytest.mark.parametrize("slip", [0.0, 0.25])
def test_a_grid_written_out_is_measured_as_the_grid(slip):
    world = generate_world(3, rows=5, cols=4, slip=slip)
    mdp, learned = paying(world), np.random.default_rng(0).normal(size=20)
    policy = some_policy(mdp)
    assert expected_return(mdp, policy) == pytest.approx(expected_return(world, policy), abs=1e-9)
    np.testing.assert_allclose(expected_visits(mdp, policy), expected_visits(world, policy), atol=1e-12)
    assert optimum(mdp) == pytest.approx(optimum(world), abs=1e-12)
    there, here = greedy_plan(mdp, learned), greedy_plan(world, learned)
    np.testing.assert_allclose(there.values, here.values, rtol=1e-12, atol=1e-9)
    assert expected_return(mdp, there) == pytest.approx(expected_return(world, here), abs=1e-9)
    np.testing.assert_allclose(expected_visits(mdp, there), expected_visits(world, here), atol=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_no_policy_earns_more_than_the_best_plan(seed):
    mdp = random_model(seed, n_states=8)
    best = optimum(mdp)
    assert best == pytest.approx(expected_return(mdp, optimal_plan(mdp)), abs=1e-12)
    assert all(expected_return(mdp, some_policy(mdp, other)) <= best + 1e-12 for other in range(5))


def test_by_hand_a_detour_pays_unless_one_must_arrive():
    """0: stay for 1, or end for 0. In three steps staying earns 3; who must arrive stays twice."""
    mdp = sparse_from_dense(
        np.array([[[1.0, 0.0], [0.0, 1.0]], np.zeros((2, 2))]), [False, True], pays=[[1.0, 0.0], [0.0, 0.0]], horizon=3
    )
    assert optimum(mdp) == 3.0
    greedy = greedy_plan(mdp, np.array([1.0, 0.0]))
    assert greedy.actions[:, 0].tolist() == [1, 0, 0]
    assert expected_return(mdp, greedy) == 2.0


def test_episodes_earn_on_average_what_is_expected():
    mdp = random_model(2, two_starts=True, horizon=12)
    policy = some_policy(mdp)
    played = rollouts(mdp, policy, 20_000, np.random.default_rng(1))
    totals = np.array([one.total for one in played])
    error = totals.std() / math.sqrt(len(totals))
    assert totals.mean() == pytest.approx(expected_return(mdp, policy), abs=4 * error)
    visits = np.bincount([s for one in played for s in one.states], minlength=mdp.n_states) / len(played)
    np.testing.assert_allclose(visits, expected_visits(mdp, policy), atol=0.06)


def test_episodes_are_possible_and_end_at_the_end():
    mdp = random_model(5, horizon=9)
    T = dense(mdp).sum(axis=1)
    for one in rollouts(mdp, some_policy(mdp), 200, np.random.default_rng(0)):
        assert all(T[s, t] > 0.0 for s, t in zip(one.states, one.states[1:], strict=False))
        assert not mdp.terminal[list(one.states[:-1])].any()
        assert one.reached_goal == bool(mdp.terminal[one.states[-1]])
        assert one.reached_goal or len(one.states) == 10


def test_episodes_are_those_of_their_seed_and_plans_can_be_played():
    mdp = random_model(4)
    plan = optimal_plan(mdp)
    first, second = (rollouts(mdp, plan, 20, np.random.default_rng(7)) for _ in range(2))
    assert first == second


def test_what_happened_is_paid_not_what_was_expected():
    """A lottery pays 10 or nothing; no episode earns 1."""
    mdp = SparseMdp(
        np.array([0, 2, 2, 2]), np.array([1, 2]), np.array([0.1, 0.9]), 3, 1, np.array([10.0, 0.0]),
        np.array([False, True, True]), 0, horizon=1,
    )  # fmt: skip
    totals = {one.total for one in rollouts(mdp, np.ones((3, 1)), 200, np.random.default_rng(0))}
    assert totals == {0.0, 10.0}
    assert expected_return(mdp, np.ones((3, 1))) == pytest.approx(1.0)
