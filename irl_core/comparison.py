"""The human, the learners and the optimum, measured on the same world.

A policy is measured exactly (`expected_return`), in played episodes (`mean_return`, with its standard error), and as a
plan: `greedy_return` is what the best path under the learned reward earns on the true one. The human is measured by the
totals of the attempts that were learned from. Places are by expected return (the human's: by mean), 1 is best, equals
share a place and the next one counts them all (1, 2, 2, 4).
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from irl_core.array_checks import check_whole
from irl_core.arrays import Policy
from irl_core.checks import shown
from irl_core.errors import InvalidSettings
from irl_core.evaluation import Rollout, expected_return, greedy_plan, optimal_plan, rollouts
from irl_core.learners import LEARNERS, LearningResult
from irl_core.planning import HardPlan
from irl_core.types import MAX_SEED, Demonstration, World, check_demonstrations, check_world

HUMAN: Final = "human"
OPTIMAL: Final = "optimal"
_SAME_SHARE: Final = 1e-9


@dataclass(frozen=True)
class Entry:
    """One line of a comparison; None where a figure does not exist.

    The human has no policy to expect from, and who learned a policy and no reward has no plan for it.
    """

    who: str
    title: str
    mean_return: float
    standard_error: float
    expected_return: float | None
    greedy_return: float | None
    share_of_optimum: float | None
    place: int
    episodes: int

    @property
    def score(self) -> float:
        """What decides the place."""
        return self.mean_return if self.expected_return is None else self.expected_return

    def to_json(self) -> dict[str, Any]:
        """The entry as the API has it."""
        return {
            "who": self.who,
            "title": self.title,
            "mean_return": self.mean_return,
            "standard_error": self.standard_error,
            "expected_return": self.expected_return,
            "greedy_return": self.greedy_return,
            "share_of_optimum": self.share_of_optimum,
            "place": self.place,
            "episodes": self.episodes,
        }


@dataclass(frozen=True)
class Comparison:
    """Entries sorted by place, and the episodes behind them by who played them."""

    seed: int
    horizon: int
    entries: tuple[Entry, ...]
    rollouts: Mapping[str, tuple[Rollout, ...]]

    def to_json(self) -> dict[str, Any]:
        """The comparison as the API has it, its episodes under `rollouts`."""
        return {
            "seed": self.seed,
            "horizon": self.horizon,
            "entries": [entry.to_json() for entry in self.entries],
            "rollouts": {who: [episode.to_json() for episode in played] for who, played in self.rollouts.items()},
        }


def compare(
    world: World,
    demonstrations: Iterable[Demonstration],
    results: Iterable[LearningResult],
    *,
    seed: int,
    n_episodes: int = 50,
) -> Comparison:
    """Measure everybody on the world. Each player's episodes are drawn from the seed and their name alone.

    Raises InvalidModel, ImpossibleDemonstration, InvalidPolicy, InvalidSettings.
    """
    check_world(world)
    check_whole("seed", seed, minimum=0, maximum=MAX_SEED)
    human = tuple(_as_rollout(one) for one in check_demonstrations(demonstrations))
    best_plan = optimal_plan(world)
    best = float(best_plan.values[-1, world.start])
    episodes = {HUMAN: human} if human else {}
    entries = [_human_entry(human)] if human else []
    for result in _checked(results):
        name = result.learner
        episodes[name] = _play(world, result.policy, name, seed=seed, n_episodes=n_episodes)
        expected = expected_return(world, result.policy)
        entries.append(_entry(name, episodes[name], expected=expected, greedy=_greedy_return(world, result)))
    episodes[OPTIMAL] = _play(world, best_plan, OPTIMAL, seed=seed, n_episodes=n_episodes)
    entries.append(_entry(OPTIMAL, episodes[OPTIMAL], expected=best, greedy=best))
    return Comparison(seed, world.horizon, _placed(entries, optimum=best), episodes)


def _checked(results: object) -> tuple[LearningResult, ...]:
    """Results of learning, from any list of them."""
    listed = tuple(results) if isinstance(results, Iterable) else (results,)
    for one in listed:
        if not isinstance(one, LearningResult) or not isinstance(results, Iterable):
            raise InvalidSettings(f"results must be a list of LearningResult, not {shown(one)}.", field="results")
    return listed


def places(scores: Sequence[float], *, tolerance: float) -> list[int]:
    """Standard competition ranking, the highest score first: 1 + how many are better by more than the tolerance."""
    return [1 + sum(other > score + tolerance for other in scores) for score in scores]


def _placed(entries: Iterable[Entry], *, optimum: float) -> tuple[Entry, ...]:
    """Entries with place and share, sorted by place; who shares one stays in the order given."""
    listed = list(entries)
    tolerance = _SAME_SHARE * (abs(optimum) or 1.0)
    by_score = places([entry.score for entry in listed], tolerance=tolerance)
    placed = [
        replace(entry, place=place, share_of_optimum=entry.score / optimum if optimum > 0.0 else None)
        for entry, place in zip(listed, by_score, strict=True)
    ]
    return tuple(sorted(placed, key=lambda entry: entry.place))


def _human_entry(episodes: Sequence[Rollout]) -> Entry:
    return replace(_entry(HUMAN, episodes, expected=0.0, greedy=0.0), expected_return=None, greedy_return=None)


def _greedy_return(world: World, result: LearningResult) -> float | None:
    """What the best plan under the learned reward earns; None for who learned a policy and no reward."""
    if np.ptp(result.reward) == 0.0:
        return None
    return expected_return(world, greedy_plan(world, result.reward))


def _entry(who: str, episodes: Sequence[Rollout], *, expected: float, greedy: float | None) -> Entry:
    totals = np.array([episode.total for episode in episodes])
    n, mean = len(totals), math.fsum(totals) / len(totals)
    return Entry(
        who=who,
        title=_title(who),
        mean_return=mean,
        standard_error=math.sqrt(math.fsum((totals - mean) ** 2) / (n - 1) / n) if n > 1 else 0.0,
        expected_return=expected,
        greedy_return=greedy,
        share_of_optimum=None,
        place=0,
        episodes=n,
    )


def _title(who: str) -> str:
    named = {HUMAN: "Human", OPTIMAL: "Optimum"}
    return named[who] if who in named else LEARNERS[who].title


def _play(world: World, policy: Policy | HardPlan, who: str, *, seed: int, n_episodes: int) -> tuple[Rollout, ...]:
    rng = np.random.default_rng(np.random.SeedSequence([seed, *who.encode()]))
    return tuple(rollouts(world, policy, n_episodes, rng))


def _as_rollout(demonstration: Demonstration) -> Rollout:
    return Rollout(tuple(demonstration.states.tolist()), demonstration.total, demonstration.reached_goal)
