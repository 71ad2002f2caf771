"""Things for tests to have, with good defaults, so that a test shows only what matters."""

import uuid
from collections import deque
from typing import Any

from httpx2 import Client, Response

PLAYABLE_SEED = 5
"""A 7×7 world in which a success is possible; `test_worlds.py` checks that it stays so."""


def make_world(client: Client, **parameters: Any) -> dict[str, Any]:
    """Store a world; a playable one of 7×7 unless told otherwise."""
    response = client.post("/api/v1/worlds", json={"seed": PLAYABLE_SEED} | parameters)
    assert response.status_code == 201, response.text
    return response.json()


def make_demonstration(
    client: Client, world: dict[str, Any], *, failed: bool = False, attempt_id: str | None = None
) -> dict[str, Any]:
    """Play an attempt: along the best path, or one step and then give up."""
    response = post_demonstration(client, world, attempt(world, failed=failed, attempt_id=attempt_id))
    assert response.status_code == 201, response.text
    return response.json()


def post_demonstration(client: Client, world: dict[str, Any], body: dict[str, Any]) -> Response:
    return client.post(f"/api/v1/worlds/{world['id']}/demonstrations", json=body)


def attempt(
    world: dict[str, Any], *, failed: bool = False, attempt_id: str | None = None, **changes: Any
) -> dict[str, Any]:
    """The body of a demonstration; a change of None leaves the field out."""
    actions = [1] if failed else best_path(world)
    body = {
        "id": attempt_id or str(uuid.uuid4()),
        "actions": actions,
        "step_ms": [100.0 + step for step in range(len(actions))],
        "ending": "gave_up" if failed else "goal",
    } | changes
    return {name: value for name, value in body.items() if value is not None}


def make_ranking(client: Client, world: dict[str, Any], outcome: str, ids: list[str]) -> dict[str, Any]:
    """Confirm an order without ties."""
    body = {"order": [[one] for one in ids], "confirmed": True}
    response = client.put(f"/api/v1/worlds/{world['id']}/rankings/{outcome}", json=body)
    assert response.status_code == 200, response.text
    return response.json()


def best_path(world: dict[str, Any]) -> list[int]:
    """Find the actions of the best path, by Bellman–Ford (every square but the goal costs)."""
    rewards = [reward for row in world["rewards"] for reward in row]
    best: dict[int, tuple[float, list[int]]] = {world["start"]: (0.0, [])}
    waiting = deque([world["start"]])
    while waiting:
        state = waiting.popleft()
        total, actions = best[state]
        if state in world["goals"]:
            continue
        for action in range(4):
            reached = step(world, state, action)
            if reached not in best or total + rewards[reached] > best[reached][0] + 1e-12:
                best[reached] = (total + rewards[reached], [*actions, action])
                waiting.append(reached)
    return best[world["goal"]][1]


def step(world: dict[str, Any], state: int, action: int) -> int:
    """Where one step leads, without slips."""
    row, col = divmod(state, world["cols"])
    row, col = row + (-1, 0, 1, 0)[action], col + (0, 1, 0, -1)[action]
    reached = row * world["cols"] + col
    inside = 0 <= row < world["rows"] and 0 <= col < world["cols"]
    return reached if inside and reached not in world["walls"] else state


def losing_path(world: dict[str, Any]) -> list[int]:
    """Actions of a way to the goal that loses more than it pays: to the dearest square, to and fro, and on."""
    rewards = [reward for row in world["rewards"] for reward in row]
    worst = min((s for s in range(len(rewards)) if s != world["start"]), key=rewards.__getitem__)
    there = shortest_path(world, world["start"], worst)
    back = (there[-1] + 2) % 4
    to_and_fro = [back, there[-1]] * (1 + int(rewards[world["goal"]] / -rewards[worst]))
    return there + to_and_fro + shortest_path(world, worst, world["goal"])


def shortest_path(world: dict[str, Any], start: int, end: int) -> list[int]:
    """The actions of a shortest path, breadth first; it enters no goal on its way."""
    paths: dict[int, list[int]] = {start: []}
    waiting = deque([start])
    while waiting:
        state = waiting.popleft()
        if state == end or state in world["goals"]:
            continue
        for action in range(4):
            reached = step(world, state, action)
            if reached not in paths:
                paths[reached] = [*paths[state], action]
                waiting.append(reached)
    return paths[end]


def record_of(n_steps: int, **changes: Any) -> dict[str, Any]:
    """What a browser measured about an attempt of so many steps."""
    return {
        "version": 1,
        "rt": [180.5 + step for step in range(n_steps)],
        "device": ["key"] * n_steps,
        "events": [
            {"type": "blur", "at_ms": 50.0, "step": 0, "value": None},
            {"type": "undo", "at_ms": 410.3, "step": 1, "value": 2.0},
        ],
        "elapsed_ms": 1234.5,
        "abandoned": [{"n_steps": 4, "elapsed_ms": 900.0}],
        "client": {
            "agent": "desktop Chromium",
            "viewport": [1280, 800],
            "pixel_ratio": 2.0,
            "refresh_hz": 59.9,
            "pointer": "fine",
            "reduced_motion": False,
            "forced_colours": False,
            "dark": True,
            "totals_shown": True,
            "hold_to_move": False,
        },
    } | changes
