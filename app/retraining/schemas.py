"""What crosses the wire when learning again at once."""

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from app.demonstrations.schemas import Id
from app.learning.schemas import Word
from app.rankings.events import Groups

Number = Annotated[int, Field(strict=True)] | Annotated[float, Field(strict=True, allow_inf_nan=False)]
LearnerName = Annotated[str, Field(max_length=40, description="The name of a learner.")]


class OrdersIn(BaseModel):
    """Orders as they stand. An outcome that is left out, or empty, has none."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    success: Groups = Field(default=[], description="Groups of the successes kept, best first.")
    failure: Groups = Field(default=[], description="Groups of the failures kept, worst first.")


class PreviewIn(BaseModel):
    """What to learn with, and from which orders."""

    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        json_schema_extra={
            "examples": [
                {
                    "orders": {
                        "success": [
                            ["8f14e45f-ceea-467f-a1d2-0c6f1f9b2a11"],
                            ["45c48cce-2e2d-4fbd-aa1a-fc51c7c6ad26", "d3d94468-02a4-4259-b55d-38e6d163e820"],
                        ]
                    }
                }
            ]
        },
    )

    learner: LearnerName | None = Field(
        default=None, description="If left out: IRLFR where the failures allow it, else IRLR, else whoever can learn."
    )
    settings: Annotated[dict[Word, Number | Word], Field(max_length=40)] = Field(
        default={}, description="Settings that differ from the defaults, by name."
    )
    orders: OrdersIn = Field(description="The orders to learn from, confirmed or not; nothing of them is stored.")


class ChangeIn(BaseModel):
    """One thing that might have been otherwise."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    drop: Id | None = Field(default=None, description="Leave this attempt out.")
    swap: tuple[Id, Id] | None = Field(default=None, description="Let these two of one order trade places.")
    relabel: Id | None = Field(
        default=None,
        description="Call a success a failure, the least bad; or a failure that reached a goal a success, the last.",
    )

    @model_validator(mode="after")
    def _is_one(self) -> Self:
        if len(self.told) != 1:
            message = "must say one change: drop, swap or relabel"
            raise ValueError(message)
        if self.swap is not None and self.swap[0] == self.swap[1]:
            message = "swap must name two attempts, not one twice"
            raise ValueError(message)
        return self

    @property
    def told(self) -> dict[str, Any]:
        """The change, without what it does not say."""
        return self.model_dump(exclude_none=True)


class WhatIfIn(BaseModel):
    """Which learner of the run shall learn again, and from what change."""

    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        json_schema_extra={
            "examples": [{"learner": "irlfr", "change": {"drop": "8f14e45f-ceea-467f-a1d2-0c6f1f9b2a11"}}]
        },
    )

    learner: LearnerName
    change: ChangeIn


class LearnedOut(BaseModel):
    """What a learner came to."""

    learner: str
    title: str
    outcome: str = Field(description="converged, iteration_limit or diverged.")
    sentence: str = Field(description="How it ended, in words.")
    iterations: int
    reward: list[list[float]] = Field(description="The learned reward, rows × cols.")
    policy: list[list[float]] = Field(description="Of each square, the chance of up, right, down, left.")
    visitation: list[list[float]] = Field(description="How often the policy is in each square, rows × cols.")
    compute_ms: float = Field(description="How long the learner itself computed, in milliseconds.")


class ReturnsOut(BaseModel):
    """What a policy earns in the true world."""

    expected_return: float = Field(description="On average, from the start over the world's horizon.")
    greedy_return: float | None = Field(description="By the best plan for the learned reward; null without a reward.")


class DifferenceOut(BaseModel):
    """What came of a change: the new − the old."""

    policy_change: float = Field(description="The share of steps that are taken otherwise, 0 to 1.")
    reward_change: float = Field(description="By how much the learned reward differs, on average over the squares.")
    return_change: float | None = Field(description="Above 0: the change helped.")
    turned: list[int] = Field(description="The squares whose likeliest action is another.")
    reward: list[float] = Field(description="The new reward − the old one of each square.")


class WhatIfOut(ReturnsOut):
    """What a learner would have come to."""

    learner: str
    change: dict[str, Any] = Field(description="The change, as it was told.")
    result: LearnedOut
    before: ReturnsOut
    difference: DifferenceOut
    compute_ms: float = Field(description="How long the learner itself computed, in milliseconds.")


class OneInfluenceOut(BaseModel):
    """What one attempt changed; everything but `sentence` is null where nothing can be learned without it."""

    id: str
    outcome: str
    n_steps: int
    policy_change: float | None = Field(description="The share of steps that would be taken otherwise without it.")
    reward_change: float | None = Field(description="By how much the learned reward would differ, on average.")
    return_change: float | None = Field(description="What it is worth: above 0 where it helped.")
    expected_return: float | None = Field(description="What the policy earns that is learned without it.")
    turned: list[int] | None = Field(description="The squares whose likeliest action would be another without it.")
    sentence: str | None = Field(description="Why nothing can be learned without it.")


class InfluenceOut(BaseModel):
    """What each attempt changed, in the order in which they were played."""

    learner: str
    influences: list[OneInfluenceOut]
    compute_ms: float = Field(description="How long was computed, in milliseconds.")


class UncertaintyOut(BaseModel):
    """How sure a learner can be."""

    learner: str
    method: Literal["posterior", "bootstrap"]
    level: float = Field(description="The share of draws that lie inside the intervals.")
    n_draws: int
    seed: int
    policy_agreement: list[float] = Field(description="The share of draws that agree on the likeliest action.")
    reward_low: list[float] = Field(description="The learned reward of each square, the lower end.")
    reward_high: list[float] = Field(description="The learned reward of each square, the upper end.")
    return_low: float | None = Field(description="What the policy earns, the lower end, in the world's own units.")
    return_high: float | None = Field(description="What the policy earns, the upper end.")
    sentence: str
    compute_ms: float = Field(description="How long was computed, in milliseconds.")
