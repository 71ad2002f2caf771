"""Bayesian IRLFR: its posterior against a naive twin, its chain against importance sampling, its promises to people."""

import json
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from irl_core import _kernels
from irl_core.demonstrators import demonstrate
from irl_core.errors import InvalidModel, IrlError, MissingDemonstrations
from irl_core.evaluation import expected_return, greedy_plan, optimum
from irl_core.gridworld import draw_playable_world
from irl_core.learners import LearningProblem, LearningResult, LearningState, Outcome, Settings, learn
from irl_core.learners.birlfr import Birlfr
from irl_core.learners.birlfr.chain import Chain
from irl_core.learners.birlfr.decision import best_actions
from irl_core.learners.birlfr.model import Model
from irl_core.mdp import GridMdp
from irl_core.planning import soft_plan
from irl_core.playing import simulate
from irl_core.trajectories import demonstration_of
from irl_core.types import Ranking, World
from tests.core import naive_birlfr
from tests.core.examples import DOWN, LEFT, RIGHT, UP, attempt, make_world

LEARNER = Birlfr()


def problem_of(kind, *, seed=0, world=None, rankings=True, **changes):
    """A person of this kind, three successes and three failures."""
    rng = np.random.default_rng(seed)
    while True:
        played_in = draw_playable_world(rng, rows=5, cols=5) if world is None else world
        left = demonstrate(kind, played_in, rng)
        if left is not None:
            return LearningProblem.build(
                played_in, left.demonstrations, left.rankings if rankings else (), Settings(**changes), seed
            )


def tiny_problem(*, goals=(5,), walls=(), slip=0.0, **changes):
    """A 2×3 world, one success, a failure with a bump and a loop, one that gave up, a tie."""
    rewards = np.array([[-0.5, -0.2, -3.0], [-2.0, -0.4, 1.0]])
    rewards.flat[list(goals)] = 1.0
    world = World(2, 3, rewards, 0, goals, walls, slip)
    plays = {"a": [RIGHT, DOWN, RIGHT], "b": [UP, DOWN, LEFT, RIGHT, RIGHT], "c": [DOWN, UP], "d": [DOWN, RIGHT, RIGHT]}
    ours = [played(world, actions, id_=id_) for id_, actions in plays.items()]
    by_outcome = {kind: [one.id for one in ours if one.outcome == kind] for kind in ("success", "failure")}
    rankings = []
    if by_outcome["success"]:
        rankings.append(Ranking("success", tuple((id_,) for id_ in by_outcome["success"])))
    if by_outcome["failure"]:
        first, *others = by_outcome["failure"]
        rankings.append(Ranking("failure", ((first,), tuple(others)) if others else ((first,),)))
    return LearningProblem.build(world, ours, rankings, Settings(unfinished_failures="include", **changes), 1)


def played(world, actions, *, id_):
    """As many of the actions as it takes to reach a goal, or all."""
    for n_steps in range(1, len(actions)):
        one = simulate(world, actions[:n_steps], attempt_id=id_)
        if one.reached_goal:
            return one
    return simulate(world, actions, attempt_id=id_)


VARIANTS: dict[str, dict[str, Any]] = {
    "plain": {},
    "walls": {"walls": (4,), "goals": (3, 2)},
    "slip": {"slip": 0.25},
    "two goals": {"goals": (5, 2)},
    "no colours": {"use_colours": "no"},
}


@pytest.mark.parametrize("variant", VARIANTS)
def test_the_log_posterior_is_what_its_formulas_say(variant):
    model = Model(problem := tiny_problem(**VARIANTS[variant]))
    rng = np.random.default_rng(3)
    for _ in range(5):
        q = 0.7 * rng.standard_normal(model.dimension)
        expected = naive_birlfr.log_posterior(problem, model.squares, model.prior, q)
        assert model.log_posterior(q)[0] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("variant", VARIANTS)
