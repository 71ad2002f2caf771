"""The browser and the server tell the same story of 10,000 random sessions at the keyboard.

Keys go the page's own way through its JavaScript (tests/js/agree.js, one Node process for all sessions): moves, undo,
restart, giving up, running out of steps and of time, reloads, trying again from earlier attempts, presses that mean
nothing. What the page would send goes through the server's own schema, parents and simulation. States, rewards, totals
(bit for bit), outcomes, endings and the seeds of slips must be the same.
"""

import json
import os
import random
import subprocess
from collections import Counter, deque
from functools import lru_cache, reduce
from operator import add
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.demonstrations.convert import simulated_columns
from app.demonstrations.schemas import DemonstrationIn
from app.demonstrations.service import check_lengths, seeds_after
from app.models import Demonstration
from app.worlds.convert import StoredWorld
from hatch_build import node_command
from irl_core import InvalidWorld, World

ROOT = Path(__file__).resolve().parents[2]
N_SESSIONS = 10_000
N_WORLDS = 600
MOVES, LETTERS, OTHERS = "^>v<", "wdsakljh", "zbrgeett.oRCS?"
KEYS = MOVES * 4 + LETTERS * 2 + OTHERS
SEEN_AT_LEAST = {
    "goal": 5000, "gave_up": 5000, "out_of_steps": 500, "out_of_time": 500, "success": 1000, "failure": 5000,
    "branched": 1000, "branched again": 100, "slipped": 5000, "total near 0": 1000, "total of 0": 500,
    "decided by rounding": 50,
}  # fmt: skip


@lru_cache(maxsize=N_WORLDS)
def world_of(n: int) -> tuple[StoredWorld, str]:
    """The n-th of the worlds played, and how its JSON reaches the browser."""
    rng = random.Random(n)
    while True:
        try:
            world = draw_world(rng)
        except InvalidWorld:  # walls on the start, or across every way
            continue
        stored = StoredWorld(f"world-{n}", world, spec={})
        return stored, json.dumps(stored.to_json())


def draw_world(rng: random.Random) -> World:
    """Small worlds, where much happens soon: any start, several goals, walls, slips, limits, awkward rewards."""
    rows, cols = rng.choice([(2, 2), (2, 2), (2, 3), (3, 3), (3, 3), (4, 5), (2, 9), (10, 10)])
    squares = list(range(rows * cols))
    start, *others = rng.sample(squares, len(squares))
    goals = tuple(others[: rng.choice([1, 1, 2, min(4, len(others))])])
    walls = tuple(square for square in others if square not in goals and rng.random() < rng.choice([0, 0.3]))
    rewards = np.array([draw_reward(rng) for _ in squares]).reshape(rows, cols)
    world = World(
        rows, cols, rewards, start, goals, walls,
        slip=rng.choice([0.0, 0.0, 0.1, 1 / 3, 0.5, 0.9]),
        horizon=rng.choice([0, 2 * len(squares), rng.randint(1, len(squares)), rng.randint(1, len(squares))]),
        time_limit_s=rng.choice([None, 5, 6, 9]),
    )  # fmt: skip
    return with_a_fair_goal(world, rng)


def draw_reward(rng: random.Random) -> float:
    """Costs whose sums have to be rounded, and some that are exact."""
    return -rng.choice([rng.uniform(0, 7), rng.randint(0, 70) / 10, rng.randint(0, 30) / 100, float(rng.randint(0, 7))])


def with_a_fair_goal(world: World, rng: random.Random) -> World:
    """Let the nearest goal pay what the way costs, or a hair more or less: there a sum decides between the outcomes."""
    squares = [state for state, _ in shortest_way(world)]
    paid = world.reward.copy()
    cost = -careless_sum([float(paid[state]) for state in squares[:-1]])
    hair = rng.choice([0.0, 0.0, -1.0, 1.0]) * np.spacing(cost)
    paid[squares[-1]] = cost + hair if rng.random() < 0.8 else rng.uniform(0, 20)
    return World(
        world.rows, world.cols, paid.reshape(world.rows, world.cols), world.start, world.goals, world.walls,
        slip=world.slip, horizon=world.horizon, time_limit_s=world.time_limit_s,
    )  # fmt: skip


def careless_sum(numbers: list[float]) -> float:
    """One after the other, each sum rounded; Python's own `sum` is more careful from 3.12 on."""
    return reduce(add, numbers, 0.0)


