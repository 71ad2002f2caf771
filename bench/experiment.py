"""Learning quality: the paper's protocol on simulated people, held against what PAPER.md lets one expect.

40 worlds for each kind of person by default; with IRLFR_BENCH_WORLDS=500 it takes a quarter of an hour, and says it
more exactly. A share of the optimum falls short only where it does so by more than both samples explain: PAPER.md's
figures are of 100 worlds. Our learner must be ahead of the policies that the paper's execute, and not behind their
greedy plans, which it is compared with because it plans, too. The same seed draws the same worlds anywhere.
"""

import math
import os
from collections.abc import Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Final

from bench.measure import Figure
from irl_core.experiment import ExperimentSpec, KindSummary, Measure, WorldOutcome, run_chunk, summarise

N_WORLDS: Final = int(os.environ.get("IRLFR_BENCH_WORLDS", "40"))
AT_A_TIME: Final = 5
SEED: Final = 1
PAPERS: Final = ("meirl", "irlr", "irlf", "irlfr")
OURS: Final = "birlfr"
MEASURES: Final[tuple[Measure, ...]] = ("soft", "greedy")
N_EXPECTED: Final = 100
#: PAPER.md, "What to expect": the share of the optimum that each of the paper's learners reaches, its policy executed.
EXPECTED: Final[Mapping[str, tuple[float, ...]]] = {
    "mixture": (0.48, 0.57, 0.52, 0.61),
    "boltzmann": (0.39, 0.46, 0.31, 0.42),
    "myopic": (0.58, 0.66, 0.59, 0.70),
    "shortest_path": (0.29, 0.36, 0.32, 0.39),
    "wanderer": (0.53, 0.62, 0.58, 0.68),
    "perceptual": (0.52, 0.60, 0.55, 0.63),
}


def measure() -> Iterator[Figure]:
    for summary in summarise(_outcomes(), seed=SEED):
        yield from _shares(summary)
        for which in MEASURES:
            yield _ahead(summary, which)


def _outcomes() -> list[WorldOutcome]:
    """All worlds of all kinds, on all cores."""
    spec = ExperimentSpec(seed=SEED, learners=(*PAPERS, OURS))
    chunks = [
        (kind, first, min(first + AT_A_TIME, N_WORLDS)) for kind in EXPECTED for first in range(0, N_WORLDS, AT_A_TIME)
    ]
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        waiting = [pool.submit(run_chunk, spec, *chunk) for chunk in chunks]
        return [outcome for one in waiting for outcome in one.result()]


def _shares(summary: KindSummary) -> Iterator[Figure]:
    """Each learner's share; the best attempt and the greedy plan of the same reward beside it."""
    for name, expected in zip(PAPERS, EXPECTED[summary.demonstrator], strict=True):
        learner = summary.learner(name)
        share = learner.share["soft"]
        reference = f"[{share.low:.2f}, {share.high:.2f}], planned {learner.share['greedy'].value:.2f}"
        title = f"{summary.demonstrator}, {summary.n_worlds} worlds: share of the optimum, {learner.title}"
        error = (share.high - share.value) * math.sqrt(1 + summary.n_worlds / N_EXPECTED)
        yield Figure(title, (share.value,), "", f"≥ {expected:g}", share.value + error >= expected, reference)


def _ahead(summary: KindSummary, which: Measure) -> Figure:
    """How far ours is ahead of the nearest of the four, paired by world."""
    leads = {name: summary.difference(OURS, name, measure=which) for name in PAPERS}
    nearest = min(leads, key=lambda name: leads[name].low)
    lead, ours = leads[nearest], summary.learner(OURS)
    reference = f"[{lead.low:.3f}, {lead.high:.3f}] ahead of {nearest}; its share {ours.share[which].value:.2f}"
    title = f"{summary.demonstrator}, {summary.n_worlds} worlds: {ours.title} ahead of all four"
    if which == "soft":
        return Figure(f"{title}, executed", (lead.value,), "", "> 0", lead.low > 0, reference)
    return Figure(f"{title}, planned", (lead.value,), "", "≥ 0", lead.high >= 0, reference)
