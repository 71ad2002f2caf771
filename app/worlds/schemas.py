"""What crosses the wire about worlds."""

from typing import Annotated, Any, Final

from pydantic import AfterValidator, BaseModel, ConfigDict, FailFast, Field
from pydantic_core import PydanticCustomError

from app.config import Way

SIDE: Final = (2, 100)
SEED: Final = (0, 2**53 - 1)
"""Up to the largest whole number that JavaScript and Python write alike."""
RED_PROBABILITY: Final = (0.0, 1.0)
SLIP: Final = (0.0, 0.9)
SQUARE: Final = (0, SIDE[1] ** 2 - 1)
REWARD: Final = (-7.0, 0.0)
GOAL_REWARD: Final = (0.0, 200.0)
STEP_LIMIT: Final = (1, 2 * SIDE[1] ** 2)
TIME_LIMIT_S: Final = (5, 3600)
MOST_GOALS: Final = 100
MOST_WALLS: Final = SIDE[1] ** 2 - 2
"""One square for the start and one for a goal stay open."""


def _without_minus_zero(value: float) -> float:
    """−0.0 and 0.0 are one number and must give one id."""
    return value + 0.0


def _each_once(painted: list[tuple[int, float]]) -> list[tuple[int, float]]:
    seen: set[int] = set()
    for square, _ in painted:
        if square in seen:
            raise PydanticCustomError(
                "painted_twice", "must name each square once; {square} is there twice", {"square": square}
            )
        seen.add(square)
    return painted


def _whole(bounds: tuple[int, int]) -> Any:  # noqa: ANN401 - what Annotated takes
    return Field(ge=bounds[0], le=bounds[1], strict=True)


def _real(bounds: tuple[float, float]) -> Any:  # noqa: ANN401 - as _whole
    return Field(ge=bounds[0], le=bounds[1], strict=True, allow_inf_nan=False)


Probability = Annotated[float, _real(RED_PROBABILITY), AfterValidator(_without_minus_zero)]
Slip = Annotated[float, _real(SLIP), AfterValidator(_without_minus_zero)]
Size = Annotated[int, _whole(SIDE)]
Seed = Annotated[int, _whole(SEED)]
Square = Annotated[int, _whole(SQUARE)]
Reward = Annotated[float, _real((REWARD[0], GOAL_REWARD[1])), AfterValidator(_without_minus_zero)]


class WorldIn(BaseModel):
    """What a world is generated from; everything has a default."""

    model_config = ConfigDict(
        extra="forbid", frozen=True, json_schema_extra={"examples": [{"rows": 7, "cols": 7, "seed": 5}]}
    )

    rows: Size = Field(default=7, description="Rows, 2 to 100.")
    cols: Size = Field(default=7, description="Columns, 2 to 100.")
    seed: Seed | None = Field(
        default=None,
        description="Gives exactly that world. Without it the server draws one in which a success is possible.",
    )
    red_probability: Probability = Field(default=0.3, description="The probability that a square is red.")
    slip: Slip = Field(default=0.0, description="The probability that a step goes another way than intended.")
    walls: Annotated[list[Square], FailFast()] = Field(
        default=[], max_length=MOST_WALLS, description="Squares (row · cols + col) that cannot be entered."
    )
    start: Square = Field(default=0, description="The square where every attempt begins.")
    goals: list[Square] | None = Field(
        default=None,
        min_length=1,
        max_length=MOST_GOALS,
        description="Squares where an attempt ends; each pays rows + cols. Default: the last square.",
    )
    painted: Annotated[list[tuple[Square, Reward]], FailFast(), AfterValidator(_each_once)] = Field(
        default=[],
        max_length=SQUARE[1] + 1,
        description="[[square, reward], …]: rewards of your own, −7 to 0, or 0 to 200 for a goal. Not for walls.",
    )
    step_limit: Annotated[int, _whole(STEP_LIMIT)] | None = Field(
        default=None,
        description="The most steps of an attempt, from the shortest way to twice the squares; becomes the horizon.",
    )
    time_limit_s: Annotated[int, _whole(TIME_LIMIT_S)] | None = Field(
        default=None, description="The most seconds of an attempt, 5 to 3600. Default: none."
    )
    rank_by: Way | None = Field(
        default=None,
        description="How attempts are ordered here: lists, pairwise, magnitude or segments. Default: as people like.",
    )
    pooled: Annotated[bool, Field(strict=True)] = Field(
        default=False,
        description="Whether the comparisons of all who play here are pooled, without names, in /results?world=.",
    )


class WorldOut(BaseModel):
    """A world: its squares are numbered row by row from 0."""

    id: str = Field(description="Made from the parameters: the same world always has the same id.")
    rows: int
    cols: int
    start: int = Field(description="The square where every attempt begins.")
    goal: int = Field(description="The first square where it ends.")
    goals: list[int] = Field(description="All squares where it ends.")
    walls: list[int] = Field(description="Squares that cannot be entered.")
    rewards: list[list[float]] = Field(description="rows × cols: the reward of reaching each square.")
    colours: list[list[str]] = Field(description='rows × cols: "red", "blue", "goal" or "wall".')
    seed: int | None = Field(description="Gives this world again, with the other parameters.")
    red_probability: float | None = Field(description="The probability with which each square was made red.")
    slip: float = Field(description="The probability that a step goes in one of the three other directions.")
    horizon: int = Field(description="The most steps an attempt may have, and the horizon of planning.")
    time_limit_s: int | None = Field(description="The most seconds an attempt may last, or null.")
    rank_by: Way | None = Field(description="The one way to put attempts in order here, or null: as people like.")
    pooled: bool = Field(description="Whether everybody's comparisons in this world are pooled, without names.")
    success_possible: bool = Field(description="Whether any attempt can reach the goal with a total of 0 or more.")
    spec: dict[str, Any] = Field(description="The smallest body of POST /worlds that makes this world again.")
