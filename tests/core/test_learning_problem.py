"""What a learner learns from: what is missing for whom, what is refused, and the settings."""

import json

import numpy as np
import pytest

from irl_core import (
    LEARNERS,
    ImpossibleDemonstration,
    InvalidRanking,
    InvalidSettings,
    IrlError,
    LearningProblem,
    LearningState,
    MissingDemonstrations,
    Ranking,
    Settings,
    feature_counts,
    generate_world,
    learn,
    simulate,
)
from tests.core.examples import LEFT, make_problem, make_world, play_like_a_person
from tests.core.test_learners import failure_counts, missing, small_problem


class TestWhatIsMissing:
    def test_nobody_learns_without_a_success(self):
        problem = small_problem()
        empty = LearningProblem.build(problem.world, problem.failures)
        for name, learner in LEARNERS.items():
            if learner.takes_anything:
                continue
            assert "needs at least one success" in missing(empty, learner)
            with pytest.raises(MissingDemonstrations, match="needs at least one success"):
                learn(name, empty)

    def test_who_takes_anything_learns_from_a_single_attempt_but_not_from_none(self):
        problem = small_problem(iterations=3)
        alone = LearningProblem.build(problem.world, problem.failures[:1], settings=problem.settings)
        assert np.isfinite(learn("birlfr", alone).reward).all()
        lost = simulate(problem.world, [LEFT], attempt_id="e")
        nothing = LearningProblem.build(problem.world, [lost])
        assert 'One failure ended elsewhere; to learn from such too, set "unfinished_' in missing(
            nothing, LEARNERS["birlfr"]
        )
        with pytest.raises(MissingDemonstrations, match="at least one attempt that reaches the goal"):
            learn("birlfr", nothing)

    def test_learners_from_failure_need_one(self):
        problem = small_problem()
        only = LearningProblem.build(problem.world, problem.successes, [Ranking("success", (("a",), ("b",)))])
        assert only.missing(LEARNERS["irlr"]) is None
        assert "IRLF needs at least one failure" in missing(only, LEARNERS["irlf"])

    def test_failures_that_never_arrived_do_not_count_unless_included(self):
        problem = small_problem()
        lost = simulate(problem.world, [LEFT], attempt_id="e")
        left_out = LearningProblem.build(problem.world, [*problem.successes, lost])
        assert 'set "unfinished_failures" to "include"' in missing(left_out, LEARNERS["irlf"])
        included = LearningProblem.build(
            problem.world, [*problem.successes, lost], settings=Settings(unfinished_failures="include")
        )
        assert included.missing(LEARNERS["irlf"]) is None

    def test_learners_by_rank_need_an_order_of_several(self):
        problem = small_problem()
        unranked = LearningProblem.build(problem.world, problem.demonstrations)
        assert unranked.missing(LEARNERS["irlf"]) is None
        assert "needs your successes in order: none of the 2 has a place yet" in missing(unranked, LEARNERS["irlr"])
        half = LearningProblem.build(problem.world, problem.demonstrations, [Ranking("success", (("a",), ("b",)))])
        assert "needs your failures in order" in missing(half, LEARNERS["irlfr"])
        stale = LearningProblem.build(problem.world, problem.demonstrations, [Ranking("success", (("a",),))])
        assert "1 of the 2 has no place yet" in missing(stale, LEARNERS["irlr"])

    def test_a_single_attempt_is_its_own_order(self):
        problem = small_problem()
        single = LearningProblem.build(problem.world, [problem.successes[0], problem.failures[0]])
        assert all(single.missing(learner) is None for learner in LEARNERS.values())


