"""The events of a sitting, as the browser sends them and as they are kept. docs/codebook.md tells them to researchers.

Here is only what an event is made of; what it does, and when it can happen, stands in `replay.py`.
"""

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BaseModel, BeforeValidator, ConfigDict, FailFast, Field
from pydantic_core import PydanticCustomError

from app.config import Way
from app.demonstrations.record import MOST_STEPS, Browser, Count, Flag, Ms
from app.demonstrations.schemas import Id
from app.models.sitting import Means
from app.rankings.content import Outcome

MOST_RANKED = 200
MOST_EVENTS = 20_000
"""In a sitting. The longest day of moving cards comes to a few thousand."""

Group = Annotated[list[Id], FailFast(), Field(min_length=1, max_length=MOST_RANKED)]
Groups = Annotated[list[Group], FailFast(), Field(max_length=MOST_RANKED)]
Ids = Annotated[list[Id], FailFast(), Field(max_length=MOST_RANKED)]
Version = Annotated[int, Field(ge=0, le=2**31, strict=True)]
AwayMs = Annotated[float, Field(ge=0, le=1e15, strict=True, allow_inf_nan=False)]
"""By the calendar's clock, which a person may have put right by years in between: no reason to lose a log."""
Step = Annotated[int, Field(ge=1, le=MOST_STEPS, strict=True)]


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class _Event(_Part):
    n: Annotated[Count, Field(lt=MOST_EVENTS)] = Field(description="Its number in the sitting: 0, 1, 2 …")
    at_ms: Ms = Field(
        description="Milliseconds since the sitting began, by a clock that never goes back; time with the page closed"
        " is left out."
    )
    means: Means = Field(description='By what it was done; "page": by itself; "button": a button, however pressed.')


class _InOneList(_Event):
    outcome: Outcome = Field(description="In which list.")


class Orders(_Part):
    """Both lists."""

    success: Groups = Field(description="Best first.")
    failure: Groups = Field(description="Worst first.")


class Origins(_Part):
    """Where both lists came from."""

    success: Literal["random", "version", "draft"] = Field(description="Where the list of successes came from.")
    failure: Literal["random", "version", "draft"] = Field(description="Where the list of failures came from.")


class Versions(_Part):
    """The confirmed versions on which both lists stood."""

    success: Version = Field(description="Of the successes; 0: none.")
    failure: Version = Field(description="Of the failures; 0: none.")


class Begin(_Event):
    """The sitting began; always the first event."""

    type: Literal["begin"]
    orders: Orders = Field(description="Both lists as they were first shown.")
    from_: Origins = Field(
        alias="from",
        description='"random": drawn by the server; "version": confirmed before; "draft": left unconfirmed before.',
    )
    based_on: Versions = Field(description="The confirmed versions on which the lists stood.")
    way: Way = Field(description="Which way of saying the order was shown.")
    client: Browser = Field(description="The browser and the device.")


class Place(_InOneList):
    """A card was put in another place."""

    type: Literal["place"]
    id: Id = Field(description="The attempt.")
    group: Annotated[Count, Field(le=MOST_RANKED)] = Field(
        description="Where among the other cards, groups counted from 0 at the top: alone before that group, or in it."
    )
    joins: Flag = Field(description="It ties with that group.")


class Swap(_InOneList):
    """Two cards changed places."""

    type: Literal["swap"]
    id: Id = Field(description="The one attempt.")
    with_: Id = Field(alias="with", description="The other.")


class Set(_InOneList):
    """The whole list was put in order at once."""

    type: Literal["set"]
    order: Groups = Field(description="The order after it.")
    by: Literal["score", "pairwise", "segments", "version"] = Field(
        description="By their totals, by the answers, by the stretches, or as in an earlier version."
    )


class Lift(_InOneList):
    """A card was lifted."""

    type: Literal["lift"]
    id: Id = Field(description="The attempt.")


class Drop(_Event):
    """The lifted card was put down."""

    type: Literal["drop"]


