"""How sure a learner can be: draws against a naive twin, and what the sentences say where nothing can be drawn."""

import json
from collections import Counter

import numpy as np
import pytest

from irl_core import (
    InvalidSettings,
    LearningProblem,
    MissingDemonstrations,
    Ranking,
    Settings,
    expected_return,
    learn,
    simulate,
)
from irl_core.uncertainty import bootstrap, from_posterior, resampled, summary
from tests.core.examples import LEFT, make_problem
from tests.core.test_baselines import small_problem


def naive_times(problem, number):
    """How often each demonstration is drawn, id by id."""
    rng = np.random.default_rng(np.random.SeedSequence([problem.seed, *b"attempts", number]))
    used = [one.id for one in problem.failures]
    times = Counter[str]()
    for stratum in (
        [one.id for one in problem.demonstrations if one.outcome == "success"],
        [one.id for one in problem.demonstrations if one.id in used],
        [one.id for one in problem.demonstrations if one.outcome == "failure" and one.id not in used],
    ):
        if stratum:
            times.update(stratum[k] for k in rng.integers(len(stratum), size=len(stratum)))
    return times


def naive_weights(groups, times):
    """θ of each demonstration, all its copies together: copies share the mean of the places that they fill."""
    n = place = sum(times[id_] for group in groups for id_ in group)
    weights: dict[str, float] = {}
    for group in groups:
        members = [id_ for id_ in group for _ in range(times[id_])]
        places = [place - k for k in range(len(members))]
        place -= len(members)
        for id_ in members:
            weights[id_] = weights.get(id_, 0.0) + 2 * (sum(places) / len(places)) / (n * (n + 1))
    return weights


def naive_quantile(values, share):
    """Linear between the order statistics."""
    values = sorted(values)
    at = share * (len(values) - 1)
    low = int(at)
    return values[low] + (at - low) * (values[min(low + 1, len(values) - 1)] - values[low])


def naive_likeliest(row):
    return {action for action, chance in enumerate(row) if chance >= max(row) - 1e-9}


def test_a_draw_has_each_attempt_as_often_as_the_naive_twin_with_its_weight():
    problem = make_problem(seed=3)
    for number in range(20):
        again, times = resampled(problem, number), naive_times(problem, number)
        assert Counter(one.id.split(" #")[0] for one in again.demonstrations) == times
        for outcome, weigh in (("success", again.success_weights), ("failure", again.failure_weights)):
            expected = naive_weights(problem.orders[outcome], times)
            found: dict[str, float] = {}
            for id_, weight in weigh(ranked=True).items():
                found[id_.split(" #")[0]] = found.get(id_.split(" #")[0], 0.0) + weight
            assert found == pytest.approx(expected)
    assert (again.seed, again.settings, len(again.successes)) == (problem.seed, problem.settings, 3)


def test_the_bootstrap_is_that_of_the_naive_twin():
    problem, n_draws = small_problem(iterations=15), 12
    found = bootstrap("irlfr", problem, n_draws=n_draws)
    whole = learn("irlfr", problem)
    results = [learn("irlfr", resampled(problem, number)) for number in range(n_draws)]
    returns = [expected_return(problem.world, result.policy) for result in results]
    assert found.return_low == pytest.approx(naive_quantile(returns, 0.05))
    assert found.return_high == pytest.approx(naive_quantile(returns, 0.95))
    for state in range(9):
        rewards = [result.reward[state] for result in results]
        assert found.reward_low[state] == pytest.approx(naive_quantile(rewards, 0.05))
        assert found.reward_high[state] == pytest.approx(naive_quantile(rewards, 0.95))
        mine = naive_likeliest(whole.policy[state])
        agreeing = [bool(mine & naive_likeliest(result.policy[state])) for result in results]
        assert found.policy_agreement[state] == pytest.approx(sum(agreeing) / n_draws)
    assert (found.method, found.level, found.n_draws, found.seed) == ("bootstrap", 0.9, n_draws, problem.seed)
    assert f"from {n_draws} draws of the same attempts, IRLFR earns " in found.sentence
    assert (
        json.loads(json.dumps(found.to_json(), allow_nan=False))["policy_agreement"] == found.policy_agreement.tolist()
    )