def test_the_gradient_agrees_with_finite_differences(variant):
    model = Model(tiny_problem(**VARIANTS[variant]))
    q, h = 0.7 * np.random.default_rng(4).standard_normal(model.dimension), 1e-5
    _, gradient, _ = model.log_posterior(q)
    for i, unit in enumerate(np.eye(model.dimension)):
        slope = (model.log_posterior(q + h * unit)[0] - model.log_posterior(q - h * unit)[0]) / (2 * h)
        assert gradient[i] == pytest.approx(slope, abs=1e-6, rel=1e-6)


def test_the_path_sum_is_that_of_planning_with_a_long_horizon():
    world = make_world(4, 5, walls=(7,), seed=2)
    problem = LearningProblem.build(world, [one_way(world)], settings=Settings(unfinished_failures="include"))
    model = Model(problem)
    action = np.append(np.random.default_rng(0).uniform(1.5, 3.0, len(model.squares)), 0.0)
    band, v = np.zeros((len(model.squares), model.evidence.width + 1)), np.zeros(len(model.squares))
    assert _kernels.birlfr.path_sums(action, model.evidence.neighbours, band, v)
    reward = np.zeros(world.n_states)
    reward[model.squares] = -action[:-1]
    plan = soft_plan(world, reward, horizon=400)
    assert np.log(v[model.squares == world.start][0]) == pytest.approx(plan.log_partition, abs=1e-10)


def test_a_look_three_steps_ahead_solved_by_hand():
    """Two squares in a row, the goal behind the second; squares cost nothing, each step beyond halves the weight.

    u_0 = (1/4, 1/2), u_1 = (3/4 + 1/2, 1 + 1 + 1/4), u_2 = (15/4 + 9/4, 9/2 + 1 + 5/4): right weighs 27/4 of 99/4.
    """
    neighbours = np.array([[0, 1, 0, 0], [1, 2, 1, 0]], dtype=np.int32)
    moves = np.array([[0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]])
    distances = np.array([2.0, 1.0])
    value, _, _ = _kernels.birlfr.look_steps(np.zeros(3), math.log(2.0), distances, neighbours, moves, 0.0, np.zeros(3))
    assert value == pytest.approx(math.log(3.0 / 11.0), abs=1e-12)


def one_way(world):
    """The shortest way to the goal, as an attempt."""
    plan = greedy_plan(world, np.where(np.arange(world.n_states) == world.goal, 1.0, -1.0))
    states = [world.start]
    while states[-1] not in world.goals:
        states.append(int(world.next_states[states[-1], plan.actions[-1][states[-1]]]))
    return attempt(world, states, id_="w")


def test_the_chain_finds_the_means_that_importance_sampling_finds():
    problem = tiny_problem(iterations=3000)
    model, rng = Model(problem), np.random.default_rng(5)
    log_weights, costs = np.empty(40_000), np.empty((40_000, model.n_costs))
    for k in range(len(log_weights)):
        q = rng.standard_normal(model.dimension)
        log_weights[k], _, costs[k] = model.log_posterior(q)
        log_weights[k] += 0.5 * q @ q  # drawn from the prior: what weighs is the likelihood
    weights = np.exp(log_weights - log_weights.max())
    weights /= weights.sum()
    n_effective = 1.0 / (weights**2).sum()
    mean = weights @ costs
    spread = np.sqrt(weights @ (costs - mean) ** 2)
    chain = Chain.at_start(model, seed=1, iterations=3000)
    for _ in range(3000):
        chain.advance()
    assert n_effective > 500
    # Within a tenth of a posterior standard deviation: some three standard errors of either estimate.
    np.testing.assert_array_less(np.abs(chain.mean_costs - mean), 0.1 * spread + 1e-12)
    assert chain.split_r_hat() < 1.05


def test_learning_can_be_cut_anywhere_and_pass_through_json():
    problem = problem_of("wanderer", iterations=60)
    whole = LEARNER.advance(problem, LEARNER.start(problem), iterations=60)
    state = LEARNER.start(problem)
    for share in (1, 22, 7, 30):
        state = LearningState.from_json(json.loads(json.dumps(state.to_json())))
        state = LEARNER.advance(problem, state, iterations=share)
    assert state.to_json() == whole.to_json()
    one, other = LEARNER.result(problem, whole), LEARNER.result(problem, state)
    assert one.to_json() == other.to_json() == LearningResult.from_json(one.to_json()).to_json()


