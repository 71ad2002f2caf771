"""What crosses the wire when learning again at once."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

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
