"""Some worlds of an experiment: a pure function of its arguments, so that it can run anywhere and any number of times.

World k, whatever the kind of demonstrator, is the first playable one drawn from SeedSequence([seed, k]). The j-th draw
of it is played with the stream SeedSequence([seed, k, j, the kind's name]); where this demonstrator never fails or
never succeeds, the next world of the same stream is drawn instead and counted (`n_redrawn`). Learners and episodes are
seeded by the world's own seed, and episodes by the learner's name besides: over many worlds nobody's luck is shared,
while `irl_core.compare` lets everybody share it within one. So the outcome of a world depends on nothing but the spec,
the kind and k.
"""

import math
from typing import Final

import numpy as np

from irl_core.arrays import Reward
from irl_core.checks import is_integer
from irl_core.checks import shown as in_words
from irl_core.demonstrators import MOST_ATTEMPTS, Demonstrated, demonstrate, demonstrator_named
from irl_core.errors import DivergentPartition, InvalidSettings, InvalidWorld, MissingDemonstrations
from irl_core.evaluation import expected_return, greedy_plan, optimum, rollouts
from irl_core.experiment.outcomes import LearnerOutcome, WorldOutcome
from irl_core.experiment.spec import ExperimentSpec
from irl_core.gridworld import draw_playable_world
from irl_core.learners import LEARNERS, LearningProblem, LearningResult, learn
from irl_core.types import World

MOST_REDRAWN: Final = 100
_TO_THE_END: Final = 1_000_000


def run_chunk(spec: ExperimentSpec, kind: str, first: int, last: int) -> list[WorldOutcome]:
    """The outcomes of worlds `first` up to, but without, `last`. Raises InvalidSettings or InvalidWorld."""
    demonstrator_named(kind)
    if not isinstance(spec, ExperimentSpec):
        raise InvalidSettings(f"spec must be an ExperimentSpec, not {in_words(spec)}.", field="spec")
    if not is_integer(first) or not is_integer(last) or not 0 <= int(first) <= int(last):
        raise InvalidSettings(
            f"A chunk runs from a world to a later one, not from {in_words(first)} to {in_words(last)}.", field="first"
        )
    return [run_world(spec, kind, index) for index in range(first, last)]


def run_world(spec: ExperimentSpec, kind: str, index: int) -> WorldOutcome:
    """One world of the experiment: drawn, played, learned from, and measured."""
    world, shown, n_redrawn = play_world(spec, kind, index)
    problem = LearningProblem.build(
        world, shown.demonstrations, shown.rankings, settings=spec.settings, seed=_seed_of(world)
    )
    return WorldOutcome(
        demonstrator=kind,
        index=index,
        world_seed=_seed_of(world),
        n_redrawn=n_redrawn,
        n_attempts=shown.n_attempts,
        optimum=optimum(world),
        totals=tuple(one.total for one in shown.demonstrations),
        learners={name: _learned(spec, world, problem, name) for name in spec.learners},
    )


def play_world(spec: ExperimentSpec, kind: str, index: int) -> tuple[World, Demonstrated, int]:
    """World `index`, what the demonstrator left there, and how many worlds had to be redrawn before."""
    worlds = np.random.default_rng(np.random.SeedSequence([spec.seed, index]))
    for n_redrawn in range(MOST_REDRAWN):
        world = draw_playable_world(
            worlds, rows=spec.rows, cols=spec.cols, red_probability=spec.red_probability, slip=spec.slip
        )
        shown = demonstrate(
            kind,
            world,
            np.random.default_rng(np.random.SeedSequence([spec.seed, index, n_redrawn, *kind.encode()])),
            n_successes=spec.n_successes,
            n_failures=spec.n_failures,
            ranking_noise=spec.ranking_noise,
            ties_within=spec.ties_within,
        )
        if shown is not None:
            return world, shown, n_redrawn
    raise InvalidWorld(
        f"In none of {MOST_REDRAWN} worlds of {spec.rows}×{spec.cols} squares has {kind} both {spec.n_successes}"
        f" successes and {spec.n_failures} failures within {MOST_ATTEMPTS} attempts; ask for fewer, for another slip or"
        " size, or for another demonstrator.",
        field="demonstrators",
    )


def _learned(spec: ExperimentSpec, world: World, problem: LearningProblem, name: str) -> LearnerOutcome:
    try:
        result = _run_to_the_end(problem, name)
    except (DivergentPartition, MissingDemonstrations) as error:
        return LearnerOutcome.refused(error.message)
    episodes = rollouts(world, result.policy, spec.n_episodes, _episodes_rng(world, name))
    return LearnerOutcome(
        outcome=result.outcome.value,
        iterations=result.iterations,
        gap=result.gap,
        mean_return=math.fsum(episode.total for episode in episodes) / len(episodes),
        expected_return=expected_return(world, result.policy),
        greedy_return=_greedy_return(world, result.reward),
    )


def _greedy_return(world: World, reward: Reward) -> float:
    """What the best plan under the learned reward earns; NaN where the reward is the same everywhere."""
    return math.nan if np.ptp(reward) == 0.0 else expected_return(world, greedy_plan(world, reward))


def _run_to_the_end(problem: LearningProblem, name: str) -> LearningResult:
    return learn(LEARNERS[name], problem, frame_every=_TO_THE_END)


def _episodes_rng(world: World, name: str) -> np.random.Generator:
    return np.random.default_rng(np.random.SeedSequence([_seed_of(world), *name.encode()]))


def _seed_of(world: World) -> int:
    if world.seed is None:
        raise InvalidWorld("A world of an experiment is drawn from a seed.", field="seed")
    return world.seed
