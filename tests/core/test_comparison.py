"""Everybody on one world: means and how far they are known, shares, places, what is lost where."""

import json
from dataclasses import replace

import numpy as np
import pytest

from irl_core import (
    LearningProblem,
    Settings,
    World,
    compare,
    learn,
    optimal_plan,
    optimum,
    simulate,
)
from irl_core.comparison import HumanAttempts, places
from tests import recomputed
from tests.core.examples import DOWN, RIGHT, UP, make_problem, make_world

PAPER = ("meirl", "irlr", "irlf", "irlfr")


@pytest.fixture(scope="module")
def problem():
    return make_problem(iterations=20)


@pytest.fixture(scope="module")
def results(problem):
    return [learn(name, problem) for name in PAPER]


@pytest.fixture(scope="module")
def comparison(problem, results):
    return compare(problem.world, problem.demonstrations, results, seed=3)


def entry(comparison, who):
    return next(one for one in comparison.entries if one.who == who)


def test_everybody_is_there_sorted_by_place(comparison):
    assert {one.who for one in comparison.entries} == {"human", *PAPER, "optimal"}
    assert [one.place for one in comparison.entries] == sorted(one.place for one in comparison.entries)
    assert comparison.entries[0].who == "optimal"
    scores = [one.score for one in comparison.entries]
    assert scores == sorted(scores, reverse=True)


def test_by_hand_the_human_is_the_mean_of_their_attempts(problem, comparison):
    totals = [one.total for one in problem.demonstrations]
    human = entry(comparison, "human")
    assert human.mean_return == pytest.approx(np.mean(totals))
    assert human.standard_error == pytest.approx(np.std(totals, ddof=1) / np.sqrt(6))
    assert (human.expected_return, human.greedy_return, human.episodes) == (None, None, 6)
    assert human.share_of_optimum == pytest.approx(np.mean(totals) / optimum(problem.world))
    assert human.success_rate == 0.5
    assert [list(one.states) for one in comparison.rollouts["human"]] == [
        one.states.tolist() for one in problem.demonstrations
    ]
    best, mean = comparison.human.best, comparison.human.mean
    assert best == problem.demonstrations[0].id
    assert mean == min(problem.demonstrations, key=lambda one: abs(one.total - np.mean(totals))).id


def slippery_problem():
    """A world that has everything, a square that nobody comes to among it, and three who wander in it."""
    world = make_world(4, 5, seed=2, slip=0.2, walls=(7, 3, 9), goals=(19, 15), horizon=30)
    wanderings = [np.random.default_rng(k).integers(0, 4, 4).tolist() for k in range(3)]
    attempts = [simulate(world, actions, attempt_id=f"wanderer-{k}") for k, actions in enumerate(wanderings)]
    return LearningProblem.build(world, attempts, (), Settings(unfinished_failures="include"))


@pytest.mark.parametrize(
    ("problem", "names"),
    [
        (make_problem(iterations=20), ("meirl", "irlfr", "bc", "birlfr")),
        (slippery_problem(), ("birlfr",)),
    ],
    ids=["the paper's world", "slip, walls, two goals"],
)
def test_every_figure_is_what_loops_that_share_no_code_make_of_policies_and_episodes(problem, names):
    results = [learn(name, problem) for name in names]
    chances = np.random.default_rng(0).dirichlet(np.ones(4), problem.world.n_states)
    results.append(replace(results[0], learner="random", policy=chances))
    told = compare(problem.world, problem.demonstrations, results, seed=3).to_json()
    ours = recomputed.comparison(
        problem.world.to_json(),
        [one.to_json() for one in problem.demonstrations],
        {one.learner: one.to_json() for one in results},
        told["rollouts"],
        seed=3,
    )
    assert recomputed.differences(told, ours) == []
    assert told["value_lost_scale"] > 0.0


def test_who_does_the_same_does_the_same_in_every_episode(problem, results):
    """Common random numbers: two of one policy walk alike, so that nothing but policies is compared."""
    twin = replace(results[0], learner="irlr")
    found = compare(problem.world, [], [results[0], twin], seed=5)
    assert found.rollouts["meirl"] == found.rollouts["irlr"]
    [test] = found.tests
    assert (test.mean_difference, test.low, test.high, test.p_value, test.p_adjusted) == (0.0, 0.0, 0.0, 1.0, 1.0)


