"""How the gradient without a horizon grows with the grid, up to a million squares: time, memory, and a plot of both.

Each size runs in a process of its own, which reports CPU seconds and the peak of its memory above what it had before
the grid was made. `python -m bench.core.growth` measures and writes docs/growth.json and docs/growth.svg.
"""

import json
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from bench.measure import Figure, at_most
from irl_core.inference import infer
from irl_core.mdp.grid import GridMdp

Costs: TypeAlias = Callable[[np.random.Generator, int], np.ndarray]
SIDES = (32, 56, 100, 178, 316, 562, 1000)
DOCS = Path(__file__).parents[2] / "docs"


def learned_costs(rng: np.random.Generator, n: int) -> np.ndarray:
    """As a learner finds them: 30 % of the squares red at 0.5 to 3.5, the others blue at 0.02 to 0.5."""
    return np.where(rng.random(n) < 0.3, rng.uniform(0.5, 3.5, n), rng.uniform(0.02, 0.5, n))


def hard_costs(_rng: np.random.Generator, n: int) -> np.ndarray:
    """Hardly any, everywhere alike: ρ = e^−0.02."""
    return np.full(n, 0.02)


def problem(side: int, costs: Costs) -> tuple[GridMdp, np.ndarray]:
    """A square grid, start top left, goal bottom right, R = −log 4 − cost, the goal's 0."""
    n = side * side
    mdp = GridMdp(side, side, (n - 1,))
    reward = -np.log(4.0) - costs(np.random.default_rng(side), n)
    reward[-1] = 0.0
    return mdp, reward


def measure() -> Iterator[Figure]:
    runs = [in_own_process(side) for side in SIDES]
    write(runs)
    last = runs[-1]
    name = "1000×1000, no horizon, one gradient (R = −log 4 − cost, red and blue)"
    yield at_most(name, [last["seconds"]], target=10, goal=3.2, unit="s", reference="CPU time, own process")
    name = "growth exponent of the gradient in states, 32² to 1000²"
    yield at_most(name, [exponent(runs)], target=1.4, goal=1.29, unit="", reference="docs/growth.svg")
    name = "memory per state at 10⁶, grid and results included"
    yield at_most(name, [last["bytes_per_state"]], target=400, goal=176, unit="B", reference="peak RSS, own process")


def exponent(runs: list[dict[str, Any]]) -> float:
    """The slope in logs from the first size to the last."""
    first, last = runs[0], runs[-1]
    return float(np.log(last["seconds"] / first["seconds"]) / np.log(last["states"] / first["states"]))


def in_own_process(side: int) -> dict[str, Any]:
    """What `report` prints in a fresh process."""
    command = [sys.executable, "-m", "bench.core.growth", str(side)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=DOCS.parent)
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def report(side: int) -> dict[str, Any]:
    """Time and memory of one gradient; small grids are timed several times over."""
    infer(*problem(40, learned_costs), inference="path_infinite")  # compiles or loads, by lines …
    infer(*problem(8, learned_costs), inference="path_infinite")  # … and by LU
    before = memory("VmRSS")
    mdp, reward = problem(side, learned_costs)
    n_times = max(1, 200_000 // mdp.n_states)
    started = time.process_time()
    for _ in range(n_times):
        infer(mdp, reward, inference="path_infinite")
    seconds = (time.process_time() - started) / n_times
    return {"states": mdp.n_states, "seconds": seconds, "bytes_per_state": (memory("VmHWM") - before) / mdp.n_states}


def memory(field: str) -> int:
    """Bytes that Linux has on record for this process: VmRSS resident now, VmHWM at most so far."""
    lines = Path("/proc/self/status").read_text(encoding="utf-8").splitlines()
    return 1024 * next(int(line.split()[1]) for line in lines if line.startswith(f"{field}:"))


def write(runs: list[dict[str, Any]]) -> None:
    """docs/growth.json and docs/growth.svg."""
    import matplotlib as mpl  # noqa: PLC0415 - only who draws loads it

    mpl.use("svg")
    from matplotlib import pyplot as plt  # noqa: PLC0415

    (DOCS / "growth.json").write_text(json.dumps({"exponent": exponent(runs), "runs": runs}, indent=1) + "\n")
    states, seconds = [run["states"] for run in runs], [run["seconds"] for run in runs]
    with plt.rc_context({"svg.hashsalt": "irlfr", "font.size": 12, "svg.fonttype": "none"}):
        figure, axes = plt.subplots(figsize=(7.2, 4.6), facecolor="white", layout="constrained")
        axes.loglog(states, seconds, "o-", color="#1b5e9b", label=f"measured, exponent {exponent(runs):.2f}")
        linear = [seconds[0] * n / states[0] for n in states]
        axes.loglog(states, linear, "--", color="#6b6b6b", label="in proportion to the states")
        axes.set(xlabel="states (squares of the grid)", ylabel="CPU seconds for one gradient")
        axes.set_title("Exact gradient without a horizon, one core")
        axes.grid(which="major", color="#dddddd")
        axes.legend(frameon=False)
        figure.savefig(DOCS / "growth.svg", metadata={"Date": None})
        plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(json.dumps(report(int(sys.argv[1]))))
    else:
        for line in measure():
            print(line)
