"""Demonstration files: worlds, demonstrations and rankings as JSON lines, to learn from elsewhere.

One object a line, with a `kind` and the fields of the API (`id` of a world and `world_id` may be left out if there is
one world):

    {"kind": "world", "id": "w", "rows": 7, "cols": 7, "rewards": [[…], …], "start": 0, "goals": [48], …}
    {"kind": "demonstration", "world_id": "w", "id": "d", "actions": [1, 2, …], "ending": "goal", …}
    {"kind": "ranking", "world_id": "w", "outcome": "success", "order": [["d"], ["e", "f"]], …}

Lines may come in any order; of two rankings of one outcome the later holds, as a later version does. A ranking we
write says besides, for programs elsewhere, what follows from its order: `display_rank` and `paper_index` by id
(weights.py). Every demonstration is played again, with slips by its `slip_seeds` (pairs of a seed and the step from
which it decides; its id if there are none), and what the line claims of it (states, rewards, total, outcome, ending)
must be what happened. A demonstration with `"discarded": true` is read, kept and left out of learning. Fields that are
not known are kept and written again; kinds that are not known are refused.
"""

import json
import math
import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final, NoReturn, TypeAlias

from irl_core.checks import Refused, finite, identifier, shown
from irl_core.errors import InvalidFile, InvalidRanking, IrlError
from irl_core.playing import simulate
from irl_core.types import Demonstration, DemonstrationOutcome, Ranking, World, check_demonstrations, check_world
from irl_core.weights import display_ranks, paper_index

MAX_LINES: Final = 100_000
MAX_LINE_LENGTH: Final = 1_000_000
"""In characters. A world of 100×100 squares takes some 350,000, its longest demonstration 50,000."""
MAX_LENGTH: Final = 200_000_000
SAME: Final = 1e-9
"""How near a total or reward that a file claims must be to what happened."""

Source: TypeAlias = str | os.PathLike[str] | Iterable[str]
_Record: TypeAlias = dict[str, Any]
_Numbered: TypeAlias = tuple[int, _Record]


@dataclass(frozen=True)
class WorldSection:
    """What a file says about one world."""

    world_id: str | None
    world: World
    demonstrations: tuple[Demonstration, ...]
    rankings: tuple[Ranking, ...]
    discarded: tuple[Demonstration, ...]


@dataclass(frozen=True)
class DemonstrationFile:
    """A file as read: its worlds, and its lines with every field they had."""

    sections: tuple[WorldSection, ...]
    records: tuple[Mapping[str, Any], ...]

    @property
    def world(self) -> World:
        """The world, if there is one only."""
        return self._only_section.world

    @property
    def demonstrations(self) -> tuple[Demonstration, ...]:
        """The demonstrations to learn from, if there is one world only."""
        return self._only_section.demonstrations

    @property
    def rankings(self) -> tuple[Ranking, ...]:
        """The rankings, if there is one world only."""
        return self._only_section.rankings

    def to_text(self) -> str:
        """The file again, fields that were not known included."""
        return "".join(map(_line, self.records))

    @property
    def _only_section(self) -> WorldSection:
        if len(self.sections) != 1:
            raise InvalidFile(f"The file holds {len(self.sections)} worlds; one was expected.")
        return self.sections[0]


def read_demonstration_file(source: Source) -> DemonstrationFile:
    """Read a path, or lines; raises InvalidFile, which names the line and the field."""
    numbered = [(number, _parse(line, number)) for number, line in _numbered_lines(source)]
    of_kind: dict[str, list[_Numbered]] = {"world": [], "demonstration": [], "ranking": []}
    for number, record in numbered:
        kind = record.get("kind")
        if not isinstance(kind, str) or kind not in of_kind:
            _refuse(f"kind must be world, demonstration or ranking, not {shown(kind)}", number, "kind")
        of_kind[kind].append((number, record))
    reader = _Reader(of_kind["world"])
    for number, record in of_kind["demonstration"]:
        reader.add_demonstration(number, record)
    for number, record in of_kind["ranking"]:
        reader.add_ranking(number, record)
    return DemonstrationFile(reader.sections(), tuple(record for _, record in numbered))


def write_demonstration_file(
    world: World,
    demonstrations: Iterable[Demonstration],
    rankings: Iterable[Ranking] = (),
    *,
    world_id: str | None = None,
    more: Mapping[str, Mapping[str, Any]] | None = None,
) -> str:
    """The text of a file of one world. `more` holds further fields by demonstration id (step_ms, created_at, …)."""
    check_world(world)
    played = check_demonstrations(demonstrations)
    lines = [world_line(world, world_id=world_id)]
    lines += [demonstration_line(one, world_id=world_id, more=(more or {}).get(one.id)) for one in played]
    for ranking in rankings:
        if not isinstance(ranking, Ranking):
            raise InvalidRanking(f"rankings must be Rankings; here is {shown(ranking)}.", field="rankings")
        lines.append(ranking_line(ranking, world_id=world_id))
    return "".join(lines)


