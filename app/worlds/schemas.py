"""What crosses the wire about worlds."""

from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict, FailFast, Field, field_validator

LARGEST_SEED = 2**53 - 1
"""The largest whole number that JavaScript and Python write alike."""


def _without_minus_zero(value: float) -> float:
    """−0.0 and 0.0 are one number and must give one id."""
    return value + 0.0


Probability = Annotated[float, Field(ge=0, le=1, strict=True, allow_inf_nan=False), AfterValidator(_without_minus_zero)]
Slip = Annotated[float, Field(ge=0, le=0.9, strict=True, allow_inf_nan=False), AfterValidator(_without_minus_zero)]
Size = Annotated[int, Field(ge=2, le=100, strict=True)]
Seed = Annotated[int, Field(ge=0, le=LARGEST_SEED, strict=True)]
Square = Annotated[int, Field(ge=0, lt=10_000, strict=True)]


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
        default=[], max_length=9_998, description="Squares (row · cols + col) that cannot be entered."
    )


class WorldQuery(BaseModel):
    """The same in the query of a page's address, where every number is text and an empty text is none."""

    model_config = ConfigDict(extra="ignore", frozen=True)

    rows: Annotated[int, Field(ge=2, le=100)] | None = None
    cols: Annotated[int, Field(ge=2, le=100)] | None = None
    seed: Annotated[int, Field(ge=0, le=LARGEST_SEED)] | None = None
    red_probability: Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)] | None = None
    slip: Annotated[float, Field(ge=0, le=0.9, allow_inf_nan=False)] | None = None
    new: str | None = Field(default=None, description="Given in any form: a fresh world, please.")

    @field_validator("rows", "cols", "seed", "red_probability", "slip", mode="before")
    @classmethod
    def _empty_is_none(cls, text: object) -> object:
        return None if text == "" else text

    @property
    def asks_for_a_world(self) -> bool:
        """Whether anything was asked for."""
        return bool(self.model_dump(exclude_none=True))

    def to_world_in(self) -> WorldIn:
        """Return what the API would be asked; with one side given the world is square."""
        told = self.model_dump(exclude_none=True, exclude={"new"})
        sides = {"rows": self.rows or self.cols, "cols": self.cols or self.rows} if self.rows or self.cols else {}
        return WorldIn(**(told | sides))


class WorldOut(BaseModel):
    """A world: its squares are numbered row by row from 0."""

    id: str = Field(description="Made from the parameters: the same world always has the same id.")
    rows: int
    cols: int
    start: int = Field(description="The square where every attempt begins.")
    goal: int = Field(description="The square where it ends.")
    goals: list[int] = Field(description="All squares where it ends.")
    walls: list[int] = Field(description="Squares that cannot be entered.")
    rewards: list[list[float]] = Field(description="rows × cols: the reward of reaching each square.")
    colours: list[list[str]] = Field(description='rows × cols: "red", "blue", "goal" or "wall".')
    seed: int | None = Field(description="Gives this world again, with the other parameters.")
    red_probability: float | None = Field(description="The probability with which each square was made red.")
    slip: float = Field(description="The probability that a step goes in one of the three other directions.")
    horizon: int = Field(description="The most steps an attempt may have, and the horizon of planning.")
    success_possible: bool = Field(description="Whether any attempt can reach the goal with a total of 0 or more.")
