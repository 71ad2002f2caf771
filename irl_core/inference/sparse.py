"""Path inference for any discrete model (SparseMdp).

Paths ζ = (s_0, a_0, s_1, …) from a start to a terminal state, P(ζ) ∝ Π_t T(s_{t+1} | s_t, a_t) · exp(Σ_t R(s_t)), as
Ziebart et al. (2008), Eq. 4. With W(s, s′) = Σ_a T(s′ | s, a) and Z_n(s) the weight of all that arrive in n steps:

    Z_n(t) = e^{R(t)} at terminal t,   Z_0(s) = 0,   Z_n(s) = e^{R(s)} Σ_{s′} W(s, s′) Z_{n−1}(s′),
    P_n(a | s) = Σ_{s′} T(s′ | s, a) Z_{n−1}(s′) / Σ_{s′} W(s, s′) Z_{n−1}(s′),
    q_n(s′ | s) = W(s, s′) Z_{n−1}(s′) / Σ …,   the law by which states follow each other under P(ζ).

The log partition is Σ_s ρ_0(s) log Z_N(s): each path's likelihood is given its start. Its gradient in R is μ^π, the
visits that q spreads from ρ_0, start and end included. In a grid slip cancels from W; here nothing need cancel, so a
path may owe its weight to luck: P(ζ) prefers actions whose *best* outcomes pay (which causal inference does not).

**Paths of any length** (`path_infinite`): (I − M) Z = e^R W e^{R(t)}, M = e^R W between the states on the way from the
starts. Σ_k M^k is finite iff ρ(M) < 1, and that is so iff (I − M) x = 1 has a solution x > 0 (Berman and Plemmons 1994,
*Nonnegative Matrices*, Ch. 6, Theorem 2.3, I₂₇: I − M is a non-singular M-matrix), which one sparse LU decides along
with Z. To keep numbers near 1 we solve for y = Z e^{−u}, with M scaled likewise, u(s) the log weight of the best path:
u(s) = R(s) + max_{s′} (log W(s, s′) + u(s′)). Where that maximum grows beyond S steps, or a single state or pair of
states gains by going round, the sum is infinite as well.

Where no terminal state can be reached, at terminal states, and (any length) off the way from the starts, the policy is
uniform. Weights are kept as mantissa · 2^exponent (`_kernels/sparse.py`); where they are many, every √N-th of Z_n
is stored and the others are computed again when the visits come to them.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from irl_core import _kernels
from irl_core.array_checks import check_size
from irl_core.arrays import BoolVector, IntMatrix, IntVector, Matrix, Policy, Vector
from irl_core.errors import DivergentPartition, InvalidModel
from irl_core.inference.base import Inferred
from irl_core.mdp.sparse import SparseMdp

_FEW: Final = 1 << 19
"""Weights that are held without thinking of memory, 16 bytes each: 8 MB."""
_LN2: Final = math.log(2.0)
_LN2_HIGH: Final = float.fromhex("0x1.62e42feep-1")
_LN2_LOW: Final = 1.90821492927058770002e-10
"""Together ln 2, the high part short enough that k times it is exact (Cody and Waite 1980)."""


@dataclass(frozen=True, eq=False)
class _Weights:
    """Z = mantissa · 2^exponent, row by row of steps to go, each (n + 1, S)."""

    mantissa: Matrix
    exponent: IntMatrix

    def log(self, row: int) -> Vector:
        """Log Z with that many steps to go, counted from this block's first row; −∞ where there is no way."""
        mantissa = self.mantissa[row]
        log_mantissa: Vector = np.log(mantissa, out=np.full(mantissa.shape, -np.inf), where=mantissa > 0.0)
        log_z: Vector = log_mantissa + self.exponent[row] * _LN2
        return log_z


def infer_path_sparse(mdp: SparseMdp, reward: Vector, *, horizon: int, starts: Vector) -> Inferred:
    """Log partition, P_N(a | s) and visits of paths of at most `horizon` steps.

    `reward` and `starts` have shape (S,). Raises InvalidModel where a start has no path, InvalidReward beyond ±10¹².
    """
    _check_ends(mdp)
    factor = _as_powers_of_two(reward)
    every = _block(mdp, horizon)
    first_rows = _first_rows(mdp, factor, horizon=horizon, every=every)
    here, visits = starts.copy(), starts.copy()
    policy: Policy = np.empty((0, 0))
    log_partition = 0.0
    for block in range(len(first_rows) - 1, -1, -1):
        n_steps = min(every, horizon - block * every)
        weights = _rows(mdp, factor, first_rows[block], n_steps=n_steps)
        if block == len(first_rows) - 1:
            log_partition = mean_log(weights.log(-1), starts, within=f" within {horizon} steps")
            policy = action_policy(mdp, weights.log(-2))
        _kernels.sparse.forward(*_flow(mdp), weights.mantissa, weights.exponent, here, visits)
    return Inferred("path", log_partition, policy, visits)