class TestBadInput:
    def test_demonstrations_of_another_world_are_refused(self):
        successes, failures = play_like_a_person(generate_world(7))
        with pytest.raises(ImpossibleDemonstration, match="is not of this world: its step 0 does not exist"):
            LearningProblem.build(generate_world(8), [*successes, *failures])
        with pytest.raises(ImpossibleDemonstration, match="is not of this world"):
            LearningProblem.build(make_world(3, 3), successes)

    def test_demonstrations_are_given_once(self):
        problem = small_problem()
        with pytest.raises(ImpossibleDemonstration, match="'a' is given twice"):
            LearningProblem.build(problem.world, [problem.successes[0]] * 2)

    @pytest.mark.parametrize("groups", [(("c",),), (("zz",),)])
    def test_a_ranking_of_strangers_is_refused(self, groups):
        problem = small_problem()
        with pytest.raises(InvalidRanking, match="which is not one of them"):
            LearningProblem.build(problem.world, problem.demonstrations, [Ranking("success", groups)])

    def test_two_rankings_of_one_outcome_are_refused(self):
        problem = small_problem()
        with pytest.raises(InvalidRanking, match="two rankings"):
            LearningProblem.build(problem.world, problem.demonstrations, [Ranking("success", (("a",),))] * 2)

    @pytest.mark.parametrize("seed", [-1, 1.5, True, None])
    def test_a_seed_is_a_whole_number(self, seed):
        problem = small_problem()
        with pytest.raises(InvalidSettings, match="seed must be"):
            LearningProblem.build(problem.world, problem.demonstrations, seed=seed)

    def test_an_unknown_learner_is_refused(self):
        with pytest.raises(InvalidSettings, match="there are meirl, irlr, irlf, irlfr"):
            learn("irl", small_problem())

    @pytest.mark.parametrize("data", [{}, {"learner": "meirl"}, None])
    def test_a_state_that_is_none_is_refused(self, data):
        with pytest.raises(IrlError, match="not the state of a learner"):
            LearningState.from_json(data)

    def test_a_state_of_another_world_is_refused(self):
        state = LEARNERS["meirl"].start(make_problem())
        with pytest.raises(IrlError, match="49 weights; this problem has 9"):
            LEARNERS["meirl"].advance(small_problem(), state, iterations=1)


WRONG_SETTINGS: list[tuple[str, list[object]]] = [
    ("learning_rate", [0, -0.1, 10.1, float("nan"), float("inf"), "0.1", True, None, 10**400]),
    ("iterations", [0, 100_001, 1.5, True, "5", None]),
    ("tolerance", [0, 1.1, float("nan")]),
    ("lambda_start", [0, -1, float("inf")]),
    ("lambda_decay", [0, 1.01]),
    ("lambda_min", [0, 11, float("nan")]),
    ("initial_weights", ["random", None, 0, ["zero"]]),
    ("unfinished_failures", ["", True]),
    ("lambda_rule", ["none", 1]),
    ("inference", ["paths", None]),
    ("discount", [0, 1.1, float("nan")]),
    ("features", ["pixels", 3]),
    ("optimiser", ["adam"]),
    ("l2", [-1, float("inf")]),
]


@pytest.mark.parametrize(("name", "value"), [(name, value) for name, values in WRONG_SETTINGS for value in values])
def test_a_setting_out_of_range_is_refused_by_name(name, value):
    with pytest.raises(InvalidSettings) as refusal:
        Settings.from_json({name: value})
    assert refusal.value.field == name
    assert name in str(refusal.value)


def test_settings_survive_json_and_describe_themselves():
    ours = Settings(iterations=7, lambda_min=2)
    assert Settings.from_json(json.loads(json.dumps(ours.to_json()))) == ours
    with pytest.raises(InvalidSettings, match="There is no setting 'alpha'"):
        Settings.from_json({"alpha": 1})
    described = {one["name"]: one for one in Settings.describe()}
    assert described.keys() == ours.to_json().keys()
    assert described["learning_rate"]["symbol"] == "α"
    for one in described.values():
        assert one.keys() == {"name", "symbol", "default", "minimum", "maximum", "choices", "help", "group"}
        Settings.from_json({one["name"]: one["default"]})


def test_counts_of_the_problem_are_the_weighted_visits():
    problem = small_problem()
    by_rank = feature_counts(problem.world, problem.failures, {"c": 2 / 3, "d": 1 / 3})
    np.testing.assert_allclose(failure_counts(problem), by_rank)
