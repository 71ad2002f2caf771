"""Tables as statistics programs read them: UTF-8, commas, a header row, one line a row."""

import csv
import io
from collections.abc import Iterable
from typing import TypeAlias

Cell: TypeAlias = str | int | float | bool | None

STARTS_A_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def csv_text(rows: Iterable[Iterable[Cell]]) -> str:
    """Write rows; None is an empty cell."""
    text = io.StringIO()
    csv.writer(text).writerows([_cell(value) for value in row] for row in rows)
    return text.getvalue()


def _cell(value: Cell) -> Cell:
    """Write a value as statistics programs read it; no text may begin a formula in a spreadsheet."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str) and value.startswith(STARTS_A_FORMULA):
        return f"'{value}"
    return value
