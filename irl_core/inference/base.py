"""What inference gives, whatever its kind: the distribution over paths that a reward implies, and its gradient."""

from dataclasses import dataclass
from typing import Final, Literal, TypeAlias, get_args

import numpy as np

from irl_core.arrays import Matrix, Policy, Vector, read_only

StepPolicies: TypeAlias = np.ndarray[tuple[int, int, int], np.dtype[np.float64]]
InferenceKind: TypeAlias = Literal["path", "path_infinite", "causal", "ziebart"]
INFERENCE_KINDS: Final[tuple[InferenceKind, ...]] = get_args(InferenceKind)


@dataclass(frozen=True, eq=False)
class Inferred:
    """What a reward R implies.

    `log_partition` is Σ_s ρ_0(s) log Z(s) over the starts (for `causal`: Σ ρ_0 V). `policy`, shape (S, A), is the
    stationary one that is drawn and executed. `visitation`, shape (S,), is μ^π, the expected number of visits (for
    `causal`: discounted). For every kind but `ziebart` it is the gradient of the log partition in R. `step_policies`,
    shape (N, S, A), is the policy with n = 1, …, N steps to go, where it was asked for.
    """

    inference: InferenceKind
    log_partition: float
    policy: Policy
    visitation: Vector
    step_policies: StepPolicies | None = None

    def __post_init__(self) -> None:
        read_only(self.policy)
        read_only(self.visitation)


@dataclass(frozen=True, eq=False)
class BatchInferred:
    """What B rewards imply, each in its own grid: the fields of Inferred with a leading axis B."""

    inference: InferenceKind
    log_partition: Vector
    policy: np.ndarray[tuple[int, int, int], np.dtype[np.float64]]
    visitation: Matrix
