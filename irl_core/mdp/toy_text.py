"""Gymnasium's toy-text environments (FrozenLake, CliffWalking, Taxi) as models, read from their transition tables.

Such an environment has `P[s][a]`, a list of (probability, next state, reward, whether the episode ends there), and
`initial_state_distrib`. Here a *state* is terminal, so an environment whose episode ends on some ways into a state and
goes on after others has no such model; that is only looked at where an episode can come. What a table says of the time
after an episode's end is left out.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from irl_core.arrays import BoolVector, IntVector, Vector
from irl_core.errors import InvalidModel
from irl_core.mdp.sparse import SparseMdp

_HELP = "an environment with a transition table P[state][action] = [(probability, next state, reward, ends), …]"


class HasTable(Protocol):
    """An environment of Gymnasium; its `unwrapped` has the table."""

    @property
    def unwrapped(self) -> Any: ...  # noqa: ANN401 - Gymnasium's own type has no P


@dataclass(frozen=True, eq=False)
class _Entries:
    """The table, one entry after another, in the order of states and actions."""

    rows: IntVector
    reached: IntVector
    chances: Vector
    pays: Vector
    ends: BoolVector


def from_gymnasium(env: HasTable, *, start: int | Vector | None = None, horizon: int | None = None) -> SparseMdp:
    """The environment's model. Gymnasium itself is not needed: anything with P will do. Raises InvalidModel.

    `start`, a state or a distribution of shape (S,), is the environment's own unless given (state 0 where it has none);
    `horizon` is its `max_episode_steps` (or an attribute `horizon`), or else SparseMdp's rule.
    """
    bare = getattr(env, "unwrapped", env)
    table = getattr(bare, "P", None)
    if not isinstance(table, Mapping | Sequence) or len(table) == 0:
        raise InvalidModel(f"env must be {_HELP}; {type(bare).__name__} has no P.", field="env")
    n_states, n_actions = len(table), _n_actions(table)
    entries = _entries(table, n_states=n_states, n_actions=n_actions)
    began = _start(bare) if start is None else start
    terminal = np.zeros(n_states, dtype=np.bool_)
    terminal[entries.reached[entries.ends]] = True
    kept = ~terminal[entries.rows // n_actions]
    model = SparseMdp(
        indptr=np.concatenate([[0], np.cumsum(np.bincount(entries.rows[kept], minlength=n_states * n_actions))]),
        indices=entries.reached[kept],
        probabilities=entries.chances[kept],
        n_states=n_states,
        n_actions=n_actions,
        pays=entries.pays[kept],
        terminal=terminal,
        start=began,
        horizon=_horizon(env, bare) if horizon is None else horizon,
    )
    _check_ends(model, entries, kept)
    return model


def _n_actions(table: Any) -> int:  # noqa: ANN401 - outside data
    try:
        return len(table[0])
    except (IndexError, KeyError, TypeError) as error:
        raise InvalidModel(f"env must be {_HELP}; its P has no state 0: {error!r}.", field="env") from error


def _entries(table: Any, *, n_states: int, n_actions: int) -> _Entries:  # noqa: ANN401 - outside data
    rows: list[int] = []
    listed: list[tuple[Any, ...]] = []
    try:
        for state in range(n_states):
            for action in range(n_actions):
                listed.extend(table[state][action])
                rows.extend([state * n_actions + action] * len(table[state][action]))
        chances, reached, pays, ends = zip(*listed, strict=True)
        return _Entries(
            np.array(rows, dtype=np.int64),
            _states(reached, n_states=n_states),
            np.array(chances, dtype=np.float64),
            np.array(pays, dtype=np.float64),
            np.array(ends, dtype=np.bool_),
        )
    except (IndexError, KeyError, TypeError, ValueError) as error:
        raise InvalidModel(f"env must be {_HELP}; its P is none: {error!r}.", field="env") from error


def _states(reached: Sequence[Any], *, n_states: int) -> IntVector:
    states = np.array(reached, dtype=np.int64)
    if len(states) and (states.min() < 0 or states.max() >= n_states):
        raise InvalidModel(
            f"env's P leads to state {states.max() if states.min() >= 0 else states.min()}; its states are 0 to"
            f" {n_states - 1}.",
            field="env",
        )
    return states


def _check_ends(model: SparseMdp, entries: _Entries, kept: BoolVector) -> None:
    """Refuse a state that ends the episode on one way in and not on another, where an episode can come."""
    state, action = np.divmod(entries.rows, model.n_actions)
    goes_on = kept & ~entries.ends & model.terminal[entries.reached] & (entries.chances > 0.0)
    mixed = np.flatnonzero(goes_on & (model.steps_from_start[state] >= 0))
    if len(mixed):
        here, taken, reached = state[mixed[0]], action[mixed[0]], entries.reached[mixed[0]]
        raise InvalidModel(
            f"The episode goes on after action {taken} leads from state {here} to state {reached}, and ends on another"
            " way into that state: give the two cases states of their own.",
            field="env",
        )


def _start(bare: Any) -> int | Vector:  # noqa: ANN401 - outside data
    given = getattr(bare, "initial_state_distrib", None)
    starts: int | Vector = 0 if given is None else np.array(given, dtype=np.float64)
    return starts


def _horizon(env: object, bare: object) -> int:
    steps = getattr(getattr(env, "spec", None), "max_episode_steps", None) or getattr(bare, "horizon", None)
    return 0 if steps is None else int(steps)
