"""IRLF, inverse reinforcement learning from failure (IRLFR paper, Sec. III-C, Algorithm 5).

MEIRL whose reward also has w_F = (μ^π − μ̃ᶠ) / λ (Eq. 6): what the failures visit more than the policy loses reward.
λ decays from λ₀ to λ_min, so that failures count little at first. All demonstrations of one outcome weigh alike.
"""

from dataclasses import dataclass, field
from typing import final

from irl_core.learners import descent
from irl_core.learners.base import Family, Frame, LearningResult, LearningState
from irl_core.learners.problem import LearningProblem


@final
@dataclass(frozen=True)
class Irlf:
    """Successes and failures, no order."""

    name: str = field(default="irlf", init=False)
    title: str = field(default="IRLF", init=False)
    summary: str = field(default="Matches the successes and keeps away from the failures, each alike.", init=False)
    family: Family = field(default="paper", init=False)
    uses_ranking: bool = field(default=False, init=False)
    uses_failures: bool = field(default=True, init=False)
    uses_scores: bool = field(default=False, init=False)
    takes_anything: bool = field(default=False, init=False)
    references: tuple[str, ...] = field(
        default=(
            "Shiarlis, Messias, Whiteson: Inverse reinforcement learning from failure. AAMAS 2016.",
            "Ziebart, Maas, Bagnell, Dey: Maximum entropy inverse reinforcement learning. AAAI 2008.",
        ),
        init=False,
    )

    def start(self, problem: LearningProblem) -> LearningState:
        """The weights before the first iteration."""
        problem.require(self)
        return descent.start(problem, learner=self.name)

    def advance(self, problem: LearningProblem, state: LearningState, *, iterations: int) -> LearningState:
        """Gradient steps on w_D, w_F in closed form, then λ decays."""
        return descent.advance(problem, state, self._aims(problem), iterations=iterations)

    def frame(self, problem: LearningProblem, state: LearningState) -> Frame:
        """What it shows at this iteration."""
        return descent.frame(problem, state, self._aims(problem))

    def result(self, problem: LearningProblem, state: LearningState) -> LearningResult:
        """What it came to."""
        return descent.result(problem, state, self._aims(problem))

    def _aims(self, problem: LearningProblem) -> descent.Aims:
        """μ̃ᴰ and μ̃ᶠ with θ_i = 1 / N each."""
        return descent.aims_of(problem, uses_ranking=self.uses_ranking, uses_failures=self.uses_failures)
