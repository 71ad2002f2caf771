"""What each demonstration changed, and what would be if."""

import json

import numpy as np
import pytest

from irl_core import (
    InvalidRanking,
    LearningProblem,
    MissingDemonstrations,
    Ranking,
    Settings,
    expected_return,
    expected_visits,
    learn,
    simulate,
)
from irl_core.influence import difference, influence, influence_of, what_if
from tests.core.examples import LEFT, make_problem
from tests.core.test_baselines import small_problem


def test_the_influence_is_that_of_learning_again_without():
    problem = small_problem(iterations=30)
    found = {one.id: one for one in influence("irlfr", problem)}
    assert list(found) == ["a", "b", "c", "d"]
    rest = [one for one in problem.demonstrations if one.id != "c"]
    rankings = [Ranking("success", (("a",), ("b",))), Ranking("failure", (("d",),))]
    whole = learn("irlfr", problem)
    without = learn("irlfr", LearningProblem.build(problem.world, rest, rankings, problem.settings))
    one, world = found["c"], problem.world
    assert one.return_change == expected_return(world, whole.policy) - expected_return(world, without.policy)
    assert one.reward_change == pytest.approx(np.abs(whole.reward - without.reward).mean())
    visits = expected_visits(world, whole.policy)[:8]
    distance = np.abs(whole.policy - without.policy)[:8].sum(axis=1) / 2
    assert one.policy_change == pytest.approx((visits * distance).sum() / visits.sum())
    assert 0 < (one.policy_change or 0) < 1
    assert (one.outcome, one.n_steps, one.sentence) == ("failure", 4, None)
    json.dumps([one.to_json() for one in found.values()], allow_nan=False)


def test_what_a_learner_does_not_look_at_has_no_influence():
    by_id = {one.id: one for one in influence("meirl", small_problem(iterations=10))}
    assert (by_id["c"].policy_change, by_id["c"].reward_change, by_id["c"].return_change) == (0.0, 0.0, 0.0)
    assert by_id["a"].reward_change


def test_two_attempts_alike_have_the_same_influence_and_little_of_it():
    problem = small_problem(iterations=20)
    twin = simulate(problem.world, problem.successes[0].actions.tolist(), attempt_id="a2")
    twice = LearningProblem.build(problem.world, [*problem.demonstrations, twin], settings=problem.settings)
    by_id = {one.id: one for one in influence("meirl", twice)}
    assert by_id["a"].reward_change == by_id["a2"].reward_change
    assert (by_id["a"].reward_change or 0) < (by_id["b"].reward_change or 0)


def test_without_the_only_success_a_sentence_says_why_nothing_is_learned():
    problem = small_problem()
    single = LearningProblem.build(
        problem.world, [problem.successes[0], *problem.failures], [Ranking("failure", (("c",), ("d",)))],
        Settings(iterations=5),
    )  # fmt: skip
    first, *others = influence("irlfr", single)
    assert (first.policy_change, first.reward_change, first.return_change) == (None, None, None)
    assert "needs at least one success" in (first.sentence or "")
    assert all(one.sentence is None for one in others)


def test_a_model_without_rewards_has_no_return_to_change():
    problem = small_problem(iterations=5)
    rankings = [Ranking(outcome, groups) for outcome, groups in problem.orders.items()]
    blind = LearningProblem.build(problem.mdp, problem.demonstrations, rankings, problem.settings)
    assert all(one.return_change is None and one.policy_change is not None for one in influence("irlr", blind))


def test_a_problem_that_cannot_be_learned_from_at_all_is_refused():
    problem = small_problem()
    with pytest.raises(MissingDemonstrations):
        influence("meirl", LearningProblem.build(problem.world, problem.failures))


