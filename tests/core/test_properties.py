"""What must hold of every inference and learner, in any world up to 12×12 and for any finite weights up to ±1000."""

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from irl_core import (
    DivergentPartition,
    GridMdp,
    InvalidModel,
    LearningProblem,
    Ranking,
    Settings,
    demonstration_of,
    infer,
    infer_batch,
    learn,
)
from irl_core.inference import INFERENCE_KINDS
from irl_core.mdp import SparseMdp

COMMON = settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.too_slow])


@st.composite
def grids(draw, largest=12, *, may_slip=True):
    """Any grid whose goal can be reached, with walls, one or two goals and one or two starts."""
    rows, cols = draw(st.integers(1, largest)), draw(st.integers(2, largest))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    squares = rng.permutation(rows * cols)
    n_goals = draw(st.integers(1, 2)) if rows * cols > 3 else 1
    goals, starts = squares[:n_goals], squares[n_goals : n_goals + draw(st.integers(1, 2))]
    n_walls = draw(st.integers(0, rows * cols // 3))
    walls = squares[len(goals) + len(starts) :][:n_walls]
    start = np.zeros(rows * cols)
    start[starts] = rng.dirichlet(np.ones(len(starts)))
    slip = draw(st.sampled_from([0.0, 0.1, 0.5])) if may_slip else 0.0
    try:
        mdp = GridMdp(rows, cols, tuple(goals.tolist()), tuple(walls.tolist()), slip, start=start)
        mdp_of_each = [GridMdp(rows, cols, mdp.goals, mdp.walls, start=int(one), horizon=mdp.horizon) for one in starts]
    except InvalidModel:
        assume(False)
    assert mdp_of_each
    return mdp


@st.composite
def grids_and_rewards(draw, largest=12, scales=(0.1, 3.0, 30.0, 1000.0)):
    mdp = draw(grids(largest))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    scale = draw(st.sampled_from(scales))
    reward = rng.uniform(-scale, scale, mdp.n_states)
    if draw(st.booleans()):
        reward[rng.random(mdp.n_states) < 0.5] = draw(st.sampled_from([-scale, scale]))
    return mdp, reward


@given(grids_and_rewards(), st.sampled_from(INFERENCE_KINDS), st.sampled_from([1.0, 0.9]))
@COMMON
def test_every_inference_is_finite_and_its_probabilities_sum_to_1(case, kind, discount):
    mdp, reward = case
    try:
        found = infer(mdp, reward, inference=kind, discount=discount)
    except DivergentPartition:
        assert kind == "path_infinite"
        return
    assert np.isfinite(found.log_partition)
    assert np.isfinite(found.visitation).all()
    assert (found.visitation >= 0).all()
    np.testing.assert_allclose(found.policy.sum(axis=1), 1, atol=1e-9)
    assert (found.policy >= 0).all()
    if kind in {"path", "path_infinite"}:
        arrived = found.visitation[list(mdp.goals)].sum()
        assert arrived == pytest.approx(1, abs=1e-6)
        assert (found.visitation + 1e-9 >= mdp.starts).all()


@given(grids_and_rewards(largest=6), st.sampled_from(["path", "causal", "ziebart"]))
@COMMON
def test_turning_the_grid_turns_the_visits_and_the_policy(case, kind):
    """Relabelling: the transposed grid has its states and actions by other numbers, and the same distribution."""
    mdp, reward = case
    turned_number = np.arange(mdp.n_states).reshape(mdp.rows, mdp.cols).T.reshape(-1)  # new → old
    number_now = np.argsort(turned_number)  # old → new
    turned = GridMdp(
        mdp.cols,
        mdp.rows,
        tuple(number_now[list(mdp.goals)].tolist()),
        tuple(number_now[list(mdp.walls)].tolist()),
        mdp.slip,
        start=mdp.starts[turned_number],
        horizon=mdp.horizon,
    )
    here = infer(mdp, reward, inference=kind)
    there = infer(turned, reward[turned_number], inference=kind)
    assert there.log_partition == pytest.approx(here.log_partition, rel=1e-9, abs=1e-9)
    np.testing.assert_allclose(there.visitation, here.visitation[turned_number], rtol=1e-6, atol=1e-9)
    up_is_left = [3, 2, 1, 0]
    np.testing.assert_allclose(there.policy, here.policy[turned_number][:, up_is_left], rtol=1e-6, atol=1e-9)


@given(grids(largest=4), st.integers(0, 2**32 - 1))
@COMMON
def test_a_grid_and_the_same_model_with_its_states_shuffled_agree(mdp, seed):
    rng = np.random.default_rng(seed)
    reward, order = rng.normal(-1, 1, mdp.n_states), rng.permutation(mdp.n_states)
    shuffled = shuffle(mdp.to_sparse(), order)
    for kind in ("path", "causal"):
        here = infer(mdp, reward, inference=kind)
        there = infer(shuffled, reward[order], inference=kind)
        assert there.log_partition == pytest.approx(here.log_partition, abs=1e-9)
        np.testing.assert_allclose(there.visitation, here.visitation[order], atol=1e-8)


def shuffle(mdp, order):
    """The model whose state i is the old state order[i]."""
    new_number, A = np.argsort(order), mdp.n_actions
    rows = [row for old in order for row in range(old * A, old * A + A)]
    pieces = [slice(mdp.indptr[row], mdp.indptr[row + 1]) for row in rows]
    return SparseMdp(
        indptr=np.concatenate([[0], np.cumsum([piece.stop - piece.start for piece in pieces])]),
        indices=np.concatenate([new_number[mdp.indices[piece]] for piece in pieces]),
        probabilities=np.concatenate([mdp.probabilities[piece] for piece in pieces]),
        n_states=mdp.n_states,
        n_actions=A,
        pays=mdp.pays[order],
        terminal=mdp.terminal[order],
        start=mdp.starts[order],
        horizon=mdp.horizon,
    )


@given(grids_and_rewards(largest=6, scales=(1.0, 5.0)), st.floats(-50, 50))
@COMMON
def test_a_constant_on_every_goal_shifts_the_log_partition_and_nothing_else(case, constant):
    """Every path pays exactly one goal, once."""
    mdp, reward = case
    raised = reward + constant * mdp.terminal
    here, there = infer(mdp, reward), infer(mdp, raised)
    assert there.log_partition == pytest.approx(here.log_partition + constant, abs=1e-9)
    np.testing.assert_allclose(there.visitation, here.visitation, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(there.policy, here.policy, rtol=1e-9, atol=1e-12)


@given(st.integers(0, 2**32 - 1), st.floats(-5, 5), st.sampled_from([1.0, 0.9]))
@COMMON
def test_without_a_terminal_state_a_constant_everywhere_changes_no_causal_choice(seed, constant, discount):
    """Every episode then has N steps, whatever is done."""
    rng = np.random.default_rng(seed)
    S, A, N = 5, 3, 7
    mdp = SparseMdp(
        indptr=np.arange(S * A + 1) * S,
        indices=np.tile(np.arange(S), S * A),
        probabilities=rng.dirichlet(np.ones(S), S * A).reshape(-1),
        n_states=S,
        n_actions=A,
        pays=np.zeros((S, A)),
        terminal=np.zeros(S, dtype=bool),
        start=0,
        horizon=N,
    )
    reward = rng.normal(0, 1, S)
    here = infer(mdp, reward, inference="causal", discount=discount)
    there = infer(mdp, reward + constant, inference="causal", discount=discount)
    np.testing.assert_allclose(there.policy, here.policy, atol=1e-9)
    np.testing.assert_allclose(there.visitation, here.visitation, atol=1e-9)


@given(st.lists(grids(largest=5), min_size=1, max_size=1), st.integers(1, 20), st.integers(0, 2**32 - 1))
@COMMON
def test_a_batch_is_its_members_one_by_one(one, n, seed):
    (mdp,) = one
    rng = np.random.default_rng(seed)
    rewards = rng.normal(-2, 1.5, (n, mdp.n_states)) * rng.choice([1.0, 1.0, 300.0], (n, 1))
    batch = infer_batch([mdp] * n, rewards)
    for i, reward in enumerate(rewards):
        single = infer(mdp, reward)
        assert batch.log_partition[i] == pytest.approx(single.log_partition, rel=1e-12, abs=1e-12)
        np.testing.assert_allclose(batch.visitation[i], single.visitation, rtol=1e-10, atol=1e-12)
        np.testing.assert_allclose(batch.policy[i], single.policy, rtol=1e-10, atol=1e-12)


@given(grids(largest=5), st.integers(0, 2**32 - 1), st.sampled_from(["meirl", "irlr", "irlf", "irlfr"]))
@COMMON
def test_the_order_and_the_splitting_of_demonstrations_change_nothing(mdp, seed, name):
    rng = np.random.default_rng(seed)
    walks = [walk(mdp, rng) for _ in range(4)]
    assume(all(walks))
    ours = [
        demonstration_of(mdp, states, actions, id="abcd"[i], outcome="success" if i < 2 else "failure")
        for i, (states, actions) in enumerate(walks)
    ]
    rankings = [Ranking("success", (("a",), ("b",))), Ranking("failure", (("c",), ("d",)))]
    settings_ = Settings(iterations=5)
    first = learn(name, LearningProblem.build(mdp, ours, rankings, settings_)).reward
    second = learn(name, LearningProblem.build(mdp, ours[::-1], rankings[::-1], settings_)).reward
    np.testing.assert_array_equal(first, second)
    if name in {"meirl", "irlf"}:  # each alike: two copies of half the weight are one
        twice = [
            demonstration_of(mdp, one.states, one.actions, id=one.id + copy, outcome=one.outcome)
            for one in ours
            for copy in "12"
        ]
        np.testing.assert_allclose(
            learn(name, LearningProblem.build(mdp, twice, (), settings_)).reward, first, atol=1e-9
        )


def walk(mdp, rng):
    """A random walk that arrives within the horizon, or nothing after twenty tries."""
    for _ in range(20):
        states = [int(rng.choice(mdp.n_states, p=mdp.starts))]
        actions: list[int] = []
        while not mdp.terminal[states[-1]] and len(actions) < mdp.horizon:
            actions.append(int(rng.integers(4)))
            states.append(int(mdp.next_states[states[-1], actions[-1]]))
        if mdp.terminal[states[-1]]:
            return states, actions
    return None
