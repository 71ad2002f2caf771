"""A small HTTP load generator: each connection asks again as soon as it is answered."""

import asyncio
import time
from collections.abc import Callable
from dataclasses import dataclass, field


@dataclass(slots=True)
class Load:
    """What came back."""

    seconds: float = 0.0
    latencies_ms: list[float] = field(default_factory=list)
    n_errors: int = 0

    @property
    def rate(self) -> float:
        return len(self.latencies_ms) / self.seconds

    @property
    def p99_ms(self) -> float:
        return sorted(self.latencies_ms)[int(0.99 * (len(self.latencies_ms) - 1))]


def post_for(
    seconds: float, *, port: int, path: str, body: Callable[[], bytes], cookies: list[str], expected: int = 201
) -> Load:
    """POST fresh bodies on as many connections as there are cookies ("" for none)."""
    return asyncio.run(_post_for(seconds, port=port, path=path, body=body, cookies=cookies, expected=expected))


async def _post_for(
    seconds: float, *, port: int, path: str, body: Callable[[], bytes], cookies: list[str], expected: int
) -> Load:
    load = Load()
    started = time.perf_counter()

    async def one_connection(cookie: str) -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        while time.perf_counter() - started < seconds:
            content = body()
            head = f"POST {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nContent-Type: application/json\r\n"
            head += f"Content-Length: {len(content)}\r\n" + (f"Cookie: {cookie}\r\n" if cookie else "") + "\r\n"
            asked = time.perf_counter()
            writer.write(head.encode() + content)
            status = await _read_answer(reader)
            load.latencies_ms.append(1e3 * (time.perf_counter() - asked))
            load.n_errors += status != expected
        writer.close()

    await asyncio.gather(*(one_connection(cookie) for cookie in cookies))
    load.seconds = time.perf_counter() - started
    return load


async def _read_answer(reader: asyncio.StreamReader) -> int:
    head = (await reader.readuntil(b"\r\n\r\n")).decode("latin-1").lower()
    length = next(int(line.partition(":")[2]) for line in head.split("\r\n") if line.startswith("content-length:"))
    await reader.readexactly(length)
    return int(head.split(" ", 2)[1])