def shortest_way(world: World) -> list[tuple[int, int]]:
    """The squares of a shortest way to a goal, without the start, each with the direction that leads there."""
    ways: dict[int, list[tuple[int, int]]] = {world.start: []}
    waiting = deque([world.start])
    while (state := waiting.popleft()) not in world.goals:
        for direction, reached in enumerate(world.next_states[state].tolist()):
            if reached not in ways:
                ways[reached] = [*ways[state], (reached, direction)]
                waiting.append(reached)
    return ways[state]


@pytest.fixture(scope="module")
def node():
    """The browser's side, waiting for sessions."""
    command = [*node_command(), "tests/js/agree.js"]
    environment = os.environ | {"NODE_OPTIONS": ""}
    with subprocess.Popen(
        command, cwd=ROOT, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        yield process
        process.communicate()


def played_in_the_browser(node, world: str, *, salt: int, picks: int, keys: str) -> list[dict[str, Any]]:
    node.stdin.write(f'{{"world": {world}, "salt": {salt}, "picks": {picks}, "keys": {json.dumps(keys)}}}\n')
    node.stdin.flush()
    line = node.stdout.readline()
    assert line, "the browser's side has ended; its last words stand above"
    return json.loads(line)


def found_by_the_server(world: StoredWorld, bodies: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """What would be stored of these attempts, each after its parent."""
    stored: dict[str, dict[str, Any]] = {}
    for body in bodies:
        told = DemonstrationIn.model_validate(body)
        check_lengths(told)
        parent = Demonstration(**stored[told.parent_id]) if told.parent_id else None
        seeds = seeds_after(parent, world, told) if parent else None
        stored[told.id] = simulated_columns(world, told, slip_seeds=seeds)
    return list(stored.values())


def as_the_server_says(attempt: dict[str, Any]) -> dict[str, Any]:
    """What the page showed, by the names of the columns."""
    names = {"step_ms": "stepMs", "slip_seeds": "slipSeeds", "parent_id": "parentId", "parent_step": "parentStep"}
    told = {name: attempt[names.get(name, name)] for name in COMPARED}
    return told | {"parent_step": told["parent_step"] or None, "record": attempt["body"]["record"]}


COMPARED = (
    "id", "states", "actions", "rewards", "step_ms", "total", "outcome", "ending", "slip_seeds", "parent_id",
    "parent_step",
)  # fmt: skip


def what_was_seen(world: World, columns: dict[str, Any]) -> list[str]:
    total, careless, at_goal = columns["total"], careless_sum(columns["rewards"]), columns["ending"] == "goal"
    walked = zip(columns["states"], columns["actions"], strict=False)
    intended = [int(world.next_states[state, action]) for state, action in walked]
    also = {
        "branched": columns["parent_id"] is not None,
        "branched again": len(columns["slip_seeds"]) > 2,
        "slipped": intended != columns["states"][1:],
        "total near 0": at_goal and abs(total) < 1e-12,
        "total of 0": at_goal and total == 0,
        "decided by rounding": at_goal and (careless >= 0) != (total >= 0),
    }
    return [columns["ending"], columns["outcome"], *(name for name, is_so in also.items() if is_so)]


def spelled(world: World, rng: random.Random) -> str:
    """A shortest way to a goal, by arrows or letters."""
    return "".join(
        MOVES[direction] if rng.random() < 0.5 else LETTERS[direction] for _, direction in shortest_way(world)
    )


def test_browser_and_server_agree_on_every_session(node):
    seen: Counter[str] = Counter()

    @given(
        n=st.integers(0, N_WORLDS - 1),
        salt=st.integers(0, 2**32 - 1),
        picks=st.integers(0, 2**32 - 1),
        goes_straight=st.booleans(),
        keys=st.text(KEYS, max_size=10) | st.text(KEYS, min_size=30, max_size=200),
    )
    @settings(max_examples=N_SESSIONS, deadline=None, database=None, suppress_health_check=list(HealthCheck))
    def agree(n, salt, picks, *, goes_straight, keys):
        world, sent = world_of(n)
        if goes_straight:
            keys = spelled(world.world, random.Random(salt)) + keys
        attempts = played_in_the_browser(node, sent, salt=salt, picks=picks, keys=keys)
        found = found_by_the_server(world, [attempt["body"] for attempt in attempts])
        for attempt, columns in zip(attempts, found, strict=True):
            seen.update(what_was_seen(world.world, columns))
            assert as_the_server_says(attempt) == {name: columns[name] for name in (*COMPARED, "record")}

    agree()
    # Agreement about little would be easy: the sessions went everywhere.
    assert {name: seen[name] for name, least in SEEN_AT_LEAST.items() if seen[name] < least} == {}
