"""The learning core: one exact gradient on a 7×7 world, against the dense reference."""

from collections.abc import Iterator

import numpy as np

from bench import dense
from bench.measure import Figure, at_least, at_most, cpu_seconds
from irl_core import draw_playable_world, soft_plan, visitation

HORIZON = 50
N_PAIRS = 7
SECONDS_PER_SIDE = 0.3


def measure() -> Iterator[Figure]:
    world = draw_playable_world(5)
    reward = np.random.default_rng(1).normal(-1.0, 1.0, world.n_states)
    tensor = dense.transitions(world)

    def ours() -> np.ndarray:
        return visitation(world, soft_plan(world, reward, horizon=HORIZON))

    def reference() -> np.ndarray:
        return dense.gradient_visits(world, tensor, reward, horizon=HORIZON)

    difference = float(np.abs(ours() - reference()).max())
    yield at_most(
        "7×7 gradient, difference from dense", [difference], target=1e-9, unit="visits", reference="bench/dense.py"
    )
    slow = max(1, round(SECONDS_PER_SIDE / cpu_seconds(reference, repeats=3)))
    fast = max(1, round(SECONDS_PER_SIDE / cpu_seconds(ours, repeats=3)))
    pairs = [(cpu_seconds(reference, repeats=slow), cpu_seconds(ours, repeats=fast)) for _ in range(N_PAIRS)]
    ratios = [theirs / own for theirs, own in pairs]
    name = f"7×7 gradient, N = {HORIZON}, one world, against dense"
    yield at_least(
        name, ratios, target=20, unit="×", reference=f"bench/dense.py, {1e3 * min(t for t, _ in pairs):.2f} ms"
    )
