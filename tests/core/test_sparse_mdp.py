"""Discrete models: what they hold, what they refuse, and grids and Gymnasium's tables turned into them."""

from typing import Any

import gymnasium
import numpy as np
import pytest

from irl_core import World
from irl_core.errors import InvalidModel
from irl_core.mdp import GridMdp, SparseMdp, as_mdp
from irl_core.mdp.toy_text import from_gymnasium
from tests import naive
from tests.core.examples import SMALL_WORLDS, make_world
from tests.core.naive_models import dense, random_model, sparse_from_dense


def chain(**changes):
    """0 → 1 → 2, or stay; 2 ends it. Two actions: go (surely), try (half of the time)."""
    given: dict[str, Any] = {
        "indptr": np.array([0, 1, 3, 4, 6, 6, 6]),
        "indices": np.array([1, 0, 1, 2, 1, 2]),
        "probabilities": np.array([1.0, 0.5, 0.5, 1.0, 0.5, 0.5]),
        "n_states": 3,
        "n_actions": 2,
        "pays": np.array([[-1.0, -0.5], [4.0, 2.0], [0.0, 0.0]]),
        "terminal": np.array([False, False, True]),
        "start": 0,
    }
    return SparseMdp(**(given | changes))


def test_by_hand_a_chain_of_three():
    mdp = chain()
    assert (mdp.n_states, mdp.n_actions, mdp.horizon) == (3, 2, 6)
    np.testing.assert_array_equal(mdp.flow.toarray(), [[0.5, 1.5, 0], [0, 0.5, 1.5], [0, 0, 0]])
    np.testing.assert_array_equal(mdp.starts, [1, 0, 0])
    np.testing.assert_array_equal(mdp.start_states, [0])
    np.testing.assert_array_equal(mdp.steps_from_start, [0, 1, 2])
    np.testing.assert_array_equal(mdp.steps_to_end, [2, 1, 0])


def test_what_a_model_pays_may_be_said_for_each_entry():
    mdp = chain(pays=np.array([1.0, 0.0, 2.0, 3.0, 0.0, 4.0]))
    np.testing.assert_array_equal(mdp.pays, [[1.0, 1.0], [3.0, 2.0], [0.0, 0.0]])
    np.testing.assert_array_equal(mdp.entry_pays, [1, 0, 2, 3, 0, 4])
    np.testing.assert_array_equal(chain().entry_pays, [-1, -0.5, -0.5, 4, 2, 2])


def test_a_model_keeps_its_own_arrays():
    indices = np.array([1, 0, 1, 2, 1, 2])
    mdp = chain(indices=indices)
    indices[:] = 0
    assert mdp.indices[3] == 2
    with pytest.raises(ValueError, match="read-only"):
        mdp.probabilities[0] = 0.5


@pytest.mark.parametrize("seed", range(5))
def test_transitions_and_flow_are_those_written_out(seed):
    mdp = random_model(seed, two_starts=seed % 2 == 1)
    T = dense(mdp)
    np.testing.assert_allclose(mdp.transitions.toarray().reshape(T.shape), T, atol=1e-15)
    np.testing.assert_allclose(mdp.flow.toarray(), T.sum(axis=1), atol=1e-15)


@pytest.mark.parametrize("world", SMALL_WORLDS.values(), ids=SMALL_WORLDS)
def test_a_grid_written_out_moves_as_the_grid_does(world):
    mdp = world.mdp.to_sparse()
    T = naive.transitions(world)
    for state in range(world.n_states):
        if world.mdp.terminal[state]:
            np.testing.assert_array_equal(dense(mdp)[state], 0.0)
        elif not world.mdp.blocked[state]:
            np.testing.assert_allclose(dense(mdp)[state], T[state], atol=1e-15)
    assert mdp.horizon == world.horizon
    np.testing.assert_array_equal(mdp.starts, world.mdp.starts)


def test_every_model_is_known_by_its_transitions():
    world, sparse = make_world(), chain()
    assert as_mdp(world) is world.mdp
    assert as_mdp(world.mdp) is world.mdp
    assert as_mdp(sparse) is sparse


