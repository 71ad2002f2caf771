"""Path inference without a horizon: the sum over paths of any length, where it is finite.

**Problem.** As in `inference.path`, with N → ∞: paths from a start to a goal, P(ζ) ∝ Π T · exp(Σ_t R(s_t)), start and
goal included. z(s), the weight of all paths from s, solves

    z(goal) = e^{R(goal)},   z(s) = e^{R(s)} Σ_d z(s′_d)      (slip cancels, see `irl_core.planning`),

over the squares *on the way*: those that a start leads to before a goal. A direction that leads nowhere is a loop.
With K = diag(e^{−R} − loops) − adjacency on them this is K z = Σ of e^{R(goal)} over goals beside. K is symmetric, and
the sum over paths is finite exactly when it is positive definite (the spectral radius ρ of the e^R-weighted moves is
below 1): when no pivot of elimination is ≤ 0. Below −log 4 everywhere it always is.

**Gradient.** For L = Σ_s ρ_0(s) log z(s) the visits μ = ∂L/∂R come from one more solve with the same matrix:
K x = ρ_0 / z, then μ(s) = e^{−R(s)} z(s) x(s), and at goals μ(g) = e^{R(g)} Σ x of the squares beside.
The next direction has q(d | s) = z(s′_d) / Σ_{d′} z(s′_{d′}), the action P(a | s) = Σ_d T(d | a) q(d | s).

**Potentials.** log z reaches −220 in a learned 100×100 world, −2,100 at 1000×1000. With u near log z we solve for
y = z e^{−u} instead: M = 1 − W with W(s, s′) = e^{R(s) + u(s′) − u(s)}, a loop e^{R(s)}; M y = 0 on the way, y = 1 at
goals; Mᵀ x = ρ_0 / y gives μ = y · x, goals included. M is K with its rows and columns scaled, so its pivots have the
signs of K's. u starts as a lower bound from a Gauss–Seidel pass in logs; u ← u + log y mends it.

**How it is solved.** Many small worlds: K by LDLᵀ, side by side; what leaves the range of plain floats goes the next
way. One world at most 32 squares wide: M by banded LU. Larger ones: line Gauss–Seidel, rows solved exactly, in
strips that are swept while they stay in the cache, down and up in turn until change and what is left to come are below
1e-12; that leaves an error of some 1e-10 in μ at worst, 1e-12 as a rule. Where that takes too long (ρ near 1), LU again
if its band has a gigabyte; a larger grid is refused then.

Source: Ziebart et al. (2008), "Maximum entropy inverse reinforcement learning", Eq. 4, whose Algorithm 1 runs this sum
for N steps; as linear equations: Todorov (2007), "Linearly-solvable Markov decision problems", Eq. 6.
"""

from collections.abc import Sequence
from typing import Final, NoReturn, TypeAlias

import numpy as np

from irl_core import _kernels
from irl_core.array_checks import check_reward
from irl_core.arrays import IntVector, Matrix, Vector
from irl_core.errors import DivergentPartition, InvalidModel
from irl_core.inference.base import BatchInferred, Inferred
from irl_core.mdp.grid import GridMdp

Cube: TypeAlias = np.ndarray[tuple[int, int, int], np.dtype[np.float64]]
Kinds: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.uint8]]

DIRECT_WIDTH: Final = 32
DIRECT_NUMBERS: Final = 1 << 27
"""The widest grid whose band is factorised at once, and the largest band when relaxation does not settle (1 GB)."""

_TOLERANCE: Final = 1e-12
_FIRST_TOLERANCE: Final = 1e-9
_MAX_PASSES: Final = 200
_MAX_ROUNDS: Final = 60
_RADIUS_UP_TO: Final = 256
"""A refusal names the spectral radius of grids of so many squares; of larger ones it takes long."""

_NEAR: Final = 3.0
"""u is near enough to log z when no |log y| is larger."""

_REMEDY: Final = (
    'Lower the reward of the squares on the way (below −log 4 it always converges), or use inference "path".'
)
_FAR: Final = 570.0
"""y is kept between e^−570 and e^570 while u is far from log z."""