def world_line(world: World, *, world_id: str | None = None) -> str:
    """The line of a world."""
    return _line({"kind": "world", **({} if world_id is None else {"id": world_id}), **world.to_json()})


def demonstration_line(
    demonstration: Demonstration, *, world_id: str | None = None, more: Mapping[str, Any] | None = None
) -> str:
    """The line of a demonstration, with further fields."""
    return _line({"kind": "demonstration", **_link(world_id), **(more or {}), **demonstration.to_json()})


def ranking_line(ranking: Ranking, *, world_id: str | None = None, more: Mapping[str, Any] | None = None) -> str:
    """The line of a ranking, each place as people and as the paper count it, with further fields."""
    told = {
        "outcome": ranking.outcome,
        "order": [list(group) for group in ranking.groups],
        "display_rank": display_ranks(ranking.groups),
        "paper_index": paper_index(ranking.groups),
    }
    return _line({"kind": "ranking", **_link(world_id), **told, **(more or {})})


def _link(world_id: str | None) -> _Record:
    return {} if world_id is None else {"world_id": world_id}


class _Reader:
    """The worlds of a file, with what the following lines say about them."""

    def __init__(self, worlds: list[_Numbered]) -> None:
        self._worlds: dict[str | None, World] = {}
        self._played: dict[str | None, dict[str, Demonstration]] = {}
        self._discarded: dict[str | None, set[str]] = {}
        self._rankings: dict[str | None, dict[DemonstrationOutcome, Ranking]] = {}
        for number, record in worlds:
            self._add_world(number, record, alone=len(worlds) == 1)
        if not worlds:
            raise InvalidFile('The file has no line of kind "world".', field="kind")

    def add_demonstration(self, number: int, record: _Record) -> None:
        key = self._world_of(number, record)
        id_ = _identifier(record, "id", number)
        if id_ in self._played[key]:
            _refuse(f"demonstration {shown(id_)} is there twice", number, "id")
        discarded = record.get("discarded", False)
        if not isinstance(discarded, bool):
            _refuse(f"discarded must be true or false, not {shown(discarded)}", number, "discarded")
        self._played[key][id_] = _played(self._worlds[key], id_, record, number)
        if discarded:
            self._discarded[key].add(id_)

    def add_ranking(self, number: int, record: _Record) -> None:
        key = self._world_of(number, record)
        try:
            ranking = Ranking(record.get("outcome"), record.get("order"))  # type: ignore[arg-type]  # Ranking checks them
        except IrlError as error:
            raise InvalidFile(error.message, line=number, field=error.field) from None
        for id_ in ranking.ids:
            played = self._played[key].get(id_)
            if played is None or played.outcome != ranking.outcome:
                _refuse(f"{shown(id_)} is no {ranking.outcome} in this world", number, "order")
        kept = [[id_ for id_ in group if id_ not in self._discarded[key]] for group in ranking.groups]
        self._rankings[key][ranking.outcome] = Ranking(ranking.outcome, tuple(tuple(group) for group in kept if group))

    def sections(self) -> tuple[WorldSection, ...]:
        return tuple(self._section(key) for key in self._worlds)

    def _section(self, key: str | None) -> WorldSection:
        played, discarded = self._played[key], self._discarded[key]
        return WorldSection(
            world_id=key,
            world=self._worlds[key],
            demonstrations=tuple(one for one in played.values() if one.id not in discarded),
            rankings=tuple(self._rankings[key].values()),
            discarded=tuple(one for one in played.values() if one.id in discarded),
        )

    def _add_world(self, number: int, record: _Record, *, alone: bool) -> None:
        key = None if alone and record.get("id") is None else _identifier(record, "id", number)
        if key in self._worlds:
            _refuse(f"world {shown(key)} is there twice", number, "id")
        try:
            self._worlds[key] = World.from_json(record)
        except IrlError as error:
            raise InvalidFile(error.message, line=number, field=error.field) from None
        self._played[key], self._discarded[key], self._rankings[key] = {}, set(), {}

    def _world_of(self, number: int, record: _Record) -> str | None:
        """The world a line speaks of; it may leave that out where there is one only."""
        only = next(iter(self._worlds)) if len(self._worlds) == 1 else None
        if len(self._worlds) == 1 and (record.get("world_id") is None or only is None):
            return only
        world_id = _identifier(record, "world_id", number)
        if world_id not in self._worlds:
            _refuse(f"there is no world {shown(world_id)} in this file", number, "world_id")
        return world_id


