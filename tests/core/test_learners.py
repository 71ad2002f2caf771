"""The paper's four learners: what they compute, how they end, that they can be interrupted, what they refuse."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from irl_core import (
    LEARNERS,
    Frame,
    LearningProblem,
    LearningResult,
    LearningState,
    Outcome,
    Ranking,
    Settings,
    World,
    expected_return,
    generate_world,
    learn,
    rank_weights,
    simulate,
    soft_plan,
    visitation,
)
from irl_core.learners import descent
from tests import naive
from tests.core.examples import DOWN, LEFT, RIGHT, attempt, make_problem, ranked

NAMES = [name for name, learner in LEARNERS.items() if learner.family == "paper"]


def small_problem(**changes):
    """A 3×3 world with two successes and two failures that end at the goal, ranked."""
    rewards = np.array([[-0.5, -0.2, -0.3], [-3.0, -0.4, -0.1], [-3.0, -2.0, 2.0]])
    world = World(3, 3, rewards, 0, (8,))
    walks = {"a": [0, 1, 2, 5, 8], "b": [0, 1, 4, 5, 8], "c": [0, 3, 6, 7, 8], "d": [0, 3, 4, 7, 8]}
    ours = [attempt(world, states, id_=id_) for id_, states in walks.items()]
    assert [one.outcome for one in ours] == ["success", "success", "failure", "failure"]
    rankings = [Ranking("success", (("a",), ("b",))), Ranking("failure", (("c",), ("d",)))]
    return LearningProblem.build(world, ours, rankings, Settings(**changes), 0)


def attempt_with_a_slip(world):
    """Right, right, down: the first step slips downward or stays, and the goal is still reached with three steps."""
    for k in range(10_000):
        id_ = f"s{k}"
        states, _ = naive.play(world, [RIGHT, RIGHT, DOWN], id_)
        if states[3] == 3 and 3 not in states[:3]:
            return simulate(world, [RIGHT, RIGHT, DOWN], attempt_id=id_)
    raise AssertionError


def failure_counts(problem):
    counts = descent.aims_of(problem, uses_ranking=True, uses_failures=True).failures
    assert counts is not None
    return counts


def state_of(name, w_success, w_failure, lam):
    return LearningState(name, 0, {"w_success": w_success, "w_failure": w_failure, "lambda": lam})


def missing(problem, learner):
    return problem.missing(learner) or ""


def run(name, problem, *, chunk=1000, through_json=False):
    learner = LEARNERS[name]
    state = learner.start(problem)
    while not state.is_finished:
        state = learner.advance(problem, state, iterations=chunk)
        if through_json:
            state = LearningState.from_json(json.loads(json.dumps(state.to_json())))
    return state


@pytest.mark.parametrize("name", NAMES)
def test_three_iterations_are_algorithm_5_written_out(name):
    problem = small_problem(iterations=3, lambda_start=4.0, lambda_decay=0.5, lambda_min=1.5, learning_rate=0.3)
    world, learner = problem.world, LEARNERS[name]
    theta_d = {"a": 2 / 3, "b": 1 / 3} if learner.uses_ranking else {"a": 1 / 2, "b": 1 / 2}
    theta_f = {"c": 2 / 3, "d": 1 / 3} if learner.uses_ranking else {"c": 1 / 2, "d": 1 / 2}
    mu_d = sum(theta_d[one.id] * np.bincount(one.states, minlength=9) for one in problem.successes)
    mu_f = sum(theta_f[one.id] * np.bincount(one.states, minlength=9) for one in problem.failures)
    w_d, w_f = np.zeros(9), np.zeros(9)
    for lam in (4.0, 2.0, 1.5):
        _, mu = naive.dense_gradient(world, w_d + w_f, horizon=world.horizon)
        w_d = w_d - 0.3 * (mu - mu_d)
        if learner.uses_failures:
            w_f = (mu - mu_f) / lam
    result = learn(name, problem)
    np.testing.assert_allclose(result.reward, w_d + w_f, atol=1e-12)
    assert (result.iterations, result.outcome) == (3, Outcome.ITERATION_LIMIT)


@pytest.mark.parametrize("slip", [0.0, 0.2])
def test_the_log_likelihood_is_that_of_the_enumerated_paths(slip):
    """P(ζ) of states and actions, from all paths of a 2×2 world, the slips' own chance included."""
    world = World(2, 2, np.array([[0.0, -0.1], [-0.2, 2.0]]), 0, (3,), slip=slip, horizon=4)
    one = attempt_with_a_slip(world) if slip else simulate(world, [RIGHT, DOWN], attempt_id="s")
    assert one.outcome == "success"
    problem = LearningProblem.build(world, [one], settings=Settings(iterations=5))
    result = learn("meirl", problem)
    every = list(naive.paths(world, result.reward, start=0, horizon=4))
    ours = [p for p in every if p.states == one.states.tolist() and p.actions == one.actions.tolist()]
    expected = np.log(sum(p.weight for p in ours) / sum(p.weight for p in every))
    assert result.log_likelihood == pytest.approx(expected, abs=1e-12)


