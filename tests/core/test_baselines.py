"""The neighbourhood: what each baseline learns, by hand and by a second solver; how it acts, ends and resumes."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq, minimize

from irl_core import (
    Frame,
    InvalidSettings,
    IrlError,
    LearningProblem,
    LearningResult,
    LearningState,
    MissingDemonstrations,
    Outcome,
    Ranking,
    Settings,
    World,
    expected_visits,
    greedy_plan,
    learn,
)
from irl_core.learners.baselines import BehaviouralCloning, RandomPlay, ScoreIrl, Trex, report
from irl_core.learners.baselines.trex import preferences_of
from tests.core.examples import DOWN, RIGHT, attempt, make_problem, ranked

ALL = {one.name: one for one in (Trex(), BehaviouralCloning(), ScoreIrl(), RandomPlay())}


def small_problem(**changes):
    """A 3×3 world with two successes and two failures that end at the goal, ranked."""
    rewards = np.array([[-0.5, -0.2, -0.3], [-3.0, -0.4, -0.1], [-3.0, -2.0, 2.0]])
    world = World(3, 3, rewards, 0, (8,))
    walks = {"a": [0, 1, 2, 5, 8], "b": [0, 1, 4, 5, 8], "c": [0, 3, 6, 7, 8], "d": [0, 3, 4, 7, 8]}
    ours = [attempt(world, states, id_=id_) for id_, states in walks.items()]
    rankings = [Ranking("success", (("a",), ("b",))), Ranking("failure", (("c",), ("d",)))]
    return LearningProblem.build(world, ours, rankings, Settings(**changes), 0)


def counts_of(problem, id_):
    (one,) = (one for one in problem.demonstrations if one.id == id_)
    return np.bincount(one.states, minlength=problem.mdp.n_states)


class TestTrex:
    def test_pairs_run_along_each_ranking_and_from_successes_to_failures(self):
        preferences = preferences_of(small_problem())
        found = {("abcd"[row.argmax()], "abcd"[row.argmin()]) for row in preferences.pairs}
        assert found == {("a", "b"), ("d", "c"), ("a", "c"), ("a", "d"), ("b", "c"), ("b", "d")}
        assert len(preferences.pairs) == 6

    def test_a_tie_makes_no_pair(self):
        problem = small_problem()
        tied = replace(problem, orders={"success": (("a", "b"),), "failure": (("c", "d"),)})
        assert len(preferences_of(tied).pairs) == 4

    def test_one_pair_by_hand(self):
        """With w = c · d, d = φ_a − φ_d, the condition ℓ₂ c = σ(−c ‖d‖²) is one equation in c."""
        problem = small_problem(preference_l2=0.3)
        pair = LearningProblem.build(
            problem.world, [problem.successes[0], problem.failures[1]], settings=problem.settings
        )
        d = counts_of(pair, "a") - counts_of(pair, "d")
        c = brentq(lambda c: 0.3 * c - 1 / (1 + math.exp(c * (d @ d))), 0.0, 10.0, xtol=1e-14)
        result = learn(Trex(), pair)
        assert result.outcome is Outcome.CONVERGED
        np.testing.assert_allclose(result.weights, c * d, atol=1e-9)
        assert result.log_likelihood == pytest.approx(-math.log1p(math.exp(-c * (d @ d))), abs=1e-9)
        assert result.sentence.endswith("1 of 1 preferences are met.")

    @pytest.mark.parametrize("features", ["one_hot", "colour_position"])
    @pytest.mark.parametrize("ridge", [1e-3, 0.1, 10.0])
    def test_newton_finds_the_minimum_that_lbfgs_finds_in_the_weights(self, features, ridge):
        problem = make_problem(preference_l2=ridge, features=features)
        preferences = preferences_of(problem)
        differences = preferences.pairs @ preferences.counts

        def objective(w):
            z = differences @ w
            slope = -differences.T @ (1 / (1 + np.exp(np.minimum(z, 700.0)))) + ridge * w
            return np.logaddexp(0, -z).sum() + ridge / 2 * (w @ w), slope

        best = minimize(objective, np.zeros(differences.shape[1]), jac=True, method="L-BFGS-B",
                        options={"ftol": 1e-15, "gtol": 1e-9, "maxiter": 5000})  # fmt: skip
        result = learn(Trex(), problem)
        assert result.outcome is Outcome.CONVERGED
        assert result.iterations < 40
        assert objective(result.weights)[0] <= best.fun + 1e-10
        np.testing.assert_allclose(result.weights, best.x, atol=1e-3)
        assert np.abs(objective(result.weights)[1]).max() < 1e-7

    def test_better_attempts_are_worth_more(self):
        problem = small_problem()
        weights = learn(Trex(), problem).weights
        values = [weights @ counts_of(problem, id_) for id_ in "abdc"]
        assert values == sorted(values, reverse=True)

    def test_a_state_of_other_demonstrations_is_refused(self):
        with pytest.raises(IrlError, match="other demonstrations"):
            Trex().advance(make_problem(), Trex().start(small_problem()), iterations=1)


class TestCloning:
    def test_frequencies_by_hand(self):
        """From square 1 "a" goes right and "b" down; α = 1 counts each of the four actions once more."""
        result = learn(BehaviouralCloning(), small_problem(cloning_prior=1.0))
        np.testing.assert_allclose(result.policy[1], [1 / 6, 2 / 6, 2 / 6, 1 / 6])
        np.testing.assert_allclose(result.policy[0], [1 / 6, 3 / 6, 1 / 6, 1 / 6])
        np.testing.assert_array_equal(result.policy[[3, 6, 7, 8]], 0.25)
        assert (result.policy[0].argmax(), result.policy[2].argmax()) == (RIGHT, DOWN)
        assert result.log_likelihood == pytest.approx(math.log(3 / 6 * 2 / 6 * 2 / 5 * 3 / 6))
        assert "2 successes in 5 of 9 states" in result.sentence

    def test_without_smoothing_to_speak_of_it_walks_the_successes(self):
        problem = small_problem(cloning_prior=1e-9)
        result = learn(BehaviouralCloning(), problem)
        assert result.gap < 1e-6
        np.testing.assert_allclose(
            result.visitation, (counts_of(problem, "a") + counts_of(problem, "b")) / 2, atol=1e-6
        )
        assert result.log_likelihood == pytest.approx(math.log(1 / 2), abs=1e-6)


class TestScores:
    @pytest.mark.parametrize("features", ["one_hot", "position"])
    def test_the_dual_solves_the_normal_equations(self, features):
        problem = make_problem(score_l2=0.7, features=features)
        result = learn(ScoreIrl(), problem)
        phi = np.array([
            problem.features.counts(np.bincount(one.states[1:], minlength=49).astype(float))
            for one in problem.demonstrations
        ])  # fmt: skip
        totals = np.array([one.total for one in problem.demonstrations])
        primal = np.linalg.solve(phi.T @ phi + 0.7 * np.eye(phi.shape[1]), phi.T @ totals)
        np.testing.assert_allclose(result.weights, primal, atol=1e-9)

    def test_with_little_ridge_the_totals_are_met(self):
        problem = small_problem(score_l2=1e-9)
        weights = learn(ScoreIrl(), problem).weights
        for one in problem.demonstrations:
            assert weights @ np.bincount(one.states[1:], minlength=9) == pytest.approx(one.total, abs=1e-6)

    def test_it_says_that_it_was_told(self):
        assert ScoreIrl().uses_scores
        assert "uses scores" in ScoreIrl().title
        assert "told these totals" in learn(ScoreIrl(), small_problem()).sentence
        assert not any(one.uses_scores for name, one in ALL.items() if name != "score_irl")


def test_random_play_takes_every_action_alike_from_the_start():
    problem = small_problem()
    result = learn(RandomPlay(), problem)
    assert (result.outcome, result.iterations) == (Outcome.CONVERGED, 0)
    np.testing.assert_array_equal(result.policy, 0.25)
    assert result.log_likelihood == pytest.approx(4 * math.log(1 / 4))
    np.testing.assert_allclose(result.visitation, expected_visits(problem.world, np.full((9, 4), 0.25)))


@pytest.mark.parametrize("name", ALL)
class TestAll:
    def test_a_run_in_pieces_and_through_json_is_the_uninterrupted_one_bit_for_bit(self, name):
        problem, learner = make_problem(), ALL[name]
        whole = learner.advance(problem, learner.start(problem), iterations=1000)
        state = learner.start(problem)
        while not state.is_finished:
            state = learner.advance(problem, state, iterations=1)
            state = LearningState.from_json(json.loads(json.dumps(state.to_json(), allow_nan=False)))
        assert state.to_json() == whole.to_json()
        first, second = (learner.result(problem, one).to_json() for one in (whole, state))
        assert first == second
        assert LearningResult.from_json(json.loads(json.dumps(first, allow_nan=False))).to_json() == first
        assert learner.advance(problem, whole, iterations=5) is whole

    def test_the_order_in_which_demonstrations_are_given_changes_no_bit(self, name):
        problem = make_problem()
        rankings = ranked(problem.successes, problem.failures)[::-1]
        shuffled = LearningProblem.build(problem.world, problem.demonstrations[::-1], rankings, problem.settings)
        assert learn(ALL[name], problem).to_json() == learn(ALL[name], shuffled).to_json()

    def test_frames_show_the_way_and_results_have_the_shapes_of_the_api(self, name):
        problem = make_problem()
        frames: list[Frame] = []
        result = learn(ALL[name], problem, on_frame=frames.append, frame_every=1)
        assert [frame.iteration for frame in frames] == list(range(result.iterations + 1)) or name == "trex"
        assert frames[-1].iteration == result.iterations
        np.testing.assert_array_equal(frames[-1].policy, result.policy)
        np.testing.assert_allclose(result.policy.sum(axis=1), 1.0)
        assert np.shape(result.to_json()["reward"]) == (7, 7)
        assert all(np.isfinite([frame.gap, frame.log_likelihood]).all() for frame in frames)

    def test_a_learner_that_is_stopped_says_so(self, name):
        problem, learner = make_problem(), ALL[name]
        if name != "random":  # it has nothing to stop
            assert learner.result(problem, learner.start(problem)).outcome is Outcome.STOPPED

    def test_it_introduces_itself(self, name):
        learner = ALL[name]
        assert (learner.name, learner.family) == (name, "baseline")
        assert learner.summary.endswith(".")
        assert name == "random" or learner.references

    def test_it_needs_a_success(self, name):
        problem = small_problem()
        with pytest.raises(MissingDemonstrations, match="needs at least one success"):
            ALL[name].start(LearningProblem.build(problem.world, problem.failures))


@pytest.mark.parametrize("learner", [Trex(), ScoreIrl()], ids=lambda one: one.name)
@pytest.mark.parametrize("seed", range(4))
def test_a_planned_policy_arrives_on_the_path_that_the_shown_reward_plans(learner, seed):
    problem = make_problem(seed=seed)
    result = learn(learner, problem)
    assert (result.reward[:48] < 0).all()
    visits = expected_visits(problem.world, result.policy)
    assert visits[48] == pytest.approx(1.0)
    assert visits.max() == pytest.approx(1.0)
    np.testing.assert_allclose(visits, expected_visits(problem.world, greedy_plan(problem.world, result.reward)))


def test_costs_keep_every_difference_between_squares_on_the_way():
    problem = small_problem()
    reward = np.random.default_rng(0).normal(2.0, 3.0, 9)
    costs = report.as_costs(problem, reward)
    np.testing.assert_allclose(np.diff(costs[:8]), np.diff(reward[:8]))
    assert costs[:8].max() < 0
    assert costs[8] == reward[8]
    np.testing.assert_allclose(report.as_costs(problem, np.zeros(9))[:8], -1.0)


@pytest.mark.parametrize(
    ("name", "value"),
    [("episodes", 9), ("episodes", 50.5), ("preference_l2", 0), ("score_l2", float("nan")), ("cloning_prior", -1)],
)
def test_a_setting_out_of_range_is_refused_by_name(name, value):
    with pytest.raises(InvalidSettings, match=name) as refusal:
        Settings.from_json({name: value})
    assert refusal.value.field == name