def test_the_horizon_is_never_less_than_twice_the_shortest_way():
    n = 30
    T = np.zeros((n, 1, n))
    T[np.arange(n - 1), 0, np.arange(1, n)] = 1.0
    assert sparse_from_dense(T, np.arange(n) == n - 1).horizon == 60
    assert sparse_from_dense(T, np.arange(n) == n - 1, start=28).horizon == 60
    assert sparse_from_dense(T, np.arange(n) == n - 1, horizon=29).horizon == 29


def test_a_model_without_an_end_is_one():
    T = np.array([[[0.0, 1.0]], [[1.0, 0.0]]])
    assert sparse_from_dense(T, [False, False]).horizon == 4


@pytest.mark.parametrize(
    ("changes", "field", "says"),
    [
        ({"n_states": 0}, "n_states", "at least 1, not 0"),
        ({"n_actions": 2.0}, "n_actions", "whole number"),
        ({"terminal": np.array([0, 0, 1])}, "terminal", "3 truth values"),
        ({"terminal": np.array([False, True])}, "terminal", r"shape \(2,\)"),
        ({"indptr": np.array([0, 1, 3])}, "indptr", "must be 7 numbers from 0 to 6"),
        ({"indptr": np.array([0, 1, 3, 4, 6, 6, 5])}, "indptr", "from 0 to 5"),
        ({"indptr": np.array([0, 3, 1, 4, 6, 6, 6])}, "indptr", "never fall"),
        ({"indices": np.array([1.0, 0, 1, 2, 1, 2])}, "indices", "whole numbers; here are float64"),
        ({"indices": np.array([1, 0, 1, 3, 1, 2])}, "indices", "Action 0 in state 1 leads to state 3"),
        ({"indices": np.array([1, 0, -1, 2, 1, 2])}, "indices", "Action 1 in state 0 leads to state -1"),
        ({"probabilities": np.ones(5)}, "probabilities", "6 numbers"),
        ({"probabilities": np.array([1.0, 0.5, np.nan, 1, 0.5, 0.5])}, "probabilities", "1 are not"),
        ({"probabilities": np.array([1.0, 1.5, -0.5, 1, 0.5, 0.5])}, "probabilities", "Action 1 in state 0 .* -0.5"),
        ({"probabilities": np.array([1.0, 0.5, 0.4, 1, 0.5, 0.5])}, "probabilities", "action 1 in state 0 .* 0.9"),
        ({"terminal": np.array([False, True, True])}, "terminal", "State 1 is terminal, so its rows must be empty"),
        ({"terminal": np.array([False, False, False])}, "probabilities", "action 0 in state 2 .* sum is 0"),
        ({"pays": np.zeros((2, 2))}, "pays", "3 × 2 numbers, or 6"),
        ({"pays": np.full((3, 2), np.inf)}, "pays", "finite"),
        ({"start": 3}, "start", "from 0 to 2"),
        ({"start": 2}, "start", "cannot start in state 2: it ends there"),
        ({"start": [0.5, 0.4, 0.0]}, "start", "sum is 0.9"),
        ({"horizon": 1}, "horizon", "at least 2 steps, the shortest way to a terminal state, not 1"),
        ({"horizon": 2.5}, "horizon", "whole number"),
    ],
)
def test_numbers_that_make_no_model_are_refused(changes, field, says):
    with pytest.raises(InvalidModel, match=says) as refusal:
        chain(**changes)
    assert refusal.value.field == field


def test_a_state_that_leads_to_itself_alone_is_refused_by_number():
    T = np.array([[[0.0, 0.5, 0.5]], [[0.0, 1.0, 0.0]], [[0.0, 0.0, 0.0]]])
    with pytest.raises(InvalidModel, match=r"State 1 .* nowhere but to itself: mark it as terminal") as refusal:
        sparse_from_dense(T, [False, False, True])
    assert refusal.value.field == "terminal"


def test_a_loop_without_a_way_out_is_refused():
    T = np.array([[[0.0, 0.5, 0.0, 0.5]], [[0.0, 0.0, 1.0, 0.0]], [[0.0, 1.0, 0.0, 0.0]], np.zeros((1, 4))])
    with pytest.raises(InvalidModel, match=r"State 1 .* leads to no terminal state"):
        sparse_from_dense(T, [False, False, False, True])


