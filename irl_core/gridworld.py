"""Making worlds and playing them.

World (IRLFR paper, Sec. IV-A): start top left, goal bottom right. With probability 0.3 a square is red and pays
U[−7, −1], otherwise it is blue and pays U[−1, 0]; the goal pays rows + cols, once, and ends the attempt. A
world can be asked for with another start, other goals, walls, and squares painted by hand.

Play: a step pays the reward of the square reached, also when the edge or a wall held the agent where it was. The start
square's own reward is not paid at the beginning. With slip p the intended direction is taken with probability 1 − p and
each of the other three with p / 3. Which one is decided by a counter-based hash of the attempt's id and the step, so
that the browser, without asking, plays the very attempt the server later replays. An attempt that began as a copy of
another ("try again from here") slips in the copied steps by that one's id, and from there on by its own.
"""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from irl_core.arrays import Matrix
from irl_core.checks import Refused, finite, identifier, is_integer, shown
from irl_core.errors import ImpossibleDemonstration, InvalidWorld
from irl_core.grid import N_ACTIONS
from irl_core.types import (
    ENDINGS,
    MAX_SEED,
    MAX_SIDE,
    MAX_SLIP,
    MIN_SIDE,
    Demonstration,
    Ending,
    SlipSeeds,
    World,
    check_world,
)
from irl_core.world_checks import is_list, place, real, square_of, squares_of, whole

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


def simulate(
    world: World,
    actions: Sequence[int],
    *,
    attempt_id: str = "",
    ending: str | None = None,
    id: str | None = None,  # noqa: A002 - the field it sets
    slip_seeds: Sequence[tuple[str, int]] | None = None,
) -> Demonstration:
    """Play the actions and tell what happened; raises ImpossibleDemonstration where they cannot have been played.

    `attempt_id` decides the slips (and is the demonstration's id unless `id` says otherwise); `slip_seeds`, pairs of a
    seed and the step from which it decides, do so in its place: `[("parent", 0), ("child", 5)]`. `ending`, if claimed,
    must fit what happened; otherwise it is found: at a goal, out of steps, or given up.
    """
    check_world(world)
    id_ = attempt_id if id is None else id
    _check_ids(attempt_id, id_)
    checked = _check_actions(world, actions)
    seeds = ((attempt_id, 0),) if slip_seeds is None else _check_slip_seeds(slip_seeds, n_steps=len(checked))
    states, rewards = [world.start], []
    for step, (intended, seed) in enumerate(zip(checked, _seed_of_each_step(seeds, len(checked)), strict=True)):
        if states[-1] in world.goals:
            raise ImpossibleDemonstration("the goal was already reached; nothing comes after it.", step=step)
        direction = _slipped(seed, step, intended, world.slip)
        states.append(int(world.next_states[states[-1], direction]))
        rewards.append(float(world.reward[states[-1]]))
    at_goal, total = states[-1] in world.goals, math.fsum(rewards)
    return Demonstration(
        id=id_,
        states=np.array(states, dtype=np.int64),
        actions=np.array(checked, dtype=np.int64),
        rewards=np.array(rewards, dtype=np.float64),
        total=total,
        outcome="success" if at_goal and total >= 0.0 else "failure",
        ending=_settle_ending(world, ending, at_goal=at_goal, n_steps=len(checked)),
        slip_seeds=seeds,
    )


def _seed_of_each_step(seeds: SlipSeeds, n_steps: int) -> Iterator[str]:
    ends = [first for _, first in seeds[1:]] + [n_steps]
    for (seed, first), end in zip(seeds, ends, strict=True):
        yield from itertools.repeat(seed, end - first)


def slip_direction(attempt_id: str, step: int, intended: int, slip: float) -> int:
    """The direction a step really takes: FNV-1a over "attempt_id:step", murmur3's finaliser, then the slip law.

    u = h / 2³² is uniform on [0, 1): from `slip` upward the step goes as intended, below it each of the three others
    has a third. static/js/board/moves.js is its twin; tests/core/slip_vectors.json holds both to the same table.
    Raises InvalidWorld.
    """
    whole("step", step, minimum=0, maximum=MAX_SEED)
    slip = real("slip", slip, minimum=0.0, maximum=MAX_SLIP)
    return _slipped(attempt_id, step, whole("intended", intended, minimum=0, maximum=N_ACTIONS - 1), slip)


