"""A world in the query of an address, where a person reads and edits it.

    rows=7&cols=9&seed=5&walls=3-5,9&start=1&goals=48,6&painted=12-14:-3.5,20:-1&step_limit=60&rank_by=pairwise&pooled=1

`3-5` are all squares from 3 to 5, `12-14:-3.5` paints each of them. static/js/worlds/query.js writes the same;
tests/core/world_queries.json holds both to one table. Reading never raises: what could not be read is said field by
field, and the rest is kept, so that the editor can show it.
"""

import itertools
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

from starlette.datastructures import QueryParams

from app.config import WAYS
from app.worlds import schemas
from app.worlds.schemas import WorldIn

LONGEST: Final = 60_000
"""Characters of a query. Browsers and proxies begin to refuse addresses not far beyond."""

_WHOLE = re.compile(r"-?[0-9]{1,16}")
_NUMBER = re.compile(r"-?(?:[0-9]{1,16}(?:\.[0-9]{0,340})?|\.[0-9]{1,340})(?:[eE]-?[0-9]{1,3})?")
_SQUARES = re.compile(r"([0-9]{1,6})(?:-([0-9]{1,6}))?")


class _Unreadable(ValueError):
    """What the text would have to be."""


@dataclass(frozen=True, slots=True)
class WorldQuery:
    """What an address asks for: the parts that could be read, and what was wrong with the others."""

    text: str
    spec: Mapping[str, Any]
    problems: Mapping[str, str]
    asks_for_a_world: bool

    @property
    def problem(self) -> str:
        """What is wrong, for people; empty if nothing is."""
        if "query" in self.problems or not self.problems:
            return self.problems.get("query", "")
        return f"This address describes no world: {'; '.join(one.rstrip('.') for one in self.problems.values())}."

    @property
    def to_mend(self) -> str:
        """The address of the editor with all this in it, to be mended there."""
        return "/worlds/new" if len(self.text) > LONGEST else f"/worlds/new?{self.text}"

    def to_world_in(self) -> WorldIn:
        """Return what the API would be asked."""
        return WorldIn(**self.spec)


def read_query(text: str) -> WorldQuery:
    """Read what stands behind the ? of an address; names it does not know are passed over."""
    if len(text) > LONGEST:
        sentence = f"This address is too long: {len(text):,} characters, where {LONGEST:,} can be read."
        return WorldQuery(text, {}, {"query": f"{sentence} Paint or wall fewer squares, or whole rows of them."}, True)
    given = QueryParams(text)
    spec: dict[str, Any] = {}
    problems: dict[str, str] = {}
    for name, read in _READERS.items():
        try:
            told = _once(given.getlist(name))
            if told:
                spec[name] = read(told)
        except _Unreadable as unreadable:
            problems[name] = f"{name} {unreadable}."
    if ("rows" in spec) != ("cols" in spec) and not {"rows", "cols"} & set(problems):
        spec["rows"] = spec["cols"] = spec.get("rows") or spec.get("cols")  # with one side given the world is square
    return WorldQuery(text, spec, problems, bool(spec or problems or "new" in given))


def write_query(spec: Mapping[str, Any]) -> str:
    """Write the query of the world that this body of POST /worlds makes."""
    told = {name: value for name, value in spec.items() if value is not False and value not in (None, [])}
    if "rows" in told or "cols" in told:
        told = {"rows": 7, "cols": 7} | told
    return "&".join(f"{name}={_write(name, told[name])}" for name in _READERS if name in told)


def _once(told: list[str]) -> str:
    """What was told, with the minus that pages show as the one that programs read; an empty text is none."""
    texts = [one.strip().replace("−", "-") for one in told if one.strip()]
    if len(texts) > 1:
        raise _Unreadable("must be given once")
    return texts[0] if texts else ""


def _whole(bounds: tuple[int, int]) -> Callable[[str], int]:
    low, high = bounds

    def read(text: str) -> int:
        if not _WHOLE.fullmatch(text) or not low <= int(text) <= high:
            raise _Unreadable(f"must be a whole number from {low} to {high}")
        return int(text)

    return read


