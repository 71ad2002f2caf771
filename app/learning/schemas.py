"""What crosses the wire when learning."""

from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

LARGEST_SEED = 2**53 - 1
"""The largest whole number that JavaScript holds exactly."""

Word = Annotated[str, Field(pattern=r"^[A-Za-z_]{1,40}$")]
"""The name of a setting, or its value where that is a word: irl_core's refusals repeat both."""


class RunIn(BaseModel):
    """What to learn with. Everything may be left out."""

    model_config = ConfigDict(extra="forbid", strict=True)

    learners: Annotated[
        list[Annotated[str, Field(max_length=40)]],
        Field(
            min_length=1,
            max_length=20,
            description="Names of learners, in the order in which they shall learn; if left out, those that the learn"
            " page chooses: the paper's four and Bayesian IRLFR.",
        ),
    ] = []
    settings: Annotated[
        dict[Word, int | float | Word],
        Field(
            max_length=40,
            description="Settings that differ from the defaults, by name: see `settings` on the learn page.",
        ),
    ] = {}
    seed: Annotated[
        int | None,
        Field(ge=0, le=LARGEST_SEED, description="For the start weights and the episodes; drawn if left out."),
    ] = None


class RunOut(BaseModel):
    """A run as it stands."""

    id: str
    world_id: str
    is_own: bool = Field(description="You asked for it; otherwise you see it by a link that was shared.")
    status: Literal["queued", "running", "done", "failed", "cancelled"]
    reason: str | None = Field(description="Why it failed, in words.")
    ahead: int | None = Field(description="How many runs come before it; null unless it is queued.")
    worker: Literal["ready", "warming", "none"] = Field(
        description="Whether a worker takes runs, still compiles what it needs, or is missing."
    )
    seed: int
    settings: dict[str, Any]
    learners: dict[str, dict[str, Any]] = Field(
        description="By name: outcome, sentence, iterations, gap, log_likelihood, reward[rows][cols], "
        "policy[rows·cols][4] (the one that is executed), visitation[rows][cols], weights of the features (null where "
        "they are the reward), posterior (null but for Bayesian learners); outcome is null until then."
    )
    compute_ms: dict[str, float] = Field(
        description="How long each learner has computed, in milliseconds; beside the results, which are the same again."
    )
    n_demonstrations: int
    n_left_out: int = Field(description="Failures that never reached the goal and were not learned from.")
    versions: dict[str, str]
    created_at: datetime
    started_at: datetime | None
    finished_at: datetime | None


class FramesOut(BaseModel):
    """What the learners of a run have shown of themselves so far."""

    run_id: str
    frames: list[dict[str, Any]] = Field(
        description="As in the stream, with `number`: learner, iteration, iterations, compute_ms, gap, log_likelihood, "
        "reward[S], policy[S][4], visitation[S]."
    )
    last: int = Field(description="Ask again with `after` = this for what has come since.")


class ShareOut(BaseModel):
    """A link that opens a run to whoever has it."""

    key: str
    address: str = Field(description="The page of the comparison, on this server.")
    created_at: datetime
