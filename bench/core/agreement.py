"""How far the gradient is from the enumeration of all paths, from finite differences, and from a second solver."""

from collections.abc import Iterator

import numpy as np

from bench.measure import Figure, at_most
from irl_core.inference.path import infer_path
from irl_core.inference.path_log import infer_path_in_logs
from irl_core.mdp import GridMdp
from tests import naive

SMALL = (
    (GridMdp(2, 2, (3,)), 6),
    (GridMdp(2, 3, (5,), walls=(1,)), 6),
    (GridMdp(3, 3, (8,)), 6),
    (GridMdp(3, 3, (8,), slip=0.3), 4),
    (GridMdp(3, 3, (2, 8), walls=(4,)), 6),
    (GridMdp(3, 3, (2, 8), slip=0.3, start=np.array([0.25, 0, 0, 0.75, 0, 0, 0, 0, 0])), 4),
)
N_RANDOM = 40
STEP = 1e-4


def measure() -> Iterator[Figure]:
    found = [from_enumeration(mdp, horizon, seed) for seed, (mdp, horizon) in enumerate(SMALL)]
    yield at_most(
        "log partition and visits, off path enumeration",
        [max(found)],
        target=1e-12,
        unit="",
        reference=f"tests/naive.py, the largest of {len(SMALL)} worlds ≤ 3×3: slip, walls, two goals, two starts",
    )
    found = [from_differences(mdp, seed) for seed, (mdp, _) in enumerate(SMALL)]
    yield at_most(
        "visits, off finite differences of the log partition",
        [max(found)],
        target=1e-8,
        unit="",
        reference=f"five points, the largest of the same {len(SMALL)} worlds",
    )
    found = [from_logs(seed) for seed in range(N_RANDOM)]
    yield at_most(
        "log partition, policy, visits: two independent solvers",
        [max(found)],
        target=1e-9,
        unit="",
        reference=f"plain numbers against logs, the largest of {N_RANDOM} worlds of up to 12×12",
    )


def from_enumeration(mdp: GridMdp, horizon: int, seed: int) -> float:
    """The largest difference in log partition and visits from all paths added up, start by start."""
    reward = np.random.default_rng(seed).normal(0.0, 1.5, mdp.n_states)
    ours = infer_path(mdp, reward, horizon=horizon, starts=mdp.starts)
    log_partition, visits = 0.0, np.zeros(mdp.n_states)
    for start in mdp.start_states.tolist():
        paths = naive.enumerate_paths(  # type: ignore[no-untyped-call]
            mdp, reward, start=start, horizon=horizon
        )
        log_partition += mdp.starts[start] * paths.log_partition
        visits += mdp.starts[start] * paths.visits
    return max(abs(ours.log_partition - log_partition), float(np.abs(ours.visitation - visits).max()))


def from_differences(mdp: GridMdp, seed: int) -> float:
    """The largest difference of the visits from the slope of the log partition, by five points."""
    reward = np.random.default_rng(seed).normal(-1.0, 1.5, mdp.n_states)

    def log_z(state: int, by: float) -> float:
        moved = reward + by * (np.arange(mdp.n_states) == state)
        return infer_path(mdp, moved, horizon=mdp.horizon, starts=mdp.starts).log_partition

    near = [log_z(s, STEP) - log_z(s, -STEP) for s in range(mdp.n_states)]
    far = [log_z(s, 2 * STEP) - log_z(s, -2 * STEP) for s in range(mdp.n_states)]
    slopes = (8 * np.array(near) - np.array(far)) / (12 * STEP)
    visits = infer_path(mdp, reward, horizon=mdp.horizon, starts=mdp.starts).visitation
    return float(np.abs(slopes - visits).max())


def from_logs(seed: int) -> float:
    """The largest relative difference between the two solvers, on a random world."""
    rng = np.random.default_rng(seed)
    rows, cols = rng.integers(3, 13, 2).tolist()
    mdp = GridMdp(rows, cols, (rows * cols - 1, cols - 1), walls=(cols + 1,), slip=0.1)
    reward = rng.normal(-1.0, 1.0, mdp.n_states)
    ours = infer_path(mdp, reward, horizon=mdp.horizon, starts=mdp.starts)
    logs = infer_path_in_logs(mdp, reward, horizon=mdp.horizon, starts=mdp.starts)
    return max(
        abs(ours.log_partition - float(logs.log_z[0])) / max(1.0, abs(ours.log_partition)),
        float(np.abs(ours.policy - logs.policy).max()),
        float((np.abs(ours.visitation - logs.visitation) / np.maximum(1.0, logs.visitation)).max()),
    )