def infer_path_infinite(mdp: GridMdp, reward: object, *, starts: Vector) -> Inferred:
    """What `reward`, shape (S,), implies for paths of any length from `starts`, a distribution of shape (S,).

    Off the way (walls, goals, squares no start leads to) the policy is uniform and the visits are 0. Raises
    DivergentPartition where the sum is infinite, InvalidReward, and InvalidModel where a start sees no goal.
    """
    shape = (mdp.rows, mdp.cols)
    # copies: a read-only array is another type to Numba, which would compile everything once more
    own_reward, own_starts = check_reward(reward, n_states=mdp.n_states).copy(), starts.copy()
    kind = _kinds([mdp], own_starts[None])[0]
    log_z, visits = _solve(mdp, kind, own_reward.reshape(shape), own_starts.reshape(shape))
    policy = np.empty((*shape, mdp.n_actions))
    _kernels.lines.path_policy(kind, log_z, float(mdp.slip), policy)
    begins = np.flatnonzero(starts)
    log_partition = float(starts[begins] @ log_z.reshape(-1)[begins])
    return Inferred("path_infinite", log_partition, policy.reshape(-1, mdp.n_actions), visits.reshape(-1))


def infer_path_infinite_batch(mdps: Sequence[GridMdp], rewards: Matrix, *, starts: Matrix) -> BatchInferred:
    """The same for B grids of one shape, `rewards` and `starts` of shape (B, S).

    Raises DivergentPartition, which names the worlds, if the sum of any is infinite.
    """
    n_worlds, n_states = rewards.shape
    shape = (n_worlds, mdps[0].rows, mdps[0].cols)
    begun = np.require(starts, np.float64, ("C", "W"))  # as Numba has compiled it; nothing is written
    kinds = _kinds(mdps, begun)
    with np.errstate(over="ignore", under="ignore"):  # what leaves the range of floats is not trusted, and solved apart
        pays, inverse = np.exp(rewards), np.exp(-rewards)
    results = np.empty(n_worlds), np.empty((n_worlds, n_states, 4)), np.empty((n_worlds, n_states))
    trusted = _kernels.banded.solve_worlds(
        kinds,
        pays.reshape(shape),
        inverse.reshape(shape),
        begun.reshape(shape),
        np.array([mdp.slip for mdp in mdps]),
        *results,
    )
    _solve_apart(mdps, rewards, begun, np.flatnonzero(~trusted), results)
    return BatchInferred("path_infinite", *results)


def diverges(mdp: GridMdp, reward: object) -> bool:
    """Whether the sum over paths of any length from the grid's own starts is infinite for this reward, (S,)."""
    try:
        infer_path_infinite(mdp, reward, starts=mdp.starts)
    except DivergentPartition:
        return True
    return False


def path_kinds(mdps: Sequence[GridMdp], starts: Matrix) -> Kinds:
    """What each square is to the kernels: WALL, FREE, GOAL, ON_THE_WAY (see `_kernels.lines`), (B, rows, cols)."""
    return _kinds(mdps, starts)


def _kinds(mdps: Sequence[GridMdp], starts: Matrix) -> Kinds:
    rows, cols = mdps[0].rows, mdps[0].cols
    layouts: dict[tuple[tuple[int, ...], tuple[int, ...]], int] = {}
    which = [layouts.setdefault((mdp.goals, mdp.walls), len(layouts)) for mdp in mdps]
    drawn: Kinds = np.ones((len(layouts), rows * cols), dtype=np.uint8)
    for kind, (goals, walls) in zip(drawn, layouts, strict=True):
        kind[list(goals)] = 2
        kind[list(walls)] = 0
    kinds = drawn[which].reshape(-1, rows, cols)
    _kernels.banded.mark_each_way(kinds, starts.reshape(-1, rows, cols))
    return kinds


def _solve(mdp: GridMdp, kind: Kinds, reward: Matrix, starts: Matrix) -> tuple[Matrix, Matrix]:
    """Log z and visits, both (rows, cols), of a settled problem."""
    u = np.empty_like(reward)
    if not _kernels.lines.first_potential(kind, reward, u):
        _refuse_divergence(mdp, reward)
    if not np.isfinite(u[starts > 0.0]).all():
        raise InvalidModel("A start is walled off from every goal.", field="starts")
    if min(kind.shape) <= DIRECT_WIDTH:
        return _solve_directly(mdp, kind, reward, starts, u)
    return _solve_by_lines(mdp, kind, reward, starts, u)


def _solve_directly(mdp: GridMdp, kind: Kinds, reward: Matrix, starts: Matrix, u: Matrix) -> tuple[Matrix, Matrix]:
    """By banded LU, the shorter side as its width."""
    if kind.shape[1] > kind.shape[0]:
        turned = np.ascontiguousarray
        log_z, visits = _solve_directly(mdp, turned(kind.T), turned(reward.T), turned(starts.T), turned(u.T))
        return np.ascontiguousarray(log_z.T), np.ascontiguousarray(visits.T)
    y, x = np.empty(kind.size), np.empty(kind.size)
    for _ in range(_MAX_ROUNDS):
        if not _kernels.banded.solve_in_potentials(kind, reward, u, starts.reshape(-1), y, x):
            _refuse_divergence(mdp, reward)
        log_y = _log(y).reshape(kind.shape)
        u = u + log_y
        if np.abs(log_y).max() < _FAR / 2 and np.isfinite(x).all():
            return u, (y * x).reshape(kind.shape)
    return _refuse_divergence(mdp, reward)