def test_the_step_of_meirl_is_the_gradient_of_its_log_likelihood():
    problem = small_problem()
    aims = descent.aims_of(problem, uses_ranking=True, uses_failures=False)
    w, h = np.random.default_rng(0).normal(-1, 0.5, 9), 1e-4

    def log_likelihood(weights):
        return descent.look(problem, state_of("irlr", weights, np.zeros(9), 1.0), aims).log_likelihood

    gradient = aims.successes - visitation(problem.world, soft_plan(problem.world, w))
    for state in range(9):
        e = h * (np.arange(9) == state)
        slope = (8 * (log_likelihood(w + e) - log_likelihood(w - e))
                 - (log_likelihood(w + 2 * e) - log_likelihood(w - 2 * e))) / (12 * h)  # fmt: skip
        assert slope == pytest.approx(gradient[state], abs=1e-8)


@pytest.mark.parametrize("name", NAMES)
def test_a_run_in_pieces_and_through_json_is_the_uninterrupted_one_bit_for_bit(name):
    problem = small_problem(iterations=60, initial_weights="uniform")
    whole = run(name, problem)
    pieces = run(name, problem, chunk=7, through_json=True)
    assert whole.to_json() == pieces.to_json()
    first, second = (LEARNERS[name].result(problem, state).to_json() for state in (whole, pieces))
    assert first == second
    assert LearningResult.from_json(json.loads(json.dumps(first))).to_json() == first


@given(cuts=st.lists(st.integers(1, 30), min_size=1, max_size=6), name=st.sampled_from(NAMES))
@settings(max_examples=15, deadline=None)
def test_however_the_iterations_are_portioned_out_the_state_is_the_same(cuts, name):
    problem = small_problem(iterations=40)
    learner = LEARNERS[name]
    state = learner.start(problem)
    for cut in [*cuts, 40]:
        state = learner.advance(problem, state, iterations=cut)
    assert state.to_json() == run(name, problem).to_json()
    assert learner.advance(problem, state, iterations=5) is state


@pytest.mark.parametrize("name", NAMES)
def test_the_order_in_which_demonstrations_are_given_changes_no_bit(name):
    problem = small_problem(iterations=30)
    shuffled = LearningProblem.build(
        problem.world,
        problem.demonstrations[::-1],
        [Ranking("failure", problem.orders["failure"]), Ranking("success", problem.orders["success"])],
        problem.settings,
        problem.seed,
    )
    assert learn(name, problem).to_json() == learn(name, shuffled).to_json()


def test_a_demonstration_split_in_two_of_half_the_weight_changes_nothing():
    problem = small_problem(iterations=30)
    twice = [
        attempt(problem.world, one.states.tolist(), id_=f"{one.id}{k}") for one in problem.demonstrations for k in "12"
    ]
    split = LearningProblem.build(problem.world, twice, (), problem.settings)
    for name in ("meirl", "irlf"):
        np.testing.assert_allclose(learn(name, split).reward, learn(name, problem).reward, atol=1e-10)


