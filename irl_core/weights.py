"""How much each demonstration counts.

Suppose the quality of demonstrations is uniform on (0, 1) (the paper's "normal" in Sec. III-D is a slip). The i-th of N
order statistics has mean i / (N + 1); its share of the sum is

    θ_i = 2 i / (N (N + 1)),   i = 1 … N,   Σ θ_i = 1,

with i = N for the best success and for the *worst* failure. Those that tie share the mean of their θ. Unranked
demonstrations weigh 1 / N. People count from the other end: the display rank is 1 at the top of either list, and those
that tie all have the first of their places (1, 2, 2, 4). Place p from the top has the index i = N + 1 − p; those that
tie share the mean of their indices, so m of them at display rank r have i = N + 1 − r − (m − 1) / 2. Feature counts
(Eqs. 3, 7, 8) are sums over time, not divided by length, so that with Σ θ = 1 weighted and unweighted ones are on one
scale:

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
    indices = paper_index(groups)
    n = len(indices)
    return {id_: 2.0 * index / (n * (n + 1)) for id_, index in indices.items()}


def paper_index(groups: Iterable[Iterable[str]]) -> dict[str, float]:
    """The paper's index i of each id: N for the group on top, 1 at the bottom, ties share the mean (4, 2.5, 2.5, 1)."""
    checked = check_groups(groups)
    n = sum(len(group) for group in checked)
    indices: dict[str, float] = {}
    for group in checked:
        indices |= dict.fromkeys(group, n - len(indices) - (len(group) - 1) / 2)
    return indices


def display_ranks(groups: Iterable[Iterable[str]]) -> dict[str, int]:
    """The rank people see of each id: 1 for the group on top, ties share the first of their places (1, 2, 2, 4)."""
    ranks: dict[str, int] = {}
    for group in check_groups(groups):
        ranks |= dict.fromkeys(group, len(ranks) + 1)
    return ranks


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
