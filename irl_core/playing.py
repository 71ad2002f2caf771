"""Playing worlds: what a row of actions leads to, chance included.

A step pays the reward of the square reached, also when the edge or a wall held the agent where it was. The start
square's own reward is not paid at the beginning. With slip p the intended direction is taken with probability 1 − p and
each of the other three with p / 3. Which one is decided by a counter-based hash of the attempt's id and the step, so
that the browser, without asking, plays the very attempt the server later replays. An attempt that began as a copy of
another ("try again from here") slips in the copied steps by that one's id, and from there on by its own.
"""

import itertools
import math
from collections.abc import Iterator, Sequence

import numpy as np

from irl_core.checks import Refused, identifier, is_integer, shown
from irl_core.errors import ImpossibleDemonstration
from irl_core.grid import N_ACTIONS
from irl_core.types import ENDINGS, MAX_SEED, MAX_SLIP, Demonstration, Ending, SlipSeeds, World, check_world
from irl_core.world_checks import is_list, real, whole


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


def _seed_of_each_step(seeds: SlipSeeds, n_steps: int) -> Iterator[str]:
    ends = [first for _, first in seeds[1:]] + [n_steps]
    for (seed, first), end in zip(seeds, ends, strict=True):
        yield from itertools.repeat(seed, end - first)


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
