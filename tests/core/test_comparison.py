"""Everybody on one world: means, shares, places."""

import json

import numpy as np
import pytest

from irl_core import (
    World,
    compare,
    expected_return,
    greedy_plan,
    learn,
    optimum,
    simulate,
)
from irl_core.comparison import places
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
    assert [list(one.states) for one in comparison.rollouts["human"]] == [
        one.states.tolist() for one in problem.demonstrations
    ]


def test_a_learner_is_its_policy_exactly_in_episodes_and_as_a_plan(problem, results, comparison):
    for result in results:
        one = entry(comparison, result.learner)
        assert one.expected_return == expected_return(problem.world, result.policy)
        assert one.greedy_return == expected_return(problem.world, greedy_plan(problem.world, result.reward))
        totals = [episode.total for episode in comparison.rollouts[result.learner]]
        assert (len(totals), one.episodes) == (50, 50)
        assert one.mean_return == pytest.approx(np.mean(totals))
        assert one.standard_error == pytest.approx(np.std(totals, ddof=1) / np.sqrt(50))
        assert one.share_of_optimum == pytest.approx(one.expected_return / optimum(problem.world))


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
        "who", "title", "mean_return", "standard_error", "expected_return", "greedy_return", "share_of_optimum",
        "place", "episodes",
    }  # fmt: skip
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
