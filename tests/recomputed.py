"""The whole comparison once more, from what is stored: world, attempts, policies, episodes.

By loops that read as the formulas do; nothing of app or irl_core is imported, so that who agrees has copied no
mistake. Of libraries it takes the uniform numbers that NumPy draws from a seed, and SciPy's quantile of Student's t.
"""

import math
import statistics
from itertools import combinations, pairwise
from typing import Any

import numpy as np
from scipy.special import stdtrit

from tests.journey import Grid

EPISODES, SIGNS = 0, 1
N_DRAWS = 9_999
TOLERANCE = 1e-9

Json = dict[str, Any]


def comparison(world: Json, demonstrations: list[Json], learners: Json, rollouts: Json, *, seed: int) -> Json:
    """What `GET /runs/{id}/comparison` must say; `learners` are the run's results by name."""
    grid = Square(world)
    best = grid.best_values()
    values = {name: grid.values(result["policy"]) for name, result in learners.items()}
    for name, result in learners.items():
        assert replayed(grid, result["policy"], seed, len(rollouts[name])) == rollouts_states(rollouts[name]), name
    totals = {who: [check_episode(grid, one) for one in episodes] for who, episodes in rollouts.items()}
    assert [one["states"] for one in demonstrations] == rollouts_states(rollouts.get("human", []))
    expected = {name: value[grid.start] for name, value in values.items()} | {"optimal": best[grid.start]}
    greedy: dict[str, float | None] = {name: grid.greedy_return(result["reward"]) for name, result in learners.items()}
    greedy["optimal"] = best[grid.start]
    entries = [entry(who, rollouts[who], totals[who], expected.get(who), greedy.get(who)) for who in totals]
    reachable = grid.reachable() - grid.goals
    lost = {name: [max(best[s] - v[s], 0.0) if s in reachable else 0.0 for s in grid.squares]
            for name, v in values.items()}  # fmt: skip
    most = max((max(one) for one in lost.values()), default=0.0)
    at_stake = max(best[s] for s in reachable)
    return {
        "seed": seed,
        "horizon": grid.horizon,
        "entries": placed(entries, optimum=best[grid.start]),
        "human": human_attempts(demonstrations),
        "value_lost": lost,
        "value_lost_scale": min(most, at_stake) if at_stake > 0 else most,
        "tests": paired_tests({name: totals[name] for name in learners}, seed),
    }


class Square(Grid):
    """The rules of the world, and what can be earned from every square."""

    def __init__(self, world: Json) -> None:
        super().__init__(world)
        self.squares = range(self.rows * self.cols)

    def reachable(self) -> set[int]:
        """Squares one can come to from the start."""
        found, new = {self.start}, [self.start]
        while new:
            here = new.pop()
            if here in self.goals:
                continue
            ahead = {self.reached(here, action) for action in range(4)} - found
            found |= ahead
            new += ahead
        return found

    def best_values(self) -> list[float]:
        """V* with all steps to go, by backward induction."""
        value = [0.0 for _ in self.squares]
        for _ in range(self.horizon):
            value = [
                0.0 if s in self.goals else max(self._backup(value, s, action) for action in range(4))
                for s in self.squares
            ]
        return value

    def values(self, policy: list[list[float]]) -> list[float]:
        """V^π with all steps to go."""
        value = [0.0 for _ in self.squares]
        for _ in range(self.horizon):
            value = [
                0.0 if s in self.goals else math.fsum(policy[s][a] * self._backup(value, s, a) for a in range(4))
                for s in self.squares
            ]
        return value

    def greedy_return(self, learned: list[list[float]]) -> float | None:
        """The true return of the plan that earns most of the learned reward and arrives; None where that is flat.

        Not to arrive costs more than all that can be earned; under slip, 0.1 % more chance of arriving is worth it all.
        """
        reward = [value for row in learned for value in row]
        span = max(reward) - min(reward)
        if span == 0:
            return None
        late = -(self.horizon * span + 1) * (1000 if self.slip else 1)
        planned = [0.0 if s in self.goals else late for s in self.squares]
        worth = [0.0 for _ in self.squares]
        for _ in range(self.horizon):
            ahead = [reward[s] + planned[s] for s in self.squares]
            choices = [[self._mean(ahead, s, action) for action in range(4)] for s in self.squares]
            best = [choices[s].index(max(choices[s])) for s in self.squares]
            worth = [0.0 if s in self.goals else self._backup(worth, s, best[s]) for s in self.squares]
            planned = [0.0 if s in self.goals else choices[s][best[s]] for s in self.squares]
        return worth[self.start]

    def direction_law(self, chances: list[float]) -> list[float]:
        """The chance of each direction when actions are chosen with these chances and may slip."""
        return [
            math.fsum(p * (1 - self.slip if d == action else self.slip / 3) for action, p in enumerate(chances))
            for d in range(4)
        ]


def replayed(grid: Square, policy: list[list[float]], seed: int, n_episodes: int) -> list[list[int]]:
    """Play the policy again with the numbers of the seed: step t of episode k draws u[t][k], whoever plays."""
    u = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(EPISODES,))).random((grid.horizon, n_episodes))
    laws = [grid.direction_law(row) for row in policy]
    episodes = []
    for k in range(n_episodes):
        states = [grid.start]
        for t in range(grid.horizon):
            law = laws[states[-1]]
            direction = sum(u[t][k] >= below for below in (law[0], law[0] + law[1], law[0] + law[1] + law[2]))
            states.append(grid.reached(states[-1], direction))
            if states[-1] in grid.goals:
                break
        episodes.append(states)
    return episodes


