"""Maximum-entropy fits, many worlds at a time: the reward whose paths visit each square as often as was observed.

**Problem.** For each world, with one weight a square (one-hot features), find

    w = argmin f(w),   f(w) = Σ_s ρ_0(s) log z(s; w) − w·μ̃ + l2/2 |w|²,

z of `inference.path_infinite` with R = w, μ̃ the observed feature counts (the start and the goal included, so Σ over
goals is 1 for demonstrations that arrive). f is convex, and infinite where the sum over paths is: its own barrier. Its
gradient is g = μ − μ̃ + l2 w. The penalty is needed: without it squares that nobody visits would go to −∞.

**Newton in potentials.** P(s, s′) is the path measure's law at w, 0 at goals. To first order a change δw changes log z
by η with η = δw + P η, so δw = (1 − P) η, and in terms of η the second-order part of f is

    ½ Σ_s μ(s) Var_{s′ ~ P(s, ·)} η(s′) + l2/2 |(1 − P) η|²:

the Fisher information of a path is what its steps tell. The Newton system A η = −(1 − Pᵀ) g has the matrix
A = Σ_s μ(s) [diag(p_s) − p_s p_sᵀ] + l2 (1 − Pᵀ)(1 − P), p_s row s of P: it couples squares at most two steps apart, is
positive definite, and holds for any distribution of starts (ρ_0 does not change with w). One banded LDLᵀ of width
2 · cols gives the step; it is shortened until f falls enough (Armijo) and K stays positive definite.

**It stops** when ‖g‖∞ ≤ tolerance, or after `max_iterations` steps. It starts at w = −log 4 − 0.3, where the sum over
paths is always finite.

Where no start leads to, w = μ̃ / l2 (0, unless counts were given there). Source: Ziebart et al. (2008) for the
objective; Boyd and Vandenberghe (2004), ch. 9.5 and 9.6 for the method.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from irl_core import _kernels
from irl_core.array_checks import float_array
from irl_core.arrays import IntVector, Matrix, Vector, read_only
from irl_core.checks import Refused, real_number, shown, whole_number
from irl_core.errors import InvalidModel, InvalidReward, InvalidSettings
from irl_core.inference.path_infinite import path_kinds
from irl_core.mdp.grid import GridMdp
from irl_core.world_checks import is_list

_FIRST_WEIGHT = -np.log(4.0) - 0.3


@dataclass(frozen=True, eq=False)
class MaxentFit:
    """What B worlds were fitted to. `gap` is ‖g‖∞ at the end: above the tolerance the fit has not converged.

    `rewards` (B, S); `iterations`, `gap` and `log_likelihood` (B,). The log-likelihood is that of one path, on average
    over the counts: w·μ̃ − Σ ρ_0 log z, without the penalty.
    """

    rewards: Matrix
    iterations: IntVector
    gap: Vector
    log_likelihood: Vector

    def __post_init__(self) -> None:
        for array in (self.rewards, self.iterations, self.gap, self.log_likelihood):
            read_only(array)


def fit_maxent(
    mdps: Sequence[GridMdp], counts: Matrix, *, l2: float = 0.01, tolerance: float = 1e-6, max_iterations: int = 50
) -> MaxentFit:
    """Fit B grids of one shape to feature counts, shape (B, S), each ≥ 0 and per path (1 in all at the goals).

    `l2` > 0 is the penalty, `tolerance` > 0 what ‖g‖∞ may be at the end, `max_iterations` ≥ 1 the Newton steps allowed.
    Raises InvalidSettings, InvalidModel (grids of several shapes, a start that sees no goal), InvalidReward (counts).
    """
    penalty = _positive("l2", l2)
    accepted = _positive("tolerance", tolerance)
    n_steps = _n_steps(max_iterations)
    checked = _check_counts(mdps, counts)
    shape = (len(mdps), mdps[0].rows, mdps[0].cols)
    starts = np.stack([mdp.starts for mdp in mdps])
    weights, iterations = np.zeros(checked.shape), np.zeros(len(mdps), dtype=np.int64)
    gap, value = np.full(len(mdps), np.inf), np.full(len(mdps), np.inf)
    _kernels.newton.fit_worlds(
        path_kinds(mdps, starts),
        checked.reshape(shape),
        starts.reshape(shape),
        _FIRST_WEIGHT,
        penalty,
        accepted,
        n_steps,
        weights,
        iterations,
        gap,
        value,
    )
    lost = np.flatnonzero(~np.isfinite(value))
    if len(lost):
        raise InvalidModel(f"In world {lost[0]} a start is walled off from every goal.", field="mdps")
    return MaxentFit(weights, iterations, gap, 0.5 * penalty * (weights**2).sum(axis=1) - value)


def _check_counts(mdps: Sequence[GridMdp], counts: Matrix) -> Matrix:
    if not is_list(mdps) or len(mdps) == 0 or not all(isinstance(mdp, GridMdp) for mdp in mdps):
        raise InvalidModel("mdps must be a list of at least one GridMdp (of a World: world.mdp).", field="mdps")
    shapes = {(mdp.rows, mdp.cols) for mdp in mdps}
    if len(shapes) > 1:
        raise InvalidModel(f"The grids of a fit have one size; here are {sorted(shapes)}.", field="mdps")
    try:
        checked: Matrix = float_array(counts).copy()
    except Refused as refused:
        raise InvalidReward(f"counts must be numbers, shape (worlds, states); {refused}.", field="counts") from None
    wanted = (len(mdps), mdps[0].n_states)
    if checked.shape != wanted:
        raise InvalidReward(f"counts must have the shape {wanted}, not {checked.shape}.", field="counts")
    if not np.isfinite(checked).all() or (checked < 0.0).any():
        raise InvalidReward("counts must be finite and at least 0.", field="counts")
    return checked


def _positive(name: str, value: object) -> float:
    try:
        return real_number(value, minimum=0.0, above=True)
    except Refused as refused:
        raise InvalidSettings(f"{name} {refused}.", field=name) from None


def _n_steps(value: object) -> int:
    try:
        return whole_number(value, minimum=1, maximum=100_000)
    except Refused:
        raise InvalidSettings(
            f"max_iterations must be a whole number from 1 to 100000, not {shown(value)}.", field="max_iterations"
        ) from None