def infer_path_infinite_sparse(mdp: SparseMdp, reward: Vector, *, starts: Vector) -> Inferred:
    """The same of paths of any length. Raises DivergentPartition where their sum is infinite, else as above."""
    _check_ends(mdp)
    inside = _on_the_way(mdp, starts)
    here = np.flatnonzero(inside)
    u = _best_paths(mdp, reward, inside)
    mean_log(u, starts, within="")
    law = _scaled_flow(mdp, reward, u, inside)[here]
    among, out = law[:, here], law[:, np.flatnonzero(mdp.terminal)]
    solve = _solver(among)
    y = solve(out @ np.ones(out.shape[1]), "N")
    shares = solve(starts[here] / y, "T")
    visits: Vector = np.zeros(mdp.n_states)
    visits[here] = y * shares
    visits[mdp.terminal] = out.T @ shares
    log_z = np.where(mdp.terminal, reward, -np.inf)
    log_z[here] = u[here] + np.log(y)
    policy = action_policy(mdp, log_z, where=inside)
    return Inferred("path_infinite", mean_log(log_z, starts, within=""), policy, visits)


def action_policy(mdp: SparseMdp, log_z: Vector, *, where: BoolVector | None = None) -> Policy:
    """P(a | s) ∝ Σ_{s′} T(s′ | s, a) Z(s′), shape (S, A); uniform where that is 0 or `where` is false."""
    ahead = np.where(mdp.probabilities > 0.0, log_z[mdp.indices], -np.inf)
    state = mdp.rows // mdp.n_actions
    top = _largest_ahead(ahead, mdp.indptr[:: mdp.n_actions])
    top[np.isneginf(top)] = 0.0
    sums = np.bincount(mdp.rows, mdp.probabilities * np.exp(ahead - top[state]), mdp.n_states * mdp.n_actions)
    policy: Policy = sums.reshape(mdp.n_states, mdp.n_actions).astype(np.float64, copy=False)
    total = policy.sum(axis=1, keepdims=True)
    known = total > 0.0 if where is None else (total > 0.0) & where[:, None]
    return np.where(known, policy / np.where(total > 0.0, total, 1.0), 1.0 / mdp.n_actions)


def log_weights(mdp: SparseMdp, reward: Vector, *, horizon: int) -> tuple[Vector, Vector]:
    """Log Z_N and log Z_{N−1}, each of shape (S,)."""
    _check_ends(mdp)
    factor = _as_powers_of_two(reward)
    every = _block(mdp, horizon)
    first_rows = _first_rows(mdp, factor, horizon=horizon, every=every)
    last = _rows(mdp, factor, first_rows[-1], n_steps=horizon - (len(first_rows) - 1) * every)
    return last.log(-1), last.log(-2)


def mean_log(log_z: Vector, starts: Vector, *, within: str) -> float:
    """Σ_s ρ_0(s) log Z(s). Raises InvalidModel where a start has no path, `within` so many steps."""
    begun = np.flatnonzero(starts)
    lost = begun[~np.isfinite(log_z[begun])]
    if len(lost):
        raise InvalidModel(f"From state {lost[0]} no terminal state can be reached{within}.", field="starts")
    return float((starts[begun] * log_z[begun]).sum())


def _check_ends(mdp: SparseMdp) -> None:
    if not mdp.terminal.any():
        raise InvalidModel(
            "Paths must arrive somewhere, and this model has no terminal state: mark one, or use causal inference.",
            field="terminal",
        )


def _as_powers_of_two(reward: Vector) -> tuple[Vector, IntVector]:
    """e^R as mantissa · 2^exponent, accurate to rounding for any size of R."""
    check_size("reward", reward)
    halvings = np.rint(reward / _LN2)
    rest = (reward - halvings * _LN2_HIGH) - halvings * _LN2_LOW
    return np.exp(rest), halvings.astype(np.int64)


def _block(mdp: SparseMdp, horizon: int) -> int:
    """Steps whose Z are held at once: all of them while they are few numbers, else √N."""
    return horizon if horizon * mdp.n_states <= _FEW else math.isqrt(horizon - 1) + 1


def _first_rows(
    mdp: SparseMdp, factor: tuple[Vector, IntVector], *, horizon: int, every: int
) -> list[tuple[Vector, IntVector]]:
    """Z_n for n = 0, every, 2·every, … below the horizon."""
    mantissa, exponent = factor
    rows = [(np.where(mdp.terminal, mantissa, 0.0), np.where(mdp.terminal, exponent, 0))]
    for _ in range(every, horizon, every):
        block = _rows(mdp, factor, rows[-1], n_steps=every)
        rows.append((block.mantissa[-1].copy(), block.exponent[-1].copy()))
    return rows


