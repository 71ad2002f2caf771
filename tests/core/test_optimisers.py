"""Exact optimisers, other inference and other features: the same problem, reached by another way."""

import json
import math

import numpy as np
import pytest

from irl_core import (
    LEARNERS,
    GridMdp,
    ImpossibleDemonstration,
    InvalidFeatures,
    InvalidModel,
    LearningProblem,
    LearningState,
    Outcome,
    Ranking,
    Settings,
    demonstration_of,
    infer,
    learn,
)
from irl_core.learners import optimisers
from tests.core.examples import DOWN, RIGHT, make_problem, make_world
from tests.core.test_learners import run, small_problem


def quadratic(weights):
    """½ wᵀAw − b·w; its minimum is A⁻¹b."""
    A, b = np.array([[3.0, 1.0, 0.0], [1.0, 2.0, 0.5], [0.0, 0.5, 1.0]]), np.array([1.0, -2.0, 0.5])
    return float(weights @ A @ weights / 2 - b @ weights), A @ weights - b


MINIMUM = np.linalg.solve([[3.0, 1.0, 0.0], [1.0, 2.0, 0.5], [0.0, 0.5, 1.0]], [1.0, -2.0, 0.5])


def test_newton_solves_a_quadratic_in_one_step():
    moved = optimisers.step("newton", quadratic, {"w_success": np.zeros(3)})
    np.testing.assert_allclose(moved["w_success"], MINIMUM, atol=1e-7)


def test_lbfgs_solves_a_quadratic_in_a_few_steps():
    values: dict[str, np.ndarray | float] = {"w_success": np.zeros(3)}
    for _ in range(12):
        values = optimisers.step("lbfgs", quadratic, values)
    np.testing.assert_allclose(values["w_success"], MINIMUM, atol=1e-7)


def test_a_step_never_leaves_the_finite_region():
    """With f = −log(1 − w) + … a full Newton step from far off would leave w < 1."""

    def barrier(weights):
        w = float(weights[0])
        return (math.inf, np.zeros(1)) if w >= 1 else (-math.log(1 - w) - 50 * w, np.array([1 / (1 - w) - 50]))

    for name in ("newton", "lbfgs"):
        values: dict[str, np.ndarray | float] = {"w_success": np.array([-3.0])}
        for _ in range(60):
            values = optimisers.step(name, barrier, values)
            assert np.max(values["w_success"]) < 1
        np.testing.assert_allclose(values["w_success"], 1 - 1 / 50, atol=1e-5)


@pytest.mark.parametrize("name", ["meirl", "irlr"])
def test_newton_lbfgs_and_the_descent_come_to_the_same_reward(name):
    """With a ridge the minimum is unique."""
    rewards = [
        learn(name, small_problem(optimiser=optimiser, l2=0.1, tolerance=1e-7, learning_rate=0.3, iterations=3000))
        for optimiser in ("newton", "lbfgs", "descent")
    ]
    assert {one.outcome for one in rewards} == {Outcome.CONVERGED}
    newton, lbfgs, descent = rewards
    assert newton.iterations < lbfgs.iterations < descent.iterations
    assert newton.iterations <= 15
    np.testing.assert_allclose(newton.reward, descent.reward, atol=1e-6)
    np.testing.assert_allclose(lbfgs.reward, descent.reward, atol=1e-6)


def test_without_a_ridge_newton_still_matches_the_successes_fast():
    result = learn("irlr", make_problem(optimiser="newton", tolerance=1e-6))
    assert (result.outcome, result.gap < 1e-6) == (Outcome.CONVERGED, True)
    assert result.iterations < 40


@pytest.mark.parametrize("name", ["irlf", "irlfr"])
def test_learners_from_failure_descend_whatever_the_optimiser(name):
    plain, asked = (
        learn(name, small_problem(iterations=20)),
        learn(name, small_problem(iterations=20, optimiser="newton")),
    )
    np.testing.assert_array_equal(plain.reward, asked.reward)


@pytest.mark.parametrize("optimiser", ["newton", "lbfgs"])
def test_an_optimiser_in_pieces_and_through_json_is_the_uninterrupted_one_bit_for_bit(optimiser):
    problem = small_problem(optimiser=optimiser, l2=0.1, iterations=12, tolerance=1e-12)
    whole, pieces = run("irlr", problem), run("irlr", problem, chunk=2, through_json=True)
    assert whole.to_json() == pieces.to_json()


@pytest.mark.parametrize("inference", ["path", "path_infinite", "causal", "ziebart"])
@pytest.mark.parametrize("name", ["meirl", "irlr", "irlf", "irlfr"])
def test_every_inference_can_be_learned_with(name, inference):
    problem = small_problem(inference=inference, iterations=60, learning_rate=0.05, lambda_min=10.0, discount=0.95)
    result = learn(name, problem)
    assert result.outcome in {Outcome.ITERATION_LIMIT, Outcome.CONVERGED}
    assert np.isfinite(result.reward).all()
    first = LEARNERS[name].frame(problem, LEARNERS[name].start(problem))
    assert result.gap < first.gap


def test_paths_of_any_length_start_where_their_sum_is_finite_and_agree_with_a_long_horizon():
    infinite = small_problem(inference="path_infinite", optimiser="newton", l2=0.1, tolerance=1e-9)
    result = learn("irlr", infinite)
    assert result.outcome is Outcome.CONVERGED
    assert result.spectral_radius < 1
    long = infer(infinite.mdp, result.reward, horizon=2000)
    np.testing.assert_allclose(long.visitation, result.visitation, atol=1e-8)


