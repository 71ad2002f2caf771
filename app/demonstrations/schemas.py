"""What crosses the wire about demonstrations."""

from datetime import datetime
from typing import Annotated, Any, Literal
from uuid import UUID

from pydantic import BaseModel, BeforeValidator, ConfigDict, FailFast, Field, WithJsonSchema
from pydantic_core import PydanticCustomError

MOST_STEPS = 20_000
"""No world has a longer horizon: 2 · 100 · 100."""
LONGEST_STEP_MS = 86_400_000.0
"""A day: whoever comes back the next morning has left."""

Action = Annotated[int, Field(ge=0, le=3, strict=True)]
StepMs = Annotated[float, Field(ge=0, le=LONGEST_STEP_MS, strict=True, allow_inf_nan=False)]


def _in_one_spelling(value: object) -> object:
    if not isinstance(value, str):
        return value
    try:
        return str(UUID(value))
    except ValueError:
        raise PydanticCustomError("uuid", "must be a UUID") from None


Id = Annotated[str, BeforeValidator(_in_one_spelling), WithJsonSchema({"type": "string", "format": "uuid"})]
"""A UUID in any spelling; from here on lower case with hyphens."""


class DemonstrationIn(BaseModel):
    """An attempt as the browser tells it. What it earned is worked out here."""

    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        json_schema_extra={
            "examples": [
                {
                    "id": "8f14e45f-ceea-467f-a1d2-0c6f1f9b2a11",
                    "actions": [1, 1, 2],
                    "step_ms": [412.5, 180.0, 230.1],
                    "ending": "gave_up",
                }
            ]
        },
    )

    id: Id = Field(description="A UUID made by the client, before the first step; slips depend on it.")
    actions: Annotated[list[Action], FailFast()] = Field(
        max_length=MOST_STEPS, description="0 up, 1 right, 2 down, 3 left."
    )
    step_ms: Annotated[list[StepMs], FailFast()] = Field(
        max_length=MOST_STEPS, description="Milliseconds each step took, one for each action."
    )
    ending: Literal["goal", "gave_up", "out_of_steps"] = Field(description="How the attempt ended.")


class DemonstrationOut(BaseModel):
    """One attempt in one world."""

    id: str
    world_id: str
    states: list[int] = Field(description="The squares visited, the start included: one more than actions.")
    actions: list[int] = Field(description="0 up, 1 right, 2 down, 3 left, as intended; slips show in the states.")
    rewards: list[float] = Field(description="The reward of each square reached.")
    total: float = Field(description="The sum of the rewards.")
    outcome: str = Field(description='"success": reached the goal with total ≥ 0; "failure": everything else.')
    ending: str = Field(description='"goal", "gave_up" or "out_of_steps".')
    step_ms: list[float] | None = Field(description="Milliseconds each step took.")
    discarded: bool = Field(description="Left out of ranking and learning.")
    created_at: datetime = Field(description="When it was first received, in UTC.")
    parent_id: str | None = Field(default=None, description="Reserved: null.")

    @classmethod
    def of(cls, row: Any) -> "DemonstrationOut":  # noqa: ANN401 - a model or a row of the same columns
        """Read a row."""
        return cls(
            id=row.id,
            world_id=row.world_id,
            states=row.states,
            actions=row.actions,
            rewards=row.rewards,
            total=row.total,
            outcome=row.outcome,
            ending=row.ending,
            step_ms=row.step_ms,
            discarded=row.discarded_at is not None,
            created_at=row.created_at,
        )
