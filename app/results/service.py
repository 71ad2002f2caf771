"""Results over many worlds: one's own, and everybody's in worlds that pool them.

Everybody's are shown without names, and a world, a learner or a pair of learners only from three people on: with fewer,
somebody who knows their own would read another's.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, Final, TypeAlias

from app.db import Database
from app.errors import NotFound, Unprocessable
from app.results import convert, queries, words
from app.results.convert import LEAST_PEOPLE
from app.results.queries import Finished
from app.results.schemas import ResultsOut, WorldResultOut
from app.results.words import OWN, POOLED, Voice
from irl_core.many_worlds import LEAST_UNITS, Overview

MOST_WORLDS: Final = 20

Spec: TypeAlias = Mapping[str, Any]


def own_results(database: Database, visitor_id: str | None) -> ResultsOut:
    """Take a visitor's latest finished comparison of each world together."""
    if visitor_id is None:
        return _results(convert.overview_of([], OWN), [], OWN)
    with database.read() as session:
        found = queries.own_comparisons(session, visitor_id)
        specs = queries.specs_of(session, {one.world_id for one in found})
    overview = convert.overview_of(found, OWN)
    titles = convert.titles_of(overview, OWN)
    listed = [_own_world(one, specs[one.world_id], titles) for one in found]
    return _results(overview, listed, OWN)


def pooled_results(database: Database, world_ids: Sequence[str]) -> ResultsOut:
    """Take everybody's latest finished comparison in these worlds together, of those that enough people finished.

    Raises NotFound, and Unprocessable for a world whose players were not told that results are pooled.
    """
    asked_for = list(dict.fromkeys(world_ids))
    with database.read() as session:
        specs = queries.specs_of(session, asked_for)
        _check(asked_for, specs)
        found = queries.comparisons_in(session, asked_for)
    n_people = Counter(one.world_id for one in found)
    listed = [_pooled_world(world_id, specs[world_id], n_people[world_id]) for world_id in asked_for]
    shown = [one for one in found if n_people[one.world_id] >= LEAST_PEOPLE]
    return _results(convert.overview_of(shown, POOLED), listed, POOLED)


def _check(asked_for: Sequence[str], specs: Mapping[str, Spec]) -> None:
    for world_id in asked_for:
        if world_id not in specs:
            message = "There is no such world here. Its link may be incomplete, or nobody has played it yet."
            raise NotFound(message)
        if not specs[world_id].get("pooled", False):
            message = (
                f"World {world_id} pools no results: who played it was not told, so theirs stay their own."
                " Make a world with “Pool everybody’s results” ticked, and hand out its link."
            )
            raise Unprocessable(message, code="not_pooled", fields={"world": message})


def _own_world(one: Finished, spec: Spec, titles: Mapping[str, str]) -> WorldResultOut:
    return WorldResultOut(
        **_facts(one.world_id, spec),
        n_comparisons=1,
        n_people_missing=0,
        run_id=one.run_id,
        finished_at=one.finished_at,
        optimum=convert.optimum_of(one),
        entries=convert.entries_out(one, titles),
    )


def _pooled_world(world_id: str, spec: Spec, n_people: int) -> WorldResultOut:
    return WorldResultOut(
        **_facts(world_id, spec), n_comparisons=n_people, n_people_missing=max(0, LEAST_PEOPLE - n_people)
    )


def _facts(world_id: str, spec: Spec) -> dict[str, Any]:
    facts = {name: spec[name] for name in ("rows", "cols", "seed")}
    return {"world_id": world_id, "pooled": spec.get("pooled", False), **facts}


def _results(overview: Overview, worlds: list[WorldResultOut], voice: Voice) -> ResultsOut:
    titles = convert.titles_of(overview, voice)
    return ResultsOut(
        scope="own" if voice is OWN else "pooled",
        unit=voice.unit,
        n_comparisons=overview.n,
        n_units=overview.n_units,
        n_units_needed=LEAST_UNITS,
        headline=words.headline(overview, titles, voice),
        remarks=words.remarks(overview, titles, voice),
        standings=convert.standings_out(overview, titles),
        duels=[convert.duel_out(duel) for duel in overview.duels],
        table_one=convert.table_one_out(overview.table_one, titles, voice) if overview.table_one else None,
        worlds=worlds,
    )
