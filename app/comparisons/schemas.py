"""What crosses the wire about comparisons."""

from pydantic import BaseModel, Field


class EntryOut(BaseModel):
    """One of those who are compared."""

    who: str = Field(description="`human`, the name of a learner, or `optimal`.")
    title: str
    mean_return: float = Field(description="Mean total of the episodes; the human's, of all ranked demonstrations.")
    standard_error: float
    expected_return: float | None = Field(
        description="Exact, from the start over `horizon` steps, of the policy that is executed; null for the human."
    )
    greedy_return: float | None = Field(
        description="Exact, of the best path to a goal under the learned reward; null for the human."
    )
    share_of_optimum: float | None = Field(
        description="expected_return (the human's: mean_return) over the optimum's; null where that is not positive."
    )
    place: int = Field(
        description="1 is best, by expected return (the human's: mean return); ties share the better place."
    )
    episodes: int


class ComparisonOut(BaseModel):
    """The human, the learners and the optimum in one world."""

    run_id: str
    seed: int
    horizon: int
    entries: list[EntryOut] = Field(description="Sorted by place.")


class RolloutOut(BaseModel):
    """One episode."""

    states: list[int]
    total: float
    reached_goal: bool
