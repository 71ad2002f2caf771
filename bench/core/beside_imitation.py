"""What `imitation` takes for the gradient, against the dense reference beside it; run in an environment that has it.

    python bench/core/beside_imitation.py < world.json        # prints ratios of CPU time, imitation / dense

`imitation` 1.0.1 needs old releases of much else, so the benchmark runs this file with the Python that the variable
IRLFR_BENCH_IMITATION_PYTHON names. It computes another gradient, of maximum causal entropy, but the work is the same:
a log partition, the policy of each of N steps, and the visits, by `mce_partition_fh` and `mce_occupancy_measures`. Most
of its time is that of SciPy's `logsumexp`, several times as long in 1.17 as in 1.13; so the release is told.
"""

import json
import os
import sys
import time
from collections.abc import Callable

for _library in ("OMP", "OPENBLAS", "MKL"):
    os.environ[f"{_library}_NUM_THREADS"] = "1"  # before NumPy is imported: one thread on both sides

import dense  # type: ignore[import-not-found]  # noqa: E402 - the file beside this one
import numpy as np  # noqa: E402
import scipy  # noqa: E402
from imitation.algorithms.mce_irl import (  # type: ignore[import-not-found]  # noqa: E402
    mce_occupancy_measures,
    mce_partition_fh,
)
from seals.base_envs import TabularModelMDP  # type: ignore[import-not-found]  # noqa: E402

N_PAIRS = 7
SECONDS_PER_SIDE = 0.3


def main() -> None:
    world = json.load(sys.stdin)
    reward, horizon = np.array(world["reward"]), world["horizon"]
    model = dense.model_of(np.array(world["next_states"]), goals=world["goals"], slip=0.0, start=world["start"])
    env = TabularModelMDP(
        transition_matrix=model.tensor, reward_matrix=reward, horizon=horizon, initial_state_dist=model.starts
    )

    def theirs() -> None:
        _, _, policies = mce_partition_fh(env, reward=reward, discount=1.0)
        mce_occupancy_measures(env, reward=reward, pi=policies, discount=1.0)

    def reference() -> None:
        dense.gradient(model, reward, horizon=horizon)

    ratios = [cpu_seconds(theirs) / cpu_seconds(reference) for _ in range(N_PAIRS)]
    print(json.dumps({"scipy": scipy.__version__, "ratios": ratios}))


def cpu_seconds(work: Callable[[], None]) -> float:
    work()
    started, n_calls = time.process_time(), 0
    while time.process_time() - started < SECONDS_PER_SIDE:
        work()
        n_calls += 1
    return (time.process_time() - started) / n_calls


if __name__ == "__main__":
    main()
