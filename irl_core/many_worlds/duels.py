"""Who earned more than whom in the same comparison. Equal are those within 1e-9 of the optimum of each other."""

from typing import Final, TypeAlias

import numpy as np

from irl_core.arrays import Matrix, Vector

SAME_SHARE: Final = 1e-9
BoolCube: TypeAlias = np.ndarray[tuple[int, int, int], np.dtype[np.bool_]]


def duels(scores: Matrix, optima: Vector) -> tuple[BoolCube, BoolCube]:
    """Whether i earned more than j, and whether as much, in each comparison: both (n, L, L) from scores of (n, L).

    Who has no score (NaN) meets nobody.
    """
    ahead, behind = scores[:, :, None], scores[:, None, :]
    tolerance = SAME_SHARE * np.where(optima == 0.0, 1.0, np.abs(optima))[:, None, None]
    wins: BoolCube = ahead > behind + tolerance
    losses = behind > ahead + tolerance
    meet = ~np.isnan(ahead) & ~np.isnan(behind)
    ties: BoolCube = meet & ~wins & ~losses
    return wins, ties


def shared_places(scores: Matrix, optima: Vector) -> Matrix:
    """The place of each, (n, L): 1 + how many earned more (equals share the better place); NaN for the absent."""
    wins, _ = duels(scores, optima)
    places: Matrix = np.where(np.isnan(scores), np.nan, 1.0 + wins.sum(axis=1))
    return places


def midranks(scores: Matrix, optima: Vector) -> Matrix:
    """The place of each, (n, L), equals sharing the mean of their places; everybody must be there."""
    wins, ties = duels(scores, optima)
    ranks: Matrix = 1.0 + wins.sum(axis=1) + (ties.sum(axis=1) - 1.0) / 2.0  # everybody ties with itself
    return ranks
