"""The learners by name, and `learn`, which runs one of them to its end."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from irl_core.array_checks import check_whole
from irl_core.checks import shown
from irl_core.errors import InvalidSettings
from irl_core.learners.base import Family, Frame, Learner, LearningResult, LearningState, Outcome, Posterior
from irl_core.learners.baselines import BehaviouralCloning, RandomPlay, ScoreIrl, Trex
from irl_core.learners.birlfr import Birlfr
from irl_core.learners.irlf import Irlf
from irl_core.learners.irlfr import Irlfr
from irl_core.learners.irlr import Irlr
from irl_core.learners.meirl import Meirl
from irl_core.learners.model_free import ModelFree
from irl_core.learners.problem import LearningProblem, check_problem
from irl_core.learners.settings import Settings

LEARNERS: Mapping[str, Learner] = MappingProxyType(
    {
        learner.name: learner
        for learner in (
            *(Meirl(), Irlr(), Irlf(), Irlfr()),
            *(Birlfr(), ModelFree()),
            *(Trex(), BehaviouralCloning(), ScoreIrl(), RandomPlay()),
        )
    }
)
"""The learners of the paper, in its order; ours; and those of the neighbourhood."""

DEFAULT_LEARNERS: tuple[str, ...] = tuple(
    name for name, learner in LEARNERS.items() if learner.family == "paper" or name == "birlfr"
)
"""Who learns where nobody says who: the paper's four and Bayesian IRLFR."""


def learn(
    learner: str | Learner,
    problem: LearningProblem,
    *,
    on_frame: Callable[[Frame], None] | None = None,
    frame_every: int = 10,
    should_stop: Callable[[], bool] = lambda: False,
) -> LearningResult:
    """Run a learner to its end, or until `should_stop`, which is asked every `frame_every` iterations.

    `on_frame` is shown the start, every `frame_every`-th iteration and the end. Raises MissingDemonstrations where the
    problem lacks what the learner needs, InvalidSettings, and what the model cannot do (InvalidModel, InvalidFeatures,
    DivergentPartition).
    """
    learner = _named(learner)
    check_problem(problem)
    frame_every = check_whole("frame_every", frame_every, minimum=1)
    state = learner.start(problem)
    _show(learner, problem, state, on_frame)
    while not state.is_finished and not should_stop():
        state = learner.advance(problem, state, iterations=frame_every)
        _show(learner, problem, state, on_frame)
    return learner.result(problem, state)


def _named(learner: str | Learner) -> Learner:
    if isinstance(learner, str) and learner in LEARNERS:
        return LEARNERS[learner]
    if isinstance(learner, str) or not hasattr(learner, "start"):
        raise InvalidSettings(
            f"There is no learner {shown(learner)}; there are {', '.join(LEARNERS)}.", field="learners"
        )
    return learner


def _show(
    learner: Learner, problem: LearningProblem, state: LearningState, on_frame: Callable[[Frame], None] | None
) -> None:
    if on_frame is not None:
        on_frame(learner.frame(problem, state))


__all__ = [
    "DEFAULT_LEARNERS",
    "LEARNERS",
    "Family",
    "Frame",
    "Learner",
    "LearningProblem",
    "LearningResult",
    "LearningState",
    "Outcome",
    "Posterior",
    "Settings",
    "learn",
]
