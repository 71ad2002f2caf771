"""Exact minimisers of a smooth convex f, one iteration at a time, so that a run can be stopped and resumed.

**Newton.** The Hessian of f is the covariance of feature counts under P(ζ). It is taken column by column from central
differences of the exact gradient, ∇f(w ± h e_k), relative error O(h²), which costs 2K inferences and holds for every
kind of inference and every feature map. Step p = −(H + εI)⁻¹ ∇f, no longer than 10 in any weight, halved until
f(w + p) ≤ f(w) + 10⁻⁴ p·∇f (Armijo). With one-hot features and no ridge the minimum is at infinity for squares that
nobody visits: there each step multiplies the remaining visits by 1/e, so the gap still falls fast.

**L-BFGS** (Nocedal & Wright, *Numerical Optimization*, 2nd ed., Algorithms 7.4, 7.5), the last ten pairs kept in the
state, with a bisection for the weak Wolfe conditions (Lewis & Overton, *Nonsmooth optimization via quasi-Newton
methods*, Math. Program. 2013, Algorithm 2.6): it needs one inference for each trial, and no matrix.

A value that is infinite or no number counts as too high: the line search stays where f is finite.
"""

import math
from collections.abc import Callable, Mapping
from typing import Final, Literal, TypeAlias

import numpy as np

from irl_core.arrays import Matrix, Vector
from irl_core.errors import InvalidSettings

Objective: TypeAlias = Callable[[Vector], tuple[float, Vector]]
"""The function f and its gradient, w of shape (K,) → (f(w), ∇f(w))."""

MAX_NEWTON_FEATURES: Final = 1000
_DIFFERENCE: Final = 1e-4
_DAMPING: Final = 1e-10
_LONGEST_STEP: Final = 10.0
_ARMIJO: Final = 1e-4
_WOLFE: Final = 0.9
_MAX_TRIALS: Final = 50
_N_PAIRS: Final = 10


def step(
    optimiser: Literal["newton", "lbfgs"], f: Objective, values: Mapping[str, Vector | float]
) -> dict[str, Vector | float]:
    """The values of a descent's state after one iteration; `w_success` moves, L-BFGS keeps its pairs beside it."""
    weights = np.asarray(values["w_success"])
    if optimiser == "newton":
        return {**values, "w_success": _newton(f, weights)}
    s, y = (np.asarray(values.get(name, ())).reshape(-1, len(weights)) for name in ("lbfgs_s", "lbfgs_y"))
    moved, s, y = _lbfgs(f, weights, s, y)
    return {**values, "w_success": moved, "lbfgs_s": s.reshape(-1), "lbfgs_y": y.reshape(-1)}


def _newton(f: Objective, weights: Vector) -> Vector:
    if len(weights) > MAX_NEWTON_FEATURES:
        raise InvalidSettings(
            f"Newton needs a matrix of K × K, and {len(weights)} features are more than {MAX_NEWTON_FEATURES}; use"
            ' optimiser "lbfgs".',
            field="optimiser",
        )
    value, gradient = f(weights)
    direction = np.asarray(-np.linalg.solve(_hessian(f, weights), gradient), dtype=np.float64).reshape(-1)
    direction *= min(1.0, _LONGEST_STEP / max(float(np.abs(direction).max()), 1e-300))
    return _backtracked(f, weights, direction, value=value, slope=float(direction @ gradient))


def _hessian(f: Objective, weights: Vector) -> Matrix:
    """Central differences of the gradient, made symmetric and a little positive, shape (K, K)."""
    n = len(weights)
    hessian: Matrix = np.empty((n, n))
    for k in range(n):
        there, back = weights.copy(), weights.copy()
        there[k] += _DIFFERENCE
        back[k] -= _DIFFERENCE
        hessian[k] = (_gradient(f, there) - _gradient(f, back)) / (2 * _DIFFERENCE)
    hessian = (hessian + hessian.T) / 2
    hessian[np.diag_indices(n)] += _DAMPING * (1.0 + float(np.abs(np.diag(hessian)).max()))
    return hessian


def _gradient(f: Objective, weights: Vector) -> Vector:
    return f(weights)[1]


def _backtracked(f: Objective, weights: Vector, direction: Vector, *, value: float, slope: float) -> Vector:
    """The first of w + p, w + p/2, … that lowers f enough; w itself where none does."""
    for trial in range(_MAX_TRIALS):
        share = 0.5**trial
        moved: Vector = weights + share * direction
        if f(moved)[0] <= value + _ARMIJO * share * slope:
            return moved
    return weights


def _lbfgs(f: Objective, weights: Vector, s: Matrix, y: Matrix) -> tuple[Vector, Matrix, Matrix]:
    """The weights after one iteration, and the pairs w′ − w, ∇f′ − ∇f kept, oldest first, shapes (≤ 10, K)."""
    value, gradient = f(weights)
    direction = -_inverse_hessian_times(gradient, s, y)
    if not float(direction @ gradient) < 0.0:
        direction = -gradient
    moved, moved_gradient = _weak_wolfe(f, weights, direction, value=value, slope=float(direction @ gradient))
    ds, dy = moved - weights, moved_gradient - gradient
    if float(ds @ dy) > 1e-12 * float(dy @ dy):
        s, y = (np.vstack([pairs, new])[-_N_PAIRS:] for pairs, new in ((s, ds), (y, dy)))
    return moved, s, y


def _inverse_hessian_times(vector: Vector, s: Matrix, y: Matrix) -> Vector:
    """The two-loop recursion; before the first pair a step of length at most 1."""
    if len(s) == 0:
        return vector / max(1.0, float(np.linalg.norm(vector)))
    rho = 1.0 / (s * y).sum(axis=1)
    q, alpha = vector.copy(), np.zeros(len(s))
    for i in range(len(s) - 1, -1, -1):
        alpha[i] = rho[i] * float(s[i] @ q)
        q -= alpha[i] * y[i]
    q *= float(s[-1] @ y[-1]) / float(y[-1] @ y[-1])
    for i in range(len(s)):
        q += (alpha[i] - rho[i] * float(y[i] @ q)) * s[i]
    return q


def _weak_wolfe(
    f: Objective, weights: Vector, direction: Vector, *, value: float, slope: float
) -> tuple[Vector, Vector]:
    """The moved weights and the gradient there; the last trial that lowered f where no step meets both conditions."""
    low, high, share = 0.0, math.inf, 1.0
    best, best_gradient = weights, f(weights)[1]
    for _ in range(_MAX_TRIALS):
        moved: Vector = weights + share * direction
        moved_value, moved_gradient = f(moved)
        if not moved_value <= value + _ARMIJO * share * slope:
            high = share
        else:
            best, best_gradient = moved, moved_gradient
            if float(direction @ moved_gradient) >= _WOLFE * slope:
                break
            low = share
        share = (low + high) / 2 if math.isfinite(high) else 2 * low
    return best, best_gradient
