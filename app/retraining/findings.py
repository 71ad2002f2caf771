"""What is found out about a learner of a run by learning many times: influence and uncertainty.

Every time is a call of its own, so that others have their turns in between.
"""

import math
from collections.abc import Awaitable, Callable
from typing import Final, TypeAlias

from app.kit.companion import Line
from app.retraining import computing
from app.retraining.answers import Answer
from app.retraining.computing import TooSlow
from irl_core import LearningProblem, LearningResult
from irl_core.uncertainty import Draw

Finding: TypeAlias = Callable[[Line, LearningProblem, LearningResult], Awaitable[Answer]]

LIMIT_MS: Final = 20_000.0
"""The longest that one answer may be computed, in time of the processor."""
TELLS_MS: Final = 2000.0
"""After this long the pace says whether it will come to more: before, a slow beginning would."""
BUDGET_MS: Final = 1000.0
"""As many draws are taken as fit into this …"""
N_DRAWS: Final = (200, 100, 50, 30)
"""… one of these numbers, so that a little more haste does not make it another."""
AT_ONCE_MS: Final = 100.0
"""Draws are taken in portions of about this, between which others have their turns."""


async def find_influence(line: Line, problem: LearningProblem, whole: LearningResult) -> Answer:
    """Tell what each demonstration changed, in the order in which they were played. Raises TooSlow."""
    influences, spent_ms = [], 0.0
    for one in problem.demonstrations:
        found, took_ms = await line.ask(computing.learn_without, problem, whole, one.id)
        influences.append(found.to_json())
        spent_ms += took_ms
        check_pace(spent_ms, n_done=len(influences), n_all=len(problem.demonstrations))
    return {"learner": whole.learner, "influences": influences, "compute_ms": spent_ms}


async def find_uncertainty(line: Line, problem: LearningProblem, whole: LearningResult) -> Answer:
    """Tell how sure a learner is. Raises TooSlow."""
    draws, spent_ms = ([], 0.0) if whole.posterior else await take_draws(line, problem, whole)
    found = await line.ask(computing.sum_up, problem, whole, draws)
    return found.to_json() | {"compute_ms": spent_ms}


async def take_draws(line: Line, problem: LearningProblem, whole: LearningResult) -> tuple[list[Draw], float]:
    """Learn from as many draws as can be afforded; the first tells how many those are."""
    draws, spent_ms = await line.ask(computing.learn_draws, problem, whole, range(1))
    n_draws = affordable(spent_ms)
    while len(draws) < n_draws:
        at_once = max(1, math.floor(AT_ONCE_MS * len(draws) / max(spent_ms, 1.0)))
        numbers = range(len(draws), min(n_draws, len(draws) + at_once))
        more, took_ms = await line.ask(computing.learn_draws, problem, whole, numbers)
        draws += more
        spent_ms += took_ms
        check_pace(spent_ms, n_done=len(draws), n_all=n_draws)
    return draws, spent_ms


def affordable(draw_ms: float) -> int:
    """Choose the number of draws by what one of them takes."""
    return next((n for n in N_DRAWS if n * draw_ms <= BUDGET_MS), N_DRAWS[-1])


def check_pace(spent_ms: float, *, n_done: int, n_all: int) -> None:
    """Raise TooSlow when all of it would take longer than anybody waits."""
    if spent_ms > TELLS_MS and spent_ms / n_done * n_all > LIMIT_MS:
        raise TooSlow
