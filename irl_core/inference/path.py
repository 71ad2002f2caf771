"""Path inference with a finite horizon: the exact gradient of the likelihood of whole paths."""

from collections.abc import Sequence

import numpy as np

from irl_core.arrays import Matrix, Vector
from irl_core.errors import InvalidModel
from irl_core.inference.base import BatchInferred, Inferred, check_reward
from irl_core.inference.path_log import infer_path_in_logs
from irl_core.mdp.grid import GridMdp


def infer_path(
    mdp: GridMdp, reward: object, *, horizon: int, starts: Vector, step_policies: bool = False
) -> Inferred:
    """What `reward`, shape (S,), implies for the paths that arrive within the horizon."""
    if horizon < 1:
        raise InvalidModel(f"horizon must be at least 1 step, not {horizon}.", field="horizon")
    checked = check_reward(reward, n_states=mdp.n_states)
    found = infer_path_in_logs(mdp, checked, horizon=horizon, starts=starts, step_policies=step_policies)
    begins = np.flatnonzero(starts)
    if not np.isfinite(found.log_z[begins]).all():
        raise InvalidModel(f"No goal can be reached within {horizon} steps.", field="horizon")
    return Inferred("path", float(starts[begins] @ found.log_z[begins]), found.policy, found.visitation)


def infer_path_batch(mdps: Sequence[GridMdp], rewards: Matrix, *, horizon: int, starts: Matrix) -> BatchInferred:
    """The same for B grids of one shape, `rewards` and `starts` of shape (B, S)."""
    each = [
        infer_path(mdp, reward, horizon=horizon, starts=start)
        for mdp, reward, start in zip(mdps, rewards, starts, strict=True)
    ]
    return BatchInferred(
        "path",
        np.array([one.log_partition for one in each]),
        np.array([one.policy for one in each]),
        np.array([one.visitation for one in each]),
    )
