"""What crosses the wire about demonstrations."""

from datetime import datetime
from typing import Annotated, Any, Literal
from uuid import UUID

from pydantic import BaseModel, BeforeValidator, ConfigDict, FailFast, Field, WithJsonSchema
from pydantic_core import PydanticCustomError

from app.demonstrations.record import MOST_STEPS, Record

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
    ending: Literal["goal", "gave_up", "out_of_steps", "out_of_time"] = Field(
        description='How the attempt ended; "out_of_time" only in a world with a time limit.'
    )
    parent_id: Id | None = Field(
        default=None,
        description="The attempt of yours, in this world, from which this one was tried again: it begins with that"
        " one's first steps, which slip as they did there.",
    )
    parent_step: Annotated[int, Field(ge=1, le=MOST_STEPS, strict=True)] | None = Field(
        default=None, description="How many steps were copied from the parent; given with parent_id."
    )
    record: Record | None = Field(
        default=None,
        description="How it was played: reaction times, devices, events, client; docs/codebook.md has every field.",
    )


class DemonstrationOut(BaseModel):
    """One attempt in one world."""

    id: str
    world_id: str
    states: list[int] = Field(description="The squares visited, the start included: one more than actions.")
    actions: list[int] = Field(description="0 up, 1 right, 2 down, 3 left, as intended; slips show in the states.")
    rewards: list[float] = Field(description="The reward of each square reached.")
    total: float = Field(description="The sum of the rewards.")
    outcome: str = Field(description='"success": reached the goal with total ≥ 0; "failure": everything else.')
    ending: str = Field(description='"goal", "gave_up", "out_of_steps" or "out_of_time".')
    step_ms: list[float] | None = Field(description="Milliseconds each step took.")
    discarded: bool = Field(description="Left out of ranking and learning.")
    created_at: datetime = Field(description="When it was first received, in UTC.")
    parent_id: str | None = Field(description="The attempt from which this one was tried again, if any.")
    parent_step: int | None = Field(description="How many of its steps were copied from the parent.")
    slip_seeds: list[tuple[str, int]] = Field(
        description="Pairs of a seed and the step from which it decides the slips; for an ordinary attempt its id, from"
        " step 0."
    )
    record: dict[str, Any] | None = Field(description="How it was played, as it was sent; null if nothing was.")

    @classmethod
    def of(cls, row: Any, *, with_record: bool = True) -> "DemonstrationOut":  # noqa: ANN401 - a model or the like
        """Read a row. A record is loaded only where it is asked for."""
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
            parent_id=row.parent_id,
            parent_step=row.parent_step,
            slip_seeds=row.slip_seeds,
            record=row.record if with_record else None,
        )