class PutBack(_Event):
    """The lifted card was put back to where it came from."""

    type: Literal["put_back"]


class Undo(_Event):
    """A step was taken back."""

    type: Literal["undo"]


class Redo(_Event):
    """A step taken back was done again."""

    type: Literal["redo"]


class Answer(_InOneList):
    """A question about two attempts was answered."""

    type: Literal["answer"]
    a: Id = Field(description="The one attempt.")
    b: Id = Field(description="The other.")
    said: Literal["a", "b", "alike"] = Field(
        description="Which belongs higher (the better success, the worse failure)."
    )


class Gap(_InOneList):
    """It was said how much better (of failures: worse) one attempt is than the next."""

    type: Literal["gap"]
    above: Id = Field(description="The upper attempt.")
    below: Id = Field(description="The lower attempt.")
    value: Annotated[int, Field(ge=1, le=100, strict=True)] | None = Field(
        description="From 1, hardly, to 100, very much; null: taken back."
    )


class Stretch(_Event):
    """Steps of an attempt were marked."""

    type: Literal["stretch"]
    id: Id = Field(description="The attempt.")
    from_: Step = Field(alias="from", description="The first step, counted from 1.")
    to: Step = Field(description="The last step.")
    kind: Literal["good", "bad"] | None = Field(description="How they were; null: the marks were wiped off.")


class Cards(_InOneList):
    """Attempts came, or were discarded, while the page was open."""

    type: Literal["cards"]
    added: Ids = Field(description="New in the list, at its end, each alone.")
    removed: Ids = Field(description="Gone from the list.")


class ChooseWay(_Event):
    """Another way of saying the order was chosen."""

    type: Literal["way"]
    way: Way = Field(description="The way shown from then on.")


class Watch(_Event):
    """An attempt was replayed."""

    type: Literal["watch"]
    id: Id = Field(description="The attempt.")


class Compare(_Event):
    """Two attempts were looked at side by side."""

    type: Literal["compare"]
    a: Id = Field(description="The one attempt.")
    b: Id = Field(description="The other.")
    outcome: Outcome | None = Field(default=None, description="In which list.")


class Hidden(_Event):
    """The page was hidden."""

    type: Literal["hidden"]


class Visible(_Event):
    """The page was visible again."""

    type: Literal["visible"]


class Resumed(_Event):
    """The sitting was taken up again after its page had been closed."""

    type: Literal["resumed"]
    away_ms: AwayMs | None = Field(description="How long it was closed, by the calendar's clock; null: not known.")


class Confirm(_InOneList):
    """The order of a list was confirmed."""

    type: Literal["confirm"]
    untouched: Flag = Field(description="Said to be their order although nothing was moved.")


AnyEvent: TypeAlias = (
    Begin | Place | Swap | Set | Lift | Drop | PutBack | Undo | Redo | Answer | Gap | Stretch | Cards | ChooseWay
    | Watch | Compare | Hidden | Visible | Resumed | Confirm
)  # fmt: skip
EVENTS: dict[str, type[_Event]] = {kind.model_fields["type"].annotation.__args__[0]: kind for kind in AnyEvent.__args__}
"""Every kind of event by its type."""


def _of_a_known_type(value: object) -> object:
    """Refuse others here: pydantic's own words would repeat what was sent."""
    if isinstance(value, dict) and not (isinstance(value.get("type"), str) and value["type"] in EVENTS):
        message = f"must be an event with a type that there is: {', '.join(EVENTS)}"
        raise PydanticCustomError("event_type", message)
    return value


Event = Annotated[
    Annotated[AnyEvent, Field(discriminator="type")],
    BeforeValidator(_of_a_known_type),
]


def as_sent(event: AnyEvent) -> dict[str, Any]:
    """Return an event as JSON, its ids in one spelling: what is stored, compared and replayed."""
    return event.model_dump(by_alias=True, exclude_unset=True)