def _solve_by_lines(mdp: GridMdp, kind: Kinds, reward: Matrix, starts: Matrix, u: Matrix) -> tuple[Matrix, Matrix]:
    """By line relaxation; by LU if that takes too long."""
    up, right, down, left, pivot = (np.empty_like(reward) for _ in range(5))
    off_the_way = (kind != _kernels.lines.ON_THE_WAY).astype(np.float64)
    settle = _kernels.lines.settle
    y = np.zeros((kind.shape[0] + 2, kind.shape[1]))
    for _ in range(_MAX_ROUNDS):
        if not _kernels.lines.prepare(kind, reward, u, up, right, down, left, pivot):
            _refuse_divergence(mdp, reward)
        y[1:-1] = 1.0
        settle(y, off_the_way, up, right, down, left, False, _FIRST_TOLERANCE, 2)
        if _is_near(y):
            n_passes, _, _ = settle(y, off_the_way, up, right, down, left, False, _TOLERANCE, _MAX_PASSES)
            if n_passes < _MAX_PASSES and _is_near(y):
                break
        u += _log(y[1:-1])
    else:
        return _settle_otherwise(mdp, kind, reward, starts, u)
    u += np.log(y[1:-1])
    share = np.divide(starts, y[1:-1], out=off_the_way)
    x = np.zeros_like(y)
    n_passes, _, _ = settle(x, share, up, right, down, left, True, _TOLERANCE, _MAX_PASSES)
    if n_passes == _MAX_PASSES:
        return _settle_otherwise(mdp, kind, reward, starts, u)
    np.multiply(pivot, x[1:-1], out=pivot)
    np.multiply(pivot, y[1:-1], out=pivot)
    return u, pivot


def _settle_otherwise(mdp: GridMdp, kind: Kinds, reward: Matrix, starts: Matrix, u: Matrix) -> tuple[Matrix, Matrix]:
    """By LU, if there is room for the band; ρ is near 1, or above."""
    if kind.size * (2 * min(kind.shape) + 1) > DIRECT_NUMBERS:
        raise DivergentPartition(
            "The sum over paths of any length did not settle for this reward: the spectral radius is 1 or more, or too"
            f" near to 1 for a grid of {mdp.rows}×{mdp.cols}. {_REMEDY}"
        )
    return _solve_directly(mdp, kind, reward, starts, u)


def _solve_apart(
    mdps: Sequence[GridMdp], rewards: Matrix, starts: Matrix, worlds: IntVector, results: tuple[Vector, Cube, Matrix]
) -> None:
    """One after the other, in potentials."""
    refused: dict[int, DivergentPartition] = {}
    for k in worlds.tolist():
        try:
            found = infer_path_infinite(mdps[k], rewards[k], starts=starts[k])
        except DivergentPartition as error:
            refused[k] = error
        else:
            results[0][k], results[1][k], results[2][k] = found.log_partition, found.policy, found.visitation
    if refused:
        first, why = next(iter(refused.items()))
        more = f", {len(refused)} worlds of the batch in all: {sorted(refused)[:20]}" if len(refused) > 1 else ""
        raise DivergentPartition(f"World {first}{more}: {why.message}", spectral_radius=why.spectral_radius)


def _refuse_divergence(mdp: GridMdp, reward: Matrix) -> NoReturn:
    from irl_core.planning import spectral_radius  # noqa: PLC0415 - planning itself infers

    radius = spectral_radius(mdp, reward.reshape(-1)) if mdp.n_states <= _RADIUS_UP_TO else None
    raise DivergentPartition(
        "The sum over paths of any length is infinite for this reward: going in circles costs too little"
        + (f" (spectral radius {radius:.6g}, it must be below 1). " if radius is not None else ". ")
        + _REMEDY,
        spectral_radius=radius,
    )


def _is_near(y: Matrix) -> bool:
    return bool(np.exp(-_NEAR) < y[1:-1].min() and y[1:-1].max() < np.exp(_NEAR))


def _log(y: Vector | Matrix) -> Vector | Matrix:
    """Log y, kept within what the next round can mend."""
    kept: Matrix = np.nan_to_num(y, nan=1.0, posinf=np.exp(_FAR))
    np.clip(kept, np.exp(-_FAR), np.exp(_FAR), out=kept)
    return np.log(kept, out=kept)