def _real(bounds: tuple[float, float]) -> Callable[[str], float]:
    low, high = bounds

    def read(text: str) -> float:
        if not _NUMBER.fullmatch(text) or not low <= float(text) <= high:
            raise _Unreadable(f"must be a number from {low:g} to {high:g}, such as {(low + high) / 2:g}")
        return float(text) + 0.0  # −0 is 0

    return read


def _squares(*, most: int) -> Callable[[str], list[int]]:
    def read(text: str) -> list[int]:
        found: list[int] = []
        for part in _parts(text):
            found += _stretch(part)
            if len(found) > most:
                raise _Unreadable(f"must name at most {most} squares")
        return found

    return read


def _painted(text: str) -> list[list[int | float]]:
    found: dict[int, float] = {}
    for part in _parts(text):
        squares, colon, reward = part.partition(":")
        if not colon or not _NUMBER.fullmatch(reward.strip()):
            raise _Unreadable("must be squares with their rewards, such as 12-14:-3.5,20:-1")
        pays = _reward(reward.strip())
        for square in _stretch(squares.strip()):
            if square in found:
                raise _Unreadable(f"must name each square once; {square} is there twice")
            found[square] = pays
    return [[square, pays] for square, pays in found.items()]


def _reward(text: str) -> float:
    low, high = schemas.REWARD[0], schemas.GOAL_REWARD[1]
    if not low <= float(text) <= high:
        raise _Unreadable(f"must pay {low:g} to 0 on an ordinary square, 0 to {high:g} on a goal")
    return float(text) + 0.0


def _way(text: str) -> str:
    if text not in WAYS:
        raise _Unreadable(f"must be {', '.join(WAYS[:-1])} or {WAYS[-1]}")
    return text


def _flag(text: str) -> bool:
    if text not in {"0", "1"}:
        raise _Unreadable("must be 1 for yes or 0 for no")
    return text == "1"


def _parts(text: str) -> Iterator[str]:
    return (part for part in map(str.strip, text.split(",")) if part)


def _stretch(text: str) -> range:
    """`3-5` or `9`."""
    found = _SQUARES.fullmatch(text)
    if not found:
        raise _Unreadable("must name squares by their numbers, such as 3-5,9")
    first, last = int(found[1]), int(found[2] or found[1])
    if last < first:
        raise _Unreadable(f"must count upwards: {last}-{first}, not {first}-{last}")
    if last > schemas.SQUARE[1]:
        raise _Unreadable(f"must name squares from 0 to {schemas.SQUARE[1]}; {last} is in no world")
    return range(first, last + 1)


_READERS: Final[Mapping[str, Callable[[str], Any]]] = {
    "rows": _whole(schemas.SIDE),
    "cols": _whole(schemas.SIDE),
    "seed": _whole(schemas.SEED),
    "red_probability": _real(schemas.RED_PROBABILITY),
    "slip": _real(schemas.SLIP),
    "walls": _squares(most=schemas.MOST_WALLS),
    "start": _whole(schemas.SQUARE),
    "goals": _squares(most=schemas.MOST_GOALS),
    "painted": _painted,
    "step_limit": _whole(schemas.STEP_LIMIT),
    "time_limit_s": _whole(schemas.TIME_LIMIT_S),
    "rank_by": _way,
    "pooled": _flag,
}
"""Every field of WorldIn, in the order in which an address has them."""


def _write(name: str, value: Any) -> str:  # noqa: ANN401 - any field of WorldIn
    if name == "painted":
        return ",".join(f"{_span(run)}:{_number(pays)}" for run, pays in _runs(value))
    if isinstance(value, str):
        return value
    if value is True:
        return "1"
    if isinstance(value, list):
        return ",".join(_span(run) for run, _ in _runs((square, None) for square in value))
    return _number(value)


def _runs(squares: Iterable[tuple[int, Any]]) -> Iterator[tuple[list[int], Any]]:
    """Stretches of squares that follow one another and share a reward."""
    numbered = enumerate(squares)
    for (_, value), run in itertools.groupby(numbered, lambda one: (one[1][0] - one[0], one[1][1])):
        yield [square for _, (square, _) in run], value


def _span(run: list[int]) -> str:
    return str(run[0]) if len(run) == 1 else f"{run[0]}-{run[-1]}"


def _number(value: float) -> str:
    """Write it short: 3 rather than 3.0, 1e-7 rather than 1e-07."""
    return repr(value).removesuffix(".0").replace("e-0", "e-")