def test_the_same_problem_has_the_same_draws_and_another_seed_others():
    problem = make_problem(seed=3, iterations=5)
    ids = [[one.id for one in resampled(problem, number).demonstrations] for number in range(8)]
    assert ids == [[one.id for one in resampled(problem, number).demonstrations] for number in range(8)]
    assert len(set(map(tuple, ids))) > 1
    rankings = [Ranking(outcome, groups) for outcome, groups in problem.orders.items()]
    other = LearningProblem.build(problem.world, problem.demonstrations, rankings, problem.settings, problem.seed + 1)
    assert ids != [[one.id for one in resampled(other, number).demonstrations] for number in range(8)]
    assert bootstrap("meirl", problem, n_draws=3).to_json() == bootstrap("meirl", problem, n_draws=3).to_json()


def test_attempts_that_are_left_out_are_drawn_apart_and_stay_left_out():
    problem = small_problem(iterations=5)
    lost = [simulate(problem.world, [LEFT], attempt_id=id_) for id_ in ("e", "f")]
    with_lost = LearningProblem.build(problem.world, [*problem.demonstrations, *lost])
    for number in range(6):
        again = resampled(with_lost, number)
        assert (len(again.successes), len(again.failures), again.n_left_out) == (2, 2, 2)


def test_attempts_all_alike_leave_no_doubt_and_one_of_a_kind_cannot_say():
    problem = small_problem(iterations=5)
    twins = [simulate(problem.world, problem.successes[0].actions.tolist(), attempt_id=id_) for id_ in "xyz"]
    alike = bootstrap("meirl", LearningProblem.build(problem.world, twins, settings=problem.settings), n_draws=4)
    assert alike.policy_agreement.tolist() == [1.0] * 9
    assert alike.return_low == alike.return_high == pytest.approx(expected(problem, twins))
    assert "in at least 90% of them" in alike.sentence
    single = LearningProblem.build(problem.world, problem.successes[:1], settings=problem.settings)
    assert "cannot be said" in bootstrap("meirl", single, n_draws=2).sentence


def expected(problem, demonstrations):
    again = LearningProblem.build(problem.world, demonstrations, settings=problem.settings)
    return expected_return(problem.world, learn("meirl", again).policy)


def test_a_model_without_rewards_has_no_return_to_doubt():
    problem = small_problem(iterations=5)
    found = bootstrap(
        "meirl", LearningProblem.build(problem.mdp, problem.demonstrations, settings=problem.settings), n_draws=2
    )
    assert (found.return_low, found.return_high) == (None, None)
    assert "2 draws" in found.sentence


def test_a_posterior_is_told_in_the_units_of_the_world():
    problem = small_problem(iterations=420)
    result = learn("birlfr", problem)
    found, posterior = from_posterior(problem, result), result.posterior
    assert posterior is not None
    pays = problem.world.rewards[2][2]
    assert (found.return_low, found.return_high) == (posterior.return_low * pays, posterior.return_high * pays)
    assert (found.method, found.level, found.n_draws) == ("posterior", 0.9, posterior.n_draws)
    assert np.array_equal(found.policy_agreement, posterior.policy_agreement)
    assert "believes with 90%" in found.sentence
    with pytest.raises(MissingDemonstrations, match="no posterior"):
        from_posterior(problem, learn("irlr", problem))


def test_what_cannot_be_drawn_is_refused():
    problem = small_problem(iterations=2)
    with pytest.raises(MissingDemonstrations, match="at least one success"):
        bootstrap("meirl", LearningProblem.build(problem.world, problem.failures, settings=Settings(iterations=2)))
    with pytest.raises(InvalidSettings, match="n_draws"):
        bootstrap("meirl", problem, n_draws=0)
    with pytest.raises(InvalidSettings, match="at least one draw"):
        summary(problem, learn("meirl", problem), [])
