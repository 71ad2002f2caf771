"""Ziebart's Algorithm 1 to the letter (Ziebart et al. 2008; the paper's computePolicy and computeFE). No gradient.

    Z_t = 1 at terminal t; then N times:                 (1)
    Z_{s,a} = Σ_{s′} T(s′ | s, a) e^{R(s)} Z_{s′}         (2)
    Z_s = Σ_a Z_{s,a} + 1{s terminal}                     (2)
    P(a | s) = Z_{s,a} / Z_s                              (3)
    D_0 = ρ_0,   D_{t+1}(s) = Σ_{s′, a} D_t(s′) P(a | s′) T(s | a, s′),   t = 0, …, N − 1      (4, 5)
    D = Σ_t D_t                                           (6)

One stationary policy, that of N steps to go, is run forward for N steps with T itself. The gradient of log Z_N would
need the policy of the steps still to go, and, where transitions are uncertain, the path measure's own law in place of T
(`path`). So `visitation` here is *not* the gradient of `log_partition`: test_ziebart.py measures how far off it is. The
two agree where transitions are certain and N is so large that Z no longer changes (ρ < 1).

Kept to compare with, and because it is what the name MEIRL means in the literature. The paper reads Z_goal = 1 without
e^{R(goal)}, which shifts log Z and, with one goal, nothing else. Steps from terminal states are none here.
"""

import numpy as np

from irl_core.arrays import Vector
from irl_core.inference.base import Inferred
from irl_core.inference.sparse import action_policy, log_weights, mean_log
from irl_core.mdp import Mdp, SparseMdp


def infer_ziebart(mdp: Mdp, reward: Vector, *, horizon: int, starts: Vector) -> Inferred:
    """Log Z_N of the starts, the stationary P(a | s) and D = Σ_t D_t; `reward` and `starts` have shape (S,).

    Raises InvalidModel where a start has no path to a terminal state in N steps.
    """
    model = mdp if isinstance(mdp, SparseMdp) else mdp.to_sparse()
    log_z, log_z_before = log_weights(model, np.where(model.terminal, 0.0, reward), horizon=horizon)
    log_partition = mean_log(log_z, starts, within=f" within {horizon} steps")
    policy = action_policy(model, log_z_before)
    followed = model.followed(policy).transpose()
    here, visits = starts.copy(), starts.copy()
    for _ in range(horizon):
        here = np.asarray(followed @ here)
        visits += here
    return Inferred("ziebart", log_partition, policy, visits)
