"""Checks of rewards, policies and numbers from outside; each answers with the value as it is computed with, or raises.

Whatever holds finite real numbers will do: lists, arrays of any layout and precision, read-only ones. Texts, truth
values, complex numbers and dates are refused rather than converted.
"""

from collections.abc import Callable
from typing import Any, Final, TypeAlias

import numpy as np

from irl_core.arrays import BoolVector, Matrix, Policy, Vector
from irl_core.checks import Refused, real_number, shown, whole_number
from irl_core.errors import InvalidPolicy, InvalidReward, InvalidSettings, IrlError

Floats: TypeAlias = np.ndarray[Any, np.dtype[np.float64]]

MAX_HORIZON: Final = 10_000_000
LARGEST_REWARD: Final = 1e12
"""Beyond it a sum over a path keeps no digit of what tells one path from another."""

_SUM_TOLERANCE: Final = 1e-6
"""By how much a row of a policy may miss 1: policies come with few digits, too."""

_NO_NUMBERS: Final = {"b": "truth values", "U": "texts", "S": "texts", "c": "complex numbers", "M": "dates"}


def float_array(given: object) -> Floats:
    """The numbers as contiguous float64 of the same shape; Refused where they are none, or too large for a float."""
    try:
        array = np.asarray(given)
    except ValueError:
        raise Refused("here are lists of several lengths") from None
    if array.dtype.kind not in "iuf":
        raise Refused(f"here {_kind(given, array)}")
    with np.errstate(over="ignore"):  # what a float cannot hold becomes infinite, which the caller refuses
        return np.asarray(array, dtype=np.float64, order="C")


def finite_array(
    name: str, given: object, *, shape: tuple[int, ...], wanted: str, error: Callable[..., IrlError]
) -> Floats:
    """Finite numbers of this shape; `error` is raised with what is `wanted` and what was found."""
    try:
        checked = float_array(given)
    except Refused as refused:
        raise error(f"{name} must be {wanted}; {refused}.", field=name) from None
    if checked.shape != shape:
        raise error(f"{name} must be {wanted}; its shape is {checked.shape}, not {shape}.", field=name)
    wrong = np.argwhere(~np.isfinite(checked))
    if len(wrong):
        place = tuple(wrong[0].tolist())
        where = place[0] if len(place) == 1 else place
        raise error(f"{name} must be {wanted}; in {where} it is {checked[place]:g}.", field=name)
    return checked


def check_reward(reward: object, *, n_states: int) -> Vector:
    """The reward as contiguous float64, shape (S,). Raises InvalidReward, which says what was found."""
    wanted = f"{n_states} finite numbers, one a state"
    checked: Vector = finite_array("reward", reward, shape=(n_states,), wanted=wanted, error=InvalidReward)
    check_size("reward", checked)
    return checked


def check_size(name: str, reward: Floats) -> None:
    """Refuse rewards with which nothing can be computed any more. Raises InvalidReward."""
    beyond = reward[np.abs(reward) > LARGEST_REWARD]
    if len(beyond):
        raise InvalidReward(
            f"{name} must lie within ±{LARGEST_REWARD:g} to be computed with; it reaches {beyond[0]:g}.", field=name
        )


def check_policy(policy: object, *, terminal: BoolVector, n_actions: int) -> Policy:
    """A policy as contiguous float64, shape (S, A), rows summing to 1 but in terminal states. Raises InvalidPolicy."""
    shape = (len(terminal), n_actions)
    wanted = f"{shape[0]} × {shape[1]} probabilities, a row a state, or a plan (HardPlan)"
    checked: Matrix = finite_array("policy", policy, shape=shape, wanted=wanted, error=InvalidPolicy)
    below = np.argwhere(checked < 0.0)
    if len(below):
        state, action = below[0].tolist()
        raise InvalidPolicy(
            f"policy must be {wanted}; action {action} in state {state} has {checked[state, action]:g}.", field="policy"
        )
    sums = checked.sum(axis=1)
    wrong = np.flatnonzero(~terminal & (np.abs(sums - 1.0) > _SUM_TOLERANCE))
    if len(wrong):
        raise InvalidPolicy(
            f"policy must be {wanted}; those of state {wrong[0]} sum to {sums[wrong[0]]:g}, not 1.", field="policy"
        )
    return checked


def check_whole(name: str, value: object, *, minimum: int, maximum: int = MAX_HORIZON) -> int:
    """A whole number within bounds. Raises InvalidSettings."""
    try:
        return whole_number(value, minimum=minimum, maximum=maximum)
    except Refused as refused:
        raise InvalidSettings(f"{name} {refused}.", field=name) from None


def check_discount(discount: object) -> float:
    """γ in (0, 1]. Raises InvalidSettings."""
    try:
        return real_number(discount, minimum=0.0, maximum=1.0, above=True)
    except Refused as refused:
        raise InvalidSettings(f"discount {refused}.", field="discount") from None


def check_generator(rng: object) -> np.random.Generator:
    """A random generator. Raises InvalidSettings."""
    if not isinstance(rng, np.random.Generator):
        raise InvalidSettings(
            f"rng must be a numpy.random.Generator, such as numpy.random.default_rng(0), not {shown(rng)}.", field="rng"
        )
    return rng


def _kind(given: object, array: np.ndarray[Any, Any]) -> str:
    """What is there instead of numbers, in words."""
    if array.ndim == 0:
        return f"is {shown(given)}"
    return f"are {_NO_NUMBERS.get(array.dtype.kind, 'things that are no numbers, or larger than 64 bits')}"
