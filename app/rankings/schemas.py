"""What crosses the wire about rankings."""

from datetime import datetime
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, FailFast, Field

from app.demonstrations.schemas import Id

MOST_RANKED = 200

Outcome = Literal["success", "failure"]
Group = Annotated[list[Id], FailFast(), Field(min_length=1, max_length=MOST_RANKED)]


class RankingIn(BaseModel):
    """An order as the person left it."""

    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        json_schema_extra={
            "examples": [
                {
                    "order": [
                        ["8f14e45f-ceea-467f-a1d2-0c6f1f9b2a11"],
                        ["45c48cce-2e2d-4fbd-aa1a-fc51c7c6ad26", "d3d94468-02a4-4259-b55d-38e6d163e820"],
                    ],
                    "confirmed": True,
                }
            ]
        },
    )

    order: Annotated[list[Group], FailFast()] = Field(
        max_length=MOST_RANKED,
        description="Groups in display order: best success first, worst failure first. A group of several is a tie.",
    )
    confirmed: bool = Field(strict=True, description="The person said that this is their order.")


class RankingOut(BaseModel):
    """A confirmed order."""

    outcome: str
    order: list[list[str]]
    version: int = Field(description="1 for the first order confirmed, 2 for the next …; the newest counts.")
    confirmed: bool = True
    weights: dict[str, float] = Field(description="θ of each demonstration; they sum to 1.")
    start_order: list[str] = Field(description="The order that was shown first, drawn at random.")
    created_at: datetime


class RankingsOut(BaseModel):
    """The newest order of each outcome."""

    success: RankingOut | None
    failure: RankingOut | None
