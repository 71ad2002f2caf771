"""Path inference with a finite horizon: the exact gradient of the likelihood of whole paths.

**Problem.** Paths ζ = (s_0, s_1, …) start at s_0 ~ ρ_0, end at a goal within N steps, and from each start have

    P(ζ | s_0) = Π_t T(s_{t+1} | s_t, a_t) · exp(Σ_t R(s_t)) / Z_N(s_0)

(Ziebart et al. 2008, Eq. 4; IRLFR paper, Algorithm 1), the start's own reward and the goal's (once) included. Wanted
are Σ_s ρ_0(s) log Z_N(s), its gradient in R, which is the expected number of visits μ^π, and the policy P_n(a | s) with
n steps to go.

**Recursion.** With s′_d the square that direction d leads to, walls and edges leading back,

    Z_n(goal) = e^{R(goal)},   Z_0(s) = 0,   Z_n(s) = e^{R(s)} Σ_d Z_{n−1}(s′_d):

a slip goes each of the other ways alike, so Σ_a T(d | a) = 1 and slip cancels. It stays in the action behind a
direction, P_n(a | s) = Σ_d T(d | a) q_n(d | s), where q_n(d | s) = Z_{n−1}(s′_d) / Σ_{d′} Z_{n−1}(s′_{d′}). Where no
goal can be reached, at goals and at walls P is uniform. Visits need no division by Z_n on the way: let

    f_0(s) = e^{R(s)} ρ_0(s) / Z_N(s),   f_{t+1}(s) = e^{R(s)} Σ_d f_t(s′_d)   off the goals, where f = 0.

The grid is symmetric (d leads from s to s′ as often as back), so this is the transpose of the first recursion: f_t(s)
is the weight of all ways from the starts to s in t steps. Visits after t steps are f_t(s) Z_{N−t}(s) / e^{R(s)}, and at
a goal Z(goal) Σ_d f_{t−1}(s′_d). Both passes are sums and products of positive numbers: no digit is ever cancelled.

**Numbers.** Rows are scaled by powers of two, which is exact. Underflow takes at most 2^−1075 from Z_n(s), on the
scale of its row, and changes log Z_N by f_{N−n}(s) / e^{R(s)} times as much: a forward pass that stays below 2^1000
shows that nothing was lost, and the kernel watches for that. The policy is also given where no path from a start comes:
there Z must be 0 for want of a way, or larger than 2^−800. Where either fails, and for rewards above 136, below −600 or
of goals 600 apart, the recursion runs in logs instead (`path_log`), 60 to 180 times as long.

**Memory.** Up to 4 MB of Z_n are kept as they are; beyond that every √N-th, and the rest is computed again.

**Differences from the paper.** It has Z(goal) = 1; with one goal ours shifts log Z by R(goal) and changes nothing else,
with several it is what lets one be worth more than another. Its forward pass with T is not the gradient under slip
(`ziebart` keeps it). Shapes: S states, A = 4 actions and directions, N steps, B worlds.
"""

import math
from collections.abc import Sequence
from typing import Final
from weakref import WeakKeyDictionary

import numpy as np

from irl_core import _kernels, grid
from irl_core.arrays import IntVector, Matrix, Vector
from irl_core.errors import InvalidModel
from irl_core.inference.base import BatchInferred, Inferred, StepPolicies
from irl_core.inference.path_log import infer_path_in_logs
from irl_core.mdp.grid import GridMdp

_LANES: Final = 8
"""Worlds side by side in a batch: a vector instruction takes 4 or 8 numbers, and 16 worlds gain nothing."""

_LANES_UP_TO: Final = 400
"""From 20×20 on a world of its own fills the vectors, and eight would overflow the cache."""

_CHUNK: Final = 256
"""Worlds in one call of the kernel: what is made for them in between stays small and is used again."""

_ROW_BYTES: Final = 1 << 22
_HIGHEST_EXPONENT: Final = 700.0

_zeros_due: WeakKeyDictionary[GridMdp, dict[tuple[int, bool], int]] = WeakKeyDictionary()


def infer_path(mdp: GridMdp, reward: Vector, *, horizon: int, starts: Vector, step_policies: bool = False) -> Inferred:
    """What a finite `reward`, shape (S,), implies for paths of at most `horizon` ≥ 1 steps from ρ_0 = `starts`, (S,).

    With `step_policies` also P_n for n = 1, …, N, shape (N, S, 4). Raises InvalidModel when from some start no goal can
    be reached in time; `starts` must have no mass at goals and walls.
    """
    log_z, policy, visits = np.empty(1), np.empty((1, mdp.n_states, 4)), np.empty((1, mdp.n_states))
    steps = np.empty((horizon if step_policies else 0, mdp.n_states, 4))
    found = (log_z, policy, visits, steps)
    zeros = _gradient((mdp,), reward[None], horizon=horizon, starts=starts[None], lanes=1, found=found)
    if _is_right(mdp, int(zeros[0]), horizon, each_step=step_policies):
        return Inferred("path", float(log_z[0]), policy[0], visits[0], steps if step_policies else None)
    return _infer_in_logs(mdp, reward, horizon=horizon, starts=starts, step_policies=step_policies)


