"""The values everything else speaks of: worlds, demonstrations, rankings. Frozen; their arrays are read-only."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Final, Literal, Self, TypeAlias

import numpy as np

from irl_core import grid
from irl_core.arrays import IntMatrix, IntVector, Matrix, Vector, read_only
from irl_core.checks import shown
from irl_core.errors import ImpossibleDemonstration, InvalidModel, InvalidRanking, InvalidWorld
from irl_core.mdp.grid import GridMdp
from irl_core.world_checks import is_list, place, real, rewards_of, squares_of, whole

MIN_SIDE: Final = 2
MAX_SIDE: Final = 100
MAX_SLIP: Final = 0.9
MAX_SEED: Final = 2**53 - 1  # the largest integer that JSON and JavaScript carry exactly
MIN_TIME_LIMIT_S: Final = 5
MAX_TIME_LIMIT_S: Final = 3600
RED_BELOW: Final = -1.0
"""Red squares pay U[−7, −1], blue ones U[−1, 0]: less than −1 is red."""

DemonstrationOutcome: TypeAlias = Literal["success", "failure"]
Ending: TypeAlias = Literal["goal", "gave_up", "out_of_steps", "out_of_time"]
SlipSeeds: TypeAlias = tuple[tuple[str, int], ...]
"""Which seed decides the slips from which step on: the first from step 0, then rising."""
Colour: TypeAlias = Literal["red", "blue", "goal", "wall"]
OUTCOMES: Final[tuple[DemonstrationOutcome, ...]] = ("success", "failure")
ENDINGS: Final[tuple[Ending, ...]] = ("goal", "gave_up", "out_of_steps", "out_of_time")


@dataclass(frozen=True, eq=False)
class World:
    """A grid and its rewards. A step pays the reward of the square it reaches; a goal pays once and ends the attempt.

    `rewards` has shape (rows, cols); states are numbered row by row. `slip` is the probability that a step goes in one
    of the three other directions instead. `horizon`, the longest attempt, is min(2·rows·cols, 8·(rows + cols)) unless
    given, never less than twice the shortest path. `time_limit_s`, if there is one, is a rule of play, in seconds; no
    learner looks at it. `seed` and `red_probability` say where the world came from.
    """

    rows: int
    cols: int
    rewards: Matrix
    start: int
    goals: tuple[int, ...]
    walls: tuple[int, ...] = ()
    slip: float = 0.0
    seed: int | None = None
    red_probability: float | None = None
    horizon: int = field(default=0, kw_only=True)
    time_limit_s: int | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        rows = whole("rows", self.rows, minimum=MIN_SIDE, maximum=MAX_SIDE)
        cols = whole("cols", self.cols, minimum=MIN_SIDE, maximum=MAX_SIDE)
        start = whole("start", self.start, minimum=0, maximum=rows * cols - 1)
        goals = squares_of("goals", self.goals, n_states=rows * cols)
        walls = squares_of("walls", self.walls, n_states=rows * cols)
        self._set(rows=rows, cols=cols, start=start, goals=goals, walls=tuple(sorted(walls)))
        self._set(rewards=rewards_of(self.rewards, rows=rows, cols=cols))
        self._set(slip=real("slip", self.slip, minimum=0.0, maximum=MAX_SLIP))
        if self.seed is not None:
            self._set(seed=whole("seed", self.seed, minimum=0, maximum=MAX_SEED))
        if self.red_probability is not None:
            share = real("red_probability", self.red_probability, minimum=0.0, maximum=1.0)
            self._set(red_probability=share)
        if self.time_limit_s is not None:
            limit = whole("time_limit_s", self.time_limit_s, minimum=MIN_TIME_LIMIT_S, maximum=MAX_TIME_LIMIT_S)
            self._set(time_limit_s=limit)
        self._check_squares()
        self._settle_horizon()

    @property
    def n_states(self) -> int:
        """S = rows · cols."""
        return self.rows * self.cols

    @property
    def goal(self) -> int:
        """The first goal."""
        return self.goals[0]

    @cached_property
    def reward(self) -> Vector:
        """What reaching each state pays, shape (S,)."""
        flat = self.rewards.reshape(-1)
        read_only(flat)
        return flat

    @cached_property
    def next_states(self) -> IntMatrix:
        """The state each direction leads to, shape (S, 4); goals and walls lead to themselves."""
        reached = grid.neighbours(self.rows, self.cols, goals=self.goals, walls=self.walls)
        read_only(reached)
        return reached

    @cached_property
    def mdp(self) -> GridMdp:
        """The world without its rewards: what a learner may know."""
        return GridMdp(self.rows, self.cols, self.goals, self.walls, self.slip, start=self.start, horizon=self.horizon)

    @cached_property
    def shortest_way(self) -> int:
        """The fewest steps from the start to a goal; −1 where the walls close every way."""
        steps = grid.distances(self.next_states, self.start)[list(self.goals)]
        return int(min(steps[steps >= 0], default=-1))

    @cached_property
    def success_possible(self) -> bool:
        """Whether any attempt could reach a goal with a total of at least 0 (were every slip a lucky one)."""
        return grid.can_reach_total(
            self.next_states, self.reward, start=self.start, goals=self.goals, horizon=self.horizon, total=0.0
        )

    @property
    def colours(self) -> tuple[tuple[Colour, ...], ...]:
        """What a person sees of each square, rows × cols."""
        seen: list[Colour] = ["red" if pays < RED_BELOW else "blue" for pays in self.reward.tolist()]
        for wall in self.walls:
            seen[wall] = "wall"
        for goal in self.goals:
            seen[goal] = "goal"
        return tuple(tuple(seen[first : first + self.cols]) for first in range(0, self.n_states, self.cols))

    def to_json(self) -> dict[str, Any]:
        """The world as the API and files have it."""
        return {
            "rows": self.rows,
            "cols": self.cols,
            "start": self.start,
            "goal": self.goal,
            "goals": list(self.goals),
            "walls": list(self.walls),
            "rewards": self.rewards.tolist(),
            "colours": [list(row) for row in self.colours],
            "seed": self.seed,
            "red_probability": self.red_probability,
            "slip": self.slip,
            "horizon": self.horizon,
            "time_limit_s": self.time_limit_s,
            "success_possible": self.success_possible,
        }

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Self:
        """The world that `to_json` wrote. Keys it does not need (id, colours, …) are passed over."""
        missing = [key for key in ("rows", "cols", "rewards") if key not in data]
        if missing:
            raise InvalidWorld(f"{missing[0]} is missing.", field=missing[0])
        rows = whole("rows", data["rows"], minimum=MIN_SIDE, maximum=MAX_SIDE)
        cols = whole("cols", data["cols"], minimum=MIN_SIDE, maximum=MAX_SIDE)
        goals: Any = data["goals"] if "goals" in data else [data.get("goal", rows * cols - 1)]
        horizon = data.get("horizon")
        return cls(
            rows=rows,
            cols=cols,
            rewards=data["rewards"],
            start=data.get("start", 0),
            goals=goals,
            walls=data.get("walls", ()),
            slip=data.get("slip", 0.0),
            seed=data.get("seed"),
            red_probability=data.get("red_probability"),
            horizon=0 if horizon is None else whole("horizon", horizon, minimum=1, maximum=2 * rows * cols),
            time_limit_s=data.get("time_limit_s"),
        )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, World):
            return NotImplemented
        return self._facts() == other._facts() and np.array_equal(self.rewards, other.rewards)

    def __hash__(self) -> int:
        return hash((self._facts(), self.rewards.tobytes()))

    def _facts(self) -> tuple[object, ...]:
        walls_and_goals = (self.goals, self.walls)
        return (
            self.rows,
            self.cols,
            self.start,
            *walls_and_goals,
            self.slip,
            self.seed,
            self.red_probability,
            self.horizon,
            self.time_limit_s,
        )

    def _set(self, **values: object) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def _check_squares(self) -> None:
        if not self.goals:
            raise InvalidWorld("A world needs at least one goal.", field="goals")
        if self.start in self.goals:
            at = place(self.start, cols=self.cols)
            raise InvalidWorld(f"The start, {at}, cannot be a goal too; move one of them.", field="goals")
        for name, taken in (("start", (self.start,)), ("goal", self.goals)):
            walled = [square for square in taken if square in self.walls]
            if walled:
                at = place(walled[0], cols=self.cols)
                message = f"The {name}, {at}, cannot be a wall too; open it or move the {name}."
                raise InvalidWorld(message, field="walls")

    def _settle_horizon(self) -> None:
        if self.shortest_way < 0:
            raise InvalidWorld(
                "No goal can be reached from the start: the walls close the way. Open one of them.", field="walls"
            )
        if not self.horizon:  # 0, or None from a caller who says it in words
            self._set(horizon=grid.default_horizon(self.rows, self.cols, shortest=self.shortest_way))
        self._set(horizon=whole("horizon", self.horizon, minimum=self.shortest_way, maximum=2 * self.n_states))


@dataclass(frozen=True, eq=False)
class Demonstration:
    """One attempt, as `simulate` found it: T steps through T + 1 states. Slips are in the states.

    `outcome` is "success" if a goal was reached with a total of at least 0, else "failure". `slip_seeds` say by which
    seeds the slips were drawn; they are empty where chance was another (`demonstration_of`).
    """

    id: str
    states: IntVector
    actions: IntVector
    rewards: Vector
    total: float
    outcome: DemonstrationOutcome
    ending: Ending
    slip_seeds: SlipSeeds = field(default=(), kw_only=True)

    def __post_init__(self) -> None:
        for array in (self.states, self.actions, self.rewards):
            read_only(array)

    @property
    def n_steps(self) -> int:
        """T, the number of steps."""
        return len(self.actions)

    @property
    def reached_goal(self) -> bool:
        """Whether the attempt ended at a goal, whatever its total."""
        return self.ending == "goal"

    def to_json(self) -> dict[str, Any]:
        """The demonstration as the API and files have it."""
        return {
            "id": self.id,
            "states": self.states.tolist(),
            "actions": self.actions.tolist(),
            "rewards": self.rewards.tolist(),
            "total": self.total,
            "outcome": self.outcome,
            "ending": self.ending,
            "slip_seeds": [list(pair) for pair in self.slip_seeds],
        }

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Demonstration) and self.to_json() == other.to_json()

    def __hash__(self) -> int:
        return hash((self.id, self.actions.tobytes(), self.states.tobytes()))


@dataclass(frozen=True)
class Ranking:
    """An order of demonstrations of one outcome: best success first, or worst failure first. A group is a tie."""

    outcome: DemonstrationOutcome
    groups: tuple[tuple[str, ...], ...]

    def __post_init__(self) -> None:
        if self.outcome not in OUTCOMES:
            raise InvalidRanking(f'outcome must be "success" or "failure", not {shown(self.outcome)}.', field="outcome")
        object.__setattr__(self, "groups", check_groups(self.groups))

    @property
    def ids(self) -> tuple[str, ...]:
        """Every ranked demonstration, in display order."""
        return tuple(id_ for group in self.groups for id_ in group)


def check_world(world: object) -> World:
    """A World, which has rewards of its own. Raises InvalidModel."""
    if not isinstance(world, World):
        raise InvalidModel(f"world must be a World, not {shown(world)}.", field="world")
    return world


def check_demonstrations(given: object) -> tuple[Demonstration, ...]:
    """Demonstrations from any list of them. Raises ImpossibleDemonstration."""
    listed = tuple(given) if isinstance(given, Iterable) else (given,)
    for one in listed:
        if not isinstance(one, Demonstration):
            raise ImpossibleDemonstration(
                f"demonstrations must be a list of Demonstration (of simulate, or demonstration_of), not {shown(one)}.",
                field="demonstrations",
            )
    if isinstance(given, Demonstration):
        raise ImpossibleDemonstration("demonstrations must be a list; put the one into [].", field="demonstrations")
    return listed


def check_groups(groups: Iterable[Iterable[str]]) -> tuple[tuple[str, ...], ...]:
    """Groups of ids in display order: none empty, no id twice."""
    if not is_list(groups) or not all(is_list(group) for group in groups):
        raise InvalidRanking("An order is a list of groups, each a list of demonstration ids.", field="order")
    checked = tuple(tuple(group) for group in groups)
    seen: set[str] = set()
    for group in checked:
        if not group:
            raise InvalidRanking("A group in the order is empty; leave it out.", field="order")
        for id_ in group:
            if not isinstance(id_, str):
                raise InvalidRanking(f"A demonstration's id is a text, not {shown(id_)}.", field="order")
            if id_ in seen:
                raise InvalidRanking(f"Demonstration {shown(id_)} is in the order twice.", field="order")
            seen.add(id_)
    return checked
