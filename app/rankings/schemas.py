"""What crosses the wire about rankings."""

from datetime import datetime
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, FailFast, Field

from app.config import Way
from app.demonstrations.schemas import Id
from app.rankings.events import MOST_EVENTS, Event, Groups, Version

MOST_SENT = 500
"""Events in one body of the log."""


class EventsIn(BaseModel):
    """What happened in a sitting, in order."""

    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        json_schema_extra={
            "examples": [
                {
                    "events": [
                        {
                            "n": 1,
                            "at_ms": 5120.4,
                            "type": "place",
                            "means": "key",
                            "outcome": "success",
                            "id": "8f14e45f-ceea-467f-a1d2-0c6f1f9b2a11",
                            "group": 0,
                            "joins": False,
                        }
                    ]
                }
            ]
        },
    )

    events: Annotated[list[Event], FailFast()] = Field(
        min_length=1,
        max_length=MOST_SENT,
        description="Numbered without a gap; those that are stored already may be among them.",
    )


class LogOut(BaseModel):
    """How much of a sitting is stored."""

    id: str
    n_events: int = Field(description="Events 0 … n_events − 1 are stored.")


class SittingIn(BaseModel):
    """The sitting in which an order is confirmed."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    id: Id = Field(description="A UUID made by the client.")
    events: Annotated[list[Event], FailFast()] = Field(
        max_length=MOST_EVENTS,
        description="Its events that may not be stored yet; they are stored with the order. The last event of the"
        " sitting is the confirm of this list.",
    )


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

    order: Groups = Field(
        description="Groups in display order: best success first, worst failure first. A group of several is a tie."
    )
    confirmed: bool = Field(strict=True, description="The person said that this is their order.")
    based_on: Version | None = Field(
        default=None,
        description="The version that the person saw count (0: none); refused if another counts by now, unless that was"
        " confirmed earlier in the same sitting.",
    )
    untouched: bool = Field(
        default=False, strict=True, description="They said that the order drawn at random, as it stands, is theirs."
    )
    sitting: SittingIn | None = Field(
        default=None, description="How they came to it. The order must be the one that its events lead to."
    )


class RankingOut(BaseModel):
    """A confirmed order."""

    outcome: str
    order: list[list[str]]
    version: int = Field(description="1 for the first order confirmed, 2 for the next …; the newest counts.")
    confirmed: bool = True
    weights: dict[str, float] = Field(description="θ of each demonstration; they sum to 1.")
    start_order: list[str] = Field(description="The order that was shown first, drawn at random.")
    created_at: datetime
    way: Way = Field(description='How the person said it: "lists", "pairwise", "magnitude" or "segments".')
    given: list[dict[str, Any]] | dict[str, list[dict[str, Any]]] | None = Field(
        description="What they said: answers (pairwise), gaps (magnitude), or the stretches of each attempt (segments)."
    )
    sitting_id: str | None = Field(description="The sitting in which it was confirmed, if its log was sent.")
    n_events: int | None = Field(description="The first so many events of that sitting lead to this order.")
    untouched: bool | None = Field(description="Nothing in this list was changed in that sitting.")
    counts: bool = Field(description="The newest version, which is learned from.")


class RankingsOut(BaseModel):
    """The newest order of each outcome."""

    success: RankingOut | None
    failure: RankingOut | None


class AgreementOut(BaseModel):
    """How far an order agrees with the true totals."""

    version: int = Field(description="The version compared: the newest.")
    tau_b: float | None = Field(
        description="Kendall's τ-b: 1 the same order, 0 none, −1 upside down; null where nothing can be told apart."
    )
    n_pairs: int = Field(description="How many pairs there are.")
    n_agreeing: int = Field(description="Pairs that stand the right way round.")
    n_swapped: int = Field(description="Pairs that stand the wrong way round.")
    n_tied: int = Field(description="Pairs tied in the order, or of the same total.")
    swapped: list[tuple[str, str]] = Field(
        description="[[above, below], …]: the lower one belongs above; those whose totals differ most come first."
    )