def test_the_order_in_which_attempts_are_given_changes_no_bit():
    problem = problem_of("mixture", iterations=40)
    turned = LearningProblem.build(
        problem.model,
        problem.demonstrations[::-1],
        [Ranking(outcome, groups) for outcome, groups in reversed(problem.orders.items())],
        problem.settings,
        problem.seed,
    )
    assert learn(LEARNER, problem).to_json() == learn(LEARNER, turned).to_json()


def test_scores_are_never_used():
    """The same colours, attempts, outcomes and order under other rewards: the same bits."""
    problem = problem_of("perceptual", iterations=40)
    world = problem.world
    red = world.rewards < -1.0
    rewards = np.where(world.rewards > 0.0, world.rewards, np.where(red, world.rewards * 1.001, world.rewards * 0.999))
    other = World(world.rows, world.cols, rewards, world.start, world.goals)
    again = [simulate(other, one.actions.tolist(), attempt_id=one.id) for one in problem.demonstrations]
    assert [one.outcome for one in again] == [one.outcome for one in problem.demonstrations]
    rankings = [Ranking(outcome, groups) for outcome, groups in problem.orders.items()]
    elsewhere = LearningProblem.build(other, again, rankings, problem.settings, problem.seed)
    np.testing.assert_array_equal(learn(LEARNER, problem).reward, learn(LEARNER, elsewhere).reward)


@pytest.mark.parametrize("kind", ["boltzmann", "wanderer", "shortest_path"])
def test_a_run_converges_plans_well_and_says_how_sure_it_is(kind):
    problem = problem_of(kind, seed=5)
    found, world = learn(LEARNER, problem, frame_every=1000), problem.world
    posterior = found.posterior
    assert posterior is not None
    assert found.outcome is Outcome.CONVERGED
    assert "quarters agree" in found.sentence
    assert (posterior.reward_low <= posterior.reward_high).all()
    assert ((posterior.policy_agreement >= 0.0) & (posterior.policy_agreement <= 1.0)).all()
    assert posterior.return_low < posterior.return_high < 1.0
    assert posterior.n_draws >= 250
    assert found.reward[world.goal] == 1.0
    assert (np.delete(found.reward, world.goal) < 0.0).all()
    assert expected_return(world, found.policy) > 0.7 * optimum(world)
    assert expected_return(world, found.policy) == pytest.approx(
        expected_return(world, greedy_plan(world, found.reward)), abs=1e-9
    )


def test_red_is_taken_to_cost_more_only_where_colours_are_used():
    rewards = np.full((3, 3), -0.1)
    rewards[0, 1], rewards[2, 2] = -4.0, 6.0
    world = World(3, 3, rewards, 0, (8,))
    ours = [attempt(world, [0, 3, 6, 7, 8], id_="a")]
    with_colours, without = (
        learn(LEARNER, LearningProblem.build(world, ours, settings=Settings(use_colours=use))).reward
        for use in ("yes", "no")
    )
    assert with_colours[1] < 2.0 * with_colours[2]
    assert without[1] > 2.0 * without[2]


def test_what_an_attempt_entered_is_bounded_by_its_label():
    """One success through every square of a corridor: together they cost hardly more than the goal pays."""
    world = World(1 + 1, 6, np.array([[-0.5] * 5 + [6.0], [-0.5] * 6]), 0, (5,), walls=(6, 7, 8, 9, 10, 11))
    found = learn(LEARNER, LearningProblem.build(world, [attempt(world, [0, 1, 2, 3, 4, 5], id_="a")]))
    assert -found.reward[1:5].sum() < 1.1
    assert found.posterior is not None
    assert found.posterior.return_high > 0.0


