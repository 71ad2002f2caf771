"""Making worlds (IRLFR paper, Sec. IV-A).

Start top left, goal bottom right. With probability 0.3 a square is red and pays U[−7, −1], otherwise it is blue and
pays U[−1, 0]; the goal pays rows + cols, once, and ends the attempt. A world can be asked for with another start, other
goals, walls, and squares painted by hand.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from irl_core.arrays import Matrix
from irl_core.checks import finite, is_integer, shown
from irl_core.errors import InvalidWorld
from irl_core.types import MAX_SEED, MAX_SIDE, MIN_SIDE, World, check_world
from irl_core.world_checks import place, real, square_of, squares_of, whole

DEFAULT_SIDE = 7
DEFAULT_RED_PROBABILITY = 0.3
REWARDS = (-7.0, 0.0)
"""What a square that is no goal can be painted with."""
GOAL_REWARDS = (0.0, 200.0)
GENERATOR_VERSION = 1
"""Raised whenever the same seed would give another world."""


def generate_world(
    seed: int,
    *,
    rows: int = DEFAULT_SIDE,
    cols: int = DEFAULT_SIDE,
    red_probability: float = DEFAULT_RED_PROBABILITY,
    slip: float = 0.0,
    walls: Sequence[int] = (),
    start: int = 0,
    goals: Sequence[int] | None = None,
    painted: Mapping[int, float] | None = None,
    step_limit: int | None = None,
    time_limit_s: int | None = None,
) -> World:
    """The world of this seed: always the same one, with walls, start, goals and slip as asked for.

    Each square draws its colour, its red and its blue reward whether or not they are used, so that a higher
    `red_probability` only turns more squares of the same world red, and a goal or a wall changes no other square. Every
    goal pays rows + cols; then `painted` gives squares rewards of their own, −7 to 0, or 0 to 200 for a goal.
    `step_limit` becomes the horizon.
    """
    _check_origin(seed=seed, rows=rows, cols=cols, red_probability=red_probability)
    ends = _goals_of(goals, start=start, n_states=rows * cols)
    rng = np.random.default_rng(np.random.SeedSequence(seed))
    is_red = rng.random((rows, cols)) < red_probability
    red, blue = rng.uniform(-7.0, -1.0, (rows, cols)), rng.uniform(-1.0, 0.0, (rows, cols))
    rewards = np.where(is_red, red, blue)
    rewards.flat[list(ends)] = rows + cols
    _paint(rewards, painted, goals=ends, walls=walls)
    world = World(
        rows=rows,
        cols=cols,
        rewards=rewards,
        start=start,
        goals=ends,
        walls=walls,  # type: ignore[arg-type]  # World itself checks and sorts them
        slip=slip,
        seed=seed,
        red_probability=red_probability,
        time_limit_s=time_limit_s,
    )
    return world if step_limit is None else _limited(world, step_limit)


def draw_playable_world(
    seed: int | np.random.Generator,
    *,
    rows: int = DEFAULT_SIDE,
    cols: int = DEFAULT_SIDE,
    red_probability: float = DEFAULT_RED_PROBABILITY,
    slip: float = 0.0,
    walls: Sequence[int] = (),
    start: int = 0,
    goals: Sequence[int] | None = None,
    painted: Mapping[int, float] | None = None,
    step_limit: int | None = None,
    time_limit_s: int | None = None,
) -> World:
    """The first of a row of drawn worlds in which a success is possible; its own seed is on record in `world.seed`."""
    rng = seed if isinstance(seed, np.random.Generator) else _generator(seed)
    n_draws = 0
    while n_draws == 0 or n_draws < 50_000 // (rows * cols):  # a bound on the work: about a thousand draws at 7×7
        world = generate_world(
            int(rng.integers(2**32)),
            rows=rows,
            cols=cols,
            red_probability=red_probability,
            slip=slip,
            walls=walls,
            start=start,
            goals=goals,
            painted=painted,
            step_limit=step_limit,
            time_limit_s=time_limit_s,
        )
        if success_is_possible(world):
            return world
        n_draws += 1
    raise InvalidWorld(
        f"In none of {n_draws} worlds of {rows}×{cols} squares drawn with red_probability {red_probability:g} can a"
        " goal be reached with a total of 0 or more; ask for fewer red squares or walls, or a nearer goal.",
        field="red_probability",
    )


def success_is_possible(world: World) -> bool:
    """Whether any attempt could reach a goal with a total of at least 0 (were every slip a lucky one)."""
    return check_world(world).success_possible


def _check_origin(*, seed: int, rows: int, cols: int, red_probability: float) -> None:
    """What must hold before anything is drawn; the World checks the rest."""
    whole("rows", rows, minimum=MIN_SIDE, maximum=MAX_SIDE)
    whole("cols", cols, minimum=MIN_SIDE, maximum=MAX_SIDE)
    whole("seed", seed, minimum=0, maximum=MAX_SEED)
    real("red_probability", red_probability, minimum=0.0, maximum=1.0)


def _goals_of(goals: Sequence[int] | None, *, start: int, n_states: int) -> tuple[int, ...]:
    """The last square, unless goals are given."""
    if goals is not None:
        return squares_of("goals", goals, n_states=n_states)
    if start == n_states - 1:
        raise InvalidWorld(
            f"The start cannot be the last square, {start}: it is the goal, unless goals say otherwise.", field="start"
        )
    return (n_states - 1,)


def _paint(rewards: Matrix, painted: object, *, goals: Sequence[int], walls: Sequence[int]) -> None:
    """Give squares rewards of their own, in place."""
    if painted is not None and not isinstance(painted, Mapping):
        raise InvalidWorld(f"painted must be rewards by square, not {shown(painted)}.", field="painted")
    closed = set(squares_of("walls", walls, n_states=rewards.size))
    for key, value in (painted or {}).items():
        square = square_of("painted", key, n_states=rewards.size)
        at = place(square, cols=rewards.shape[1])
        if square in closed:
            raise InvalidWorld(
                f"painted: {at} is a wall and pays nothing; open it or leave it unpainted.", field="painted"
            )
        kind, lowest, highest = ("a goal", *GOAL_REWARDS) if square in goals else ("no goal", *REWARDS)
        reward = finite(value)
        if reward is None or not lowest <= reward <= highest:
            raise InvalidWorld(
                f"painted: {at} is {kind} and can pay {lowest:g} to {highest:g}, not {shown(value)}.", field="painted"
            )
        rewards.flat[square] = reward + 0.0  # −0.0 and 0.0 are one reward


def _limited(world: World, step_limit: int) -> World:
    shortest, most = world.shortest_way, 2 * world.n_states
    if not is_integer(step_limit) or not shortest <= int(step_limit) <= most:
        raise InvalidWorld(
            f"step_limit must be a whole number from {shortest} (the shortest way to a goal) to {most},"
            f" not {shown(step_limit)}.",
            field="step_limit",
        )
    return replace(world, horizon=int(step_limit))


def _generator(seed: int) -> np.random.Generator:
    return np.random.default_rng(whole("seed", seed, minimum=0, maximum=MAX_SEED))
