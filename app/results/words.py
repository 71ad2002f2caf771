"""What is said about results over many worlds: short, and honest where little is known."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Literal

from irl_core.many_worlds import LEAST_UNITS, Overview, Proportion, TableOne, TableOneRow

ALPHA: Final = 0.05
MOST_NAMED: Final = 4
_NUMBERS: Final = ("no", "one", "two", "three")
_PLACES: Final = ("first", "second", "third", "fourth")


@dataclass(frozen=True, slots=True)
class Voice:
    """How one's own results, or everybody's, are spoken of."""

    human: str
    """The human within a sentence: "you"."""
    comparison: str
    """What each figure counts: "world"."""
    unit: Literal["world", "person"]

    def counted(self, n: int) -> str:
        """Count comparisons: "10 worlds"."""
        return f"{n} {self.comparison}{'' if n == 1 else 's'}"

    def units(self, n: int) -> str:
        """Count what is independent: "10 people"."""
        return f"{n} {'people' if self.unit == 'person' else 'worlds'}"


OWN: Final = Voice("you", "world", "world")
POOLED: Final = Voice("the players", "comparison", "person")


def headline(overview: Overview, titles: Mapping[str, str], voice: Voice) -> str:
    """Say who came first most often."""
    if not overview.standings:
        return ""
    most = max(one.places[0].count for one in overview.standings)
    first = [one for one in overview.standings if one.places[0].count == most]
    names = listed([titles[one.who] for one in first])
    if overview.n == 1:
        together = " together" if len(first) > 1 else ""
        return f"{heading(names)} came first{together} in your only {voice.comparison} so far."
    if len(first) > 1:
        return f"{heading(names)} came first most often: each in {most} of {voice.counted(overview.n)}."
    n = first[0].n
    if n == 1:
        return f"{heading(names)} came first most often: in the only {voice.comparison} it took part in."
    of = voice.counted(n) if n == overview.n else f"the {voice.counted(n)} it took part in"
    return f"{heading(names)} came first most often: in {most} of {of}."


def remarks(overview: Overview, titles: Mapping[str, str], voice: Voice) -> list[str]:
    """Say what a reader should know before believing the figures."""
    said = [
        _few(overview.n_units),
        _line_ups(overview),
        _left_out(overview, titles),
        _beyond_chance(overview, titles, voice),
    ]
    return [one for one in said if one]


def _few(n_units: int) -> str:
    if n_units == 0 or n_units >= LEAST_UNITS:
        return ""
    says = "world says" if n_units == 1 else "worlds say"
    return f"{_NUMBERS[n_units].capitalize()} {says} little: an interval needs at least {_NUMBERS[LEAST_UNITS]}."


def _line_ups(overview: Overview) -> str:
    if all(one.n == overview.n for one in overview.standings):
        return ""
    return (
        "Not every comparison had the same learners: each is counted where it took part, and a pair where both did;"
        " a place is among those who were there."
    )


def _left_out(overview: Overview, titles: Mapping[str, str]) -> str:
    if not overview.left_out:
        return ""
    names = listed([titles[who] for who in overview.left_out])
    return f"Left out, since fewer than three people had them learn: {names}."


def _beyond_chance(overview: Overview, titles: Mapping[str, str], voice: Voice) -> str:
    """Name the pairs that are told apart, or say how many it would take."""
    if not overview.duels:
        return ""
    told_apart = [
        (duel.a, duel.b) if duel.units_for > duel.units_against else (duel.b, duel.a)
        for duel in overview.duels
        if duel.p_adjusted < ALPHA
    ]
    n_pairs = len(overview.duels)
    test = "sign test" if n_pairs == 1 else f"sign test, {n_pairs} pairs, Holm’s correction"
    if told_apart:
        return f"{_these(told_apart, titles)} more than chance would give ({test}, p < {ALPHA})."
    needed = votes_needed(n_pairs)
    if overview.n_units < needed:
        return (
            f"None of this is beyond chance yet: to tell a pair apart takes {voice.units(needed)} that all say the"
            f" same ({test})."
        )
    return f"No two of them are told apart beyond chance ({test}, p < {ALPHA})."


def _these(told_apart: Sequence[tuple[str, str]], titles: Mapping[str, str]) -> str:
    if len(told_apart) > MOST_NAMED:
        return f"{len(told_apart)} pairs, marked in the table, differ by"
    return f"{heading(listed([f'{titles[better]} over {titles[worse]}' for better, worse in told_apart]))}: that is"


def votes_needed(n_pairs: int) -> int:
    """How many votes of one mind it takes before one of so many pairs is told apart: n_pairs · 2 / 2ⁿ < ALPHA."""
    n = 1
    while n_pairs * 2.0 ** (1 - n) >= ALPHA:
        n += 1
    return n


def table_one_sentences(table: TableOne, titles: Mapping[str, str], voice: Voice) -> dict[str, str]:
    """Write out each row of the paper's Table I, as the paper does."""
    below = table.below_all
    if below.of == 1:
        human = f"{'All four learners' if below.count else 'Not all four learners'} earned more than {voice.human}."
        return {"human": human} | {row.who: _sentence_of_one(row, titles) for row in table.rows}
    of = f"{below.count} of {voice.counted(below.of)}"
    human = f"In {of} all four learners earned more than {voice.human}{_interval(below)}."
    return {"human": human} | {row.who: _learner_sentence(row, titles, voice) for row in table.rows}


def _learner_sentence(row: TableOneRow, titles: Mapping[str, str], voice: Voice) -> str:
    first, *others = row.placed
    placed = listed([f"{_PLACES[place]} in {_count(one.count)}" for place, one in enumerate(others, start=1)])
    won = [f"{titles[other]} in {_count(n)}" for other, n in row.beaten.items()]
    earned = listed(won) if any(row.beaten.values()) else "none of the others"
    return (
        f"{titles[row.who]} placed first in {first.count} of {voice.counted(first.of)}{_interval(first)}, {placed}."
        f" It earned more than {earned}."
    )


def _sentence_of_one(row: TableOneRow, titles: Mapping[str, str]) -> str:
    """Say it of a single world, where counts would all be none or one."""
    place = next(_PLACES[i] for i, one in enumerate(row.placed) if one.count)
    below = [titles[other] for other, n in row.beaten.items() if n]
    return f"{titles[row.who]} placed {place}. It earned more than {listed(below) if below else 'none of the others'}."


def _interval(one: Proportion) -> str:
    if one.low != one.low:
        return ""
    return f" (95 % interval: {100 * one.low:.0f} to {100 * one.high:.0f} %)"


def _count(n: int) -> str:
    return str(n) if n else "none"


def heading(words: str) -> str:
    """Begin with a capital."""
    return words[0].upper() + words[1:]


def listed(names: Sequence[str]) -> str:
    """Write "A", "A and B" or "A, B and C"."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
