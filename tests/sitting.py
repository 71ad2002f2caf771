"""A sitting as a browser keeps it: an id, a log, and what it sends."""

import json
import re
import uuid
from typing import Any

from httpx2 import Client, Response
from sqlalchemy import text

Json = dict[str, Any]

BROWSER = {
    "agent": "desktop Chromium", "viewport": [1280, 800], "pixel_ratio": 2.0, "refresh_hz": 59.9, "pointer": "fine",
    "reduced_motion": False, "forced_colours": False, "dark": True, "totals_shown": True,
}  # fmt: skip


class Sitting:
    """One log on its way to the server; numbers and times come by themselves."""

    def __init__(self, client: Client, world: Json) -> None:
        self.client = client
        self.world = world
        self.id = str(uuid.uuid4())
        self.log: list[Json] = []

    def do(self, kind: str, /, **fields: Any) -> Json:
        """Make the next event of the log."""
        n = len(self.log)
        self.log.append({"n": n, "at_ms": 10.5 * n, "type": kind, "means": "mouse"} | fields)
        return self.log[-1]

    def begin(self, drawn: dict[str, list[str]] | None = None, *, origins: Json | None = None, **changes: Any) -> Json:
        """Begin with the orders that the server drew for what is kept."""
        told: Json = {
            "orders": {outcome: [[one] for one in ids] for outcome, ids in (drawn or self.drawn()).items()},
            "from": origins or {"success": "random", "failure": "random"}, "based_on": {"success": 0, "failure": 0},
            "way": "lists", "client": BROWSER,
        }  # fmt: skip
        return self.do("begin", **{"means": "page"} | told | changes)

    def drawn(self) -> dict[str, list[str]]:
        """What the rank page gives as start order."""
        page = self.client.get(f"/worlds/{self.world['id']}/rank").text
        found = re.search(r'<script type="application/json" id="page-data"[^>]*>(.*?)</script>', page, re.DOTALL)
        assert found
        return json.loads(found[1])["start_order"]

    def set(self, outcome: str, order: list[list[str]]) -> Json:
        """Put a whole list in order."""
        return self.do("set", outcome=outcome, order=order, by="score")

    def send(self, events: list[Json] | None = None) -> Response:
        """Send events to the log; all of them unless told otherwise."""
        url = f"/api/v1/worlds/{self.world['id']}/sittings/{self.id}/events"
        return self.client.post(url, json={"events": self.log if events is None else events})

    def confirm(self, outcome: str, order: list[list[str]], *, untouched: bool = False, **changes: Any) -> Response:
        """Say that this is the order, and send what led to it."""
        self.do("confirm", outcome=outcome, untouched=untouched)
        return self.put(outcome, order, untouched=untouched, **changes)

    def put(
        self, outcome: str, order: list[list[str]], *, events: list[Json] | None = None, **changes: Any
    ) -> Response:
        """Send an order with the log."""
        sitting = {"id": self.id, "events": self.log if events is None else events}
        body = {"order": order, "confirmed": True, "sitting": sitting} | changes
        return self.client.put(f"/api/v1/worlds/{self.world['id']}/rankings/{outcome}", json=body)


def stored(client, table="ranking_event"):
    with client.app.state.database.read() as session:
        return session.scalar(text(f"SELECT count(*) FROM {table}"))


def error(response, status, code):
    """The error of a response that must have this status and code."""
    assert (response.status_code, response.json()["error"]["code"]) == (status, code), response.text
    return response.json()["error"]