def test_a_complete_tie_makes_ranking_learners_the_unranked_ones():
    problem = small_problem(iterations=30)
    tied = LearningProblem.build(
        problem.world,
        problem.demonstrations,
        [Ranking("success", (("a", "b"),)), Ranking("failure", (("d", "c"),))],
        problem.settings,
    )
    for ranking, plain in (("irlr", "meirl"), ("irlfr", "irlf")):
        np.testing.assert_array_equal(learn(ranking, tied).reward, learn(plain, tied).reward)


@pytest.mark.parametrize("lam", [0.1, 3.0, 10.0])
def test_a_reward_that_matches_the_successes_is_a_fixed_point_of_irlf_whatever_the_failures(lam):
    """PAPER: w_D absorbs what w_F adds. With μ^π = μ̃ᴰ the step on w_D is 0 and w_F stays at (μ̃ᴰ − μ̃ᶠ) / λ.

    One iteration is asked for: at small λ the point is there, but the iteration flees from it.
    """
    problem = small_problem(lambda_start=lam, lambda_decay=1.0, lambda_min=lam, tolerance=1e-12)
    reward = np.random.default_rng(0).normal(-1.0, 0.5, 9)
    matched = visitation(problem.world, soft_plan(problem.world, reward))
    failed = failure_counts(problem)
    at_start = problem.mdp.starts
    aims = descent.Aims(matched + 1e-11, failed, at_start, at_start, 0.0)  # just enough of a gap to go on
    w_failure = (matched - failed) / lam
    state = state_of("irlf", reward - w_failure, w_failure, lam)
    later = descent.advance(problem, state, aims, iterations=1)
    assert later.iteration == 1
    np.testing.assert_allclose(later.vector("w_success") + later.vector("w_failure"), reward, atol=1e-10)


def test_while_lambda_is_constant_failures_are_momentum_and_their_counts_cancel():
    """w_{t+1} = w_t − α (μ_t − μ̃ᴰ) + (μ_t − μ_{t−1}) / λ, in which no failure is left."""
    problem = small_problem(lambda_start=12.0, lambda_min=12.0, learning_rate=0.2)
    learner, wanted = LEARNERS["irlfr"], descent.aims_of(problem, uses_ranking=True, uses_failures=False).successes
    state, weights, visits = learner.start(problem), [np.zeros(9)], []
    for _ in range(6):
        visits.append(visitation(problem.world, soft_plan(problem.world, weights[-1])))
        state = learner.advance(problem, state, iterations=1)
        weights.append(state.vector("w_success") + state.vector("w_failure"))
    for t in range(1, 6):
        step = -0.2 * (visits[t] - wanted) + (visits[t] - visits[t - 1]) / 12.0
        np.testing.assert_allclose(weights[t + 1], weights[t] + step, atol=1e-12)


def test_the_rule_of_curvature_follows_the_largest_eigenvalue_and_keeps_irlf_from_exploding():
    explosive = {"lambda_start": 10.0, "lambda_min": 0.3, "iterations": 300}
    wild = learn("irlf", small_problem(**explosive))
    tame = learn("irlf", small_problem(**explosive, lambda_rule="curvature"))
    assert wild.gap > 0.5
    assert tame.gap < 0.1
    problem = small_problem(lambda_rule="curvature", iterations=300)
    learner = LEARNERS["irlf"]
    state = learner.advance(problem, learner.start(problem), iterations=200)
    aims = descent.aims_of(problem, uses_ranking=False, uses_failures=True)
    _, curvature = descent._largest_curvature(problem, state, aims)
    reward, h = state.vector("w_success") + state.vector("w_failure"), 1e-5
    hessian = [
        visitation(problem.world, soft_plan(problem.world, reward + h * e))
        - visitation(problem.world, soft_plan(problem.world, reward - h * e))
        for e in np.eye(9)
    ]
    largest = np.linalg.eigvalsh(np.array(hessian) / (2 * h))[-1]
    assert curvature == pytest.approx(largest, rel=0.02)


