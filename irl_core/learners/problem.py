"""What a learner learns from: a model, the demonstrations in it, their order, and the settings. Checked once, here.

The model is a World, of which a learner may know the transitions (`mdp`) and what a person sees, never the rewards; or
a GridMdp or SparseMdp, whose demonstrations may start anywhere (`demonstration_of` makes them).
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, Self

import numpy as np

from irl_core.checks import is_integer, shown
from irl_core.errors import (
    ImpossibleDemonstration,
    InvalidFeatures,
    InvalidModel,
    InvalidRanking,
    InvalidSettings,
    MissingDemonstrations,
)
from irl_core.features import FeatureMap, features_of
from irl_core.learners.settings import Settings
from irl_core.mdp import GridMdp, Mdp, as_mdp
from irl_core.mdp.dynamics import transition_chances
from irl_core.types import OUTCOMES, Demonstration, DemonstrationOutcome, Ranking, World, check_demonstrations
from irl_core.weights import rank_weights, uniform_weights


class Needs(Protocol):
    """The part of a learner that says what it learns from."""

    @property
    def title(self) -> str: ...
    @property
    def uses_ranking(self) -> bool: ...
    @property
    def uses_failures(self) -> bool: ...
    @property
    def takes_anything(self) -> bool: ...


@dataclass(frozen=True, eq=False)
class LearningProblem:
    """A snapshot that learners start from. Make one with `LearningProblem.build`.

    `demonstrations` are all that were given. `failures` are the usable ones: unless the settings include the
    unfinished, those that ended at a goal; `n_left_out` counts the others. `orders` has the groups of ranked outcomes.
    `own_features`, if given, take the place of those that the settings name.
    """

    model: World | Mdp
    demonstrations: tuple[Demonstration, ...]
    settings: Settings
    seed: int
    successes: tuple[Demonstration, ...]
    failures: tuple[Demonstration, ...]
    orders: Mapping[DemonstrationOutcome, tuple[tuple[str, ...], ...]]
    n_left_out: int
    own_features: FeatureMap | None = None

    @property
    def mdp(self) -> Mdp:
        """The transitions, without rewards."""
        return as_mdp(self.model)

    @property
    def world(self) -> World:
        """The world, if the model is one. Raises InvalidModel where it is not."""
        if not isinstance(self.model, World):
            raise InvalidModel("This needs a World: a grid with rewards that a person sees.", field="model")
        return self.model

    @cached_property
    def features(self) -> FeatureMap:
        """φ, its own or by the settings. Raises InvalidFeatures where the model has no such features."""
        return self.own_features or features_of(self.settings.features, self.model)

    @property
    def shape(self) -> tuple[int, int]:
        """How states are laid out: (rows, cols), or (1, S) off the grid."""
        mdp = self.mdp
        return (mdp.rows, mdp.cols) if isinstance(mdp, GridMdp) else (1, mdp.n_states)

    @classmethod
    def build(
        cls,
        model: World | Mdp,
        demonstrations: Iterable[Demonstration],
        rankings: Iterable[Ranking] = (),
        settings: Settings | None = None,
        seed: int = 0,
        *,
        features: FeatureMap | None = None,
    ) -> Self:
        """Check that everything belongs together; what each learner lacks, `missing` tells.

        `features`, such as `irl_core.features.from_matrix` makes, take the place of those that the settings name.
        Raises InvalidModel, ImpossibleDemonstration, InvalidRanking, InvalidSettings, InvalidFeatures.
        """
        settings = _checked_settings(settings)
        given = check_demonstrations(demonstrations)
        as_mdp(model)
        for demonstration in given:
            _check_demonstration(model, demonstration)
        _check_ids(given)
        failures = tuple(one for one in given if one.outcome == "failure")
        usable = tuple(one for one in failures if one.reached_goal or settings.unfinished_failures == "include")
        if not is_integer(seed) or seed < 0:
            raise InvalidSettings(f"seed must be a whole number from 0 on, not {shown(seed)}.", field="seed")
        return cls(
            model=model,
            demonstrations=given,
            settings=settings,
            seed=seed,
            successes=tuple(one for one in given if one.outcome == "success"),
            failures=usable,
            orders=_orders(given, rankings),
            n_left_out=len(failures) - len(usable),
            own_features=None if features is None else _fitting(features, model),
        )

    def missing(self, learner: Needs) -> str | None:
        """What this learner still needs, in words for a person, or None if it can start."""
        if learner.takes_anything:
            return None if self.successes or self.failures else self._no_attempt(learner)
        if not self.successes:
            return f"{learner.title} needs at least one success: an attempt that reaches the goal and totals 0 or more."
        if learner.uses_failures and not self.failures:
            return self._no_failure(learner)
        return self._missing_order(learner) if learner.uses_ranking else None

    def require(self, learner: Needs) -> None:
        """Raise MissingDemonstrations unless this learner can start."""
        sentence = self.missing(learner)
        if sentence is not None:
            raise MissingDemonstrations(sentence, field="learners")

    def success_weights(self, *, ranked: bool) -> dict[str, float]:
        """θ of each success; they sum to 1."""
        return self._weights("success", self.successes, ranked=ranked)

    def failure_weights(self, *, ranked: bool) -> dict[str, float]:
        """θ of each usable failure, ranked among those alone; they sum to 1."""
        return self._weights("failure", self.failures, ranked=ranked)

    def _weights(
        self, outcome: DemonstrationOutcome, kept: tuple[Demonstration, ...], *, ranked: bool
    ) -> dict[str, float]:
        ids = [one.id for one in kept]
        if not ranked or len(ids) == 1:
            return uniform_weights(ids)
        if outcome not in self.orders:
            raise MissingDemonstrations(f"There is no order of the {outcome} demonstrations.", field="rankings")
        groups = [[id_ for id_ in group if id_ in ids] for group in self.orders[outcome]]
        return rank_weights([group for group in groups if group])

    def _unplaced(self, outcome: DemonstrationOutcome, kept: tuple[Demonstration, ...]) -> str | None:
        placed = {id_ for group in self.orders.get(outcome, ()) for id_ in group}
        n_unplaced = sum(one.id not in placed for one in kept)
        if len(kept) < 2 or n_unplaced == 0:
            return None
        if n_unplaced == len(kept):
            return f"none of the {len(kept)} has a place yet"
        return f"{n_unplaced} of the {len(kept)} {'has' if n_unplaced == 1 else 'have'} no place yet"

    def _missing_order(self, learner: Needs) -> str | None:
        unplaced = self._unplaced("success", self.successes)
        if unplaced:
            return f"{learner.title} needs your successes in order: {unplaced}."
        unplaced = self._unplaced("failure", self.failures)
        if learner.uses_failures and unplaced:
            return f"{learner.title} needs your failures in order: {unplaced}."
        return None

    def _no_attempt(self, learner: Needs) -> str:
        return f"{learner.title} needs at least one attempt that reaches the goal." + self._how_to_include()

    def _no_failure(self, learner: Needs) -> str:
        if self.n_left_out == 0:
            return (
                f"{learner.title} needs at least one failure: an attempt that reaches the goal and totals less than 0."
            )
        return f"{learner.title} needs a failure that reaches the goal and totals less than 0." + self._how_to_include()

    def _how_to_include(self) -> str:
        """What to do about failures that were left out, if there are any."""
        if self.n_left_out == 0:
            return ""
        never = "One failure" if self.n_left_out == 1 else f"{self.n_left_out} failures"
        return f' {never} ended elsewhere; to learn from such too, set "unfinished_failures" to "include".'


def check_problem(problem: object) -> LearningProblem:
    """A LearningProblem. Raises InvalidModel."""
    if not isinstance(problem, LearningProblem):
        raise InvalidModel(
            f"problem must be a LearningProblem, which LearningProblem.build makes, not {shown(problem)}.",
            field="problem",
        )
    return problem


def _checked_settings(given: object) -> Settings:
    if given is None:
        return Settings()
    if not isinstance(given, Settings):
        raise InvalidSettings(f"settings must be Settings(…), not {shown(given)}.", field="settings")
    return given


def _fitting(features: object, model: World | Mdp) -> FeatureMap:
    if not isinstance(features, FeatureMap):
        raise InvalidFeatures(
            f"features must be a FeatureMap, such as from_matrix makes, not {shown(features)}.", field="features"
        )
    return features.fitting(as_mdp(model))


def _checked_rankings(given: object) -> tuple[Ranking, ...]:
    listed = tuple(given) if isinstance(given, Iterable) else (given,)
    for one in listed:
        if not isinstance(one, Ranking):
            raise InvalidRanking(f"rankings must be a list of Ranking, not of {shown(one)}.", field="rankings")
    return listed


def _orders(
    given: tuple[Demonstration, ...], rankings: Iterable[Ranking]
) -> dict[DemonstrationOutcome, tuple[tuple[str, ...], ...]]:
    by_outcome = {outcome: {one.id for one in given if one.outcome == outcome} for outcome in OUTCOMES}
    orders: dict[DemonstrationOutcome, tuple[tuple[str, ...], ...]] = {}
    for ranking in _checked_rankings(rankings):
        if ranking.outcome in orders:
            raise InvalidRanking(f"There are two rankings of {ranking.outcome} demonstrations.", field="rankings")
        for id_ in ranking.ids:
            if id_ not in by_outcome[ranking.outcome]:
                raise InvalidRanking(
                    f"The ranking of {ranking.outcome} demonstrations names {shown(id_)}, which is not one of them.",
                    field="rankings",
                )
        orders[ranking.outcome] = ranking.groups
    return orders


def _check_ids(given: tuple[Demonstration, ...]) -> None:
    seen: set[str] = set()
    for one in given:
        if one.id in seen:
            raise ImpossibleDemonstration(f"demonstration {shown(one.id)} is given twice.", field="demonstrations")
        seen.add(one.id)


def _check_demonstration(model: World | Mdp, one: Demonstration) -> None:
    """Refuse what cannot have been played in this model; `simulate` made it, but perhaps in another one."""
    mdp, states, actions = as_mdp(model), one.states, one.actions
    for numbers in (states, actions):
        if numbers.ndim != 1 or not np.issubdtype(numbers.dtype, np.integer):
            _refuse(one, f"states and actions are lists of whole numbers, not {numbers.dtype} {numbers.shape}")
    if len(states) != len(actions) + 1 or len(one.rewards) != len(actions) or not 0 < len(actions) <= mdp.horizon:
        _refuse(one, f"it needs 1 to {mdp.horizon} steps, one more state than actions, one reward a step")
    if states.min() < 0 or states.max() >= mdp.n_states or (isinstance(model, World) and states[0] != model.start):
        _refuse(one, f"it must start in square {mdp.start_states[0]} and stay below square {mdp.n_states}")
    if actions.min() < 0 or actions.max() >= mdp.n_actions:
        _refuse(one, f"its actions must lie from 0 to {mdp.n_actions - 1}")
    if not np.isfinite(one.rewards).all() or not math.isclose(one.total, math.fsum(one.rewards), abs_tol=1e-6):
        _refuse(one, f"its total must be the sum of its rewards, {math.fsum(one.rewards):g}, not {one.total:g}")
    fits = ~mdp.terminal[states[:-1]] & (transition_chances(mdp, states, actions) > 0.0)
    if isinstance(model, World):
        fits &= model.reward[states[1:]] == one.rewards
    if not fits.all():
        _refuse(one, f"its step {int(fits.argmin())} does not exist there")
    arrived = bool(mdp.terminal[states[-1]])
    if (
        one.outcome not in OUTCOMES
        or one.reached_goal != arrived
        or (isinstance(model, World) and one.outcome != _outcome(one, arrived=arrived))
    ):
        _refuse(one, f"it says {one.outcome} and {one.ending}, which is not how it ends")


def _outcome(one: Demonstration, *, arrived: bool) -> DemonstrationOutcome:
    return "success" if arrived and one.total >= 0.0 else "failure"


def _refuse(one: Demonstration, why: str) -> None:
    raise ImpossibleDemonstration(f"demonstration {shown(one.id)} is not of this world: {why}.", field="demonstrations")
