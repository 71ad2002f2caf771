"""`python -m bench.learn_watchers ADDRESS`: four people let learn, again and again, and a hundred streams watch them.

A round: each of four visitors asks for a run that takes some seconds, 25 streams begin to watch each, and all read on
to the end. What a stream was sent is held against the record of the run. Rounds follow each other until standard input
ends; then the last one is read to its end, and what was found is printed as JSON.
"""

import asyncio
import json
import sys
import threading
import urllib.request
from dataclasses import asdict, dataclass, field
from http.cookiejar import CookieJar
from typing import Any, Final
from urllib.parse import urlsplit

from bench.learn_worlds import LONG, prepare
from tests import journey

N_VISITORS = 4
N_STREAMS_EACH = 25
LEARNERS: Final = ["irlr", "irlfr"]
NUMBERED: Final = frozenset({"frame", "progress", "learner", "done", "failed"})


class Visitor(journey.Client):
    """One who asks for runs; the streams come with the same cookie."""

    def __init__(self, address: str) -> None:
        super().__init__(address)
        self._jar = CookieJar()
        self._opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(self._jar))
        self.world_id = prepare(self)

    @property
    def cookie(self) -> str:
        return "; ".join(f"{one.name}={one.value}" for one in self._jar)

    def ask(self) -> str:
        body = {"learners": LEARNERS, "settings": LONG, "seed": 1}
        return str(self.post(f"/worlds/{self.world_id}/runs", body)["id"])


@dataclass(slots=True)
class Seen:
    """What one stream was sent of its run."""

    numbers: list[int] = field(default_factory=list)
    vectors: list[int] = field(default_factory=list)
    iterations: dict[str, int] = field(default_factory=dict)
    n_frames: int = 0
    ending: str = ""

    def take(self, event: dict[str, str]) -> None:
        kind, data = event.get("event", ""), json.loads(event.get("data", "{}"))
        self.vectors.append(int(event["id"]) if event.get("id") else -1)
        if kind in NUMBERED:
            self.numbers.append(data["number"])
        if kind == "snapshot":
            self.iterations |= {name: frame["iteration"] for name, frame in data["latest"].items()}
        elif kind == "frame":
            self.n_frames += 1
            self.iterations[data["learner"]] = data["iteration"]
        elif kind in {"done", "failed"}:
            self.ending = data["status"]


@dataclass(slots=True)
class Found:
    """What all rounds came to."""

    n_rounds: int = 0
    n_streams: int = 0
    n_frames: int = 0
    without_last_frame: int = 0
    without_end: int = 0
    doubled: int = 0
    out_of_order: int = 0

    def count(self, seen: Seen, last: dict[str, int]) -> None:
        rises = [after - before for before, after in zip(seen.numbers, seen.numbers[1:], strict=False)]
        ids = [after - before for before, after in zip(seen.vectors, seen.vectors[1:], strict=False)]
        self.n_streams += 1
        self.n_frames += seen.n_frames
        self.without_last_frame += any(seen.iterations.get(name) != iteration for name, iteration in last.items())
        self.without_end += seen.ending != "done"
        self.doubled += len(set(seen.numbers)) < len(seen.numbers)
        self.out_of_order += any(rise < 0 for rise in [*rises, *ids])


async def watch(address: str, stop: threading.Event) -> Found:
    visitors = [Visitor(address) for _ in range(N_VISITORS)]
    found = Found()
    while found.n_rounds == 0 or not stop.is_set():
        runs = [await asyncio.to_thread(one.ask) for one in visitors]
        streams = [
            (one, run, _read(address, one.cookie, run))
            for one, run in zip(visitors, runs, strict=True)
            for _ in range(N_STREAMS_EACH)
        ]
        seen = await asyncio.gather(*(stream for _, _, stream in streams))
        last = {run: await asyncio.to_thread(_last, one, run) for one, run in zip(visitors, runs, strict=True)}
        for (_, run, _), one in zip(streams, seen, strict=True):
            found.count(one, last[run])
        found.n_rounds += 1
    return found


def _last(visitor: Visitor, run: str) -> dict[str, int]:
    """The iteration of each learner's last frame on record."""
    frames: list[dict[str, Any]] = visitor.get(f"/runs/{run}/frames")["frames"]
    return {frame["learner"]: frame["iteration"] for frame in frames}


async def _read(address: str, cookie: str, run: str) -> Seen:
    """Read a stream to its end."""
    place = urlsplit(address)
    reader, writer = await asyncio.open_connection(place.hostname, place.port)
    path = f"/api/v1/events?run={run}&frames={run}"
    head = f"GET {path} HTTP/1.1\r\nHost: {place.netloc}\r\nAccept: text/event-stream\r\nCookie: {cookie}\r\n\r\n"
    writer.write(head.encode())
    answered = await reader.readuntil(b"\r\n\r\n")
    if b" 200 " not in answered.partition(b"\r\n")[0]:
        raise RuntimeError(f"a stream was answered {answered.decode('latin-1')}")
    seen, text = Seen(), ""
    while size := int(await reader.readline(), 16):
        chunk = await reader.readexactly(size + 2)
        *events, text = (text + chunk[:-2].decode()).split("\n\n")
        for event in events:
            if not event.startswith(":"):
                seen.take(dict(_field(line) for line in event.split("\n")))
    writer.close()
    return seen


def _field(line: str) -> tuple[str, str]:
    name, _, value = line.partition(":")
    return name, value.removeprefix(" ")


def main(address: str) -> None:
    stop = threading.Event()

    def wait_for_the_end() -> None:
        sys.stdin.read()
        stop.set()

    threading.Thread(target=wait_for_the_end, daemon=True).start()
    found = asyncio.run(watch(address, stop))
    print(json.dumps(asdict(found)))


if __name__ == "__main__":
    main(sys.argv[1])
