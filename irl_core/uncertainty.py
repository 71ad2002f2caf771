"""How sure a learner can be, given so few attempts: a bootstrap over demonstrations, or a posterior where there is one.

**Bootstrap** (Efron & Tibshirani 1993, chs. 6 and 13). Draw b = 0, 1, … has a generator of its own, seeded with (s,
*b"attempts", b), s the problem's seed. From each of three strata, in this order, it takes as many demonstrations as are
in it, with replacement: the successes, the failures learned from, the failures left out. Their order stays; one that is
taken m times stands m times in its place, tied with itself. With R_b and π_b what the learner comes to from draw b with
the same settings and seed, R and π from the demonstrations as they are,

    policy agreement  (1/B) Σ_b [some action is among the likeliest of π and of π_b in s]     shape (S,), from 0 to 1
    reward            the (1 − level)/2 and (1 + level)/2 quantiles of R_b(s) over b          shape (S,) each
    return            the same quantiles of V^{π_b}(start) in the true world.

It answers: had the same person played again, how different might it have come out? With few demonstrations intervals
are too narrow (a bootstrap never sees what was not played), and with one of each outcome there is nothing to draw from:
the sentence then says so.

**Posterior.** Bayesian IRLFR knows what it does not know: agreement and reward are those of its `Posterior`. Its return
is in units of what the first goal pays; here it is in those of the world, so that both methods are read alike. It is
what the learner *believes* that its policy earns, where the bootstrap says what policies of other draws do earn.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np

from irl_core.array_checks import check_whole
from irl_core.arrays import BoolVector, Reward, Vector, read_only
from irl_core.checks import shown
from irl_core.errors import InvalidSettings, MissingDemonstrations
from irl_core.evaluation import expected_return
from irl_core.learners import LEARNERS, Learner, LearningProblem, LearningResult, learn
from irl_core.learners.problem import check_problem
from irl_core.planning import likeliest
from irl_core.types import Demonstration, DemonstrationOutcome, Ranking, World

LEVEL: Final = 0.9
"""Of both methods: nine in ten lie inside."""
N_DRAWS: Final = 100


@dataclass(frozen=True, eq=False)
class Draw:
    """What one draw of the bootstrap came to: R_b, shape (S,); where π_b agrees, shape (S,); what it earns."""

    reward: Reward
    agrees: BoolVector
    expected_return: float | None

    def __post_init__(self) -> None:
        read_only(self.reward)
        read_only(self.agrees)


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """How sure a learner is; see the module. `sentence` says it to people. Vectors have shape (S,).

    The returns are None where the problem's model is not a World.
    """

    learner: str
    method: Literal["posterior", "bootstrap"]
    level: float
    n_draws: int
    seed: int
    policy_agreement: Vector
    reward_low: Vector
    reward_high: Vector
    return_low: float | None
    return_high: float | None
    sentence: str

    def __post_init__(self) -> None:
        for array in (self.policy_agreement, self.reward_low, self.reward_high):
            read_only(array)

    def to_json(self) -> dict[str, Any]:
        """The uncertainty in JSON, its vectors as flat lists."""
        return {
            "learner": self.learner,
            "method": self.method,
            "level": self.level,
            "n_draws": self.n_draws,
            "seed": self.seed,
            "policy_agreement": self.policy_agreement.tolist(),
            "reward_low": self.reward_low.tolist(),
            "reward_high": self.reward_high.tolist(),
            "return_low": self.return_low,
            "return_high": self.return_high,
            "sentence": self.sentence,
        }


def bootstrap(learner: str | Learner, problem: LearningProblem, *, n_draws: int = N_DRAWS) -> Uncertainty:
    """How sure a learner is by learning again from draws of its demonstrations, `n_draws` times.

    Raises MissingDemonstrations where the learner cannot start, InvalidSettings.
    """
    check_problem(problem)
    n_draws = check_whole("n_draws", n_draws, minimum=1)
    whole = _learned(learner, problem)
    draws = (drawn(number, problem, whole, lambda again: _learned(learner, again)) for number in range(n_draws))
    return summary(problem, whole, draws)


def drawn(
    number: int, problem: LearningProblem, whole: LearningResult, learned: Callable[[LearningProblem], LearningResult]
) -> Draw:
    """What draw `number` comes to, where `whole` is what was learned from all and `learned` learns again."""
    result = learned(resampled(problem, number))
    shared = likeliest(whole.policy) & likeliest(result.policy)
    return Draw(
        reward=result.reward,
        agrees=np.asarray(shared.any(axis=1)).reshape(-1),
        expected_return=_expected_return(problem, result),
    )


def resampled(problem: LearningProblem, number: int) -> LearningProblem:
    """The problem of draw `number`. Copies of a demonstration are named "id", "id #2" and so on."""
    check_problem(problem)
    number = check_whole("number", number, minimum=0)
    rng = np.random.default_rng(np.random.SeedSequence([problem.seed, *b"attempts", number]))
    times: dict[str, int] = {}
    for stratum in _strata(problem):
        for chosen in rng.integers(len(stratum), size=len(stratum)) if stratum else ():
            times[stratum[chosen].id] = times.get(stratum[chosen].id, 0) + 1
    copies = {one.id: _copies(one, times.get(one.id, 0)) for one in problem.demonstrations}
    return LearningProblem.build(
        problem.model,
        [copy for several in copies.values() for copy in several],
        [_ranking(outcome, groups, copies) for outcome, groups in problem.orders.items()],
        problem.settings,
        problem.seed,
        features=problem.own_features,
    )


def summary(problem: LearningProblem, whole: LearningResult, draws: Iterable[Draw]) -> Uncertainty:
    """How sure a learner is by these draws. Raises InvalidSettings where there are none."""
    listed = tuple(draws)
    if not listed:
        raise InvalidSettings("A bootstrap needs at least one draw.", field="n_draws")
    rewards = np.array([draw.reward for draw in listed])
    returns = [draw.expected_return for draw in listed if draw.expected_return is not None]
    low, high = _tails(np.array(returns)) if returns else (None, None)
    return Uncertainty(
        learner=whole.learner,
        method="bootstrap",
        level=LEVEL,
        n_draws=len(listed),
        seed=problem.seed,
        policy_agreement=np.mean([draw.agrees for draw in listed], axis=0),
        reward_low=np.quantile(rewards, (1.0 - LEVEL) / 2.0, axis=0),
        reward_high=np.quantile(rewards, (1.0 + LEVEL) / 2.0, axis=0),
        return_low=low,
        return_high=high,
        sentence=_in_words(problem, whole.learner, len(listed), low, high),
    )


def from_posterior(problem: LearningProblem, result: LearningResult) -> Uncertainty:
    """How sure a Bayesian learner is, from its own posterior. Raises MissingDemonstrations where it has none."""
    check_problem(problem)
    posterior, model = result.posterior, problem.model
    if posterior is None:
        raise MissingDemonstrations(f"{shown(result.learner)} has no posterior.", field="learners")
    pays = float(model.reward[model.goal]) if isinstance(model, World) else None
    ends = (posterior.return_low, posterior.return_high)
    low, high = (None, None) if pays is None else sorted(end * pays for end in ends)
    return Uncertainty(
        learner=result.learner,
        method="posterior",
        level=posterior.level,
        n_draws=posterior.n_draws,
        seed=problem.seed,
        policy_agreement=posterior.policy_agreement,
        reward_low=posterior.reward_low,
        reward_high=posterior.reward_high,
        return_low=low,
        return_high=high,
        sentence=_believed(result.learner, posterior.level, low, high),
    )


def _strata(problem: LearningProblem) -> list[list[Demonstration]]:
    """Successes, failures learned from, failures left out, each in the order in which they were given."""
    learned_from = {one.id for one in problem.failures}
    successes = [one for one in problem.demonstrations if one.outcome == "success"]
    failures = [one for one in problem.demonstrations if one.outcome == "failure"]
    return [
        successes,
        [one for one in failures if one.id in learned_from],
        [one for one in failures if one.id not in learned_from],
    ]


def _copies(one: Demonstration, times: int) -> list[Demonstration]:
    return [one if copy == 1 else _named(one, f"{one.id} #{copy}") for copy in range(1, times + 1)]


def _named(one: Demonstration, id_: str) -> Demonstration:
    return Demonstration(
        id_, one.states, one.actions, one.rewards, one.total, one.outcome, one.ending, slip_seeds=one.slip_seeds
    )


def _ranking(
    outcome: DemonstrationOutcome, groups: Iterable[Iterable[str]], copies: Mapping[str, list[Demonstration]]
) -> Ranking:
    """The order with each demonstration as often as it was drawn."""
    expanded = (tuple(copy.id for id_ in group for copy in copies[id_]) for group in groups)
    return Ranking(outcome, tuple(group for group in expanded if group))


def _learned(learner: str | Learner, problem: LearningProblem) -> LearningResult:
    return learn(learner, problem, frame_every=problem.settings.iterations)


def _expected_return(problem: LearningProblem, result: LearningResult) -> float | None:
    return expected_return(problem.model, result.policy) if isinstance(problem.model, World) else None


def _tails(values: Vector) -> tuple[float, float]:
    return float(np.quantile(values, (1.0 - LEVEL) / 2.0)), float(np.quantile(values, (1.0 + LEVEL) / 2.0))


def _in_words(problem: LearningProblem, learner: str, n_draws: int, low: float | None, high: float | None) -> str:
    if all(len(stratum) < 2 for stratum in _strata(problem)):
        return "There is one attempt of a kind, so nothing can be drawn anew: how sure this is cannot be said."
    if low is None or high is None:
        return f"Learned again from {n_draws} draws of the same attempts."
    again = f"Learned again from {n_draws} draws of the same attempts, {_title(learner)} earns"
    if _figure(low) == _figure(high):
        return f"{again} {_figure(low)} in at least {LEVEL:.0%} of them."
    return f"{again} between {_figure(low)} and {_figure(high)} in {LEVEL:.0%} of them."


def _believed(learner: str, level: float, low: float | None, high: float | None) -> str:
    if low is None or high is None:
        return f"{_title(learner)} says how sure it is of each square."
    return (
        f"{_title(learner)} believes with {level:.0%} that its policy earns between {_figure(low)} and {_figure(high)};"
        " whether that holds, the true rewards decide."
    )


def _title(learner: str) -> str:
    return LEARNERS[learner].title if learner in LEARNERS else learner


def _figure(value: float) -> str:
    return f"{value:.2f}".replace("-", "−")
