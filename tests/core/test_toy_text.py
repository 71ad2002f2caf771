"""FrozenLake, CliffWalking and Taxi learned from scripted demonstrations: somebody who knows the way, and slips.

Nothing but states and actions is learned from, and which attempts were successes, in what order. What was learned is
then measured by what the environment itself pays.
"""

from typing import Any

import gymnasium
import numpy as np
import pytest

from irl_core import (
    Demonstration,
    LearningProblem,
    Ranking,
    Settings,
    demonstration_of,
    expected_return,
    greedy_plan,
    infer,
    learn,
    optimum,
)
from irl_core.mdp import SparseMdp
from irl_core.mdp.toy_text import from_gymnasium
from irl_core.sparse_evaluation import best_plan
from irl_core.types import DemonstrationOutcome

HOLES, LAKE_GOAL = [5, 7, 11, 12], 15


def play(name, n_attempts, *, carelessness=0.0, is_success, **settings):
    """Attempts of somebody who plans for what the environment pays and acts at random now and then: model, attempts."""
    env: Any = gymnasium.make(name, **settings)
    mdp, rng = from_gymnasium(env), np.random.default_rng(0)
    plan = best_plan(hurried(mdp))  # so that the demonstrator does not dawdle where only arriving pays
    attempts = []
    for k in range(n_attempts):
        state, _ = env.reset(seed=1000 + k)
        states, ended, cut = [int(state)], False, False
        actions: list[int] = []
        rewards: list[float] = []
        while not (ended or cut or len(actions) == mdp.horizon):
            careless = rng.random() < carelessness
            action = int(rng.integers(mdp.n_actions)) if careless else int(plan.actions[-1, states[-1]])
            state, reward, ended, cut, _ = env.step(action)
            states.append(int(state))
            actions.append(action)
            rewards.append(float(reward))
        outcome: DemonstrationOutcome = "success" if ended and is_success(states, rewards) else "failure"
        attempts.append(demonstration_of(mdp, states, actions, id=f"{k:03}", outcome=outcome, rewards=rewards))
    return mdp, attempts


def hurried(mdp):
    """The model that charges 0.01 for each step besides."""
    return SparseMdp(
        mdp.indptr, mdp.indices, mdp.probabilities, mdp.n_states, mdp.n_actions, mdp.entry_pays - 0.01, mdp.terminal,
        mdp.starts, horizon=mdp.horizon,
    )  # fmt: skip


def ranked(attempts):
    """Successes best first, failures that arrived worst first, by what the environment paid."""
    by_total = sorted(attempts, key=lambda one: (one.total, -one.n_steps))
    successes = [one for one in reversed(by_total) if one.outcome == "success"]
    failures = [one for one in by_total if one.outcome == "failure" and one.reached_goal]
    orders: list[tuple[DemonstrationOutcome, list[Demonstration]]] = [("success", successes), ("failure", failures)]
    return [Ranking(outcome, tuple((one.id,) for one in order)) for outcome, order in orders if order]


def taught(learner, mdp, attempts, **settings):
    """The result of a learner on these attempts."""
    return learn(learner, LearningProblem.build(mdp, attempts, ranked(attempts), Settings(**settings), 0))


@pytest.fixture(scope="module")
def dry_lake():
    return play(
        "FrozenLake-v1", 20, carelessness=0.2, is_slippery=False, is_success=lambda states, _: states[-1] == LAKE_GOAL
    )


@pytest.mark.parametrize("learner", ["meirl", "irlr", "irlf", "irlfr"])
@pytest.mark.parametrize("inference", ["path", "causal"])
def test_a_lake_that_is_not_slippery_is_crossed(dry_lake, learner, inference):
    """Falling into a hole ends an attempt as well: those are the failures."""
    mdp, attempts = dry_lake
    assert {one.outcome for one in attempts} == {"success", "failure"}
    found = taught(learner, mdp, attempts, inference=inference)
    assert expected_return(mdp, greedy_plan(mdp, found.reward)) == 1.0
    assert expected_return(mdp, found.policy) > 0.9
    assert found.visitation[HOLES].sum() < 0.05


@pytest.fixture(scope="module")
def slippery_lake():
    return play("FrozenLake-v1", 200, is_success=lambda *_: True)


def test_on_a_slippery_lake_causal_inference_learns_what_path_inference_cannot(slippery_lake):
    """Every attempt shows what an expert does, those that end in a hole included: outcomes are luck here.

    Planning for the causal reward succeeds in 70 % of episodes, the optimum in 74 %. Path inference takes luck for
    skill, and its reward is worth nothing. (The ridge is needed: counts of 200 attempts are those of no policy at all.)
    """
    mdp, attempts = slippery_lake
    causal, path = (
        taught("meirl", mdp, attempts, inference=kind, optimiser="lbfgs", l2=0.01) for kind in ("causal", "path")
    )
    best, random = optimum(mdp), expected_return(mdp, np.full((16, 4), 0.25))
    assert best == pytest.approx(0.744, abs=1e-3)
    assert expected_return(mdp, best_plan(mdp, causal.reward)) > 0.9 * best
    assert expected_return(mdp, causal.policy) > 0.6 * best > 20 * random
    assert expected_return(mdp, best_plan(mdp, path.reward)) < 0.2 * best


@pytest.mark.parametrize("learner", ["meirl", "irlr", "irlf", "irlfr"])
def test_the_cliff_is_passed_as_closely_as_can_be(learner):
    """Failures fell at least once, were put back to the start, and arrived all the same."""
    mdp, attempts = play("CliffWalking-v1", 16, carelessness=0.15, is_success=lambda _, rewards: min(rewards) > -100)
    assert {one.outcome for one in attempts} == {"success", "failure"}
    found = taught(learner, mdp, attempts)
    assert expected_return(mdp, greedy_plan(mdp, found.reward)) == optimum(mdp) == -13.0
    assert expected_return(mdp, found.policy) > -25.0 > expected_return(mdp, np.full((48, 4), 0.25))


def test_taxi_learned_from_a_hundred_rides_is_driven_as_well_as_can_be_from_all_starts():
    mdp, attempts = play("Taxi-v4", 100, is_success=lambda *_: True)
    assert len({int(one.states[0]) for one in attempts}) < 100 < len(mdp.start_states) == 300
    found = taught("meirl", mdp, attempts, optimiser="lbfgs", l2=0.01, tolerance=1e-3)
    assert found.outcome.name == "CONVERGED"
    best = optimum(mdp)
    assert best == pytest.approx(7.93, abs=0.005)
    assert expected_return(mdp, greedy_plan(mdp, found.reward)) > best - 0.5


def test_every_kind_of_inference_takes_taxi_as_it_takes_a_world():
    mdp = from_gymnasium(gymnasium.make("Taxi-v4"))
    for kind in ("path", "path_infinite", "causal", "ziebart"):
        found = infer(mdp, np.full(500, -3.0), inference=kind)
        np.testing.assert_allclose(found.policy.sum(axis=1), 1.0, atol=1e-12)
        assert found.visitation.sum() > 1.0