@pytest.mark.parametrize(("name", "twin"), [("irlf", "meirl"), ("irlfr", "irlr")])
def test_with_enough_iterations_failures_change_nothing_both_match_the_successes(name, twin):
    """λ is kept above the curvature; squares that no success visits make the last digits slow (their reward → −∞)."""
    problem = small_problem(learning_rate=0.5, iterations=2000, tolerance=0.01, lambda_start=20.0, lambda_min=20.0)
    ours, theirs = learn(name, problem), learn(twin, problem)
    assert (ours.outcome, theirs.outcome) == (Outcome.CONVERGED, Outcome.CONVERGED)
    np.testing.assert_allclose(ours.visitation, theirs.visitation, atol=0.02)


def test_ranking_moves_the_visits_toward_the_best_success():
    problem = small_problem(iterations=800, learning_rate=0.3)
    plain, by_rank = learn("meirl", problem), learn("irlr", problem)
    assert by_rank.visitation[2] == pytest.approx(2 / 3, abs=0.02)  # "a" alone passes square 2
    assert plain.visitation[2] == pytest.approx(1 / 2, abs=0.02)


def test_at_the_defaults_the_papers_order_holds_on_a_typical_world():
    problem = make_problem()
    returns = {name: expected_return(problem.world, learn(name, problem).policy) for name in NAMES}
    assert min(returns, key=returns.__getitem__) == "meirl"
    assert returns["irlr"] > returns["meirl"]
    assert returns["irlfr"] > returns["irlf"] > returns["meirl"]


def test_converged_says_so_and_matches_the_attempts():
    result = learn("meirl", small_problem(learning_rate=0.5, iterations=5000, tolerance=5e-3))
    assert result.outcome is Outcome.CONVERGED
    assert result.gap < 5e-3
    assert result.sentence.startswith("Converged after")
    assert result.spectral_radius < 1
    assert result.executed_gap < 0.05


def test_a_limit_that_comes_too_soon_warns():
    result = learn("irlf", make_problem(iterations=2))
    assert result.outcome is Outcome.ITERATION_LIMIT
    assert "still wide" in result.sentence
    assert "ρ" in result.sentence
    assert "Executed at every step alike" in result.sentence


def test_a_tiny_lambda_diverges_and_the_last_weights_are_kept():
    problem = small_problem(lambda_start=1e-8, lambda_min=1e-8)
    result = learn("irlf", problem)
    assert result.outcome is Outcome.DIVERGED
    assert np.isfinite(result.reward).all()
    assert np.abs(result.reward).max() <= 2 * descent.WEIGHT_LIMIT
    assert "larger λ_min" in result.sentence


def test_a_learner_that_is_stopped_says_so():
    asked = iter([False, False, True])
    frames: list[Frame] = []
    result = learn("irlr", small_problem(), on_frame=frames.append, frame_every=5, should_stop=lambda: next(asked))
    assert (result.outcome, result.iterations) == (Outcome.STOPPED, 10)
    assert result.sentence.startswith("Stopped after 10 of 500 iterations")
    assert [frame.iteration for frame in frames] == [0, 5, 10]


def test_a_frame_shows_the_state_it_was_made_of():
    problem, learner = small_problem(), LEARNERS["irlf"]
    state = learner.advance(problem, learner.start(problem), iterations=20)
    frame = learner.frame(problem, state)
    np.testing.assert_array_equal(frame.reward, state.vector("w_success") + state.vector("w_failure"))
    plan = soft_plan(problem.world, frame.reward)
    np.testing.assert_allclose(frame.policy, plan.policy, rtol=1e-12)
    wanted = [1, 1, 0.5, 0, 0.5, 1, 0, 0, 1]
    assert frame.gap == pytest.approx(np.abs(visitation(problem.world, plan) - wanted).max(), rel=1e-12)
    assert (frame.iteration, frame.iterations) == (20, 500)
    data = json.loads(json.dumps(frame.to_json(digits=5)))
    assert data["gap"] == float(f"{frame.gap:.5g}")
    assert np.shape(data["policy"]) == (9, 4)


