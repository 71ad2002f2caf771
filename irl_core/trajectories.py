"""Demonstrations in any model: what `simulate` is to a world, `demonstration_of` is to a GridMdp or SparseMdp."""

from collections.abc import Sequence

import numpy as np

from irl_core.array_checks import finite_array
from irl_core.arrays import IntVector, Vector
from irl_core.checks import Refused, identifier, is_integer, shown
from irl_core.errors import ImpossibleDemonstration
from irl_core.mdp import Mdp, as_mdp
from irl_core.mdp.dynamics import transition_chances
from irl_core.types import OUTCOMES, Demonstration, DemonstrationOutcome, Ending
from irl_core.world_checks import is_list


def demonstration_of(
    mdp: Mdp,
    states: Sequence[int] | IntVector,
    actions: Sequence[int] | IntVector,
    *,
    id: str,  # noqa: A002 - the field it sets
    outcome: DemonstrationOutcome,
    rewards: Sequence[float] | None = None,
) -> Demonstration:
    """An attempt in a model without rewards of its own: T + 1 states, T actions, and whether it counts as a success.

    `rewards`, one a step, are kept for learners that use scores (0 unless given); others never look at them. Raises
    ImpossibleDemonstration, with the first step that the model's transitions do not allow.
    """
    try:
        identifier(id)
    except Refused as refused:
        raise ImpossibleDemonstration(f"the demonstration's id {refused}.", field="id") from None
    if outcome not in OUTCOMES:
        raise ImpossibleDemonstration(f'outcome must be "success" or "failure", not {shown(outcome)}.', field="outcome")
    mdp = as_mdp(mdp)
    visited = _whole_numbers("states", states, below=mdp.n_states)
    taken = _whole_numbers("actions", actions, below=mdp.n_actions)
    if not 0 < len(taken) <= mdp.horizon or len(visited) != len(taken) + 1:
        raise ImpossibleDemonstration(
            f"an attempt has 1 to {mdp.horizon} actions and one state more; here are {len(taken)} actions and"
            f" {len(visited)} states."
        )
    impossible = np.flatnonzero(transition_chances(mdp, visited, taken) <= 0.0)
    if len(impossible):
        step = int(impossible[0])
        raise ImpossibleDemonstration(
            f"action {taken[step]} in state {visited[step]} cannot lead to state {visited[step + 1]}.", step=step
        )
    paid = _rewards(rewards, n_steps=len(taken))
    ending: Ending = "goal" if mdp.terminal[visited[-1]] else "gave_up"
    return Demonstration(id, visited, taken, paid, float(paid.sum()), outcome, ending)


def _whole_numbers(name: str, values: Sequence[int] | IntVector, *, below: int) -> IntVector:
    listed = values.tolist() if isinstance(values, np.ndarray) else values
    if not is_list(listed):
        raise ImpossibleDemonstration(f"{name} must be a list of whole numbers, not {shown(values)}.", field=name)
    for step, value in enumerate(listed):
        if not is_integer(value) or not 0 <= int(value) < below:
            raise ImpossibleDemonstration(
                f"{name} are whole numbers from 0 to {below - 1}, not {shown(value)}.", step=step, field=name
            )
    return np.array(listed, dtype=np.int64)


def _rewards(given: Sequence[float] | None, *, n_steps: int) -> Vector:
    if given is None:
        return np.zeros(n_steps)
    wanted = f"{n_steps} finite numbers, one a step"
    paid: Vector = finite_array("rewards", given, shape=(n_steps,), wanted=wanted, error=ImpossibleDemonstration)
    return paid.copy()