def _played(world: World, id_: str, record: _Record, number: int) -> Demonstration:
    """The demonstration as it happens when played again; what the line claims of it must fit."""
    actions, ending, seeds = record.get("actions", ()), record.get("ending"), record.get("slip_seeds")
    try:
        demonstration = simulate(
            world, actions, attempt_id=id_, ending=ending, slip_seeds=None if seeds in (None, []) else seeds
        )
    except IrlError as error:
        raise InvalidFile(error.message, line=number, field=error.field) from None
    happened = demonstration.to_json()
    for field in ("states", "rewards", "total", "outcome"):
        if field in record and not _same(record[field], happened[field]):
            told = "" if isinstance(happened[field], list) else f" {shown(happened[field])}, not {shown(record[field])}"
            _refuse(f"{field} of demonstration {shown(id_)}: played again it is{told or ' another'}", number, field)
    return demonstration


def _same(claimed: object, happened: object) -> bool:
    if isinstance(happened, list):
        if not isinstance(claimed, list) or len(claimed) != len(happened):
            return False
        return all(_same(one, other) for one, other in zip(claimed, happened, strict=True))
    if isinstance(happened, str):
        return claimed == happened
    number = finite(claimed)
    return number is not None and math.isclose(number, float(happened), rel_tol=SAME, abs_tol=SAME)  # type: ignore[arg-type]


def _numbered_lines(source: Source) -> Iterator[tuple[int, str]]:
    """The lines that are not blank, numbered from 1, within the limits."""
    length = 0
    for number, line in enumerate(_read(source), start=1):
        length += len(line)
        if number > MAX_LINES:
            _refuse(f"a file has at most {MAX_LINES} lines", number, None)
        if len(line) > MAX_LINE_LENGTH:
            _refuse(f"a line has at most {MAX_LINE_LENGTH} characters", number, None)
        if length > MAX_LENGTH:
            _refuse(f"a file has at most {MAX_LENGTH} characters", number, None)
        if line.strip():
            yield number, line


def _read(source: Source) -> Iterator[str]:
    if not isinstance(source, str | os.PathLike):
        yield from _given_lines(source)
        return
    try:
        with open(source, encoding="utf-8-sig") as file:  # noqa: PTH123 - reads a line by pieces no longer than allowed
            while line := file.readline(MAX_LINE_LENGTH + 1):
                yield line
    except UnicodeDecodeError as error:
        raise InvalidFile(f"The file is not UTF-8 text: {error.reason}.") from error
    except OSError as error:
        raise InvalidFile(f"The file cannot be read: {error.strerror}.") from error


def _given_lines(source: Iterable[str]) -> Iterator[str]:
    if not isinstance(source, Iterable):
        raise InvalidFile(f"A demonstration file is a path or lines of text, not {shown(source)}.")
    for number, line in enumerate(source, start=1):
        if not isinstance(line, str):
            _refuse(f"a line is a text, not {shown(line)}", number, None)
        yield line


def _parse(line: str, number: int) -> _Record:
    try:
        record = json.loads(line, parse_constant=_no_number, parse_float=_finite, object_pairs_hook=_no_doubles)
    except Refused as refused:
        _refuse(str(refused), number, None)
    except (ValueError, RecursionError):
        _refuse("this is not JSON (or nested too deeply)", number, None)
    if not isinstance(record, dict):
        _refuse("each line is one JSON object", number, None)
    return record


def _no_number(constant: str) -> NoReturn:
    raise Refused(f"{constant} is not a number JSON knows")


def _finite(text: str) -> float:
    number = float(text)
    if math.isinf(number):
        raise Refused("a number here is too large")
    return number


def _no_doubles(pairs: list[tuple[str, Any]]) -> _Record:
    record = dict(pairs)
    if len(record) < len(pairs):
        raise Refused("a key is there twice in one object")
    return record


def _identifier(record: _Record, name: str, number: int) -> str:
    try:
        return identifier(record.get(name))
    except Refused as refused:
        _refuse(f"{name} {refused}", number, name)


def _refuse(reason: str, line: int, field: str | None) -> NoReturn:
    raise InvalidFile(f"{reason}.", line=line, field=field)


def _line(record: Mapping[str, Any]) -> str:
    return json.dumps(record, allow_nan=False) + "\n"
