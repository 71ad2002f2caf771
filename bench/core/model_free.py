"""How near the model-free learner comes to the exact one, by the number of episodes it plays, and what it takes."""

import time
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from bench.measure import Figure, at_least, at_most
from irl_core import LearningProblem, LearningResult, draw_playable_world, expected_return, expected_visits, learn
from irl_core.demonstrators import demonstrate
from irl_core.learners import Settings, descent
from irl_core.learners.model_free import ModelFree

N_WORLDS = 5
EPISODES = {50: 0.3, 500: 0.1, 5000: 0.05}
"""The number of episodes an iteration, and how far visits may be from the exact ones then."""


def measure() -> Iterator[Figure]:
    given = [problem(k) for k in range(N_WORLDS)]
    exact = [exact_descent(one) for one in given]
    people = f"{N_WORLDS} worlds 7×7, mixture"
    for n, target in EPISODES.items():
        apart = [visits_apart(one, learned(one, n), best) for one, best in zip(given, exact, strict=True)]
        yield at_most(
            f"model-free IRLFR, {n} episodes: visits off the exact descent",
            apart,
            target=target,
            unit="visits",
            reference=f"descent.py from the same start, largest of squares; {people}",
        )
    started = time.process_time()
    ours = [expected_return(one.world, learned(one, Settings().episodes).policy) for one in given]
    taken = (time.process_time() - started) / N_WORLDS
    theirs = [expected_return(one.world, learn("irlfr", one).policy) for one in given]
    kept = float(np.sum(ours) / np.sum(theirs))
    yield at_least(
        "model-free IRLFR: share of what IRLFR earns", [kept], target=0.9, unit="", reference=f"irlfr; {people}"
    )
    yield at_most("model-free IRLFR: CPU a world", [taken], target=2.0, unit="s", reference="500 iterations")


def problem(k: int) -> LearningProblem:
    """The first person from seed k on who leaves three successes and three failures."""
    for attempt in range(100):
        rng = np.random.default_rng([k, attempt])
        world = draw_playable_world(rng)
        played = demonstrate("mixture", world, rng)
        if played is not None:
            return LearningProblem.build(world, played.demonstrations, played.rankings)
    raise AssertionError(k)


def learned(given: LearningProblem, n_episodes: int) -> LearningResult:
    """What the model-free learner comes to with so many episodes an iteration."""
    return learn(ModelFree(), replace(given, settings=replace(given.settings, episodes=n_episodes)), frame_every=500)


def exact_descent(given: LearningProblem) -> LearningResult:
    """IRLFR with exact visits, from where the model-free learner starts."""
    aims = descent.aims_of(given, uses_ranking=True, uses_failures=True)
    state = descent.start(given, learner="irlfr")
    state = replace(state, values={**state.values, "w_success": ModelFree().start(given).vector("w_success")})
    return descent.result(given, descent.advance(given, state, aims, iterations=given.settings.iterations), aims)


def visits_apart(given: LearningProblem, one: LearningResult, other: LearningResult) -> float:
    """The largest difference in a square's expected visits when the policies are executed."""
    first, second = (expected_visits(given.world, result.policy) for result in (one, other))
    return float(np.abs(first - second).max())
