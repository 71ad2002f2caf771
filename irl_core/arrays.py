"""Shapes as types. S states, A = 4 actions, T steps, N demonstrations (in planning: the horizon)."""

from typing import TypeAlias

import numpy as np

Vector: TypeAlias = np.ndarray[tuple[int], np.dtype[np.float64]]
Matrix: TypeAlias = np.ndarray[tuple[int, int], np.dtype[np.float64]]
IntVector: TypeAlias = np.ndarray[tuple[int], np.dtype[np.int64]]
IntMatrix: TypeAlias = np.ndarray[tuple[int, int], np.dtype[np.int64]]
BoolVector: TypeAlias = np.ndarray[tuple[int], np.dtype[np.bool_]]
BoolMatrix: TypeAlias = np.ndarray[tuple[int, int], np.dtype[np.bool_]]

Reward: TypeAlias = Vector
"""What a state pays, shape (S,)."""

Policy: TypeAlias = Matrix
"""The probability of each action in each state, shape (S, 4); rows sum to 1."""


def read_only(array: np.ndarray[tuple[int, ...], np.dtype[np.generic]]) -> None:
    """Let nobody write into an array that lives inside a value."""
    array.setflags(write=False)
