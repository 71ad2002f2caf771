"""What a benchmark reports, and how time is taken."""

import statistics
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class Figure:
    """One line of the table. `value` is the median of `runs`; `target` is met from above or from below."""

    name: str
    runs: tuple[float, ...]
    unit: str
    target: str
    met: bool
    reference: str

    @property
    def value(self) -> float:
        return statistics.median(self.runs)

    def to_json(self) -> dict[str, Any]:
        return asdict(self) | {"value": self.value, "runs": list(self.runs)}


def at_least(name: str, runs: list[float], *, target: float, unit: str, reference: str) -> Figure:
    """A figure that shall be large."""
    return Figure(name, tuple(runs), unit, f"≥ {target:g}", statistics.median(runs) >= target, reference)


def at_most(name: str, runs: list[float], *, target: float, unit: str, reference: str) -> Figure:
    """A figure that shall be small."""
    return Figure(name, tuple(runs), unit, f"≤ {target:g}", statistics.median(runs) <= target, reference)


def cpu_seconds(work: Callable[[], object], *, repeats: int) -> float:
    """CPU time of this process for one call, the mean of `repeats`."""
    started = time.process_time()
    for _ in range(repeats):
        work()
    return (time.process_time() - started) / repeats
