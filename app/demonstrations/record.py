"""What is measured about the playing of an attempt, as the browser sends it. docs/codebook.md tells it to researchers.

Every list of steps has one entry for each action; times are milliseconds of a clock that never goes back.
"""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, FailFast, Field

MOST_STEPS = 20_000
"""No world has a longer horizon: 2 · 100 · 100."""
MOST_EVENTS = 5_000
MOST_ABANDONED = 200
LONGEST_MS = 366 * 86_400_000.0
"""A year: no page stays open longer."""

Ms = Annotated[float, Field(ge=0, le=LONGEST_MS, strict=True, allow_inf_nan=False)]
Count = Annotated[int, Field(ge=0, strict=True)]
Flag = Annotated[bool, Field(strict=True)]
Device = Literal["key", "hold", "pad", "swipe", "tap", "gamepad", "copied"]
EventType = Literal["undo", "blur", "focus", "hidden", "visible", "resumed", "clock", "numbers", "look"]


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Event(_Part):
    """Something that happened during an attempt beside its steps."""

    type: EventType = Field(description="What happened.")
    at_ms: Ms = Field(description="When, in milliseconds since the attempt began.")
    step: Annotated[Count, Field(le=MOST_STEPS)] = Field(description="How many steps stood when it happened.")
    value: Annotated[float, Field(ge=-1e15, le=1e15, strict=True, allow_inf_nan=False)] | None = Field(
        default=None, description="What the type says more, such as the action that was taken back."
    )


class Abandoned(_Part):
    """A try that was thrown away by "restart"."""

    n_steps: Annotated[Count, Field(le=MOST_STEPS)] = Field(description="How many steps it had.")
    elapsed_ms: Ms = Field(description="How long it had taken, in milliseconds.")


class Browser(_Part):
    """The browser and the device, by kind."""

    agent: Annotated[str, Field(max_length=100, pattern=r"^[^\x00-\x1f\x7f]*$")] = Field(
        description='The kind of device and browser, such as "desktop Chromium".'
    )
    viewport: Annotated[list[Annotated[Count, Field(le=100_000)]], Field(min_length=2, max_length=2)] = Field(
        description="Width and height of the window's inside, in CSS pixels."
    )
    pixel_ratio: Annotated[float, Field(gt=0, le=1_000, strict=True, allow_inf_nan=False)] = Field(
        description="Pixels of the screen in a CSS pixel."
    )
    refresh_hz: Annotated[float, Field(ge=0, le=10_000, strict=True, allow_inf_nan=False)] | None = Field(
        description="Frames a second, an estimate; null where there was none."
    )
    pointer: Literal["fine", "coarse"] = Field(description='"coarse": a finger, "fine": a mouse.')
    reduced_motion: Flag = Field(description="The person asked their system for less motion.")
    forced_colours: Flag = Field(description="The system forces its own colours.")
    dark: Flag = Field(description="The page was dark.")
    totals_shown: Flag = Field(description="Totals were shown.")


class Client(Browser):
    """The same, with how keys moved."""

    hold_to_move: Flag = Field(description="A key that was held went on moving.")


class Record(_Part):
    """How an attempt was played: reaction times, devices, what happened beside the steps, on what it was played."""

    version: Annotated[int, Field(ge=1, le=1, strict=True)] = Field(description="The layout of this record: 1.")
    rt: Annotated[list[Ms | None], FailFast()] = Field(
        max_length=MOST_STEPS,
        description="Milliseconds from the frame that showed the position before the step to the press; null: pressed"
        " before it was shown, or not measured.",
    )
    device: Annotated[list[Device], FailFast()] = Field(
        max_length=MOST_STEPS,
        description='By what each step was made; "copied": it comes from the parent, or was not measured.',
    )
    events: Annotated[list[Event], FailFast()] = Field(
        max_length=MOST_EVENTS, description="What happened beside the steps, in order."
    )
    elapsed_ms: Ms = Field(
        description="Milliseconds from the attempt's beginning to its end, without those in which its page was closed."
    )
    abandoned: Annotated[list[Abandoned], FailFast()] = Field(
        max_length=MOST_ABANDONED, description="Tries thrown away since the last finished attempt, oldest first."
    )
    client: Client = Field(description="The browser and the device.")
