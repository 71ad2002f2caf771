"""IRLR, inverse reinforcement learning through ranking (IRLFR paper, Sec. III-D).

It is MEIRL with feature counts weighted by rank: the best of N successes weighs N times what the last one does (Eq. 7).
"""

from dataclasses import dataclass, field
from typing import final

from irl_core.learners import descent
from irl_core.learners.base import Family, Frame, LearningResult, LearningState
from irl_core.learners.problem import LearningProblem


@final
@dataclass(frozen=True)
class Irlr:
    """The successes in their order."""

    name: str = field(default="irlr", init=False)
    title: str = field(default="IRLR", init=False)
    summary: str = field(default="Matches the successes, the better the more.", init=False)
    family: Family = field(default="paper", init=False)
    uses_ranking: bool = field(default=True, init=False)
    uses_failures: bool = field(default=False, init=False)
    uses_scores: bool = field(default=False, init=False)
    takes_anything: bool = field(default=False, init=False)
    references: tuple[str, ...] = field(
        default=(
            "Inverse reinforcement learning through failure and ranking (the IRLFR paper), Sec. III-D.",
            "Ziebart, Maas, Bagnell, Dey: Maximum entropy inverse reinforcement learning. AAAI 2008.",
        ),
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
        """μ̃ᴰ with θ_i = 2 i / (N (N + 1)), i = N for the best."""
        return descent.aims_of(problem, uses_ranking=self.uses_ranking, uses_failures=self.uses_failures)