def test_a_descent_that_leaves_the_finite_region_says_so_and_keeps_the_last_reward():
    result = learn("irlr", small_problem(inference="path_infinite", learning_rate=5.0))
    assert result.outcome is Outcome.DIVERGED
    assert "any length became infinite" in result.sentence
    assert np.isfinite(result.visitation).all()


def test_features_share_what_is_learned_among_squares():
    result = learn("irlfr", make_problem(features="colour", iterations=300))
    world = make_problem().world
    reds = [s for s in range(49) if world.reward[s] < -1]
    assert len(set(result.reward[reds].tolist())) == 1
    blues = [s for s in range(48) if world.reward[s] >= -1]
    assert result.reward[reds[0]] < result.reward[blues[0]]
    assert len(result.weights) < 49
    again = type(result).from_json(json.loads(json.dumps(result.to_json())))
    np.testing.assert_array_equal(again.weights, result.weights)


def test_colours_need_a_world_that_a_person_sees():
    mdp = GridMdp(3, 3, (8,))
    one = demonstration_of(mdp, [0, 1, 2, 5, 8], [RIGHT, RIGHT, DOWN, DOWN], id="a", outcome="success")
    with pytest.raises(InvalidFeatures, match="colour"):
        learn("meirl", LearningProblem.build(mdp, [one], settings=Settings(features="colour")))
    with pytest.raises(InvalidModel, match="needs a World"):
        _ = LearningProblem.build(mdp, [one]).world


def test_demonstrations_may_start_in_different_squares_successes_and_failures_apart():
    """The likelihood of each is conditional on its start, so the gradient's visits start as the demonstrations do."""
    mdp = GridMdp(3, 3, (8,), start=np.array([0.5, 0, 0, 0.5, 0, 0, 0, 0, 0]))
    near = demonstration_of(mdp, [3, 4, 5, 8], [RIGHT, RIGHT, DOWN], id="a", outcome="success")
    far = demonstration_of(mdp, [0, 3, 6, 7, 8], [DOWN, DOWN, RIGHT, RIGHT], id="b", outcome="failure")
    problem = LearningProblem.build(
        mdp, [near, far], settings=Settings(iterations=1, learning_rate=0.1, lambda_start=7.0)
    )
    result = learn("irlf", problem)
    from_3, from_0 = (infer(mdp, np.zeros(9), starts=s).visitation for s in (3, 0))
    visits_a, visits_b = np.bincount([3, 4, 5, 8], minlength=9), np.bincount([0, 3, 6, 7, 8], minlength=9)
    np.testing.assert_allclose(result.reward, -0.1 * (from_3 - visits_a) + (from_0 - visits_b) / 7.0, atol=1e-12)


class TestDemonstrationsInAModel:
    mdp = GridMdp(2, 2, (3,), slip=0.0)

    @pytest.mark.parametrize(
        ("change", "match"),
        [
            ({"states": [0, 2, 3]}, "Step 0: action 1 in state 0 cannot lead to state 2"),
            ({"states": [0, 1, 9]}, "states are whole numbers from 0 to 3, not 9"),
            ({"actions": [1, 4]}, "actions are whole numbers from 0 to 3, not 4"),
            ({"actions": [1]}, "one state more"),
            ({"outcome": "won"}, "outcome must be"),
            ({"id": ""}, "id must be a text"),
            ({"rewards": [1.0]}, "2 finite numbers"),
            ({"states": [0, 1, 3, 3], "actions": [1, 2, 2]}, "Step 2"),
        ],
    )
    def test_what_cannot_have_happened_is_refused_with_its_step(self, change, match):
        good = {"states": [0, 1, 3], "actions": [RIGHT, DOWN], "id": "a", "outcome": "success", "rewards": None}
        made = good | change
        with pytest.raises(ImpossibleDemonstration, match=match):
            demonstration_of(self.mdp, made.pop("states"), made.pop("actions"), **made)

    def test_what_happened_is_kept(self):
        one = demonstration_of(self.mdp, [0, 1, 3], [RIGHT, DOWN], id="a", outcome="success", rewards=[-1, 2.5])
        assert (one.total, one.ending, one.reached_goal) == (1.5, "goal", True)


def test_the_state_of_another_kind_is_refused():
    problem = small_problem()
    with pytest.raises(Exception, match="has no vector 'w_success'"):
        LEARNERS["meirl"].advance(problem, LearningState("meirl", 0, {}), iterations=1)


def test_ranked_attempts_of_a_walled_slippery_world_with_newton():
    world = make_world(4, 4, walls=(5,), slip=0.1, seed=3)
    problem = LearningProblem.build(
        world.mdp,
        [
            demonstration_of(world.mdp, s, a, id=i, outcome="success")
            for i, s, a in (
                ("a", [0, 1, 2, 3, 7, 11, 15], [1, 1, 1, 2, 2, 2]),
                ("b", [0, 4, 8, 12, 13, 14, 15], [2, 2, 2, 1, 1, 1]),
            )
        ],
        [Ranking("success", (("a",), ("b",)))],
        Settings(optimiser="newton", l2=0.01, tolerance=1e-8),
    )
    result = learn("irlr", problem)
    assert result.outcome is Outcome.CONVERGED
    assert result.visitation[7] > 1.5 * result.visitation[8]
