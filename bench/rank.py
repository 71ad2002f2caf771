"""Rank: how many questions the pairwise mode asks, and how good the order is that comes of the answers.

The judges are simulated in Node (judges.js) and answer the very questions of the page's own pairwise.js; plain merge
insertion sorts the same things in the same start order beside it. Counts repeat exactly; only the last line is of time.
"""

import json
import statistics
import subprocess
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bench.measure import Figure, at_least, at_most
from hatch_build import node_command

HERE = Path(__file__).parent
SIZES = (6, 12, 20)
N_JUDGES = 1000
N_OTHERS = 250
SEED = 5
MOST_QUESTIONS = 1.1
MOST_QUESTIONS_OF_ERRING = 2.0
LEAST_TAU = 0.8
ERRING = "one answer in ten wrong"
#: Beyond what is asked for.
OTHERS = {
    "slips": "one answer in 30 wrong",
    "close": "wrong on a quarter of neighbours, seldom on others",
    "grades": f"half as many grades, {ERRING}",
}


@dataclass(frozen=True, slots=True)
class Judged:
    """What became of so many judges: a number for each, in their order."""

    n: int
    kind: str
    questions: list[int]
    tau: list[float]
    reference: list[int]

    @property
    def ratio(self) -> float:
        return statistics.mean(self.questions) / statistics.mean(self.reference)

    @property
    def counted(self) -> str:
        ours = f"{statistics.mean(self.questions):.2f} questions, most {max(self.questions)}"
        return f"{ours}; merge insertion {statistics.mean(self.reference):.2f}, most {max(self.reference)}"

    @property
    def spread(self) -> str:
        lowest = statistics.quantiles(self.tau, n=20)[0]
        exact = sum(tau == 1 for tau in self.tau) / len(self.tau)
        return f"median {statistics.median(self.tau):.2f}, 1 in 20 below {lowest:.2f}, exactly right {exact:.0%}"


def measure() -> Iterator[Figure]:
    kinds = ["consistent", "errs", *OTHERS]
    with ThreadPoolExecutor(max_workers=2) as pool:  # each waits for a process of its own
        for judged in pool.map(_judge, [kind for kind in kinds for _ in SIZES], SIZES * len(kinds)):
            yield from _consistent(judged) if judged.kind == "consistent" else _erring(judged)
    yield _time_of_a_question()


def _consistent(judged: Judged) -> Iterator[Figure]:
    name = f"{judged.n} things, {len(judged.tau)} consistent judges"
    yield at_most(f"{name}: questions", [judged.ratio], target=MOST_QUESTIONS, unit="×", reference=judged.counted)
    yield at_least(f"{name}: τ of the worst", [min(judged.tau)], target=1.0, unit="", reference=judged.spread)


def _erring(judged: Judged) -> Iterator[Figure]:
    name = f"{judged.n} things, {len(judged.tau)} judges, {OTHERS.get(judged.kind, ERRING)}"
    most, mean, reference = MOST_QUESTIONS_OF_ERRING, [statistics.mean(judged.tau)], judged.spread
    if judged.kind in OTHERS:
        reference = f"{judged.spread}; {judged.counted}"
    else:
        yield at_most(f"{name}: questions", [judged.ratio], target=most, unit="×", reference=judged.counted)
    yield at_least(f"{name}: mean τ", mean, target=LEAST_TAU, unit="", reference=reference)


def _time_of_a_question() -> Figure:
    ms = _run("errs", 40, n_judges=3)["ms"]
    reference = f"{ms['count']} questions: median {ms['median']:.1f} ms, longest {ms['most']:.1f} ms"
    return at_most(
        "40 things: CPU time to the next question, p99", [ms["p99"]], target=16, unit="ms", reference=reference
    )


def _judge(kind: str, n: int) -> Judged:
    found = _run(kind, n, n_judges=N_OTHERS if kind in OTHERS else N_JUDGES)
    if found["nBrokenPromises"]:
        raise RuntimeError(f"{found['nBrokenPromises']} times the count of questions left was not true")
    return Judged(n, kind, found["questions"], found["tau"], found["reference"])


def _run(kind: str, n: int, *, n_judges: int) -> dict[str, Any]:
    asked = json.dumps({"n": n, "kind": kind, "nJudges": n_judges, "seed": SEED})
    command = [*node_command(), str(HERE / "judges.js")]
    done = subprocess.run(command, input=asked, cwd=HERE.parent, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(done.stderr)
    found: dict[str, Any] = json.loads(done.stdout)
    return found