@pytest.mark.parametrize("name", NAMES)
def test_the_result_in_json_has_the_shapes_of_the_api(name):
    data = learn(name, small_problem(iterations=5)).to_json()
    assert np.shape(data["reward"]) == np.shape(data["visitation"]) == (3, 3)
    assert np.shape(data["policy"]) == (9, 4)
    assert data["outcome"] == "iteration_limit"


def test_drawn_start_weights_come_from_the_seed_and_are_the_same_for_every_learner():
    one, other = (
        LearningProblem.build(p.world, p.demonstrations, ranked(p.successes, p.failures), p.settings, seed)
        for p, seed in ((small_problem(initial_weights="uniform"), 1), (small_problem(initial_weights="uniform"), 2))
    )
    starts = [LEARNERS[name].start(one).vector("w_success") for name in NAMES]
    assert all(np.array_equal(starts[0], start) for start in starts)
    assert np.abs(starts[0]).max() <= 1
    assert not np.array_equal(starts[0], LEARNERS["meirl"].start(other).vector("w_success"))


def test_failures_that_never_arrived_are_left_out_and_the_rest_is_ranked_anew():
    problem = small_problem()
    lost = simulate(problem.world, [LEFT], attempt_id="e")
    rankings = [Ranking("success", (("a",), ("b",))), Ranking("failure", (("e",), ("c",), ("d",)))]
    given_all = [*problem.demonstrations, lost]
    without = LearningProblem.build(problem.world, given_all, rankings)
    assert without.n_left_out == 1
    assert without.failure_weights(ranked=True) == pytest.approx(rank_weights([["c"], ["d"]]))
    assert learn("irlfr", without).n_left_out == 1
    assert learn("irlr", without).n_left_out == 0
    including = LearningProblem.build(
        problem.world, given_all, rankings, Settings(unfinished_failures="include", iterations=5)
    )
    assert including.n_left_out == 0
    assert including.failure_weights(ranked=True) == pytest.approx(rank_weights([["e"], ["c"], ["d"]]))
    assert np.isfinite(learn("irlfr", including).reward).all()


def test_slip_walls_and_several_goals_can_be_learned_from():
    rewards = generate_world(20, rows=5, cols=5).rewards.copy()
    rewards[4, 4], rewards[4, 0] = 50.0, 5.0
    world = World(5, 5, rewards, 0, (24, 20), (7, 12), 0.2)
    rng = np.random.default_rng(0)
    ours = []
    for k in range(400):
        actions = rng.integers(0, 4, world.horizon).tolist()
        states, _ = naive.play(world, actions, f"d{k}")
        arrived = next((t for t, s in enumerate(states) if s in world.goals), None)
        if arrived:
            ours.append(simulate(world, actions[:arrived], attempt_id=f"d{k}"))
    worst, best = min(ours, key=lambda one: one.total), max(ours, key=lambda one: one.total)
    assert (worst.outcome, best.outcome) == ("failure", "success")
    result = learn("irlfr", LearningProblem.build(world, [worst, best], settings=Settings(iterations=50)))
    assert np.isfinite(result.reward).all()
    np.testing.assert_allclose(result.policy.sum(axis=1), 1)


def test_every_learner_says_who_it_is_and_names_its_sources():
    for name, learner in LEARNERS.items():
        assert learner.name == name
        assert learner.summary.endswith(".")
        assert name == "random" or learner.references
    for name in NAMES:
        assert LEARNERS[name].title == name.upper()
        assert any("Ziebart" in reference for reference in LEARNERS[name].references)