def test_a_trap_that_no_start_reaches_harms_nobody():
    T = np.array([[[0.0, 0.0, 1.0]], [[0.0, 1.0, 0.0]], np.zeros((1, 3))])
    assert sparse_from_dense(T, [False, False, True]).steps_to_end[1] == -1


def test_an_end_out_of_reach_is_refused():
    T = np.array([[[1.0, 0.0, 0.0]], [[0.0, 0.0, 1.0]], np.zeros((1, 3))])
    with pytest.raises(InvalidModel, match="No terminal state can be reached"):
        sparse_from_dense(T, [False, False, True])


@pytest.mark.parametrize(
    ("name", "settings", "terminal", "horizon"),
    [
        ("FrozenLake-v1", {"is_slippery": True}, [5, 7, 11, 12, 15], 100),
        ("FrozenLake-v1", {"is_slippery": False}, [5, 7, 11, 12, 15], 100),
        ("CliffWalking-v1", {}, [47], 96),
        ("Taxi-v4", {}, [0, 85, 410, 475], 200),
    ],
)
def test_toy_text_environments_are_read_from_their_tables(name, settings, terminal, horizon):
    env: Any = gymnasium.make(name, **settings)
    mdp = from_gymnasium(env)
    assert np.flatnonzero(mdp.terminal).tolist() == terminal
    assert mdp.horizon == horizon
    np.testing.assert_allclose(mdp.starts, env.unwrapped.initial_state_distrib, atol=1e-15)
    T = dense(mdp)
    for state, actions in env.unwrapped.P.items():
        for action, ways in actions.items():
            if state not in terminal:
                expected = np.zeros(mdp.n_states)
                for chance, reached, _, _ in ways:
                    expected[reached] += chance
                np.testing.assert_allclose(T[state, action], expected, atol=1e-15)
                assert mdp.pays[state, action] == pytest.approx(sum(way[0] * way[2] for way in ways), abs=1e-12)


def test_start_and_horizon_may_be_chosen():
    mdp = from_gymnasium(gymnasium.make("FrozenLake-v1"), start=8, horizon=30)
    assert mdp.start_states.tolist() == [8]
    assert mdp.horizon == 30


class Table:
    """The least that is an environment with a table."""

    def __init__(self, P):
        self.P = P
        self.unwrapped = self


def test_a_bare_table_starts_in_state_0():
    mdp = from_gymnasium(Table([[[(1.0, 1, 0.0, True)]], [[(1.0, 1, 0.0, True)]]]))
    assert mdp.start_states.tolist() == [0]
    assert mdp.terminal.tolist() == [False, True]


@pytest.mark.parametrize(
    ("env", "says"),
    [
        (Table(None), "Table has no P"),
        (object(), "object has no P"),
        (Table([[[(1.0, 1)]], [[(1.0, 1)]]]), "its P is none"),
        (Table({0: {0: [(1.0, 1, 0, False)]}, 2: {0: []}}), "its P is none: KeyError"),
        (Table([[[(1.0, 7, 0.0, True)]]]), "leads to state 7; its states are 0 to 0"),
        (
            Table([[[(1.0, 1, 0.0, True)], [(1.0, 1, 0.0, False)]], [[(1.0, 1, 0.0, True)], [(1.0, 1, 0.0, True)]]]),
            "goes on after action 1 leads from state 0 to state 1, and ends on another way",
        ),
    ],
)
def test_what_is_no_table_is_refused(env, says):
    with pytest.raises(InvalidModel, match=says) as refusal:
        from_gymnasium(env)
    assert refusal.value.field == "env"


def test_a_world_of_any_start_distribution_can_be_written_out():
    starts = np.array([0.25, 0.75, 0.0, 0.0])
    np.testing.assert_array_equal(GridMdp(2, 2, (3,), start=starts).to_sparse().starts, starts)
    assert isinstance(World(2, 2, np.zeros((2, 2)), 0, (3,)).mdp.to_sparse(), SparseMdp)
