"""What every learner is and gives: states to resume from, frames to look at, a result that says how it ended."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Protocol, Self

import numpy as np

from irl_core.arrays import Policy, Reward, Vector, read_only
from irl_core.errors import IrlError
from irl_core.learners.problem import LearningProblem


class Outcome(StrEnum):
    """How learning ended. Not converging is an outcome to show a person, not a crash."""

    CONVERGED = "converged"
    ITERATION_LIMIT = "iteration_limit"
    DIVERGED = "diverged"
    STOPPED = "stopped"


class Learner(Protocol):
    """An algorithm. It keeps nothing itself: what it has learned so far is in the state, the rest in the problem.

    `start` raises MissingDemonstrations if the problem lacks what it needs. `advance` takes up to `iterations` more
    iterations, fewer if learning ends (`state.outcome` is then set). However the iterations are portioned out, and
    whether or not a state went through JSON on its way, the result is the same to the last bit.
    """

    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def uses_ranking(self) -> bool: ...
    @property
    def uses_failures(self) -> bool: ...
    @property
    def references(self) -> tuple[str, ...]: ...

    def start(self, problem: LearningProblem) -> "LearningState": ...
    def advance(self, problem: LearningProblem, state: "LearningState", *, iterations: int) -> "LearningState": ...
    def frame(self, problem: LearningProblem, state: "LearningState") -> "Frame": ...
    def result(self, problem: LearningProblem, state: "LearningState") -> "LearningResult": ...


@dataclass(frozen=True, eq=False)
class LearningState:
    """How far a learner is: w_D and w_F, each of shape (S,), λ, and the number of iterations made."""

    learner: str
    iteration: int
    w_success: Vector
    w_failure: Vector
    lam: float
    outcome: Outcome | None = None

    def __post_init__(self) -> None:
        read_only(self.w_success)
        read_only(self.w_failure)

    @property
    def reward(self) -> Reward:
        """R = w_D + w_F, shape (S,): the features are one-hot."""
        return self.w_success + self.w_failure

    @property
    def is_finished(self) -> bool:
        """Whether learning has ended by itself."""
        return self.outcome is not None

    def to_json(self) -> dict[str, Any]:
        """The state in JSON; Python writes floats so that they read back exactly."""
        return {
            "learner": self.learner,
            "iteration": self.iteration,
            "w_success": self.w_success.tolist(),
            "w_failure": self.w_failure.tolist(),
            "lambda": self.lam,
            "outcome": None if self.outcome is None else self.outcome.value,
        }

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Self:
        """The state that `to_json` wrote."""
        try:
            return cls(
                learner=data["learner"],
                iteration=data["iteration"],
                w_success=np.array(data["w_success"], dtype=np.float64),
                w_failure=np.array(data["w_failure"], dtype=np.float64),
                lam=float(data["lambda"]),
                outcome=None if data["outcome"] is None else Outcome(data["outcome"]),
            )
        except (KeyError, TypeError, ValueError) as error:
            raise IrlError(f"This is not the state of a learner: {error!r}.", field="state") from error


@dataclass(frozen=True, eq=False)
class Frame:
    """What a learner shows of itself at one iteration. `gap` is ‖μ^π − μ̃‖∞, in visits."""

    learner: str
    iteration: int
    iterations: int
    gap: float
    log_likelihood: float
    reward: Reward
    policy: Policy
    visitation: Vector

    def to_json(self, *, digits: int | None = None) -> dict[str, Any]:
        """The frame as the API has it; `digits` are the significant ones to keep."""
        return {
            "learner": self.learner,
            "iteration": self.iteration,
            "iterations": self.iterations,
            "gap": _rounded(self.gap, digits),
            "log_likelihood": _rounded(self.log_likelihood, digits),
            "reward": _rounded(self.reward.tolist(), digits),
            "policy": _rounded(self.policy.tolist(), digits),
            "visitation": _rounded(self.visitation.tolist(), digits),
        }


@dataclass(frozen=True, eq=False)
class LearningResult:
    """What a learner came to. `policy`, shape (S, 4), is the one that is executed; the others have shape (S,).

    `spectral_radius` is ρ of the learned reward's path sum: from 1 on, paths of any length would weigh infinitely much
    and the policy depends on the horizon. `executed_gap` is how far, in visits, executing the stationary policy is from
    the path distribution it was taken from.
    """

    learner: str
    outcome: Outcome
    sentence: str
    iterations: int
    gap: float
    log_likelihood: float
    reward: Reward
    policy: Policy
    visitation: Vector
    n_left_out: int
    shape: tuple[int, int]
    spectral_radius: float
    executed_gap: float

    def __post_init__(self) -> None:
        for array in (self.reward, self.policy, self.visitation):
            read_only(array)

    def to_json(self) -> dict[str, Any]:
        """The result as the API has it: reward and visitation as rows × cols."""
        return {
            "learner": self.learner,
            "outcome": self.outcome.value,
            "sentence": self.sentence,
            "iterations": self.iterations,
            "gap": self.gap,
            "log_likelihood": self.log_likelihood,
            "reward": self.reward.reshape(self.shape).tolist(),
            "policy": self.policy.tolist(),
            "visitation": self.visitation.reshape(self.shape).tolist(),
            "n_left_out": self.n_left_out,
            "spectral_radius": self.spectral_radius,
            "executed_gap": self.executed_gap,
        }

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Self:
        """The result that `to_json` wrote."""
        reward = np.array(data["reward"], dtype=np.float64)
        return cls(
            learner=data["learner"],
            outcome=Outcome(data["outcome"]),
            sentence=data["sentence"],
            iterations=data["iterations"],
            gap=data["gap"],
            log_likelihood=data["log_likelihood"],
            reward=reward.reshape(-1),
            policy=np.array(data["policy"], dtype=np.float64),
            visitation=np.array(data["visitation"], dtype=np.float64).reshape(-1),
            n_left_out=data["n_left_out"],
            shape=(reward.shape[0], reward.shape[1]),
            spectral_radius=data["spectral_radius"],
            executed_gap=data["executed_gap"],
        )


def _rounded(value: Any, digits: int | None) -> Any:  # noqa: ANN401 - a number, or lists of them to any depth
    if digits is None:
        return value
    return [_rounded(one, digits) for one in value] if isinstance(value, list) else float(f"{value:.{digits}g}")