@pytest.mark.parametrize("changes", [{"slip": 0.3}, {"goals": (5, 2)}, {"walls": (4,), "goals": (3, 2)}])
def test_walls_slip_and_several_goals_are_learned_in(changes):
    problem = tiny_problem(iterations=60, **changes)
    found = learn(LEARNER, problem)
    assert np.isfinite(found.reward).all()
    np.testing.assert_allclose(found.policy.sum(axis=1), 1.0)
    assert found.visitation[list(changes.get("goals", (5,)))].sum() == pytest.approx(
        1.0, abs=0.05
    )  # the horizon is short for slips


def test_nothing_but_one_failure_that_gave_up_is_enough_to_begin():
    problem = tiny_problem(iterations=30)
    alone = LearningProblem.build(problem.model, [problem.demonstrations[2]], settings=problem.settings)
    assert np.isfinite(learn(LEARNER, alone).reward).all()
    with pytest.raises(MissingDemonstrations, match="at least one attempt"):
        LEARNER.start(LearningProblem.build(problem.model, []))


def test_few_iterations_end_at_the_limit_with_a_sentence():
    found = learn(LEARNER, problem_of("myopic", iterations=30))
    assert found.outcome is Outcome.ITERATION_LIMIT
    assert "too few to judge by" in found.sentence
    problem = problem_of("myopic")
    assert LEARNER.result(problem, LEARNER.start(problem)).sentence.startswith("Stopped after 0 iterations")


def test_large_grids_and_states_of_other_worlds_are_refused():
    world = make_world(21, 21)
    with pytest.raises(InvalidModel, match="up to 400 open squares; this one has 440"):
        LEARNER.start(LearningProblem.build(world, [one_way(world)], settings=Settings(unfinished_failures="include")))
    state = LEARNER.start(tiny_problem())
    with pytest.raises(IrlError, match="this problem has"):
        LEARNER.advance(problem_of("myopic"), state, iterations=1)


def test_a_grid_without_rewards_and_with_several_starts_will_do():
    starts = np.array([0.5, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    mdp = GridMdp(3, 3, (8,), start=starts)
    ours = [
        demonstration_of(mdp, [0, 3, 6, 7, 8], [DOWN, DOWN, RIGHT, RIGHT], id="a", outcome="success"),
        demonstration_of(mdp, [2, 1, 4, 7, 8], [LEFT, DOWN, DOWN, RIGHT], id="b", outcome="failure"),
    ]
    found = learn(LEARNER, LearningProblem.build(mdp, ours, settings=Settings(iterations=100)))
    assert found.reward[[1, 4]].sum() < found.reward[[3, 6]].sum()
    with pytest.raises(InvalidModel, match="learns in grids"):
        LEARNER.start(LearningProblem.build(mdp.to_sparse(), ours))


def test_with_slip_the_plan_is_the_stochastic_shortest_path():
    """No policy that differs in one square costs less from anywhere, by their exact costs."""
    model = Model(tiny_problem(slip=0.3))
    costs = np.append(np.random.default_rng(1).uniform(0.1, 1.0, len(model.squares)), 0.0)
    chosen = best_actions(model, costs[None])[0]
    ahead, n = model.evidence.neighbours, len(model.squares)

    def cost_to_go(policy):
        law = np.full((n, 4), 0.1)
        law[np.arange(n), policy] = 0.7
        moves, paid = np.zeros((n, n + 1)), np.zeros(n)
        for s in range(n):
            for d in range(4):
                moves[s, ahead[s, d]] += law[s, d]
                paid[s] += law[s, d] * costs[ahead[s, d]]
        return np.linalg.solve(np.eye(n) - moves[:, :n], paid)

    best = cost_to_go(chosen)
    for s in range(n):
        for action in range(4):
            other = chosen.copy()
            other[s] = action
            assert (cost_to_go(other) >= best - 1e-8).all()


@hypothesis_settings(max_examples=25, deadline=None)
@given(scale=st.floats(0.0, 40.0), seed=st.integers(0, 10_000))
def test_no_position_however_far_out_gives_nan(scale, seed):
    model = Model(tiny_problem(goals=(5, 2)))
    value, gradient, _ = model.log_posterior(scale * np.random.default_rng(seed).standard_normal(model.dimension))
    assert value == -math.inf or (math.isfinite(value) and np.isfinite(gradient).all())
