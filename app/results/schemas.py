"""What crosses the wire about many worlds."""

from datetime import datetime
from typing import Literal

from pydantic import BaseModel, Field


class ProportionOut(BaseModel):
    """How often something happened."""

    count: int
    of: int
    low: float | None = Field(description="95 % interval of the share (Wilson's, by people); null below three units.")
    high: float | None


class ShareOut(BaseModel):
    """What was earned of what the optimum would have earned, all comparisons taken together."""

    value: float | None = Field(description="Null where nothing could be earned.")
    low: float | None = Field(description="95 % interval; null below three units.")
    high: float | None
    method: Literal["t", "bootstrap"] | None = Field(
        description="How the interval was found: Student's t below 20 units, else 2,000 resamples of units."
    )


class StandingOut(BaseModel):
    """One who took part: the human or a learner."""

    who: str = Field(description="`human` or the name of a learner.")
    title: str
    n_comparisons: int = Field(description="In how many of the comparisons they took part.")
    places: list[ProportionOut] = Field(
        description="How often at place 1, 2, … among those who took part, the optimum left out; equals share one."
    )
    share_of_optimum: ShareOut


class DuelOut(BaseModel):
    """Two who were compared with each other."""

    a: str
    b: str
    n_comparisons: int = Field(description="In how many comparisons both took part.")
    wins: int = Field(description="In how many a earned more than b.")
    losses: int
    ties: int
    votes_for: int = Field(description="Units in which a won more often than b: worlds, or people.")
    votes_against: int
    p_value: float = Field(description="Two-sided sign test of the votes.")
    p_adjusted: float = Field(description="Holm's, over all pairs.")


class TableOneRowOut(BaseModel):
    """A row of the paper's Table I."""

    who: str
    title: str
    sentence: str
    places: list[ProportionOut] = Field(description="Among the paper's learners alone; empty for the human.")


class TableOneOut(BaseModel):
    """The paper's Table I: by the mean of played episodes, over comparisons in which its four learners took part."""

    n_comparisons: int
    rows: list[TableOneRowOut]


class WorldEntryOut(BaseModel):
    """One who took part in a comparison of yours."""

    who: str
    title: str
    place: int = Field(description="The optimum left out; equals share the better place.")
    expected_return: float = Field(description="Exact; the human's: the mean of the attempts.")
    mean_return: float = Field(description="Of the played episodes.")
    share_of_optimum: float | None


class WorldResultOut(BaseModel):
    """One of the worlds. In a pooled result no run is named and nobody's entries are shown."""

    world_id: str
    rows: int
    cols: int
    seed: int | None
    pooled: bool
    n_comparisons: int = Field(description="Finished comparisons that count: the latest of each person.")
    n_people_missing: int = Field(description="How many more people it takes before this world is shown; yours: 0.")
    run_id: str | None = None
    finished_at: datetime | None = None
    optimum: float | None = None
    entries: list[WorldEntryOut] = Field(default=[], description="By place; empty in a pooled result.")


class ResultsOut(BaseModel):
    """What many comparisons say together."""

    scope: Literal["own", "pooled"]
    unit: Literal["world", "person"] = Field(description="What is taken as independent: your worlds, or people.")
    n_comparisons: int
    n_units: int
    n_units_needed: int = Field(description="From how many units on there are intervals.")
    headline: str
    remarks: list[str] = Field(description="What a reader should know.")
    standings: list[StandingOut] = Field(description="Who came first most often stands first.")
    duels: list[DuelOut] = Field(description="Each pair once.")
    table_one: TableOneOut | None = Field(description="Null where the paper's four learners never all took part.")
    worlds: list[WorldResultOut] = Field(description="Yours: the newest comparison first. Pooled: as asked for.")
