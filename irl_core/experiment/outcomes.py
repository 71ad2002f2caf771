"""What happened in one world of an experiment. JSON both ways; a figure that does not exist is null there, NaN here."""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any, Final, Literal, Self, TypeAlias

Measure: TypeAlias = Literal["episodes", "soft", "greedy"]
MEASURES: Final[tuple[Measure, ...]] = ("episodes", "soft", "greedy")
"""Mean of the played episodes; exact expected return of the policy; of the greedy plan under the learned reward."""


@dataclass(frozen=True)
class LearnerOutcome:
    """How a learner ended in a world and what its policy earns there, in points of reward.

    `outcome` is one of `irl_core.Outcome`, or "refused" where the learner raised an error, whose words `refusal` keeps.
    """

    outcome: str
    iterations: int
    gap: float
    mean_return: float
    expected_return: float
    greedy_return: float
    refusal: str = ""

    def score(self, measure: Measure) -> float:
        """The return by this measure."""
        return {"episodes": self.mean_return, "soft": self.expected_return, "greedy": self.greedy_return}[measure]

    @classmethod
    def refused(cls, words: str) -> Self:
        """The outcome of a learner that could not learn here."""
        return cls("refused", 0, math.nan, math.nan, math.nan, math.nan, refusal=words)

    def to_json(self) -> dict[str, Any]:
        """Every field by its name."""
        return {name: finite_or_none(value) for name, value in asdict(self).items()}

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Self:
        """The outcome that `to_json` wrote."""
        values: dict[str, Any] = {name: math.nan if value is None else value for name, value in data.items()}
        return cls(**values)


@dataclass(frozen=True)
class WorldOutcome:
    """One world, its demonstrator's attempts, and its learners.

    `world_seed` makes the world again (`generate_world`); `n_redrawn` worlds before it were given up because this kind
    of demonstrator never failed or never succeeded there. `totals` are those of the demonstrations.
    """

    demonstrator: str
    index: int
    world_seed: int
    n_redrawn: int
    n_attempts: int
    optimum: float
    totals: tuple[float, ...]
    learners: Mapping[str, LearnerOutcome]

    @property
    def human_mean(self) -> float:
        """What the demonstrations earned on average."""
        return math.fsum(self.totals) / len(self.totals)

    @property
    def best_attempt(self) -> float:
        """What the best demonstration earned."""
        return max(self.totals)

    def to_json(self) -> dict[str, Any]:
        """Every field by its name."""
        plain = {one.name: getattr(self, one.name) for one in fields(self)}
        learners = {name: one.to_json() for name, one in self.learners.items()}
        return plain | {"totals": list(self.totals), "learners": learners}

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Self:
        """The outcome that `to_json` wrote."""
        learners = {name: LearnerOutcome.from_json(one) for name, one in data["learners"].items()}
        return cls(**(dict(data) | {"totals": tuple(data["totals"]), "learners": learners}))


def finite_or_none(value: object) -> object:
    """None for what JSON cannot write: NaN and infinity."""
    return None if isinstance(value, float) and not math.isfinite(value) else value
