"""A gridworld's transitions, without its rewards: what planning needs to know, up to a million squares.

States are numbered row by row, s = row · cols + col. Actions 0 up, 1 right, 2 down, 3 left; a move into the edge or a
wall leaves the agent where it is. With slip p the intended direction is taken with probability 1 − p, each of the other
three with p / 3. Goals end the episode. `start` is a square, or S probabilities; `starts` is the distribution either
way, shape (S,). `horizon` is N, the longest path in steps; unless given it is min(2·rows·cols, 8·(rows + cols)), never
less than twice the shortest way from the nearest start.
"""

from collections.abc import Iterable
from dataclasses import KW_ONLY, dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Final

import numpy as np

from irl_core import grid
from irl_core.array_checks import MAX_HORIZON, float_array
from irl_core.arrays import BoolVector, IntMatrix, IntVector, Vector, read_only
from irl_core.checks import Refused, is_integer, shown
from irl_core.errors import InvalidModel
from irl_core.world_checks import real, squares_of, whole

if TYPE_CHECKING:
    from irl_core.mdp.sparse import SparseMdp

MAX_GRID_SIDE: Final = 4096
_SUM_TOLERANCE: Final = 1e-9


@dataclass(frozen=True, eq=False)
class GridMdp:
    """A grid with walls, goals, slip and a start distribution; see the module. Raises InvalidModel."""

    rows: int
    cols: int
    goals: tuple[int, ...]
    walls: tuple[int, ...] = ()
    slip: float = 0.0
    start: int | Vector = 0
    _: KW_ONLY
    horizon: int = 0

    def __post_init__(self) -> None:
        self._set("rows", whole("rows", self.rows, minimum=1, maximum=MAX_GRID_SIDE))
        self._set("cols", whole("cols", self.cols, minimum=1, maximum=MAX_GRID_SIDE))
        self._set("goals", squares_of("goals", self.goals, n_states=self.n_states))
        self._set("walls", tuple(sorted(squares_of("walls", self.walls, n_states=self.n_states))))
        self._set("slip", real("slip", self.slip, minimum=0.0, maximum=0.9))
        if not self.goals:
            raise InvalidModel("A grid needs at least one goal.", field="goals")
        both = sorted(set(self.goals) & set(self.walls))
        if both:
            raise InvalidModel(f"Square {both[0]} is a goal and cannot be a wall.", field="walls")
        self._settle_horizon()

    @property
    def n_states(self) -> int:
        """S = rows · cols."""
        return self.rows * self.cols

    @property
    def n_actions(self) -> int:
        """A = 4."""
        return grid.N_ACTIONS

    @cached_property
    def starts(self) -> Vector:
        """Where an episode starts, a distribution of shape (S,)."""
        return start_distribution(self.start, n_states=self.n_states, not_at=(*self.goals, *self.walls))

    @cached_property
    def next_states(self) -> IntMatrix:
        """The state each direction leads to, shape (S, 4); goals and walls lead to themselves."""
        reached = grid.neighbours(self.rows, self.cols, goals=self.goals, walls=self.walls)
        read_only(reached)
        return reached

    @cached_property
    def terminal(self) -> BoolVector:
        """True at goals, shape (S,)."""
        marked = grid.mask(self.n_states, self.goals)
        read_only(marked)
        return marked

    @cached_property
    def blocked(self) -> BoolVector:
        """True at walls, shape (S,)."""
        marked = grid.mask(self.n_states, self.walls)
        read_only(marked)
        return marked

    @property
    def start_states(self) -> IntVector:
        """Where an episode can start, ascending."""
        return np.flatnonzero(self.starts)

    @cached_property
    def _sparse(self) -> "SparseMdp":
        from irl_core.mdp.sparse import SparseMdp  # noqa: PLC0415 - it imports from here

        aside, slips = self.slip / (grid.N_ACTIONS - 1), self.slip > 0.0
        laws = np.full((grid.N_ACTIONS, grid.N_ACTIONS), aside)
        np.fill_diagonal(laws, 1.0 - self.slip)
        reached = np.repeat(self.next_states, grid.N_ACTIONS, axis=0) if slips else self.next_states.reshape(-1, 1)
        chances = np.tile(laws, (self.n_states, 1)) if slips else np.ones_like(reached, dtype=np.float64)
        goes_on = np.repeat(~self.terminal, grid.N_ACTIONS)
        return SparseMdp(
            indptr=np.concatenate([[0], np.cumsum(goes_on * reached.shape[1])]),
            indices=reached[goes_on].reshape(-1),
            probabilities=chances[goes_on].reshape(-1),
            n_states=self.n_states,
            n_actions=grid.N_ACTIONS,
            pays=np.zeros((self.n_states, grid.N_ACTIONS)),
            terminal=self.terminal,
            start=self.starts,
            horizon=self.horizon,
        )

    def to_sparse(self) -> "SparseMdp":
        """The same model with its transitions written out; several directions may lead to one state."""
        return self._sparse

    def _settle_horizon(self) -> None:
        steps = grid.distances_from(self.next_states, self.start_states)[list(self.goals)]
        if (steps < 0).all():
            raise InvalidModel("No goal can be reached from the start: the walls close the way.", field="walls")
        shortest = int(steps[steps >= 0].min())
        if not self.horizon:
            self._set("horizon", grid.default_horizon(self.rows, self.cols, shortest=shortest))
        if not is_integer(self.horizon) or not shortest <= self.horizon <= MAX_HORIZON:
            raise InvalidModel(
                f"horizon must be a whole number of at least {shortest} steps, the shortest way to a goal, not"
                f" {shown(self.horizon)}, and at most {MAX_HORIZON}.",
                field="horizon",
            )

    def _set(self, name: str, value: object) -> None:
        object.__setattr__(self, name, value)


def start_distribution(given: object, *, n_states: int, not_at: Iterable[int] = ()) -> Vector:
    """A state, or S probabilities, as a read-only distribution of shape (S,). Raises InvalidModel."""
    starts: Vector = np.zeros(n_states)
    if is_integer(given):
        starts[whole("start", given, minimum=0, maximum=n_states - 1)] = 1.0
    else:
        starts = _probabilities(given, n_states=n_states)
    for state in not_at:
        if starts[state] > 0.0:
            raise InvalidModel(f"An episode cannot start in state {state}: it ends there.", field="start")
    read_only(starts)
    return starts


def _probabilities(given: object, *, n_states: int) -> Vector:
    wanted = f"start must be a state or {n_states} probabilities that sum to 1"
    try:
        starts: Vector = float_array(given).copy()
    except Refused as refused:
        raise InvalidModel(f"{wanted}; {refused}.", field="start") from None
    if starts.shape != (n_states,):
        raise InvalidModel(f"{wanted}; their shape is {starts.shape}.", field="start")
    if not np.isfinite(starts).all() or (starts < 0.0).any() or abs(starts.sum() - 1.0) > _SUM_TOLERANCE:
        raise InvalidModel(f"{wanted}; their sum is {starts.sum():g}.", field="start")
    starts /= starts.sum()
    return starts
