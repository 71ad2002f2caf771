"""Something to sample episodes from, for learners that know no transition table.

A simulator says how many states and actions there are and plays episodes by a policy it is given: reset, then step
after step until a terminal state or N steps. It gives back what happened, never a probability.

- `TableSimulator` plays a model of ours, thousands of episodes in a millisecond.
- `StepSimulator` plays any environment of Gymnasium's shape (`reset(seed=…)`, `step(action)`, discrete spaces).
"""

from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias, final

import numpy as np

from irl_core import grid
from irl_core.array_checks import check_generator, check_policy, check_whole
from irl_core.arrays import BoolVector, IntVector, Policy, Vector, read_only
from irl_core.checks import is_integer, shown
from irl_core.errors import InvalidModel
from irl_core.mdp import GridMdp, Mdp, as_mdp

Int32Matrix: TypeAlias = np.ndarray[tuple[int, int], np.dtype[np.int32]]


@dataclass(frozen=True, eq=False)
class Episodes:
    """What happened in n episodes of at most N steps.

    Episode i took `lengths[i]` steps, through `states[i, : lengths[i] + 1]` by `actions[i, : lengths[i]]` (what lies
    behind them means nothing); `arrived[i]` says whether it ended in a terminal state. Shapes (n, N + 1), (n, N), (n,).
    """

    states: Int32Matrix
    actions: Int32Matrix
    lengths: IntVector
    arrived: BoolVector

    def __post_init__(self) -> None:
        for array in (self.states, self.actions, self.lengths, self.arrived):
            read_only(array)

    @property
    def n_steps(self) -> int:
        """How many steps were simulated altogether."""
        return int(self.lengths.sum())


class Simulator(Protocol):
    """Plays episodes; see the module."""

    @property
    def n_states(self) -> int: ...
    @property
    def n_actions(self) -> int: ...
    @property
    def horizon(self) -> int: ...

    def play(self, policy: Policy, n_episodes: int, rng: np.random.Generator) -> Episodes:
        """Episodes by a policy of shape (S, A)."""
        ...


@final
class TableSimulator:
    """A grid or sparse model, played by a compiled loop. Each episode consumes as many random numbers as any other."""

    def __init__(self, mdp: Mdp) -> None:
        mdp = as_mdp(mdp)
        self.n_states, self.n_actions, self.horizon = mdp.n_states, mdp.n_actions, mdp.horizon
        self._terminal, self._starts = mdp.terminal, mdp.starts
        self._rows = _grid_rows(mdp) if isinstance(mdp, GridMdp) else _sparse_rows(mdp)
        self._is_certain = bool((np.diff(self._rows[0]) <= 1).all())

    def play(self, policy: Policy, n_episodes: int, rng: np.random.Generator) -> Episodes:
        """Episodes by a policy of shape (S, A)."""
        from irl_core import _kernels  # noqa: PLC0415 - whoever only reads results needs no compiler

        policy = check_policy(policy, terminal=self._terminal, n_actions=self.n_actions)
        n_episodes, rng = check_whole("n_episodes", n_episodes, minimum=1), check_generator(rng)
        shape = (n_episodes, self.horizon)
        starts = self._draw_starts(n_episodes, rng)
        choices = rng.random(shape)
        chances = choices if self._is_certain else rng.random(shape)
        states, actions = np.zeros((n_episodes, self.horizon + 1), np.int32), np.zeros(shape, np.int32)
        lengths, arrived = np.zeros(n_episodes, np.int64), np.zeros(n_episodes, np.bool_)
        _kernels.model_free.play(
            *self._rows, self._terminal, policy.cumsum(axis=1), starts, choices, chances,
            states, actions, lengths, arrived,
        )  # fmt: skip
        return Episodes(states, actions, lengths, arrived)

    def _draw_starts(self, n_episodes: int, rng: np.random.Generator) -> IntVector:
        sums = self._starts.cumsum()
        drawn: IntVector = np.searchsorted(sums, rng.random(n_episodes) * sums[-1], side="right").astype(np.int64)
        return drawn


@final
class StepSimulator:
    """An environment with discrete spaces, played step by step; `terminated` is arrival. Raises InvalidModel."""

    def __init__(self, env: Any, *, horizon: int) -> None:  # noqa: ANN401 - Gymnasium need not be installed
        self._env = env
        self.n_states, self.n_actions = (_size(env, name) for name in ("observation_space", "action_space"))
        if not is_integer(horizon) or horizon < 1:
            raise InvalidModel(f"horizon must be at least 1 step, not {shown(horizon)}.", field="horizon")
        self.horizon = horizon

    def play(self, policy: Policy, n_episodes: int, rng: np.random.Generator) -> Episodes:
        """Episodes by a policy of shape (S, A); each is reset with a seed of its own."""
        nowhere = np.zeros(self.n_states, dtype=np.bool_)  # which states are terminal only the environment knows
        policy = check_policy(policy, terminal=nowhere, n_actions=self.n_actions)
        n_episodes, rng = check_whole("n_episodes", n_episodes, minimum=1), check_generator(rng)
        states, actions = (
            np.zeros((n_episodes, self.horizon + 1), np.int32),
            np.zeros((n_episodes, self.horizon), np.int32),
        )
        lengths, arrived = np.zeros(n_episodes, np.int64), np.zeros(n_episodes, np.bool_)
        thresholds = policy.cumsum(axis=1)
        for i in range(n_episodes):
            states[i, 0], _ = self._env.reset(seed=int(rng.integers(2**31)))
            ended = False
            while not ended and lengths[i] < self.horizon:
                t, reached = lengths[i], thresholds[states[i, lengths[i]]]
                actions[i, t] = min(int((rng.random() >= reached).sum()), self.n_actions - 1)
                states[i, t + 1], _, arrived[i], truncated, _ = self._env.step(int(actions[i, t]))
                lengths[i] += 1
                ended = bool(arrived[i] or truncated)
        return Episodes(states, actions, lengths, arrived)


def _size(env: Any, name: str) -> int:  # noqa: ANN401 - as above
    size = getattr(getattr(env, name, None), "n", None)
    if size is None:
        raise InvalidModel(f"The environment's {name} must be discrete, with n members.", field="env")
    return int(size)


def _grid_rows(mdp: GridMdp) -> tuple[IntVector, IntVector, Vector]:
    """CSR rows s·A + a: without slip the square ahead, with slip the intended direction and the others."""
    if mdp.slip == 0.0:
        n_rows = mdp.n_states * grid.N_ACTIONS
        return np.arange(n_rows + 1), np.ascontiguousarray(mdp.next_states.reshape(-1)), np.ones(n_rows)
    chances = np.full((grid.N_ACTIONS, grid.N_ACTIONS), mdp.slip / (grid.N_ACTIONS - 1))
    np.fill_diagonal(chances, 1.0 - mdp.slip)
    ahead = np.repeat(mdp.next_states, grid.N_ACTIONS, axis=0).reshape(-1)
    cumulative = np.tile(chances.cumsum(axis=1).reshape(-1), mdp.n_states)
    return np.arange(0, len(ahead) + 1, grid.N_ACTIONS), ahead, cumulative


def _sparse_rows(mdp: Any) -> tuple[IntVector, IntVector, Vector]:  # noqa: ANN401 - a SparseMdp
    """The model's own rows, the running sum of chances starting anew in each."""
    indptr = mdp.indptr.astype(np.int64)
    sums = np.concatenate([[0.0], mdp.probabilities.cumsum()])
    before = np.repeat(sums[indptr[:-1]], np.diff(indptr))
    return indptr, mdp.indices.astype(np.int64), sums[1:] - before
