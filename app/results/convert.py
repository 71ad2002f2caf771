"""Rows ⇄ irl_core: the door of this room to the science."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from app.results import words
from app.results.queries import Finished
from app.results.schemas import (
    DuelOut,
    ProportionOut,
    ShareOut,
    StandingOut,
    TableOneOut,
    TableOneRowOut,
    WorldEntryOut,
)
from app.results.words import Voice, heading
from irl_core.comparison import HUMAN, OPTIMAL
from irl_core.learners import LEARNERS
from irl_core.many_worlds import Duel, Measured, Overview, Proportion, Standing, TableOne, look_over
from irl_core.many_worlds.duels import shared_places

LEAST_PEOPLE: Final = 3
"""Of fewer people nothing is shown: somebody who knows their own figures would read another's."""


def overview_of(comparisons: Sequence[Finished], voice: Voice) -> Overview:
    """Take comparisons together; worlds are independent within a person's, people within everybody's."""
    measured = (
        Measured(
            unit=one.world_id if voice.unit == "world" else one.visitor_id,
            optimum=optimum_of(one),
            expected={entry["who"]: score_of(entry) for entry in _players(one)},
            played={entry["who"]: entry["mean_return"] for entry in _players(one)},
        )
        for one in comparisons
    )
    return look_over(measured, least_units=LEAST_PEOPLE if voice.unit == "person" else 1)


def titles_of(overview: Overview, voice: Voice) -> dict[str, str]:
    """What everybody is called within a sentence; a learner of another version goes by its name."""
    titles = {name: learner.title for name, learner in LEARNERS.items()}
    return {
        **{who: who for who in (*(one.who for one in overview.standings), *overview.left_out)},
        **titles,
        HUMAN: voice.human,
    }


def optimum_of(one: Finished) -> float:
    """What the best plan earns in the world of a comparison."""
    return next(score_of(entry) for entry in one.entries if entry["who"] == OPTIMAL)


def score_of(entry: Mapping[str, Any]) -> float:
    """What decides the place: the exact expected return, or the human's mean."""
    expected = entry["expected_return"]
    return float(entry["mean_return"] if expected is None else expected)


def _players(one: Finished) -> list[dict[str, Any]]:
    return [entry for entry in one.entries if entry["who"] != OPTIMAL]


def entries_out(one: Finished, titles: Mapping[str, str]) -> list[WorldEntryOut]:
    """Show who took part in a comparison, by place."""
    players, optimum = _players(one), optimum_of(one)
    scores = [score_of(entry) for entry in players]
    places = shared_places(np.array([scores]), np.array([optimum]))[0]
    entries = [
        WorldEntryOut(
            who=entry["who"],
            title=heading(titles[entry["who"]]),
            place=int(place),
            expected_return=score,
            mean_return=entry["mean_return"],
            share_of_optimum=score / optimum if optimum > 0.0 else None,
        )
        for entry, score, place in zip(players, scores, places, strict=True)
    ]
    return sorted(entries, key=lambda entry: entry.place)


def standings_out(overview: Overview, titles: Mapping[str, str]) -> list[StandingOut]:
    """List who took part, the one who came first most often first; among equals the one nearer to the optimum."""
    ranked = sorted(overview.standings, key=_rank)
    return [
        StandingOut(
            who=one.who,
            title=heading(titles[one.who]),
            n_comparisons=one.n,
            places=[_proportion(place) for place in one.places],
            share_of_optimum=ShareOut(
                value=_or_none(one.share.value),
                low=_or_none(one.share.low),
                high=_or_none(one.share.high),
                method=one.share.method,
            ),
        )
        for one in ranked
    ]


def _rank(one: Standing) -> tuple[float, float]:
    share = one.share.value
    return (-one.places[0].count / one.n, math.inf if math.isnan(share) else -share)


def duel_out(duel: Duel) -> DuelOut:
    """Show a pair."""
    return DuelOut(
        a=duel.a,
        b=duel.b,
        n_comparisons=duel.n,
        wins=duel.wins,
        losses=duel.losses,
        ties=duel.ties,
        votes_for=duel.units_for,
        votes_against=duel.units_against,
        p_value=duel.p_value,
        p_adjusted=duel.p_adjusted,
    )


def table_one_out(table: TableOne, titles: Mapping[str, str], voice: Voice) -> TableOneOut:
    """Show the paper's Table I, a sentence a row."""
    sentences = words.table_one_sentences(table, titles, voice)
    placed = {row.who: [_proportion(place) for place in row.placed] for row in table.rows}
    rows = [
        TableOneRowOut(who=who, title=heading(titles[who]), sentence=sentence, places=placed.get(who, []))
        for who, sentence in sentences.items()
    ]
    return TableOneOut(n_comparisons=table.n, rows=rows)


def _proportion(one: Proportion) -> ProportionOut:
    return ProportionOut(count=one.count, of=one.of, low=_or_none(one.low), high=_or_none(one.high))


def _or_none(value: float) -> float | None:
    return value if math.isfinite(value) else None