def _rows(
    mdp: SparseMdp, factor: tuple[Vector, IntVector], first: tuple[Vector, IntVector], *, n_steps: int
) -> _Weights:
    mantissa: Matrix = np.empty((n_steps + 1, mdp.n_states))
    exponent: IntMatrix = np.empty((n_steps + 1, mdp.n_states), dtype=np.int64)
    mantissa[0], exponent[0] = first
    _kernels.sparse.backward(*_flow(mdp), *factor, mantissa, exponent)
    return _Weights(mantissa, exponent)


def _flow(mdp: SparseMdp) -> tuple[IntVector, IntVector, Vector]:
    """W as the kernels take it."""
    flow = mdp.flow
    return flow.indptr.astype(np.int64), flow.indices.astype(np.int64), flow.data


def _on_the_way(mdp: SparseMdp, starts: Vector) -> BoolVector:
    """What is reached from these starts, and arrives, before an end, shape (S,)."""
    reached = mdp.steps_from(np.flatnonzero(starts)) >= 0
    inside: BoolVector = reached & ~mdp.terminal & (mdp.steps_to_end >= 0)
    return inside


def _best_paths(mdp: SparseMdp, reward: Vector, inside: BoolVector) -> Vector:
    """u, the log weight of the best path from each state on the way, shape (S,); elsewhere −∞, R at the ends."""
    flow = mdp.flow
    log_w: Vector = np.log(flow.data)
    _refuse_short_rounds(mdp, reward, inside)
    u = np.where(mdp.terminal, reward, -np.inf)
    for _ in range(mdp.n_states + 1):
        better: Vector = np.where(inside, reward + _largest_ahead(log_w + u[flow.indices], flow.indptr), u)
        if np.array_equal(better, u):
            return u
        u = better
    raise _divergence()


def _refuse_short_rounds(mdp: SparseMdp, reward: Vector, inside: BoolVector) -> None:
    """The commonest ways for the sum to be infinite, found at once: a state, or two, that gain by going round."""
    flow = mdp.flow
    gains = np.where(inside, np.exp(np.clip(reward, -700.0, 350.0)), 0.0)
    alone = gains * flow.diagonal()
    both = flow.multiply(flow.T).tocoo()
    pairs = gains[both.row] * gains[both.col] * both.data
    if (alone >= 1.0).any() or (pairs[both.row != both.col] >= 1.0).any():
        raise _divergence()


def _scaled_flow(mdp: SparseMdp, reward: Vector, u: Vector, inside: BoolVector) -> Any:  # noqa: ANN401 - csr_array
    """e^{R(s) + u(s′) − u(s)} W(s, s′) from the states on the way, shape (S, S)."""
    from scipy.sparse import csr_array  # noqa: PLC0415 - importing irl_core must not import scipy

    flow = mdp.flow
    rows = np.repeat(np.arange(mdp.n_states), np.diff(flow.indptr))
    leads_on = inside[rows] & np.isfinite(u[flow.indices])
    change = np.full(len(rows), -np.inf)
    change[leads_on] = reward[rows[leads_on]] + u[flow.indices[leads_on]] - u[rows[leads_on]]
    return csr_array((flow.data * np.exp(change), flow.indices, flow.indptr), shape=flow.shape)


def _solver(among: Any) -> Callable[[Vector, str], Vector]:  # noqa: ANN401 - csr_array
    """Solutions of (I − M) y = b ("N") and (I − M)ᵀ y = b ("T"). Raises DivergentPartition unless ρ(M) < 1."""
    from scipy.sparse import csc_array, eye_array  # noqa: PLC0415 - importing irl_core must not import scipy
    from scipy.sparse.linalg import splu  # noqa: PLC0415 - as above

    n = among.shape[0]
    try:
        factors = splu(csc_array(eye_array(n) - among))
    except RuntimeError:  # exactly singular: ρ(M) = 1
        raise _divergence() from None
    x = factors.solve(np.ones(n))
    if not (np.isfinite(x).all() and (x > 0.0).all() and (x - among @ x > 0.5).all()):
        raise _divergence()

    def solve(right: Vector, which: str) -> Vector:
        solution: Vector = factors.solve(right, which)  # type: ignore[call-overload]  # the stub knows no second one
        return solution

    return solve


def _largest_ahead(values: Vector, indptr: np.ndarray[tuple[int], np.dtype[np.signedinteger]]) -> Vector:
    """The largest of each row's values, −∞ for an empty row."""
    filled = np.diff(indptr) > 0
    top: Vector = np.full(len(filled), -np.inf)
    if filled.any():
        top[filled] = np.maximum.reduceat(values, indptr[:-1][filled])
    return top


def _divergence() -> DivergentPartition:
    return DivergentPartition(
        "The sum over paths of any length is infinite for this reward: going round costs too little. Lower the reward,"
        " or use paths of at most N steps."
    )
