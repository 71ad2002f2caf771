"""How much each demonstration counts.

Suppose the quality of demonstrations is uniform on (0, 1) (the paper's "normal" in Sec. III-D is a slip). The i-th of N
order statistics has mean i / (N + 1); its share of the sum is

    θ_i = 2 i / (N (N + 1)),   i = 1 … N,   Σ θ_i = 1,

with i = N for the best success and for the *worst* failure. Those that tie share the mean of their θ. Unranked
demonstrations weigh 1 / N. Feature counts (Eqs. 3, 7, 8) are sums over time, not divided by length, so that with
Σ θ = 1 weighted and unweighted ones are on one scale:

    μ̃_s = Σ_i θ_i · (how often demonstration i was in s, its start included, its goal once).
"""

from collections.abc import Iterable, Mapping

import numpy as np

from irl_core.array_checks import check_discount
from irl_core.arrays import IntVector, Vector
from irl_core.checks import Refused, real_number, shown
from irl_core.errors import ImpossibleDemonstration, InvalidRanking
from irl_core.mdp import Mdp, as_mdp
from irl_core.types import Demonstration, World, check_demonstrations, check_groups


def rank_weights(groups: Iterable[Iterable[str]]) -> dict[str, float]:
    """θ of each id from groups in display order: the first group weighs most; a group of several is a tie."""
    checked = check_groups(groups)
    n = sum(len(group) for group in checked)
    weights: dict[str, float] = {}
    rank = n
    for group in checked:
        mean_rank = rank - (len(group) - 1) / 2
        weights |= dict.fromkeys(group, 2.0 * mean_rank / (n * (n + 1)))
        rank -= len(group)
    return weights


def uniform_weights(ids: Iterable[str]) -> dict[str, float]:
    """The same weight for each id; they sum to 1."""
    given: object = ids
    if not isinstance(given, Iterable):
        raise InvalidRanking(f"ids must be a list of texts, not {shown(given)}.", field="ids")
    listed = list(dict.fromkeys(ids))
    return dict.fromkeys(listed, 1.0 / len(listed)) if listed else {}


def feature_counts(
    model: World | Mdp,
    demonstrations: Iterable[Demonstration],
    weights: Mapping[str, float],
    *,
    discount: float = 1.0,
) -> Vector:
    """μ̃, the weighted sum of visits to each state, shape (S,); with a discount γ a visit at step t counts γ^t.

    Summed in the order of ids, so that the order in which demonstrations are given changes no bit of the result.
    Raises ImpossibleDemonstration, InvalidRanking (a weight that is missing or none), InvalidSettings.
    """
    n_states, gamma = as_mdp(model).n_states, check_discount(discount)
    counts: Vector = np.zeros(n_states)
    for demonstration in sorted(check_demonstrations(demonstrations), key=lambda one: one.id):
        worth = gamma ** np.arange(len(demonstration.states))
        weight = _weight_of(demonstration, weights)
        counts += weight * np.bincount(_states_below(n_states, demonstration), worth, n_states)
    return counts


def _weight_of(demonstration: Demonstration, weights: Mapping[str, float]) -> float:
    given: object = weights
    if not isinstance(given, Mapping) or demonstration.id not in given:
        raise InvalidRanking(
            f"weights must be a mapping with a number for each id; {shown(demonstration.id)} has none.", field="weights"
        )
    try:
        return real_number(weights[demonstration.id])
    except Refused as refused:
        raise InvalidRanking(f"The weight of {shown(demonstration.id)} {refused}.", field="weights") from None


def _states_below(n_states: int, demonstration: Demonstration) -> IntVector:
    if demonstration.states.max(initial=0) >= n_states:
        raise ImpossibleDemonstration(
            f"demonstration {shown(demonstration.id)} is not of this model: it visits state"
            f" {demonstration.states.max()}, and there are {n_states}.",
            field="demonstrations",
        )
    return demonstration.states


def start_counts(model: World | Mdp, demonstrations: Iterable[Demonstration], weights: Mapping[str, float]) -> Vector:
    """ρ_0, the weighted share of demonstrations that start in each state, shape (S,)."""
    starts: Vector = np.zeros(model.n_states)
    for demonstration in sorted(demonstrations, key=lambda one: one.id):
        starts[demonstration.states[0]] += weights[demonstration.id]
    starts /= starts.sum()
    return starts
