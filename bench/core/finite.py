"""The exact gradient with a finite horizon: one world, a batch, a larger world."""

import json
import os
import statistics
import subprocess
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bench.core import dense
from bench.measure import Figure, at_least, interleaved
from irl_core import World, draw_playable_world, generate_world
from irl_core.inference import infer_batch
from irl_core.inference.path import infer_path

HORIZON, LARGE_HORIZON = 50, 256
N_WORLDS = 4096
IMITATION_PYTHON = "IRLFR_BENCH_IMITATION_PYTHON"
_SCRIPT = Path(__file__).parent / "beside_imitation.py"
_NOT_HERE = f"not measured here: {IMITATION_PYTHON} names no Python that has imitation 1.0.1"


class Imitation(NamedTuple):
    """How many times as long as the dense reference `imitation` takes, with this release of SciPy."""

    times_dense: float
    scipy: str


def measure() -> Iterator[Figure]:
    world = draw_playable_world(5)
    reward = np.random.default_rng(1).normal(-1.0, 1.0, world.n_states)
    model = dense_model(world)
    slow = partial(dense.gradient, model, reward, horizon=HORIZON)
    imitation = beside_imitation(world, reward)

    def one() -> object:
        return infer_path(world.mdp, reward, horizon=HORIZON, starts=world.mdp.starts, step_policies=True)

    title = f"7×7, N = {HORIZON}, one world, policies of all steps"
    yield from _rows(title, interleaved(slow, one), imitation, must=(20, 100), goal=(36, 186))

    mdps = [generate_world(seed).mdp for seed in range(N_WORLDS)]
    rewards = np.random.default_rng(2).normal(-1.0, 1.0, (N_WORLDS, world.n_states))

    def many() -> object:
        return infer_batch(mdps, rewards, horizon=HORIZON)

    each = [(theirs, ours / N_WORLDS) for theirs, ours in interleaved(slow, many)]
    title = f"7×7, N = {HORIZON}, {N_WORLDS} worlds, per world"
    yield from _rows(title, each, imitation, must=(100, 500), goal=(545, 2800))
    yield large()


def large() -> Figure:
    """32×32, N = 256."""
    world = generate_world(3, rows=32, cols=32)
    slow = partial(dense.gradient, dense_model(world), world.reward, horizon=LARGE_HORIZON)

    def one() -> object:
        return infer_path(world.mdp, world.reward, horizon=LARGE_HORIZON, starts=world.mdp.starts, step_policies=True)

    pairs = interleaved(slow, one, n_pairs=5)
    name = f"32×32, N = {LARGE_HORIZON}, one world, policies of all steps, against dense"
    return at_least(name, _ratios(pairs), target=150, goal=568, unit="×", reference=_dense_reference(pairs))


def dense_model(world: World) -> dense.Model:
    return dense.model_of(world.next_states.astype(float), goals=list(world.goals), slip=world.slip, start=world.start)


def beside_imitation(world: World, reward: np.ndarray) -> Imitation | None:
    """How long `imitation` takes, or None where there is none."""
    python = os.environ.get(IMITATION_PYTHON)
    if not python:
        return None
    problem = {"reward": reward.tolist(), "next_states": world.next_states.tolist(), "goals": list(world.goals)}
    problem |= {"start": world.start, "horizon": HORIZON}
    done = subprocess.run([python, str(_SCRIPT)], input=json.dumps(problem), capture_output=True, text=True, check=True)
    told = json.loads(done.stdout)
    return Imitation(statistics.median(told["ratios"]), told["scipy"])


def _rows(
    title: str,
    pairs: list[tuple[float, float]],
    imitation: Imitation | None,
    *,
    must: tuple[float, float],
    goal: tuple[float, float],
) -> Iterator[Figure]:
    ratios = _ratios(pairs)
    reference = _dense_reference(pairs)
    yield at_least(f"{title}, against dense", ratios, target=must[0], goal=goal[0], unit="×", reference=reference)
    runs, said = [], _NOT_HERE
    if imitation:
        runs = [imitation.times_dense * ratio for ratio in ratios]
        said = (
            f"imitation 1.0.1 with SciPy {imitation.scipy}, {imitation.times_dense:.3g} times as long as the dense one"
        )
    yield at_least(f"{title}, against imitation", runs, target=must[1], goal=goal[1], unit="×", reference=said)


def _ratios(pairs: list[tuple[float, float]]) -> list[float]:
    return [theirs / ours for theirs, ours in pairs]


def _dense_reference(pairs: list[tuple[float, float]]) -> str:
    theirs, ours = (statistics.median(side) for side in zip(*pairs, strict=True))
    return f"bench/core/dense.py, {1e3 * theirs:.3g} ms; ours {1e6 * ours:.3g} µs"
