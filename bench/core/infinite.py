"""The exact gradient without a horizon: batches, Newton, and grids of up to a million squares."""

import statistics
from collections.abc import Iterator
from functools import partial

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from bench.core import dense, growth
from bench.core.finite import HORIZON, dense_model
from bench.measure import Figure, at_least, at_most, cpu_seconds, interleaved
from irl_core import draw_playable_world, generate_world
from irl_core._kernels import stencil
from irl_core.inference import infer, infer_batch
from irl_core.inference.path_infinite import infer_path_infinite_batch
from irl_core.maxent import fit_maxent
from irl_core.mdp.grid import GridMdp

N_WORLDS = 1024
_WORTH = "R = −log 4 − cost, costs of red 0.5…3.5, of blue 0.02…0.5"


def measure() -> Iterator[Figure]:
    yield batched()
    yield from fitted()
    yield large(growth.learned_costs, f"100×100, no horizon, against splu ({_WORTH})", target=2.0, goal=5.5)
    yield large(growth.hard_costs, "100×100, no horizon, against splu, hard: all costs 0.02, ρ = 0.98", target=2.0)
    yield bellman()
    yield from growth.measure()


def batched() -> Figure:
    """A gradient each of many 7×7 worlds."""
    world = draw_playable_world(5)
    reward = np.random.default_rng(1).normal(-1.0, 1.0, world.n_states)
    slow = partial(dense.gradient, dense_model(world), reward, horizon=HORIZON)
    mdps = [generate_world(seed).mdp for seed in range(N_WORLDS)]
    rewards = -np.log(4.0) - growth.learned_costs(np.random.default_rng(2), N_WORLDS * 49).reshape(N_WORLDS, 49)
    starts = np.stack([mdp.starts for mdp in mdps])
    pairs = interleaved(slow, lambda: infer_path_infinite_batch(mdps, rewards, starts=starts))
    return at_least(
        f"7×7, no horizon, {N_WORLDS} worlds, per world, against dense N = {HORIZON}",
        [N_WORLDS * theirs / ours for theirs, ours in pairs],
        target=500,
        goal=2400,
        unit="×",
        reference=f"bench/core/dense.py; ours {1e6 * statistics.median(o for _, o in pairs) / N_WORLDS:.2g} µs",
    )


def fitted() -> Iterator[Figure]:
    """Newton to ‖g‖∞ ≤ 1e-6 on three attempts a world."""
    mdps = [generate_world(seed).mdp for seed in range(N_WORLDS)]
    counts = three_attempts(mdps)
    fit = fit_maxent(mdps, counts)
    if not (fit.gap <= 1e-6).all():
        raise AssertionError("a fit did not converge")
    runs = [len(mdps) / cpu_seconds(lambda: fit_maxent(mdps, counts), repeats=1) for _ in range(7)]
    name = "7×7 to ‖gradient‖∞ ≤ 1e-6, l2 = 0.01, worlds a second and core"
    yield at_least(name, runs, target=5000, goal=24000, unit="/s", reference="CPU time of this process")
    name = "its Newton steps, the most of any world"
    said = f"mean {fit.iterations.mean():.2g}"
    yield at_most(name, [float(fit.iterations.max())], target=15, goal=8, unit="steps", reference=said)


def three_attempts(mdps: list[GridMdp]) -> np.ndarray:
    """Mean feature counts of three paths a world, drawn from the path measure of a learned reward."""
    rng = np.random.default_rng(3)
    costs = growth.learned_costs(rng, len(mdps) * 49).reshape(len(mdps), 49)
    laws = infer_batch(mdps, -np.log(4.0) - costs, inference="path_infinite").policy
    counts = np.zeros(costs.shape)
    for _ in range(3):
        here = np.zeros(len(mdps), dtype=np.int64)
        is_going = np.ones(len(mdps), dtype=np.bool_)
        counts[:, 0] += 1 / 3
        while is_going.any():
            law = laws[np.arange(len(mdps)), here].cumsum(axis=1)
            moves = np.minimum((law < rng.random((len(mdps), 1))).sum(axis=1), 3)
            here = np.where(is_going, mdps[0].next_states[here, moves], here)
            counts[np.flatnonzero(is_going), here[is_going]] += 1 / 3
            is_going &= here != 48
    return counts


def large(costs: growth.Costs, name: str, *, target: float, goal: float | None = None) -> Figure:
    """One gradient of a 100×100 grid against scipy's sparse LU of the same K, factorised once for both solves."""
    mdp, reward = growth.problem(100, costs)
    slow = partial(gradient_by_splu, mdp, reward)
    difference = np.abs(slow() - infer(mdp, reward, inference="path_infinite").visitation).max()
    if difference > 1e-9:
        raise AssertionError(f"splu gives other visits, by {difference:g}")
    pairs = interleaved(slow, lambda: infer(mdp, reward, inference="path_infinite"))
    return at_least(
        name,
        [theirs / ours for theirs, ours in pairs],
        target=target,
        goal=goal,
        unit="×",
        reference=f"scipy splu, {1e3 * statistics.median(t for t, _ in pairs):.3g} ms, its policy not included",
    )


def gradient_by_splu(mdp: GridMdp, reward: np.ndarray) -> np.ndarray:
    """Visits of a grid without walls whose only goal is the last square; K of `inference.path_infinite`."""
    squares = np.arange(mdp.n_states).reshape(mdp.rows, mdp.cols)
    here = np.concatenate([squares[:, :-1].ravel(), squares[:-1].ravel()])
    beside = np.concatenate([squares[:, 1:].ravel(), squares[1:].ravel()])
    half = sparse.coo_array((np.ones(len(here)), (here, beside)), shape=(mdp.n_states, mdp.n_states))
    adjacency = (half + half.T).tocsc()
    loops = 4.0 - adjacency.sum(axis=1)
    K = (sparse.diags_array(np.exp(-reward) - loops) - adjacency).tocsc()[:-1][:, :-1].tocsc()
    factors = splu(K)
    z = factors.solve(adjacency[:-1][:, [-1]].toarray().ravel() * np.exp(reward[-1]))
    x = factors.solve(np.where(mdp.starts[:-1] > 0.0, mdp.starts[:-1] / z, 0.0))
    goal = np.exp(reward[-1]) * (adjacency[[-1]][:, :-1] @ x)
    return np.append(np.exp(-reward[:-1]) * z * x, goal)


def bellman() -> Figure:
    """One backup z′ = e^R · (z of the four neighbours) of the finite horizon, against reading and writing as much."""
    side = 2002
    n, width, lane = side * side, np.uint64(side), np.uint64(1)
    z, stepped, weight, keep = np.ones(n), np.zeros(n), np.full(n, 0.2), np.zeros(n)

    def floor() -> None:
        np.multiply(z, weight, out=stepped)
        np.add(stepped, keep, out=stepped)

    pairs = interleaved(floor, lambda: stencil._step(z, stepped, weight, keep, width, lane))  # noqa: SLF001
    # the backup must move 4 numbers a square (three in, one out), the two array operations 6
    return at_least(
        "soft Bellman pass, 2000×2000, share of the bandwidth floor",
        [100.0 * (4 / 6) * theirs / ours for theirs, ours in pairs],
        target=30,
        goal=100,
        unit="%",
        reference="NumPy's multiply and add over as many numbers, per byte",
    )
