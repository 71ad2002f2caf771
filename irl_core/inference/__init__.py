"""Inference: log partition, policy and state visitation of the path distribution that a reward implies.

| kind | paths | gradient |
|---|---|---|
| `path` (default) | from a start to a terminal state in at most N steps, P(ζ) ∝ Π T · exp(Σ R) | exact |
| `path_infinite` | the same of any length, where their sum is finite (else DivergentPartition) | exact |
| `causal` | of N steps at most, by maximum causal entropy, with a discount; need not arrive | exact |
| `ziebart` | the paper's Algorithm 1 to the letter: one stationary policy, run forward with T | none |
"""

from collections.abc import Iterable, Sequence

import numpy as np

from irl_core.array_checks import check_discount, check_reward, check_size, check_whole, finite_array
from irl_core.arrays import Matrix, Vector
from irl_core.checks import shown
from irl_core.errors import InvalidModel, InvalidReward, InvalidSettings
from irl_core.inference.base import INFERENCE_KINDS, BatchInferred, InferenceKind, Inferred
from irl_core.inference.causal import infer_causal
from irl_core.inference.path import infer_path, infer_path_batch
from irl_core.inference.path_infinite import infer_path_infinite, infer_path_infinite_batch
from irl_core.inference.sparse import infer_path_infinite_sparse, infer_path_sparse
from irl_core.inference.ziebart import infer_ziebart
from irl_core.mdp import GridMdp, Mdp, as_mdp, start_distribution
from irl_core.types import World


def infer(
    model: World | Mdp,
    reward: Vector,
    *,
    inference: InferenceKind = "path",
    horizon: int | None = None,
    discount: float = 1.0,
    starts: int | Vector | None = None,
) -> Inferred:
    """What `reward`, shape (S,), implies: log partition, executed policy (S, A), state visitation (S,).

    `horizon` N is in steps (`path_infinite` has none), `discount` γ in (0, 1] is for `causal` alone, `starts` is a
    state or a distribution of shape (S,); the model's own unless given. Raises InvalidReward, InvalidModel,
    InvalidSettings, and DivergentPartition where a sum over paths of any length is infinite.
    """
    mdp = as_mdp(model)
    checked = check_reward(reward, n_states=mdp.n_states)
    begun = _starts(mdp, starts)
    if inference == "path_infinite":
        if isinstance(mdp, GridMdp):
            return infer_path_infinite(mdp, checked, starts=begun)
        return infer_path_infinite_sparse(mdp, checked, starts=begun)
    n_steps = _horizon(mdp, horizon)
    if inference == "path":
        if isinstance(mdp, GridMdp):
            return infer_path(mdp, checked, horizon=n_steps, starts=begun)
        return infer_path_sparse(mdp, checked, horizon=n_steps, starts=begun)
    if inference == "causal":
        return infer_causal(mdp, checked, horizon=n_steps, discount=check_discount(discount), starts=begun)
    if inference == "ziebart":
        return infer_ziebart(mdp, checked, horizon=n_steps, starts=begun)
    raise InvalidSettings(
        f"There is no inference {shown(inference)}; there are {', '.join(INFERENCE_KINDS)}.", field="inference"
    )


def infer_batch(
    models: Sequence[World | GridMdp],
    rewards: Matrix,
    *,
    inference: InferenceKind = "path",
    horizon: int | None = None,
    starts: Matrix | None = None,
) -> BatchInferred:
    """What B rewards, shape (B, S), imply, each in its own grid; all grids have the same rows and cols.

    For `path` and `path_infinite`, many times as fast as one after the other. `horizon` is the largest of the grids'
    unless given; `starts`, shape (B, S), are the grids' own.
    """
    mdps = _same_shape(models)
    shape = (len(mdps), mdps[0].n_states)
    wanted = f"{shape[0]} × {shape[1]} finite numbers, one row a grid"
    checked: Matrix = finite_array("rewards", rewards, shape=shape, wanted=wanted, error=InvalidReward)
    check_size("rewards", checked)
    begun = np.stack([mdp.starts for mdp in mdps]) if starts is None else _batch_starts(mdps, starts)
    if inference == "path_infinite":
        return infer_path_infinite_batch(mdps, checked, starts=begun)
    if inference == "path":
        n_steps = max(mdp.horizon for mdp in mdps) if horizon is None else _horizon(mdps[0], horizon)
        return infer_path_batch(mdps, checked, horizon=n_steps, starts=begun)
    raise InvalidSettings(
        f'In batches there are "path" and "path_infinite", not {shown(inference)}.', field="inference"
    )


def _same_shape(models: object) -> list[GridMdp]:
    if not isinstance(models, Iterable) or isinstance(models, str):
        raise InvalidModel(f"models must be a list of grids, not {shown(models)}.", field="models")
    mdps = [model.mdp if isinstance(model, World) else model for model in models]
    if not mdps:
        raise InvalidModel("A batch needs at least one grid.", field="models")
    for mdp in mdps:
        if not isinstance(mdp, GridMdp):
            raise InvalidModel(f"Only grids go in batches, not {shown(mdp)}.", field="models")
        if (mdp.rows, mdp.cols) != (mdps[0].rows, mdps[0].cols):
            raise InvalidModel(
                f"The grids of a batch have one size; here are {mdps[0].rows}×{mdps[0].cols} and"
                f" {mdp.rows}×{mdp.cols}.",
                field="models",
            )
    return mdps


def _batch_starts(mdps: Sequence[GridMdp], given: object) -> Matrix:
    shape = (len(mdps), mdps[0].n_states)
    wanted = f"{shape[0]} × {shape[1]} probabilities, one row a grid"
    starts: Matrix = finite_array("starts", given, shape=shape, wanted=wanted, error=InvalidModel)
    return np.stack([_starts(mdp, row) for mdp, row in zip(mdps, starts, strict=True)])


def _starts(mdp: Mdp, given: int | Vector | None) -> Vector:
    if given is None:
        return mdp.starts
    return start_distribution(given, n_states=mdp.n_states, not_at=np.flatnonzero(mdp.terminal).tolist())


def _horizon(mdp: Mdp, given: int | None) -> int:
    return mdp.horizon if given is None else check_whole("horizon", given, minimum=1)


__all__ = [
    "INFERENCE_KINDS",
    "BatchInferred",
    "InferenceKind",
    "Inferred",
    "infer",
    "infer_batch",
]
