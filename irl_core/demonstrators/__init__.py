"""Simulated people: they play a world, succeed and fail, and order their attempts. For experiments without humans.

`demonstrate` lets one of them play until the wished-for number of successes and of failures has reached a goal.
Attempts that reach none within S = rows · cols steps (their patience; the world may allow more) do not count. Somebody
who never fails or never succeeds in a world is given up after 300 attempts: the answer is None, and the caller draws
another world. The kinds are in `kinds.py`, the mistakes of their orders in `ranking.py`.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final, TypeAlias

import numpy as np

from irl_core.array_checks import check_generator
from irl_core.checks import Refused, real_number, shown, whole_number
from irl_core.demonstrators import kinds
from irl_core.demonstrators.play import Laws, play
from irl_core.demonstrators.ranking import rank_by_total
from irl_core.errors import InvalidSettings
from irl_core.playing import simulate
from irl_core.types import OUTCOMES, Demonstration, DemonstrationOutcome, Ranking, World, check_world

MOST_ATTEMPTS: Final = 300
_AT_ONCE: Final = 30
MOST_DEMONSTRATIONS: Final = 100

LawsOf: TypeAlias = Callable[[World, int, np.random.Generator], Laws]


@dataclass(frozen=True)
class Demonstrator:
    """A kind of simulated person. `laws(world, B, rng)` are the laws of B attempts, shape (B, S, 4)."""

    name: str
    title: str
    summary: str
    laws: LawsOf


DEMONSTRATORS: Mapping[str, Demonstrator] = MappingProxyType(
    {
        one.name: one
        for one in (
            Demonstrator("mixture", "Mixture", "Plays each attempt like one of the other five.", kinds.mixture),
            Demonstrator("boltzmann", "Boltzmann", "Knows the rewards and prefers what pays.", kinds.boltzmann),
            Demonstrator("myopic", "Myopic", "Sees the rewards of the next three steps.", kinds.myopic),
            Demonstrator("shortest_path", "Shortest path", "Walks straight, blind to colour.", kinds.shortest_path),
            Demonstrator("wanderer", "Wanderer", "Sees the shades roughly, and often steps aside.", kinds.wanderer),
            Demonstrator("perceptual", "Perceptual", "Plans on noisy impressions of the squares.", kinds.perceptual),
        )
    }
)
"""The simulated people by name."""


@dataclass(frozen=True)
class Demonstrated:
    """What somebody left: demonstrations in the order they were played, and a ranking of each outcome among them."""

    demonstrations: tuple[Demonstration, ...]
    rankings: tuple[Ranking, ...]
    n_attempts: int


def demonstrate(
    kind: str | Demonstrator,
    world: World,
    rng: np.random.Generator,
    *,
    n_successes: int = 3,
    n_failures: int = 3,
    ranking_noise: float = 0.0,
    ties_within: float = 0.0,
) -> Demonstrated | None:
    """The first successes and failures of this kind of person that reach a goal, ranked, or None after 300 attempts.

    `ranking_noise` and `ties_within` are in points of reward (see `ranking.py`). Raises InvalidSettings, InvalidModel.
    """
    check_world(world)
    check_generator(rng)
    wanted = _wanted(n_successes, n_failures)
    noise, within = _distance("ranking_noise", ranking_noise), _distance("ties_within", ties_within)
    kept: dict[DemonstrationOutcome, list[Demonstration]] = {outcome: [] for outcome in OUTCOMES}
    for n_attempts, attempt in enumerate(_attempts(demonstrator_named(kind), world, rng), start=1):
        if attempt is not None and len(kept[attempt.outcome]) < wanted[attempt.outcome]:
            kept[attempt.outcome].append(attempt)
        if all(len(kept[outcome]) == wanted[outcome] for outcome in OUTCOMES):
            rankings = [
                rank_by_total(outcome, played, rng, noise=noise, ties_within=within)
                for outcome, played in kept.items()
                if played
            ]
            return Demonstrated((*kept["success"], *kept["failure"]), tuple(rankings), n_attempts)
    return None


def demonstrator_named(kind: str | Demonstrator) -> Demonstrator:
    """The demonstrator of this name; raises InvalidSettings, with the names there are."""
    if isinstance(kind, Demonstrator):
        return kind
    if not any(kind == name for name in DEMONSTRATORS):
        raise InvalidSettings(
            f"There is no demonstrator {shown(kind)}; there are {', '.join(DEMONSTRATORS)}.", field="demonstrators"
        )
    return DEMONSTRATORS[kind]


def _attempts(who: Demonstrator, world: World, rng: np.random.Generator) -> Iterator[Demonstration | None]:
    """One attempt after the other, None for those that reached no goal; played in batches."""
    sitting = f"{rng.integers(2**32):08x}"  # ids decide slips: they must differ from world to world
    patience = min(world.horizon, world.n_states)
    for first in range(0, MOST_ATTEMPTS, _AT_ONCE):
        ids = [f"{sitting}-{k}" for k in range(first, first + _AT_ONCE)]
        played = play(world, who.laws(world, _AT_ONCE, rng), ids, rng, patience=patience)
        for id_, actions in zip(ids, played, strict=True):
            yield None if actions is None else simulate(world, actions, attempt_id=id_)


def _wanted(n_successes: int, n_failures: int) -> dict[DemonstrationOutcome, int]:
    try:
        return {
            "success": whole_number(n_successes, minimum=0, maximum=MOST_DEMONSTRATIONS),
            "failure": whole_number(n_failures, minimum=0, maximum=MOST_DEMONSTRATIONS),
        }
    except Refused as refused:
        raise InvalidSettings(f"The number of successes and of failures {refused}.", field="n_successes") from None


def _distance(name: str, value: float) -> float:
    try:
        return real_number(value, minimum=0.0)
    except Refused as refused:
        raise InvalidSettings(f"{name} {refused}.", field=name) from None


__all__ = [
    "DEMONSTRATORS",
    "MOST_ATTEMPTS",
    "Demonstrated",
    "Demonstrator",
    "demonstrate",
    "demonstrator_named",
    "rank_by_total",
]
