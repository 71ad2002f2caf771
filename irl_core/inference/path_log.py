"""Finite-horizon path inference in logs: slower than `path`, right for any finite reward.

The recursion and its letters are those of `irl_core.inference.path`, with every weight kept as its logarithm:

    log Z_n(s) = R(s) + log Σ_d exp log Z_{n−1}(s′_d),        −∞ where there is no way in n steps,
    q_n(d | s) = Z_{n−1}(s′_d) / Σ_{d′} Z_{n−1}(s′_{d′}),     D_{t+1}(s′) = Σ_{s, d: s′_d = s′} q_{N−t}(d | s) D_t(s).

Rewards of ±1000 neither overflow nor underflow. Of log Z every √N-th step is kept and the others are computed again
when the forward pass D comes to them, so that memory grows with √N · S. `path` calls this where plain numbers would not
do; it is also the second solver that the first is measured against.
"""

import math
from dataclasses import dataclass

import numpy as np

from irl_core import grid
from irl_core.arrays import Matrix, Policy, Vector
from irl_core.mdp.grid import GridMdp


@dataclass(frozen=True, eq=False)
class LogPath:
    """log Z_N, shape (S,); P_N, (S, 4); μ^π, (S,); and where asked for P_n, n = 1, …, N, (N, S, 4)."""

    log_z: Vector
    policy: Policy
    visitation: Vector
    step_policies: np.ndarray[tuple[int, int, int], np.dtype[np.float64]] | None


def infer_path_in_logs(
    mdp: GridMdp, reward: Vector, *, horizon: int, starts: Vector, step_policies: bool = False
) -> LogPath:
    """Log partitions, policy and visits; `starts` outside the reach of a goal have log Z = −∞ and are not followed."""
    ahead = np.ascontiguousarray(mdp.next_states.T)
    every = math.isqrt(horizon - 1) + 1
    kept = _backward(mdp, ahead, reward, horizon=horizon, every=every)
    policies = np.empty((horizon, mdp.n_states, grid.N_ACTIONS)) if step_policies else None
    here: Vector = starts.copy()
    visits: Vector = starts.copy()
    policy: Policy = np.empty((0, 0))
    log_z = starts
    for block in range(len(kept) - 1, -1, -1):
        first, last = block * every, min((block + 1) * every, horizon)
        rows = _rows(mdp, ahead, reward, kept[block], n_steps=last - first)
        log_z = rows[-1] if last == horizon else log_z
        for n in range(last, first, -1):
            law = direction_law(mdp, ahead, rows[n - 1 - first])
            if n == horizon or policies is not None:
                acts = mix_slip(mdp, law)
                policy = acts if n == horizon else policy
                if policies is not None:
                    policies[n - 1] = acts
            here = np.bincount(ahead.reshape(-1), (law * here).reshape(-1), mdp.n_states).astype(np.float64, copy=False)
            visits += here
    return LogPath(log_z, policy, visits, policies)


def direction_law(mdp: GridMdp, ahead: np.ndarray, log_z: Vector) -> Matrix:
    """q(d | s) from log Z of the step after, shape (4, S); 0 at goals and where nothing is ahead."""
    log_ahead = log_z[ahead]
    top = log_ahead.max(axis=0)
    law: Matrix = np.exp(log_ahead - np.where(np.isfinite(top), top, 0.0))
    total = law.sum(axis=0)
    law /= np.where(total > 0.0, total, 1.0)
    law[:, mdp.terminal] = 0.0
    return law


def mix_slip(mdp: GridMdp, law: Matrix) -> Policy:
    """P(a | s) = Σ_d T(d | a) q(d | s), shape (4, S) → (S, 4); uniform where nothing is ahead."""
    aside = mdp.slip / (grid.N_ACTIONS - 1)
    mixed = (1.0 - mdp.slip - aside) * law + aside * law.sum(axis=0)
    policy: Policy = np.ascontiguousarray(np.where(law.any(axis=0), mixed, 1.0 / grid.N_ACTIONS).T)
    return policy


def _backward(mdp: GridMdp, ahead: np.ndarray, reward: Vector, *, horizon: int, every: int) -> list[Vector]:
    """Log Z_n for n = 0, every, 2·every, … below the horizon."""
    log_z = np.full(mdp.n_states, -np.inf)
    log_z[mdp.terminal] = reward[mdp.terminal]
    kept = [log_z]
    for _ in range(every, horizon, every):
        kept.append(_rows(mdp, ahead, reward, kept[-1], n_steps=every)[-1])
    return kept


def _rows(mdp: GridMdp, ahead: np.ndarray, reward: Vector, log_z: Vector, *, n_steps: int) -> Matrix:
    """Log Z of this step and the next `n_steps`, shape (n_steps + 1, S)."""
    rows: Matrix = np.empty((n_steps + 1, mdp.n_states))
    rows[0] = log_z
    for n in range(1, n_steps + 1):
        log_ahead = rows[n - 1][ahead]
        top = log_ahead.max(axis=0)
        top[np.isneginf(top)] = 0.0
        total = np.exp(log_ahead - top).sum(axis=0)
        rows[n] = reward + top + np.log(total, out=np.full(mdp.n_states, -np.inf), where=total > 0.0)
        rows[n, mdp.terminal] = reward[mdp.terminal]
    return rows