def _slipped(attempt_id: str, step: int, intended: int, slip: float) -> int:
    if slip <= 0.0:
        return intended
    u = _hash32(f"{attempt_id}:{step}".encode()) / 2**32
    if u >= slip:
        return intended
    return (intended + 1 + min(2, int(u / slip * 3))) % N_ACTIONS


def _hash32(data: bytes) -> int:
    h = 0x811C9DC5
    for byte in data:
        h = (h ^ byte) * 0x01000193 & 0xFFFFFFFF
    h = (h ^ h >> 16) * 0x85EBCA6B & 0xFFFFFFFF
    h = (h ^ h >> 13) * 0xC2B2AE35 & 0xFFFFFFFF
    return h ^ h >> 16


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


def _check_ids(*ids: str) -> None:
    """Without an id (an attempt nobody keeps) the empty text decides the slips."""
    try:
        for id_ in ids:
            identifier("none" if id_ == "" else id_)
    except Refused as refused:
        raise ImpossibleDemonstration(f"the attempt's id {refused}.", field="id") from None


def _check_slip_seeds(slip_seeds: Sequence[tuple[str, int]], *, n_steps: int) -> SlipSeeds:
    """Pairs of a text and a step: the first from step 0, each later one from a later step that was taken."""
    if not is_list(slip_seeds) or not all(is_list(pair) and len(pair) == 2 for pair in slip_seeds):
        raise ImpossibleDemonstration("slip_seeds must be a list of pairs: a seed and a step.", field="slip_seeds")
    pairs = [(seed, first) for seed, first in slip_seeds]
    for seed, _ in pairs:
        _check_seed(seed)
    steps = [first for _, first in pairs]
    if not all(is_integer(first) for first in steps) or steps[:1] != [0] or steps[-1] >= n_steps or _falls(steps):
        raise ImpossibleDemonstration(
            f"the steps of slip_seeds must begin with 0 and rise, each below the {n_steps} that were taken.",
            field="slip_seeds",
        )
    return tuple((seed, int(first)) for seed, first in pairs)


def _check_seed(seed: object) -> None:
    try:
        identifier("none" if seed == "" else seed)
    except Refused as refused:
        raise ImpossibleDemonstration(f"a seed of slip_seeds {refused}.", field="slip_seeds") from None


def _falls(steps: list[int]) -> bool:
    return any(later <= earlier for earlier, later in itertools.pairwise(steps))


def _check_actions(world: World, actions: Sequence[int]) -> list[int]:
    if isinstance(actions, np.ndarray):
        actions = actions.tolist()
    if isinstance(actions, str | bytes) or not isinstance(actions, Sequence):
        raise ImpossibleDemonstration(f"actions must be a list of directions 0 to 3, not {shown(actions)}.")
    if len(actions) == 0:
        raise ImpossibleDemonstration("an attempt needs at least one step.")
    if len(actions) > world.horizon:
        raise ImpossibleDemonstration(
            f"{len(actions)} steps are more than this world allows ({world.horizon}).", step=world.horizon
        )
    for step, action in enumerate(actions):
        if not is_integer(action) or not 0 <= int(action) < N_ACTIONS:
            raise ImpossibleDemonstration(
                f"an action is 0 up, 1 right, 2 down or 3 left, not {shown(action)}.", step=step
            )
    return [int(action) for action in actions]


def _settle_ending(world: World, claimed: str | None, *, at_goal: bool, n_steps: int) -> Ending:
    found: Ending = "goal" if at_goal else "out_of_steps" if n_steps == world.horizon else "gave_up"
    if claimed is None:
        return found
    for ending in ENDINGS:
        if claimed == ending and (ending == found or (not at_goal and _may_stop_by(ending, world))):
            return ending
    if claimed not in ENDINGS:
        raise ImpossibleDemonstration(
            f'ending must be "goal", "gave_up", "out_of_steps" or "out_of_time", not {shown(claimed)}.', field="ending"
        )
    if claimed == "out_of_time" and not at_goal:
        raise ImpossibleDemonstration(
            'the ending is said to be "out_of_time", but this world has no time limit.', field="ending"
        )
    raise ImpossibleDemonstration(
        f'the ending is said to be "{claimed}", but after {n_steps} of at most {world.horizon} steps the agent is'
        f" {'at' if at_goal else 'not at'} a goal.",
        field="ending",
    )


def _may_stop_by(ending: Ending, world: World) -> bool:
    """How an attempt may end anywhere but at a goal: who is out of steps may have given up, or be out of time, too."""
    return ending == "gave_up" or (ending == "out_of_time" and world.time_limit_s is not None)
