"""Compile what is compiled, now rather than at the first run.

Numba keeps its machine code beside the sources (or where NUMBA_CACHE_DIR says), so this takes some seconds once, and
next to nothing from then on.
"""

from itertools import pairwise
from typing import Final

import numpy as np

from irl_core.inference import INFERENCE_KINDS, infer, infer_batch
from irl_core.learners import LEARNERS, LearningProblem, Settings, learn
from irl_core.playing import simulate
from irl_core.types import Ranking, World

_WALKS: Final = {"a": [0, 1, 2, 5, 8], "b": [0, 1, 4, 5, 8], "c": [0, 3, 6, 7, 8], "d": [0, 3, 4, 7, 8]}
_DOWN, _RIGHT = 2, 1


def warm_up() -> None:
    """Let every inference and every learner take a few steps in a small world."""
    world = World(3, 3, np.array([[-0.5, -0.2, -0.3], [-3.0, -0.4, -0.1], [-3.0, -2.0, 2.0]]), 0, (8,))
    reward = np.full(world.n_states, -2.0)
    for kind in INFERENCE_KINDS:
        infer(world, reward, inference=kind)
    infer_batch([world, world], np.stack([reward, reward]))
    infer_batch([world, world], np.stack([reward, reward]), inference="path_infinite")
    problem = _small_problem(world)
    for learner in LEARNERS.values():
        learn(learner, problem, frame_every=1)


def _small_problem(world: World) -> LearningProblem:
    attempts = [simulate(world, _actions(walk), attempt_id=name) for name, walk in _WALKS.items()]
    rankings = [Ranking("success", (("a",), ("b",))), Ranking("failure", (("c",), ("d",)))]
    return LearningProblem.build(world, attempts, rankings, Settings(iterations=2))


def _actions(walk: list[int]) -> list[int]:
    return [_RIGHT if there == here + 1 else _DOWN for here, there in pairwise(walk)]
