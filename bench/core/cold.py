"""What a first gradient costs: a new process imports irl_core and infers once, with the compiled cache in place."""

import resource
import statistics
import subprocess
import sys
from collections.abc import Iterator

from bench.measure import Figure, at_most

N_RUNS = 5
FIRST_GRADIENT = """
from irl_core import generate_world
from irl_core.inference import infer
world = generate_world(5)
infer(world, world.reward)
"""


def measure() -> Iterator[Figure]:
    cpu_seconds_of(FIRST_GRADIENT)  # fills the cache where it is empty
    pairs = [(cpu_seconds_of("import numpy"), cpu_seconds_of(FIRST_GRADIENT)) for _ in range(N_RUNS)]
    numpy = statistics.median(bare for bare, _ in pairs)
    reference = f"import numpy alone: {1e3 * numpy:.0f} ms"
    name = "import irl_core and the first 7×7 gradient, cold process"
    runs = [ours for _, ours in pairs]
    yield at_most(name, runs, target=1, goal=round(1.3 * numpy, 2), unit="s CPU", reference=reference)


def cpu_seconds_of(program: str) -> float:
    """User and system time of a Python process that runs the program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-c", program], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
