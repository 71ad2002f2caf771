"""What is computed in the companion process: plain functions of irl_core's values, which numbers go in and out of.

The web process imports this module for the names of its functions alone; Numba comes with the first call.
"""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from irl_core import (
    LEARNERS,
    IrlError,
    LearningProblem,
    LearningResult,
    World,
    expected_return,
    greedy_plan,
    warm_up,
)
from irl_core.influence import Difference, Influence, difference, influence_of, what_if
from irl_core.uncertainty import Draw, Uncertainty, drawn, from_posterior, summary

LIMIT_S: Final = 5.0
"""The longest that learning once may take here: beyond it nobody calls it at once.

All times are those of the processor: that others are at work, too, does not make a world too large.
"""
TELLS_S: Final = 1.0
"""After this long the pace says whether it will come to far more than that."""
FAR_MORE: Final = 3.0
LOOK_EVERY: Final = 100
"""Iterations between two looks at the clock in a small world …"""
STATES_AT_ONCE: Final = 10_000
"""… and in a large one as many as come to about so many squares."""


class TooSlow(Exception):
    """Learning did not end within the limit."""


EXPECTED: Final = (IrlError, TooSlow, MemoryError)
"""What these functions raise."""


@dataclass(frozen=True, slots=True)
class Learned:
    """What a learner came to, and how long it computed."""

    result: LearningResult
    compute_ms: float


def get_ready() -> None:
    """Load what is compiled."""
    warm_up()


@dataclass(frozen=True, slots=True)
class Returns:
    """What a policy earns in the true world; `greedy_return` is that of the best plan for the learned reward."""

    expected_return: float
    greedy_return: float | None


@dataclass(frozen=True, slots=True)
class Changed:
    """What came of a change, and what it was before."""

    learned: Learned
    now: Returns
    before: Returns
    difference: Difference


def learn_again(learner: str, problem: LearningProblem) -> Learned:
    """Let a learner learn from the beginning, exactly as a worker would. Raises TooSlow, and irl_core's refusals."""
    began, chosen, at_once = time.thread_time(), LEARNERS[learner], _at_once(problem)
    state = chosen.start(problem)
    while not state.is_finished:
        state = chosen.advance(problem, state, iterations=at_once)
        _check_pace(time.thread_time() - began, share_done=state.iteration / problem.settings.iterations)
    return Learned(chosen.result(problem, state), _ms_since(began))


def learn_changed(problem: LearningProblem, before: LearningResult, change: Mapping[str, Any]) -> Changed:
    """Learn again with one thing changed: `drop`, `swap` or `relabel`, as irl_core's `what_if` has it."""
    learned = learn_again(before.learner, what_if(problem, **change))
    return Changed(
        learned=learned,
        now=_returns(problem.world, learned.result),
        before=_returns(problem.world, before),
        difference=difference(problem, before, learned.result),
    )


def learn_without(problem: LearningProblem, whole: LearningResult, id_: str) -> tuple[Influence, float]:
    """Tell what one demonstration changed, and in how many milliseconds that was found out."""
    began = time.thread_time()
    found = influence_of(id_, problem, whole, lambda rest: learn_again(whole.learner, rest).result)
    return found, _ms_since(began)


def learn_draws(problem: LearningProblem, whole: LearningResult, numbers: range) -> tuple[list[Draw], float]:
    """Learn from these draws of the demonstrations; tell in how many milliseconds."""
    began = time.thread_time()
    draws = [drawn(n, problem, whole, lambda again: learn_again(whole.learner, again).result) for n in numbers]
    return draws, _ms_since(began)


def sum_up(problem: LearningProblem, whole: LearningResult, draws: list[Draw]) -> Uncertainty:
    """Tell how sure a learner is by these draws, or by its own posterior if it has one."""
    return summary(problem, whole, draws) if whole.posterior is None else from_posterior(problem, whole)


def _returns(world: World, result: LearningResult) -> Returns:
    """As the comparison has them: who learned a policy and no reward has no plan for it."""
    has_reward = np.ptp(result.reward) > 0.0
    greedy = expected_return(world, greedy_plan(world, result.reward)) if has_reward else None
    return Returns(expected_return(world, result.policy), greedy)


def _check_pace(elapsed_s: float, *, share_done: float) -> None:
    """Raise TooSlow when learning has taken too long, or is going to by far."""
    if elapsed_s > LIMIT_S or (elapsed_s > TELLS_S and elapsed_s > FAR_MORE * LIMIT_S * share_done):
        raise TooSlow


def _at_once(problem: LearningProblem) -> int:
    return max(1, min(LOOK_EVERY, STATES_AT_ONCE // problem.mdp.n_states))


def _ms_since(began: float) -> float:
    return 1000.0 * (time.thread_time() - began)