class TestWhatIf:
    def test_dropping_keeps_the_order_of_the_others(self):
        problem = make_problem()
        gone = problem.successes[1].id
        changed = what_if(problem, drop=gone)
        assert gone not in {one.id for one in changed.demonstrations}
        left = tuple(group for group in problem.orders["success"] if group != (gone,))
        assert changed.orders["success"] == left
        assert changed.orders["failure"] == problem.orders["failure"]
        assert (changed.seed, changed.settings) == (problem.seed, problem.settings)

    def test_one_of_a_tie_leaves_the_other(self):
        problem = small_problem()
        tied = LearningProblem.build(problem.world, problem.demonstrations, [Ranking("success", (("a", "b"),))])
        assert what_if(tied, drop="a").orders["success"] == (("b",),)
        assert "failure" not in what_if(tied, drop="a").orders

    def test_swapping_trades_places(self):
        changed = what_if(small_problem(), swap=("a", "b"))
        assert changed.orders == {"success": (("b",), ("a",)), "failure": (("c",), ("d",))}
        assert changed.success_weights(ranked=True) == pytest.approx({"b": 2 / 3, "a": 1 / 3})

    def test_a_success_called_a_failure_is_the_least_bad_one(self):
        problem = small_problem(iterations=5)
        changed = what_if(problem, relabel="b")
        assert [one.id for one in changed.successes] == ["a"]
        assert [one.id for one in changed.failures] == ["c", "d", "b"]
        assert changed.orders == {"success": (("a",),), "failure": (("c",), ("d",), ("b",))}
        assert changed.demonstrations[1].outcome == "failure"
        assert np.isfinite(learn("irlfr", changed).reward).all()

    def test_a_failure_called_a_success_is_the_last_one(self):
        changed = what_if(small_problem(iterations=5), relabel="d")
        assert changed.orders == {"success": (("a",), ("b",), ("d",)), "failure": (("c",),)}
        assert np.isfinite(learn("irlfr", changed).reward).all()

    def test_unranked_attempts_stay_unranked(self):
        problem = small_problem()
        unranked = LearningProblem.build(problem.world, problem.demonstrations)
        assert what_if(unranked, relabel="b").orders == {}
        alone = LearningProblem.build(problem.world, [problem.successes[0], *problem.failures[:1]])
        assert what_if(alone, relabel="c").orders == {"success": (("a",), ("c",))}

    def test_what_cannot_be_changed_is_refused(self):
        problem = small_problem()
        lost = simulate(problem.world, [LEFT], attempt_id="e")
        with_lost = LearningProblem.build(problem.world, [*problem.demonstrations, lost])
        with pytest.raises(InvalidRanking, match="one change"):
            what_if(problem)
        with pytest.raises(InvalidRanking, match="one change"):
            what_if(problem, drop="a", relabel="b")
        with pytest.raises(InvalidRanking, match="no demonstration 'z'"):
            what_if(problem, drop="z")
        with pytest.raises(InvalidRanking, match="must be in one ranking"):
            what_if(problem, swap=("a", "c"))
        with pytest.raises(InvalidRanking, match="must be in one ranking"):
            what_if(with_lost, swap=("a", "b"))
        with pytest.raises(InvalidRanking, match="never reached a goal"):
            what_if(with_lost, relabel="e")


class TestDifference:
    def test_it_is_the_new_less_the_old(self):
        problem = small_problem(iterations=30)
        before, after = learn("irlfr", problem), learn("irlfr", what_if(problem, drop="a"))
        found = difference(problem, before, after)
        assert found.reward.tolist() == [new - old for new, old in zip(after.reward, before.reward, strict=True)]
        assert found.reward_change == pytest.approx(sum(map(abs, found.reward)) / 9)
        earned = [expected_return(problem.world, result.policy) for result in (before, after)]
        assert found.return_change == earned[1] - earned[0]
        json.dumps(found.to_json(), allow_nan=False)

    def test_a_square_has_turned_where_no_action_is_likeliest_before_and_after(self):
        problem = small_problem(iterations=30)
        before, after = learn("irlfr", problem), learn("irlfr", what_if(problem, relabel="d"))
        likeliest = [
            [{a for a in range(4) if row[a] >= max(row) - 1e-9} for row in result.policy.tolist()]
            for result in (before, after)
        ]
        turned = [state for state in range(8) if not likeliest[0][state] & likeliest[1][state]]
        assert turned
        assert difference(problem, before, after).turned == tuple(turned)

    def test_of_two_results_alike_nothing_differs(self):
        problem = small_problem(iterations=5)
        result = learn("meirl", problem)
        found = difference(problem, result, result)
        assert (found.policy_change, found.reward_change, found.return_change, found.turned) == (0.0, 0.0, 0.0, ())

    def test_an_influence_says_what_is_earned_without_and_which_squares_turn(self):
        problem = small_problem(iterations=30)
        whole = learn("irlfr", problem)
        for one in influence("irlfr", problem):
            without = learn("irlfr", what_if(problem, drop=one.id))
            assert one.expected_return == expected_return(problem.world, without.policy)
            assert one.turned == difference(problem, whole, without).turned
        with pytest.raises(InvalidRanking, match="no demonstration 'z'"):
            influence_of("z", problem, whole, lambda rest: learn("irlfr", rest))
