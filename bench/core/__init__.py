"""The learning core: exact gradients, fast and at scale, against references that the benchmark brings itself."""

from collections.abc import Iterator

from bench.core import agreement, cold, finite, infinite, model_free
from bench.measure import Figure


def measure() -> Iterator[Figure]:
    for part in (finite, infinite, agreement, cold, model_free):
        yield from part.measure()
