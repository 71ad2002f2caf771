"""The human, the learners and the optimum, measured on the same world.

A policy is measured exactly (`expected_return`), in played episodes (`mean_return` with its standard error and 95 %
interval, `success_rate`, `mean_steps`), and as a plan: `greedy_return` is what the best path under the learned reward
earns on the true one. The human is measured by the attempts that were learned from. Places are by expected return (the
human's: by mean), 1 is best, equals share a place and the next one counts them all (1, 2, 2, 4).

**Common random numbers.** Episode k of everyone draws the same numbers: one stream of the seed gives u_{t,k}, uniform
on [0, 1), for step t of episode k, and whoever stands in s then goes in the first direction d with
Σ_{d′ ≤ d} P(d′ | s) > u_{t,k}, P being the policy under slip. Two players who would do the same do the same; what
differs between their episodes is what differs between them. So learners are compared episode by episode, where the luck
that both share cancels (`paired.py`: means, intervals, tests).

**Value lost.** In a square s, a learner loses V*_N(s) − V^π_N(s): how much less its policy π than the best plan earns
from there on average with all N steps to go. Nothing is lost at goals, nor said of squares where nobody can come.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from irl_core import grid
from irl_core.array_checks import check_whole
from irl_core.arrays import BoolVector, Policy, Vector, read_only
from irl_core.checks import shown
from irl_core.errors import InvalidSettings
from irl_core.evaluation import Rollout, expected_return, greedy_plan, optimal_plan, rollouts, state_values
from irl_core.learners import LEARNERS, LearningResult
from irl_core.paired import PairedTest, mean_of, paired_tests
from irl_core.planning import HardPlan
from irl_core.types import MAX_SEED, Demonstration, World, check_demonstrations, check_world

HUMAN: Final = "human"
OPTIMAL: Final = "optimal"
_SAME_SHARE: Final = 1e-9
_EPISODES, _SIGNS = 0, 1
"""The streams of a seed: who plays, and how differences are signed."""


@dataclass(frozen=True)
class Entry:
    """One line of a comparison; None where a figure does not exist.

    The human has no policy to expect from, who learned a policy and no reward has no plan for it, and one episode alone
    has no interval. `success_rate` is the share of episodes that reached a goal with a total of at least 0.
    """

    who: str
    title: str
    mean_return: float
    standard_error: float
    interval_low: float | None
    interval_high: float | None
    success_rate: float
    mean_steps: float
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
            "interval_low": self.interval_low,
            "interval_high": self.interval_high,
            "success_rate": self.success_rate,
            "mean_steps": self.mean_steps,
            "expected_return": self.expected_return,
            "greedy_return": self.greedy_return,
            "share_of_optimum": self.share_of_optimum,
            "place": self.place,
            "episodes": self.episodes,
        }


@dataclass(frozen=True)
class HumanAttempts:
    """The ids of two attempts: the best, and the one whose total lies nearest the mean; of equals the earliest."""

    best: str
    mean: str

    def to_json(self) -> dict[str, str]:
        """The ids as the API has them."""
        return {"best": self.best, "mean": self.mean}


@dataclass(frozen=True, eq=False)
class Comparison:
    """Entries sorted by place, what is behind them, and the episodes by who played them.

    `value_lost` has a vector (S,) for each learner; `value_lost_scale` is where a common scale for them ends: at the
    most that anyone loses anywhere, yet at no more than the best that any square has to lose. `tests` has every two
    learners.
    """

    seed: int
    horizon: int
    entries: tuple[Entry, ...]
    human: HumanAttempts | None
    value_lost: Mapping[str, Vector]
    value_lost_scale: float
    tests: tuple[PairedTest, ...]
    rollouts: Mapping[str, tuple[Rollout, ...]]

    def to_json(self) -> dict[str, Any]:
        """The comparison as the API has it, its episodes under `rollouts`."""
        return {
            "seed": self.seed,
            "horizon": self.horizon,
            "entries": [entry.to_json() for entry in self.entries],
            "human": self.human and self.human.to_json(),
            "value_lost": {who: lost.tolist() for who, lost in self.value_lost.items()},
            "value_lost_scale": self.value_lost_scale,
            "tests": [test.to_json() for test in self.tests],
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
    """Measure everybody on the world. A player's episodes depend on the seed and on what they do, on nobody else.

    Raises InvalidModel, ImpossibleDemonstration, InvalidPolicy, InvalidSettings.
    """
    check_world(world)
    check_whole("seed", seed, minimum=0, maximum=MAX_SEED)
    attempts = check_demonstrations(demonstrations)
    learned = _checked(results)
    best_plan = optimal_plan(world)
    best = best_plan.values[-1]
    optimum = float(best[world.start])
    values = {one.learner: state_values(world, one.policy) for one in learned}
    episodes = {HUMAN: tuple(_as_rollout(one) for one in attempts)} if attempts else {}
    entries = [_entry(HUMAN, episodes[HUMAN], expected=None, greedy=None)] if attempts else []
    for one in learned:
        name = one.learner
        episodes[name] = _play(world, one.policy, seed=seed, n_episodes=n_episodes)
        expected = float(values[name][world.start])
        entries.append(_entry(name, episodes[name], expected=expected, greedy=_greedy_return(world, one)))
    episodes[OPTIMAL] = _play(world, best_plan, seed=seed, n_episodes=n_episodes)
    entries.append(_entry(OPTIMAL, episodes[OPTIMAL], expected=optimum, greedy=optimum))
    asked = _where_one_can_be(world)
    lost = {name: _lost(best, value, asked) for name, value in values.items()}
    return Comparison(
        seed=seed,
        horizon=world.horizon,
        entries=_placed(entries, optimum=optimum),
        human=_human_attempts(attempts) if attempts else None,
        value_lost=lost,
        value_lost_scale=_scale(lost, at_stake=float(best[asked].max())),
        tests=_tests({name: episodes[name] for name in values}, seed=seed),
        rollouts=episodes,
    )


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


def _greedy_return(world: World, result: LearningResult) -> float | None:
    """What the best plan under the learned reward earns; None for who learned a policy and no reward."""
    if np.ptp(result.reward) == 0.0:
        return None
    return expected_return(world, greedy_plan(world, result.reward))


def _entry(who: str, episodes: Sequence[Rollout], *, expected: float | None, greedy: float | None) -> Entry:
    n, mean = len(episodes), mean_of([episode.total for episode in episodes])
    return Entry(
        who=who,
        title=_title(who),
        mean_return=mean.value,
        standard_error=mean.standard_error,
        interval_low=mean.low,
        interval_high=mean.high,
        success_rate=sum(episode.reached_goal and episode.total >= 0.0 for episode in episodes) / n,
        mean_steps=sum(len(episode.states) - 1 for episode in episodes) / n,
        expected_return=expected,
        greedy_return=greedy,
        share_of_optimum=None,
        place=0,
        episodes=n,
    )


def _title(who: str) -> str:
    named = {HUMAN: "Human", OPTIMAL: "Optimum"}
    return named[who] if who in named else LEARNERS[who].title


def _human_attempts(attempts: Sequence[Demonstration]) -> HumanAttempts:
    mean = math.fsum(one.total for one in attempts) / len(attempts)
    nearest = min(attempts, key=lambda one: abs(one.total - mean))
    return HumanAttempts(best=max(attempts, key=lambda one: one.total).id, mean=nearest.id)


def _play(world: World, policy: Policy | HardPlan, *, seed: int, n_episodes: int) -> tuple[Rollout, ...]:
    return tuple(rollouts(world, policy, n_episodes, _stream(seed, _EPISODES)))


def _tests(episodes: Mapping[str, Sequence[Rollout]], *, seed: int) -> tuple[PairedTest, ...]:
    totals = {who: [episode.total for episode in played] for who, played in episodes.items()}
    return paired_tests(totals, rng=_stream(seed, _SIGNS))


def _stream(seed: int, which: int) -> np.random.Generator:
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(which,)))


def _where_one_can_be(world: World) -> BoolVector:
    """Squares that can be reached from the start, goals left out, shape (S,)."""
    reached: BoolVector = grid.distances_from(world.next_states, world.mdp.start_states) >= 0
    return reached & ~grid.mask(world.n_states, world.goals)


def _lost(best: Vector, value: Vector, asked: BoolVector) -> Vector:
    """V* − V^π where it is asked, shape (S,); rounding must not make a policy better than the best."""
    lost: Vector = np.where(asked, np.maximum(best - value, 0.0), 0.0)
    read_only(lost)
    return lost


def _scale(lost: Mapping[str, Vector], *, at_stake: float) -> float:
    most = max((float(one.max()) for one in lost.values()), default=0.0)
    return min(most, at_stake) if at_stake > 0.0 else most


def _as_rollout(demonstration: Demonstration) -> Rollout:
    return Rollout(tuple(demonstration.states.tolist()), demonstration.total, demonstration.reached_goal)
