"""What every learner is and gives: states to resume from, frames to look at, a result that says how it ended."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from enum import StrEnum
from typing import Any, Literal, Protocol, Self, TypeAlias

import numpy as np

from irl_core.arrays import Policy, Reward, Vector, read_only
from irl_core.checks import whole_number
from irl_core.errors import IrlError
from irl_core.learners.problem import LearningProblem

Family: TypeAlias = Literal["paper", "ours", "baseline"]
"""The paper's four learners, our own, and those of the neighbourhood that they are measured against."""


class Outcome(StrEnum):
    """How learning ended. Not converging is an outcome to show a person, not a crash."""

    CONVERGED = "converged"
    ITERATION_LIMIT = "iteration_limit"
    DIVERGED = "diverged"
    STOPPED = "stopped"


class Learner(Protocol):
    """An algorithm. It keeps nothing itself: what it has learned so far is in the state, the rest in the problem.

    `start` raises MissingDemonstrations if the problem lacks what it needs; for one that `takes_anything` a single
    attempt is enough, be it a success or a failure. `advance` takes up to `iterations` more
    iterations, fewer if learning ends (`state.outcome` is then set). However the iterations are portioned out, and
    whether or not a state went through JSON on its way, the result is the same to the last bit.
    """

    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def summary(self) -> str: ...
    @property
    def family(self) -> Family: ...
    @property
    def uses_ranking(self) -> bool: ...
    @property
    def uses_failures(self) -> bool: ...
    @property
    def uses_scores(self) -> bool: ...
    @property
    def takes_anything(self) -> bool: ...
    @property
    def references(self) -> tuple[str, ...]: ...

    def start(self, problem: LearningProblem) -> "LearningState": ...
    def advance(self, problem: LearningProblem, state: "LearningState", *, iterations: int) -> "LearningState": ...
    def frame(self, problem: LearningProblem, state: "LearningState") -> "Frame": ...
    def result(self, problem: LearningProblem, state: "LearningState") -> "LearningResult": ...


@dataclass(frozen=True, eq=False)
class LearningState:
    """How far a learner is: the number of iterations made, and what it needs to go on, by name.

    `values` are vectors and numbers, all float64; each learner says which in its module.
    """

    learner: str
    iteration: int
    values: Mapping[str, Vector | float]
    outcome: Outcome | None = None

    def __post_init__(self) -> None:
        for value in self.values.values():
            if isinstance(value, np.ndarray):
                read_only(value)

    @property
    def is_finished(self) -> bool:
        """Whether learning has ended by itself."""
        return self.outcome is not None

    def vector(self, name: str) -> Vector:
        """The vector of this name. Raises IrlError if the state is of another learner."""
        value = self.values.get(name)
        if not isinstance(value, np.ndarray):
            raise IrlError(f"The state of {self.learner} has no vector {name!r}.", field="state")
        return value

    def number(self, name: str) -> float:
        """The number of this name. Raises IrlError if the state is of another learner."""
        value = self.values.get(name)
        if not isinstance(value, float):
            raise IrlError(f"The state of {self.learner} has no number {name!r}.", field="state")
        return value

    def ended(self, outcome: Outcome) -> Self:
        """The same state, with its verdict."""
        return replace(self, outcome=outcome)

    def to_json(self) -> dict[str, Any]:
        """The state in JSON; Python writes floats so that they read back exactly."""
        return {
            "learner": self.learner,
            "iteration": self.iteration,
            "values": {
                name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in self.values.items()
            },
            "outcome": None if self.outcome is None else self.outcome.value,
        }

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Self:
        """The state that `to_json` wrote. Raises IrlError where it is none."""
        try:
            return cls(
                learner=data["learner"],
                iteration=whole_number(data["iteration"], minimum=0, maximum=10**9),
                values={name: _value(value) for name, value in data["values"].items()},
                outcome=None if data["outcome"] is None else Outcome(data["outcome"]),
            )
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise IrlError(f"This is not the state of a learner: {error!r}.", field="state") from error


@dataclass(frozen=True, eq=False)
class Frame:
    """What a learner shows of itself at one iteration.

    `gap` is ‖μ^π − μ̃ᴰ‖∞, in visits (feature counts, where the features are not one-hot). `log_likelihood` is what the
    learner climbs; its module says of what.
    """

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
class Posterior:
    """What a Bayesian learner does not know. `level` is the probability that an interval holds.

    `reward_low` and `reward_high`, shape (S,); `policy_agreement`, shape (S,): the share of draws whose best plan takes
    the action that is executed; `return_low` and `return_high`: of the executed policy, in units of the learned reward.
    """

    level: float
    reward_low: Vector
    reward_high: Vector
    policy_agreement: Vector
    return_low: float
    return_high: float
    n_draws: int
    acceptance: float

    def __post_init__(self) -> None:
        for array in (self.reward_low, self.reward_high, self.policy_agreement):
            read_only(array)

    def to_json(self) -> dict[str, Any]:
        """The posterior in JSON, its vectors as flat lists."""
        return {
            one.name: value.tolist() if isinstance(value, np.ndarray) else value
            for one in fields(self)
            for value in [getattr(self, one.name)]
        }

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Self:
        """The posterior that `to_json` wrote."""
        return cls(**{name: _value(value) if isinstance(value, list) else value for name, value in data.items()})


@dataclass(frozen=True, eq=False)
class LearningResult:
    """What a learner came to. `policy`, shape (S, A), is the one that is executed; the others have shape (S,).

    `weights`, shape (K,), are those of the features (one-hot: the reward itself). `spectral_radius` is ρ of the learned
    reward's path sum: from 1 on, paths of any length would weigh infinitely much and the policy depends on the horizon.
    `executed_gap` is how far, in visits, executing the stationary policy is from the path distribution it was taken
    from. `shape` is how states are laid out: (rows, cols), or (1, S) off the grid.
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
    weights: Vector
    posterior: Posterior | None = None

    def __post_init__(self) -> None:
        for array in (self.reward, self.policy, self.visitation, self.weights):
            read_only(array)

    def to_json(self) -> dict[str, Any]:
        """The result as the API has it: reward and visitation as rows × cols; weights unless they are the reward."""
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
            "weights": None if np.array_equal(self.weights, self.reward) else self.weights.tolist(),
            "posterior": None if self.posterior is None else self.posterior.to_json(),
        }

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Self:
        """The result that `to_json` wrote, now or before there were weights and posteriors."""
        by_square = _value(data["reward"])
        reward = by_square.reshape(-1)
        weights, posterior = data.get("weights"), data.get("posterior")
        return cls(
            learner=data["learner"],
            outcome=Outcome(data["outcome"]),
            sentence=data["sentence"],
            iterations=data["iterations"],
            gap=data["gap"],
            log_likelihood=data["log_likelihood"],
            reward=reward,
            policy=_value(data["policy"]),
            visitation=_value(data["visitation"]).reshape(-1),
            n_left_out=data["n_left_out"],
            shape=by_square.shape,
            spectral_radius=data["spectral_radius"],
            executed_gap=data["executed_gap"],
            weights=reward if weights is None else _value(weights),
            posterior=None if posterior is None else Posterior.from_json(posterior),
        )


def _value(data: Any) -> Any:  # noqa: ANN401 - a number, or lists of them to any depth
    """A list as an array, a number as a float."""
    return np.array(data, dtype=np.float64) if isinstance(data, list) else float(data)


def _rounded(value: Any, digits: int | None) -> Any:  # noqa: ANN401 - as _value
    if digits is None:
        return value
    return [_rounded(one, digits) for one in value] if isinstance(value, list) else float(f"{value:.{digits}g}")
