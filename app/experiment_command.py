"""`irlfr experiment`: chunks of worlds on all cores, a progress bar; tables, a figure and the outcomes in a folder.

    results.json      the spec, the versions and the summary of each kind of demonstrator
    outcomes.jsonl    one world a line
    table.md          every table
    figure.svg        shares of the optimum

The chunks are pure (`irl_core.experiment.run_chunk`), so the files are the same to the last bit on however many
processes. They are written at the end; a stopped experiment leaves none.
"""

import json
import os
import platform
import signal
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from multiprocessing import get_context
from pathlib import Path
from typing import Any, Final

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.table import Table as RichTable

from app.learning.supervisor import ONE_THREAD_EACH
from irl_core.demonstrators import demonstrator_named
from irl_core.errors import InvalidSettings
from irl_core.experiment import (
    ExperimentSpec,
    KindSummary,
    Table,
    WorldOutcome,
    draw_figure,
    markdown,
    run_chunk,
    summarise,
    tables,
)

MOST_WORLDS: Final = 1_000_000
_WORLDS_AT_A_TIME: Final = 5
_PLAIN_WIDTH: Final = 150


@dataclass(frozen=True)
class Plan:
    """Which worlds to run, for which kinds of demonstrator, on how many processes, and where to write."""

    spec: ExperimentSpec
    kinds: tuple[str, ...]
    n_worlds: int
    n_processes: int
    folder: Path

    def __post_init__(self) -> None:
        if not self.kinds:
            raise InvalidSettings("An experiment needs at least one demonstrator.", field="demonstrators")
        for kind in self.kinds:
            demonstrator_named(kind)

    @property
    def chunks(self) -> list[tuple[str, int, int]]:
        """Kind, first world, and the one after the last, of each chunk."""
        return [
            (kind, first, min(first + _WORLDS_AT_A_TIME, self.n_worlds))
            for first in range(0, self.n_worlds, _WORLDS_AT_A_TIME)
            for kind in self.kinds
        ]


def run(plan: Plan) -> None:
    """Run the experiment, print its overview and write its files. Raises IrlError, OSError and KeyboardInterrupt."""
    plan.folder.mkdir(parents=True, exist_ok=True)  # before the work, not after it
    console = Console(width=None if sys.stdout.isatty() else _PLAIN_WIDTH)
    outcomes = sorted(_run_chunks(plan), key=lambda one: (plan.kinds.index(one.demonstrator), one.index))
    summaries = summarise(outcomes, seed=plan.spec.seed)
    for table in tables(summaries):
        if not table.is_detail:
            _print(console, table)
    _write(plan, outcomes, summaries)
    console.print(f"The results are in {plan.folder}: results.json, outcomes.jsonl, table.md, figure.svg")


def _run_chunks(plan: Plan) -> Iterator[WorldOutcome]:
    """The outcomes of all chunks as they come in."""
    with _progress() as progress:
        task = progress.add_task("worlds", total=len(plan.kinds) * plan.n_worlds)
        for outcomes in _chunks_here(plan) if plan.n_processes == 1 else _chunks_in_processes(plan):
            progress.advance(task, len(outcomes))
            yield from outcomes


def _chunks_here(plan: Plan) -> Iterator[list[WorldOutcome]]:
    for chunk in plan.chunks:
        yield run_chunk(plan.spec, *chunk)


def _chunks_in_processes(plan: Plan) -> Iterator[list[WorldOutcome]]:
    os.environ.update(ONE_THREAD_EACH)  # for the processes, which inherit it; BLAS reads it when it is loaded
    pool = ProcessPoolExecutor(plan.n_processes, mp_context=get_context("spawn"))
    try:
        with _interrupts_ignored():  # a process starts with each of the first submissions, and inherits this
            waiting = [pool.submit(run_chunk, plan.spec, *chunk) for chunk in plan.chunks]
        for done in as_completed(waiting):
            yield done.result()
    except BrokenProcessPool:
        raise ChildProcessError(
            "One of the processes was ended from outside, perhaps for want of memory; try fewer --processes."
        ) from None
    finally:
        pool.shutdown(cancel_futures=True)  # at Ctrl-C this waits for the few worlds under way


@contextmanager
def _interrupts_ignored() -> Iterator[None]:
    """Ctrl-C reaches every process of a terminal; the parent alone shall decide."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _progress() -> Progress:
    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
        console=Console(stderr=True),
    )


def _write(plan: Plan, outcomes: Sequence[WorldOutcome], summaries: Sequence[KindSummary]) -> None:
    lines = [json.dumps(one.to_json(), allow_nan=False) + "\n" for one in outcomes]
    (plan.folder / "outcomes.jsonl").write_text("".join(lines), encoding="utf-8")
    results = json.dumps(_results(plan, summaries), indent=1, allow_nan=False) + "\n"
    (plan.folder / "results.json").write_text(results, encoding="utf-8")
    (plan.folder / "table.md").write_text(markdown(summaries), encoding="utf-8")
    draw_figure(summaries, plan.folder / "figure.svg")


def _results(plan: Plan, summaries: Sequence[KindSummary]) -> dict[str, Any]:
    packages = ("irlfr", "numpy", "scipy", "numba")
    return {
        "spec": plan.spec.to_json(),
        "demonstrators": list(plan.kinds),
        "n_worlds": plan.n_worlds,
        "versions": {"python": platform.python_version(), **{name: version(name) for name in packages}},
        "summaries": [one.to_json() for one in summaries],
    }


def _print(console: Console, table: Table) -> None:
    printed = RichTable(*table.header, title=table.title, title_justify="left", caption=table.note or None)
    for column in printed.columns[1:]:
        column.justify = "right"
    for row in table.rows:
        printed.add_row(*row)
    console.print(printed)
