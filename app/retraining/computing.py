"""What is computed in the companion process: plain functions of irl_core's values, which numbers go in and out of.

The web process imports this module for the names of its functions alone; Numba comes with the first call.
"""

import time
from dataclasses import dataclass
from typing import Final

from irl_core import IrlError, LearningProblem, LearningResult, Outcome, learn, warm_up

LIMIT_S: Final = 5.0
"""The longest that learning once may take here. It stops of itself; the companion's own limit is the last resort."""
LOOK_EVERY: Final = 100
"""Iterations between two looks at the clock in a small world."""
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


def learn_again(learner: str, problem: LearningProblem) -> Learned:
    """Let a learner learn from the beginning, exactly as a worker would. Raises TooSlow, and irl_core's refusals."""
    began = time.perf_counter()
    until = time.monotonic() + LIMIT_S
    result = learn(learner, problem, frame_every=_at_once(problem), should_stop=lambda: time.monotonic() > until)
    if result.outcome is Outcome.STOPPED:
        raise TooSlow
    return Learned(result, 1000.0 * (time.perf_counter() - began))


def _at_once(problem: LearningProblem) -> int:
    return max(1, min(LOOK_EVERY, STATES_AT_ONCE // problem.mdp.n_states))
