"""Worlds to learn from: made, played and ordered by the API."""

import uuid
from typing import Final

from tests import journey

SEED: Final = 5
LONG: Final = {"iterations": 20_000, "tolerance": 1e-12}
"""Settings with which a learner is busy for seconds, where it takes a tenth of one by default."""


def prepare(client: journey.Client) -> str:
    """Three successes and three failures that reach the goal of a 7×7 world, and an order of each; the world's id."""
    world = client.post("/worlds", {"seed": SEED})
    grid = journey.Grid(world)
    wise = grid.cheapest_path([max(-reward, 0.0) for reward in grid.rewards])
    blind = grid.cheapest_path([1.0 for _ in grid.rewards])
    for actions in journey.three_of(grid, wise, success=True) + journey.three_of(grid, blind, success=False):
        attempt = {"id": str(uuid.uuid4()), "actions": actions, "step_ms": [250.0] * len(actions), "ending": "goal"}
        client.post(f"/worlds/{world['id']}/demonstrations", attempt)
    played = client.get(f"/worlds/{world['id']}/demonstrations")
    for outcome, sign in (("success", -1), ("failure", 1)):
        totals = {one["id"]: sign * one["total"] for one in played if one["outcome"] == outcome}
        order = [[id_] for id_ in sorted(totals, key=totals.__getitem__)]
        client.put(f"/worlds/{world['id']}/rankings/{outcome}", {"order": order, "confirmed": True})
    return str(world["id"])