def infer_path_batch(mdps: Sequence[GridMdp], rewards: Matrix, *, horizon: int, starts: Matrix) -> BatchInferred:
    """The same for B grids of one shape, each with its own walls, goals and slip; `rewards` and `starts` are (B, S).

    One grid for all of them may be given as B times the same, or once. Raises InvalidModel where shapes differ, and as
    `infer_path` does.
    """
    n_worlds, n_states = rewards.shape
    if len({(mdp.rows, mdp.cols) for mdp in mdps}) != 1 or len(mdps) not in (1, n_worlds):
        raise InvalidModel(f"mdps must be {n_worlds} grids of one shape, or one for all.", field="mdps")
    lanes = _LANES if n_states <= _LANES_UP_TO else 1
    log_z, policies, visits = np.empty(n_worlds), np.empty((n_worlds, n_states, 4)), np.empty((n_worlds, n_states))
    for first in range(0, n_worlds, _CHUNK):
        part = slice(first, first + _CHUNK)
        found = (log_z[part], policies[part], visits[part], np.empty((0, n_states, 4)))
        here = mdps if len(mdps) == 1 else mdps[part]
        zeros = _gradient(here, rewards[part], horizon=horizon, starts=starts[part], lanes=lanes, found=found)
        for b in (np.flatnonzero(zeros) + first).tolist():
            mdp = mdps[b] if len(mdps) > 1 else mdps[0]
            if not _is_right(mdp, int(zeros[b - first]), horizon, each_step=False):
                one = _infer_in_logs(mdp, rewards[b], horizon=horizon, starts=starts[b])
                log_z[b], policies[b], visits[b] = one.log_partition, one.policy, one.visitation
    return BatchInferred("path", log_z, policies, visits)


def _gradient(
    mdps: Sequence[GridMdp],
    rewards: Matrix,
    *,
    horizon: int,
    starts: Matrix,
    lanes: int,
    found: tuple[Vector, StepPolicies, Matrix, StepPolicies],
) -> IntVector:
    """Run the kernel. It gets copies, so that it is compiled once and not again for arrays that are read-only."""
    mdp = mdps[0]
    rewards = np.array(rewards, order="C")
    pays = np.minimum(rewards, _HIGHEST_EXPONENT)
    slips = np.array([mdp.slip for mdp in mdps] if len(mdps) > 1 else [mdp.slip] * len(rewards))
    zeros: IntVector = _kernels.stencil.path_gradient(
        rewards,
        np.exp(pays, out=pays),
        np.array([mdp.terminal for mdp in mdps]),
        np.array([mdp.blocked for mdp in mdps]),
        np.array(starts, order="C"),
        slips,
        mdp.cols,
        horizon,
        _rows_kept(mdp, horizon=horizon, lanes=lanes),
        lanes,
        *found,
    )
    return zeros


def _rows_kept(mdp: GridMdp, *, horizon: int, lanes: int) -> int:
    """How many of Z_0, …, Z_N lie in memory at once: all, or √N and every √N-th."""
    row_bytes = (mdp.rows + 2) * (mdp.cols + 1) * lanes * 8
    return horizon + 1 if (horizon + 1) * row_bytes <= _ROW_BYTES else math.isqrt(horizon) + 2


def _is_right(mdp: GridMdp, zeros: int, horizon: int, *, each_step: bool) -> bool:
    """Whether the kernel lost nothing, and met as many Z_n(s) = 0 as there are squares too far from any goal."""
    if zeros <= 0:
        return zeros == 0
    known = _zeros_due.setdefault(mdp, {})
    if (horizon, each_step) not in known:
        known[horizon, each_step] = _count_zeros(mdp, horizon=horizon, each_step=each_step)
    return zeros == known[horizon, each_step]


def _count_zeros(mdp: GridMdp, *, horizon: int, each_step: bool) -> int:
    """How many squares have Z_{N−1} = 0 for want of a way; at each step: how many pairs (n, s), n < N, have Z_n = 0."""
    off_goals = grid.neighbours(mdp.rows, mdp.cols, goals=(), walls=mdp.walls)
    steps = grid.distances_from(off_goals, np.flatnonzero(mdp.terminal))[~(mdp.terminal | mdp.blocked)]
    steps = np.where(steps < 0, horizon, np.minimum(steps, horizon))
    return int(steps.sum() if each_step else (steps == horizon).sum())


def _infer_in_logs(
    mdp: GridMdp, reward: Vector, *, horizon: int, starts: Vector, step_policies: bool = False
) -> Inferred:
    found = infer_path_in_logs(mdp, reward, horizon=horizon, starts=starts, step_policies=step_policies)
    begun = np.flatnonzero(starts)
    away = begun[np.isneginf(found.log_z[begun])]
    if len(away):
        raise InvalidModel(f"From state {away[0]} no goal can be reached within {horizon} steps.", field="horizon")
    log_partition = float(starts[begun] @ found.log_z[begun])
    return Inferred("path", log_partition, found.policy, found.visitation, found.step_policies)
