"""Small checks of outside data, shared by worlds, settings and files. Each answers with the value or a sentence."""

import math
from typing import SupportsFloat, SupportsIndex, TypeGuard

import numpy as np

MAX_ID_LENGTH = 200


class Refused(ValueError):
    """What is wrong with a value, in words; the caller adds which value it was."""


def whole_number(value: object, *, minimum: int, maximum: int) -> int:
    """An int within bounds; booleans, floats and strings are refused."""
    if not is_integer(value) or not minimum <= int(value) <= maximum:
        raise Refused(f"must be a whole number from {minimum} to {maximum}, not {shown(value)}")
    return int(value)


def real_number(value: object, *, minimum: float = -math.inf, maximum: float = math.inf, above: bool = False) -> float:
    """A finite float within bounds; `above` leaves the minimum itself out."""
    number = finite(value)
    too_low = number is not None and (number <= minimum if above else number < minimum)
    if number is None or too_low or number > maximum:
        raise Refused(f"must be a finite number {_range(minimum, maximum, above=above)}, not {shown(value)}")
    return number


def identifier(value: object) -> str:
    """A non-empty string that can be written as UTF-8."""
    if not isinstance(value, str) or not 0 < len(value) <= MAX_ID_LENGTH or not _is_utf8(value):
        raise Refused(f"must be a text of 1 to {MAX_ID_LENGTH} characters, not {shown(value)}")
    return value


def finite(value: object) -> float | None:
    """The value as a float, or None unless it is a finite number (a boolean is none)."""
    if isinstance(value, bool | np.bool_ | str | bytes) or not isinstance(value, SupportsFloat):
        return None
    try:
        number = float(value)
    except (OverflowError, TypeError, ValueError):
        return None
    return number if math.isfinite(number) else None


def is_integer(value: object) -> TypeGuard[SupportsIndex]:
    """An int or a NumPy integer, and no boolean."""
    return isinstance(value, int | np.integer) and not isinstance(value, bool)


def shown(value: object) -> str:
    """A value as an error message shows it: short and printable."""
    if isinstance(value, int) and not isinstance(value, bool) and abs(value) > 10**18:
        return "a number of more than 18 digits"
    if value is not None and not isinstance(value, str | bool | SupportsFloat):
        return f"a {type(value).__name__}"
    text = ascii(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _range(minimum: float, maximum: float, *, above: bool) -> str:
    if math.isinf(minimum) and math.isinf(maximum):
        return "of any size"
    if math.isinf(maximum):
        return f"{'above' if above else 'of at least'} {minimum:g}"
    return f"{'above' if above else 'from'} {minimum:g} {'and at most' if above else 'to'} {maximum:g}"


def _is_utf8(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True
