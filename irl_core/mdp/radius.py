"""The spectral radius of a discrete model's path sums: paths of any length have a finite sum iff ρ(M) < 1.

M(s, s′) = e^{R(s)} W(s, s′), W = Σ_a T, between states that can be reached before an end. ρ(M) is the largest among its
strongly connected components, since moves between components lead one way. Within one, for any v > 0,

    min_s (Mv)(s) / v(s)  ≤  ρ  ≤  max_s (Mv)(s) / v(s)      (Collatz–Wielandt),

and v ← v + Mv / ρ̂, ρ̂ the middle of the two, brings them together; adding v itself is what lets it converge where moves
alternate. In logarithms, so that no reward is too large. It ends when the bounds of the largest are within 10⁻⁶ of each
other, or after 2,000 rounds with their middle.
"""

from typing import Final

import numpy as np

from irl_core.arrays import IntVector, Vector
from irl_core.mdp.sparse import SparseMdp

_MAX_ROUNDS: Final = 2000
_CLOSE: Final = 1e-6
_LARGEST_EXPONENT: Final = 700.0


def spectral_radius_of(mdp: SparseMdp, reward: Vector) -> float:
    """ρ(M) for a reward of shape (S,): 0 where no state comes back, e^700 where it is more."""
    rows, ahead, component, log_m = _within_components(mdp, reward)
    if len(rows) == 0:
        return 0.0
    states, first = np.unique(rows, return_index=True)
    ahead = np.searchsorted(states, ahead)
    part = np.unique(component[states], return_inverse=True)[1]
    log_v: Vector = np.zeros(len(states))
    for _ in range(_MAX_ROUNDS):
        log_mv = np.logaddexp.reduceat(log_m + log_v[ahead], first)
        low, high = _bounds(log_mv - log_v, part)
        largest = int(high.argmax())
        if high[largest] - low[largest] < _CLOSE:
            break
        log_v = np.logaddexp(log_mv - (low[part] + high[part]) / 2, log_v)
        log_v -= _bounds(log_v, part)[1][part]
    return float(np.exp(min((low[largest] + high[largest]) / 2, _LARGEST_EXPONENT)))


def _within_components(mdp: SparseMdp, reward: Vector) -> tuple[IntVector, IntVector, IntVector, Vector]:
    """The moves that stay within a component: from, to, log M; and each state's component, (S,)."""
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415 - importing irl_core must not import scipy

    flow = mdp.flow
    component = connected_components(flow, connection="strong")[1].astype(np.int64)
    inside = mdp.reachable & ~mdp.terminal
    rows = np.repeat(np.arange(mdp.n_states), np.diff(flow.indptr))
    kept = inside[rows] & inside[flow.indices] & (component[rows] == component[flow.indices])
    log_m: Vector = reward[rows[kept]] + np.log(flow.data[kept])
    return rows[kept], flow.indices[kept].astype(np.int64), component, log_m


def _bounds(values: Vector, part: IntVector) -> tuple[Vector, Vector]:
    """The least and the largest value of each part."""
    n_parts = int(part.max()) + 1
    low, high = np.full(n_parts, np.inf), np.full(n_parts, -np.inf)
    np.minimum.at(low, part, values)
    np.maximum.at(high, part, values)
    return low, high