def rollouts_states(episodes: list[Json]) -> list[list[int]]:
    return [one["states"] for one in episodes]


def check_episode(grid: Square, episode: Json) -> float:
    """An episode's total from its squares, after making sure that each move is one the world allows."""
    states = episode["states"]
    assert states[0] == grid.start
    assert len(states) - 1 <= grid.horizon
    for here, there in pairwise(states):
        assert here not in grid.goals
        assert there in {grid.reached(here, action) for action in range(4)}
    assert episode["reached_goal"] == (states[-1] in grid.goals)
    total = math.fsum(grid.rewards[state] for state in states[1:])
    assert math.isclose(episode["total"], total, abs_tol=TOLERANCE)
    return total


def entry(who: str, episodes: list[Json], totals: list[float], expected: float | None, greedy: float | None) -> Json:
    low, high = interval(totals)
    won = [total >= 0 and one["reached_goal"] for one, total in zip(episodes, totals, strict=True)]
    return {
        "who": who,
        "mean_return": statistics.fmean(totals),
        "standard_error": statistics.stdev(totals) / math.sqrt(len(totals)) if len(totals) > 1 else 0.0,
        "interval_low": low,
        "interval_high": high,
        "success_rate": statistics.fmean(won),
        "mean_steps": statistics.fmean(len(one["states"]) - 1 for one in episodes),
        "expected_return": expected,
        "greedy_return": greedy,
        "episodes": len(totals),
    }


def interval(values: list[float]) -> tuple[float | None, float | None]:
    """Of the mean, 95 %, by Student's t."""
    n = len(values)
    if n == 1:
        return None, None
    reach = float(stdtrit(n - 1, 0.975)) * statistics.stdev(values) / math.sqrt(n)
    return statistics.fmean(values) - reach, statistics.fmean(values) + reach


def placed(entries: list[Json], *, optimum: float) -> list[Json]:
    def score(one: Json) -> float:
        figure: float = one["mean_return"] if one["expected_return"] is None else one["expected_return"]
        return figure

    for one in entries:
        one["place"] = 1 + sum(score(other) > score(one) + TOLERANCE * (abs(optimum) or 1) for other in entries)
        one["share_of_optimum"] = score(one) / optimum if optimum > 0 else None
    return sorted(entries, key=lambda one: one["place"])


def human_attempts(demonstrations: list[Json]) -> Json | None:
    if not demonstrations:
        return None
    mean = statistics.fmean(one["total"] for one in demonstrations)
    best = max(demonstrations, key=lambda one: one["total"])
    return {"best": best["id"], "mean": min(demonstrations, key=lambda one: abs(one["total"] - mean))["id"]}


def paired_tests(totals: dict[str, list[float]], seed: int) -> list[Json]:
    """Every two learners, episode by episode, with Holm's p-values."""
    pairs = list(combinations(totals, 2))
    if not pairs:
        return []
    n = len(totals[pairs[0][0]])
    draws = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(SIGNS,))).random((N_DRAWS, n))
    flips = [[k for k, flips in enumerate(row) if flips] for row in (draws < 0.5).tolist()]
    tests: list[Json] = []
    for a, b in pairs:
        d = [x - y for x, y in zip(totals[a], totals[b], strict=True)]
        low, high = interval(d)
        p = p_value(d, flips)
        tests.append({"a": a, "b": b, "mean_difference": statistics.fmean(d), "low": low, "high": high, "p_value": p})
    by_p = sorted(tests, key=lambda test: test["p_value"])
    for rank, test in enumerate(by_p):
        test["p_adjusted"] = max(min(1.0, (len(tests) - j) * by_p[j]["p_value"]) for j in range(rank + 1))
    return tests


def p_value(d: list[float], flips: list[list[int]]) -> float:
    """How often signs that chance gives take the sum as far from 0 as it is."""
    observed = math.fsum(d)
    bound = abs(observed) - TOLERANCE * math.fsum(map(abs, d))
    differing = [value for value in d if value != 0]
    if len(differing) <= 13:
        sums = [0.0]
        for value in differing:
            sums = [total + sign * value for total in sums for sign in (-1, 1)]
        return statistics.fmean(abs(total) >= bound for total in sums)
    reached = sum(abs(observed - 2 * sum([d[k] for k in row])) >= bound for row in flips)
    return (1 + reached) / (1 + N_DRAWS)


def differences(told: Any, ours: Any, where: str = "") -> list[str]:
    """Where two comparisons say something else; what only one of them has (titles, ids of the run) is let be."""
    if isinstance(ours, dict):
        assert isinstance(told, dict), where
        return [text for key in ours for text in differences(told.get(key), ours[key], f"{where}.{key}")]
    if isinstance(ours, list):
        if not isinstance(told, list) or len(told) != len(ours):
            return [f"{where}: {told!r} is not {ours!r}"]
        return [text for k, one in enumerate(ours) for text in differences(told[k], one, f"{where}[{k}]")]
    if isinstance(ours, float) and isinstance(told, (int, float)):
        is_same = math.isclose(told, ours, rel_tol=TOLERANCE, abs_tol=TOLERANCE)
    else:
        is_same = told == ours
    return [] if is_same else [f"{where}: {told!r} is not {ours!r}"]
