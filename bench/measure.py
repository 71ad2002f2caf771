"""What a benchmark reports, and how time is taken."""

import statistics
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class Figure:
    """One line of the table. `value` is the median of `runs`; `target`, what must be, is met from above or from below.

    `goal` is what a prototype has reached, or the limit. Without runs the figure was not measured here, and `met` is
    None.
    """

    name: str
    runs: tuple[float, ...]
    unit: str
    target: str
    met: bool | None
    reference: str
    goal: str = ""

    @property
    def value(self) -> float | None:
        return statistics.median(self.runs) if self.runs else None

    def to_json(self) -> dict[str, Any]:
        return asdict(self) | {"value": self.value, "runs": list(self.runs)}


def at_least(
    name: str, runs: list[float], *, target: float, unit: str, reference: str, goal: float | None = None
) -> Figure:
    """A figure that shall be large."""
    met = statistics.median(runs) >= target if runs else None
    return Figure(name, tuple(runs), unit, f"≥ {target:g}", met, reference, "" if goal is None else f"{goal:g}")


def at_most(
    name: str, runs: list[float], *, target: float, unit: str, reference: str, goal: float | None = None
) -> Figure:
    """A figure that shall be small."""
    met = statistics.median(runs) <= target if runs else None
    return Figure(name, tuple(runs), unit, f"≤ {target:g}", met, reference, "" if goal is None else f"{goal:g}")


def cpu_seconds(work: Callable[[], object], *, repeats: int) -> float:
    """CPU time of this process for one call, the mean of `repeats`."""
    started = time.process_time()
    for _ in range(repeats):
        work()
    return (time.process_time() - started) / repeats


def interleaved(
    reference: Callable[[], object], ours: Callable[[], object], *, n_pairs: int = 7, seconds: float = 0.3
) -> list[tuple[float, float]]:
    """CPU seconds of one call of each, measured in turns of some `seconds`, so that a busy machine troubles both."""
    for work in (reference, ours):
        work()  # the first call loads or compiles
    repeats = [max(1, round(seconds / max(cpu_seconds(work, repeats=3), 1e-6))) for work in (reference, ours)]
    return [(cpu_seconds(reference, repeats=repeats[0]), cpu_seconds(ours, repeats=repeats[1])) for _ in range(n_pairs)]
