"""How much each demonstration mattered: learning again without it, and other changes one might wonder about.

**Leave one out.** For demonstration i the learner learns again from all the others, from the beginning, with the same
settings and seed; their order stays as it was. With π, R and π₋ᵢ, R₋ᵢ what it came to with and without i, and μ the
expected visits when π is executed, goals apart,

    policy change  Σ_s μ(s) · ½ Σ_a |π(a | s) − π₋ᵢ(a | s)| / Σ_s μ(s)     the share of steps taken otherwise, 0 to 1
    reward change  Σ_s |R(s) − R₋ᵢ(s)| / S
    return change  V^π − V^π₋ᵢ in the true world: above 0 where the demonstration helped.

This is exact retraining, N + 1 runs, no influence function to first order (Koh and Liang 2017): with few demonstrations
leaving one out is no small change. Nothing says that influences add up.

**What if.** `what_if` changes one thing, `difference` compares what was learned before and after, in the same figures
but for the sign: there it is the new − the old, so that a return change above 0 says that the change helped. A square
has *turned* where none of the actions that were likeliest before is likeliest after.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from irl_core.arrays import Reward, read_only
from irl_core.checks import shown
from irl_core.errors import InvalidRanking, MissingDemonstrations
from irl_core.evaluation import expected_return, expected_visits
from irl_core.learners import Learner, LearningProblem, LearningResult, learn
from irl_core.learners.problem import check_problem
from irl_core.planning import likeliest
from irl_core.types import Demonstration, DemonstrationOutcome, Ranking, World

_OTHER: Final[dict[DemonstrationOutcome, DemonstrationOutcome]] = {"success": "failure", "failure": "success"}


@dataclass(frozen=True)
class Influence:
    """What one demonstration changed; see the module. Changes are None where nothing can be learned without it.

    `sentence` then says why. `return_change` is None, too, where the problem's model is not a World, and so is
    `expected_return`, what is earned without it. `turned` are the squares that turn when it is left out.
    """

    id: str
    outcome: DemonstrationOutcome
    n_steps: int
    policy_change: float | None
    reward_change: float | None
    return_change: float | None
    sentence: str | None
    expected_return: float | None = None
    turned: tuple[int, ...] | None = None

    def to_json(self) -> dict[str, Any]:
        """The influence in JSON."""
        return {
            "id": self.id,
            "outcome": self.outcome,
            "n_steps": self.n_steps,
            "policy_change": self.policy_change,
            "reward_change": self.reward_change,
            "return_change": self.return_change,
            "sentence": self.sentence,
            "expected_return": self.expected_return,
            "turned": None if self.turned is None else list(self.turned),
        }


@dataclass(frozen=True, eq=False)
class Difference:
    """What came of a change: the new − the old; see the module. `reward`, shape (S,), is the new reward − the old one.

    `return_change` is None where the problem's model is not a World.
    """

    policy_change: float
    reward_change: float
    return_change: float | None
    turned: tuple[int, ...]
    reward: Reward

    def __post_init__(self) -> None:
        read_only(self.reward)

    def to_json(self) -> dict[str, Any]:
        """The difference in JSON."""
        return {
            "policy_change": self.policy_change,
            "reward_change": self.reward_change,
            "return_change": self.return_change,
            "turned": list(self.turned),
            "reward": self.reward.tolist(),
        }


def influence(learner: str | Learner, problem: LearningProblem) -> tuple[Influence, ...]:
    """The influence of each demonstration of the problem, in the order given.

    Raises MissingDemonstrations where the learner cannot even start with all of them.
    """
    check_problem(problem)
    whole = _learned(learner, problem)
    return tuple(
        influence_of(one.id, problem, whole, lambda rest: _learned(learner, rest)) for one in problem.demonstrations
    )


def influence_of(
    id_: str, problem: LearningProblem, whole: LearningResult, learned: Callable[[LearningProblem], LearningResult]
) -> Influence:
    """The influence of one demonstration, where `whole` is what was learned from all and `learned` learns again.

    Raises InvalidRanking where the problem has no such demonstration.
    """
    one = _named(check_problem(problem), id_)
    try:
        without = learned(_without(problem, one))
    except MissingDemonstrations as missing:
        return Influence(one.id, one.outcome, one.n_steps, None, None, None, missing.message)
    found = difference(problem, whole, without)
    return Influence(
        id=one.id,
        outcome=one.outcome,
        n_steps=one.n_steps,
        policy_change=found.policy_change,
        reward_change=found.reward_change,
        return_change=None if found.return_change is None else 0.0 - found.return_change,
        sentence=None,
        expected_return=_expected_return(problem, without),
        turned=found.turned,
    )


def what_if(
    problem: LearningProblem,
    *,
    drop: str | None = None,
    swap: tuple[str, str] | None = None,
    relabel: str | None = None,
) -> LearningProblem:
    """The problem with one thing changed: a demonstration left out, two that trade places, or one called otherwise.

    `swap` names two ranked demonstrations of one outcome. `relabel` calls a success a failure, where it is the least
    bad one, or a failure that reached a goal a success, where it is the last. Raises InvalidRanking.
    """
    check_problem(problem)
    if sum(one is not None for one in (drop, swap, relabel)) != 1:
        raise InvalidRanking("Say one change: drop, swap or relabel.", field="change")
    if drop is not None:
        return _without(problem, _named(problem, drop))
    if swap is not None:
        return _swapped(problem, *_pair(swap))
    assert relabel is not None  # noqa: S101 - for the type checker
    return _relabelled(problem, _named(problem, relabel))


def difference(problem: LearningProblem, before: LearningResult, after: LearningResult) -> Difference:
    """What differs between two results in the model of a problem; steps are counted where `before` leads."""
    check_problem(problem)
    changed: Reward = after.reward - before.reward
    old, new = (_expected_return(problem, result) for result in (before, after))
    return Difference(
        policy_change=_policy_change(problem, before, after),
        reward_change=float(np.abs(changed).mean()),
        return_change=None if old is None or new is None else new - old,
        turned=_turned(problem, before, after),
        reward=changed,
    )


def _learned(learner: str | Learner, problem: LearningProblem) -> LearningResult:
    return learn(learner, problem, frame_every=problem.settings.iterations)


def _policy_change(problem: LearningProblem, before: LearningResult, after: LearningResult) -> float:
    visits = np.where(problem.mdp.terminal, 0.0, expected_visits(problem.mdp, before.policy))
    distance = np.abs(before.policy - after.policy).sum(axis=1) / 2.0
    return float(visits @ distance / visits.sum())


def _expected_return(problem: LearningProblem, result: LearningResult) -> float | None:
    return expected_return(problem.model, result.policy) if isinstance(problem.model, World) else None


def _turned(problem: LearningProblem, before: LearningResult, after: LearningResult) -> tuple[int, ...]:
    """The states of which no action is among the likeliest both before and after."""
    shared = (likeliest(before.policy) & likeliest(after.policy)).any(axis=1)
    return tuple(np.flatnonzero(~shared & ~problem.mdp.terminal).tolist())


def _without(problem: LearningProblem, gone: Demonstration) -> LearningProblem:
    kept = [one for one in problem.demonstrations if one.id != gone.id]
    return _rebuilt(problem, kept, {outcome: _removed(groups, gone.id) for outcome, groups in problem.orders.items()})


def _pair(swap: object) -> tuple[str, str]:
    if not isinstance(swap, tuple | list) or len(swap) != 2:
        raise InvalidRanking(f"swap must be a pair of ids, not {shown(swap)}.", field="swap")
    first, second = swap
    return first, second


def _swapped(problem: LearningProblem, first: str, second: str) -> LearningProblem:
    outcomes = {_named(problem, id_).outcome for id_ in (first, second)}
    placed = {id_ for groups in problem.orders.values() for group in groups for id_ in group}
    if len(outcomes) > 1 or not {first, second} <= placed:
        raise InvalidRanking(
            f"{shown(first)} and {shown(second)} cannot trade places: they must be in one ranking.", field="swap"
        )
    trade = {first: second, second: first}
    orders = {
        outcome: [[trade.get(id_, id_) for id_ in group] for group in groups]
        for outcome, groups in problem.orders.items()
    }
    return _rebuilt(problem, problem.demonstrations, orders)


def _relabelled(problem: LearningProblem, one: Demonstration) -> LearningProblem:
    """Built by hand: what the person says is no longer what the world would say."""
    if not one.reached_goal:
        raise InvalidRanking(
            f"Demonstration {shown(one.id)} cannot be called a success: it never reached a goal.", field="relabel"
        )
    changed = replace(one, outcome=_OTHER[one.outcome])
    orders: dict[DemonstrationOutcome, tuple[tuple[str, ...], ...]] = {
        outcome: _removed(groups, one.id) for outcome, groups in problem.orders.items()
    }
    others = problem.successes if changed.outcome == "success" else problem.failures
    if changed.outcome in orders or len(others) < 2:
        alone = tuple((other.id,) for other in others)
        orders[changed.outcome] = (*orders.get(changed.outcome, alone), (one.id,))
    return replace(
        problem,
        demonstrations=tuple(changed if other.id == one.id else other for other in problem.demonstrations),
        successes=_moved(problem.successes, changed, to="success"),
        failures=_moved(problem.failures, changed, to="failure"),
        orders=orders,
    )


def _moved(
    kept: tuple[Demonstration, ...], changed: Demonstration, *, to: DemonstrationOutcome
) -> tuple[Demonstration, ...]:
    others = tuple(one for one in kept if one.id != changed.id)
    return (*others, changed) if changed.outcome == to else others


def _removed(groups: Iterable[tuple[str, ...]], id_: str) -> tuple[tuple[str, ...], ...]:
    """The groups without this demonstration; a group that it had for itself goes with it."""
    remaining = (tuple(other for other in group if other != id_) for group in groups)
    return tuple(group for group in remaining if group)


def _rebuilt(problem: LearningProblem, demonstrations: Any, orders: Any) -> LearningProblem:  # noqa: ANN401 - lists or tuples alike
    rankings = [Ranking(outcome, tuple(map(tuple, groups))) for outcome, groups in orders.items() if groups]
    return LearningProblem.build(
        problem.model, demonstrations, rankings, problem.settings, problem.seed, features=problem.own_features
    )


def _named(problem: LearningProblem, id_: str) -> Demonstration:
    for one in problem.demonstrations:
        if one.id == id_:
            return one
    raise InvalidRanking(f"There is no demonstration {shown(id_)} in this problem.", field="demonstrations")
