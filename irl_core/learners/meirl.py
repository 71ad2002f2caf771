"""MEIRL, maximum entropy inverse reinforcement learning (IRLFR paper, Sec. III-B, Algorithm 4).

It finds the reward under which the expected visits are those of the successes, all weighing 1 / N (Eqs. 3, 5).
"""

from dataclasses import dataclass, field
from typing import final

from irl_core.learners import descent
from irl_core.learners.base import Family, Frame, LearningResult, LearningState
from irl_core.learners.problem import LearningProblem


@final
@dataclass(frozen=True)
class Meirl:
    """The successes as they are: no order, no failures."""

    name: str = field(default="meirl", init=False)
    title: str = field(default="MEIRL", init=False)
    summary: str = field(default="Matches the successes, each alike.", init=False)
    family: Family = field(default="paper", init=False)
    uses_ranking: bool = field(default=False, init=False)
    uses_failures: bool = field(default=False, init=False)
    uses_scores: bool = field(default=False, init=False)
    takes_anything: bool = field(default=False, init=False)
    references: tuple[str, ...] = field(
        default=("Ziebart, Maas, Bagnell, Dey: Maximum entropy inverse reinforcement learning. AAAI 2008.",),
        init=False,
    )

    def start(self, problem: LearningProblem) -> LearningState:
        """The weights before the first iteration."""
        problem.require(self)
        return descent.start(problem, learner=self.name)

    def advance(self, problem: LearningProblem, state: LearningState, *, iterations: int) -> LearningState:
        """Gradient steps on w_D alone."""
        return descent.advance(problem, state, self._aims(problem), iterations=iterations)

    def frame(self, problem: LearningProblem, state: LearningState) -> Frame:
        """What it shows at this iteration."""
        return descent.frame(problem, state, self._aims(problem))

    def result(self, problem: LearningProblem, state: LearningState) -> LearningResult:
        """What it came to."""
        return descent.result(problem, state, self._aims(problem))

    def _aims(self, problem: LearningProblem) -> descent.Aims:
        """μ̃ᴰ with θ_i = 1 / N."""
        return descent.aims_of(problem, uses_ranking=self.uses_ranking, uses_failures=self.uses_failures)
