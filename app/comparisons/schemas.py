"""What crosses the wire about comparisons."""

from pydantic import BaseModel, Field


class EntryOut(BaseModel):
    """One of those who are compared."""

    who: str = Field(description="`human`, the name of a learner, or `optimal`.")
    title: str
    mean_return: float = Field(description="Mean total of the episodes; the human's, of all ranked demonstrations.")
    standard_error: float
    interval_low: float | None = Field(
        None, description="95 % interval of the mean (Student's t); null for one episode."
    )
    interval_high: float | None = None
    success_rate: float | None = Field(
        None, description="Share of the episodes that reached a goal with a total of at least 0."
    )
    mean_steps: float | None = None
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


class HumanAttemptsOut(BaseModel):
    """Two of the human's demonstrations, by id; of equals the earliest."""

    best: str
    mean: str = Field(description="The one whose total lies nearest the mean of all.")


class PairedTestOut(BaseModel):
    """How much more one learner earned than another, episode by episode: episode k of both drew the same numbers."""

    a: str
    b: str
    mean_difference: float = Field(description="Of a's totals minus b's.")
    low: float | None = Field(description="95 % interval of the mean difference (Student's t).")
    high: float | None
    p_value: float = Field(description="Two-sided sign-flip permutation test; exact where at most 13 episodes differ.")
    p_adjusted: float = Field(description="Holm's, over all pairs of this comparison.")


class ComparisonOut(BaseModel):
    """The human, the learners and the optimum in one world. Comparisons of earlier versions lack what may be null."""

    run_id: str
    seed: int = Field(description="Episode k of everyone draws the same numbers, from this seed.")
    horizon: int
    entries: list[EntryOut] = Field(description="Sorted by place.")
    human: HumanAttemptsOut | None = None
    value_lost: dict[str, list[float]] | None = Field(
        None,
        description="For each learner V*(s) − V^π(s) of every square with `horizon` steps to go; 0 at goals and where "
        "nobody can come.",
    )
    value_lost_scale: float | None = Field(
        None, description="Where a common scale ends: the largest loss, at most the largest V*(s)."
    )
    tests: list[PairedTestOut] | None = Field(None, description="Every two learners, in the order of the run.")


class RolloutOut(BaseModel):
    """One episode."""

    states: list[int]
    total: float
    reached_goal: bool
