"""Checks of what a World is made from; each answers with the value as the World keeps it, or raises InvalidWorld."""

from collections.abc import Iterable, Sequence
from typing import Any, Final

import numpy as np

from irl_core.arrays import Matrix, read_only
from irl_core.checks import Refused, is_integer, real_number, shown, whole_number
from irl_core.errors import InvalidWorld

MAX_REWARD: Final = 1e6


def rewards_of(values: Any, *, rows: int, cols: int) -> Matrix:  # noqa: ANN401 - outside data
    """Rewards as a read-only copy; every number finite and at most a million in size."""
    if isinstance(values, np.ndarray):
        values = values.tolist()
    if not is_list(values) or len(values) != rows or not all(is_list(row) and len(row) == cols for row in values):
        raise InvalidWorld(f"rewards must be {rows} rows of {cols} numbers.", field="rewards")
    for row, numbers in enumerate(values):
        for col, number in enumerate(numbers):
            try:
                real_number(number, minimum=-MAX_REWARD, maximum=MAX_REWARD)
            except Refused as refused:
                raise InvalidWorld(f"rewards[{row}][{col}] {refused}.", field="rewards") from None
    rewards: Matrix = np.array(values, dtype=np.float64)
    read_only(rewards)
    return rewards


def squares_of(name: str, values: Iterable[int], *, n_states: int) -> tuple[int, ...]:
    """Numbers of squares, none twice."""
    if not is_list(values):
        raise InvalidWorld(f"{name} must be a list of square numbers, not {shown(values)}.", field=name)
    listed = [square_of(name, value, n_states=n_states) for value in values]
    if len(set(listed)) < len(listed):
        raise InvalidWorld(f"{name} names a square twice.", field=name)
    return tuple(listed)


def square_of(name: str, value: object, *, n_states: int) -> int:
    """The number of a square."""
    if not is_integer(value) or not 0 <= int(value) < n_states:
        raise InvalidWorld(
            f"{name} must name squares of this world by their whole numbers, 0 to {n_states - 1}, not {shown(value)}.",
            field=name,
        )
    return int(value)


def place(square: int, *, cols: int) -> str:
    """A square in words, as a person counts: square 12 (row 2, column 6)."""
    return f"square {square} (row {square // cols + 1}, column {square % cols + 1})"


def whole(name: str, value: object, *, minimum: int, maximum: int) -> int:
    """An int within bounds, the field's name in the refusal."""
    try:
        return whole_number(value, minimum=minimum, maximum=maximum)
    except Refused as refused:
        raise InvalidWorld(f"{name} {refused}.", field=name) from None


def real(name: str, value: object, *, minimum: float, maximum: float) -> float:
    """A finite float within bounds, the field's name in the refusal."""
    try:
        return real_number(value, minimum=minimum, maximum=maximum)
    except Refused as refused:
        raise InvalidWorld(f"{name} {refused}.", field=name) from None


def is_list(value: object) -> bool:
    """A list, tuple or array; a text is none."""
    return isinstance(value, Sequence | np.ndarray) and not isinstance(value, str | bytes)