def test_nobody_loses_anything_who_plans_on_the_true_reward(problem, results):
    best = optimal_plan(problem.world).actions[-1]
    wise = replace(results[0], policy=np.eye(4)[best])
    found = compare(problem.world, [], [wise], seed=1)
    assert found.value_lost_scale == pytest.approx(0.0, abs=1e-9)
    assert entry(found, "meirl").share_of_optimum == pytest.approx(1.0)


def test_the_scale_of_losses_ends_at_what_is_at_stake():
    problem = make_problem(iterations=5)
    found = compare(problem.world, [], [learn("random", problem)], seed=1)
    assert found.value_lost["random"].max() > 100.0
    assert found.value_lost_scale == optimal_plan(problem.world).values[-1].max()


def test_one_attempt_is_both_best_and_mean_and_has_no_interval(problem):
    one = problem.demonstrations[3]
    found = compare(problem.world, [one], [], seed=0)
    human = entry(found, "human")
    assert found.human == HumanAttempts(best=one.id, mean=one.id)
    assert (human.interval_low, human.interval_high, human.standard_error) == (None, None, 0.0)
    assert found.tests == ()
    assert compare(problem.world, [], [], seed=0).human is None


def test_episodes_depend_on_the_seed_and_the_player_alone(problem, results, comparison):
    again = compare(problem.world, [], results[1:2], seed=3)
    other = compare(problem.world, [], results[1:2], seed=4)
    assert again.rollouts["irlr"] == comparison.rollouts["irlr"]
    assert other.rollouts["irlr"] != comparison.rollouts["irlr"]
    assert "human" not in again.rollouts


def test_the_json_is_that_of_the_api(comparison):
    data = json.loads(json.dumps(comparison.to_json()))
    assert (data["seed"], data["horizon"]) == (3, 98)
    assert data["entries"][0].keys() == {
        "who", "title", "mean_return", "standard_error", "interval_low", "interval_high", "success_rate", "mean_steps",
        "expected_return", "greedy_return", "share_of_optimum", "place", "episodes",
    }  # fmt: skip
    assert data["human"].keys() == {"best", "mean"}
    assert data["value_lost"].keys() == set(PAPER)
    assert [len(lost) for lost in data["value_lost"].values()] == 4 * [49]
    assert [(test["a"], test["b"]) for test in data["tests"]][:3] == [
        ("meirl", "irlr"), ("meirl", "irlf"), ("meirl", "irlfr"),
    ]  # fmt: skip
    assert data["rollouts"]["meirl"][0].keys() == {"states", "total", "reached_goal"}


def test_who_plays_best_shares_the_first_place_with_the_optimum():
    world = World(2, 2, np.array([[0.0, -1.0], [-2.0, 4.0]]), 0, (3,))
    best = simulate(world, [RIGHT, DOWN], attempt_id="a")
    assert [(one.who, one.place) for one in compare(world, [best], [], seed=0).entries] == [
        ("human", 1),
        ("optimal", 1),
    ]
    assert entry(compare(world, [best], [], seed=0), "human").standard_error == 0.0


def test_no_share_where_the_optimum_is_nothing():
    world = World(2, 2, np.array([[0.0, -3.0], [-3.0, 1.0]]), 0, (3,))
    found = compare(world, [simulate(world, [UP], attempt_id="a")], [], seed=0)
    assert all(one.share_of_optimum is None for one in found.entries)
    assert all(one.place == 1 for one in found.entries)


def test_the_optimum_slips_too():
    found = compare(make_world(3, 3, slip=0.3), [], [], seed=1)
    assert len({one.states for one in found.rollouts["optimal"]}) > 1


@pytest.mark.parametrize(
    ("scores", "expected"),
    [([3.0, 1.0, 2.0], [1, 3, 2]), ([2.0, 2.0, 1.0], [1, 1, 3]), ([1.0, 1.0 + 1e-12, 0.0], [1, 1, 3]), ([], [])],
)
def test_places_are_shared_and_counted_on(scores, expected):
    assert places(scores, tolerance=1e-9) == expected


def test_who_learned_no_reward_has_no_greedy_return():
    problem = make_problem()
    entries = compare(
        problem.world, problem.demonstrations, [learn("bc", problem), learn("irlr", problem)], seed=1
    ).entries
    greedy = {one.who: one.greedy_return for one in entries}
    assert greedy["bc"] is None
    assert greedy["irlr"] is not None
