"""Features: what of a state a linear reward may look at.

A feature map φ gives each state K numbers, and a reward is linear in them, R(s) = Σ_k w_k φ_k(s) = (φw)(s). What an
algorithm matches are then expected feature counts, φᵀμ for state visits μ of shape (S,) (IRLFR paper, Eq. 3): the
gradient of anything in w is φᵀ of its gradient in R.

| name | φ(s) | K |
|---|---|---|
| one_hot | 1 for the state itself: any reward can be said, none carries over from one state to another | S |
| colour | 1 for what a person sees of the square: red, blue or goal | 3 |
| position | 1, row and column, the latter two scaled to [0, 1] | 3 |
| colour_position | red, blue, goal, row, column (the three classes add up to position's 1) | 5 |
| tiles | 1 for the tile of each tiling that covers the square (Sutton and Barto 2018, Sec. 9.5.4) | by size |

Walls are never visited: they have no colour, and a learned reward of 0 there under `colour`. One-hot is not stored:
φw is w itself. Where each state has few features (colours, tiles) their numbers are stored, (S, n), not the matrix.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal, Protocol, Self, TypeAlias, get_args

import numpy as np

from irl_core.array_checks import finite_array, float_array
from irl_core.arrays import IntMatrix, Matrix, Vector, read_only
from irl_core.checks import Refused, is_integer, shown
from irl_core.errors import InvalidFeatures
from irl_core.mdp.grid import GridMdp
from irl_core.types import World
from irl_core.world_checks import is_list

FeatureName: TypeAlias = Literal["one_hot", "colour", "position", "colour_position", "tiles"]
FEATURE_NAMES: Final[tuple[FeatureName, ...]] = get_args(FeatureName)

COLOUR_CLASSES: Final = ("red", "blue", "goal")
_TILE_SIDE: Final = 3
_TILE_SHIFTS: Final = ((0, 0), (1, 2), (2, 1))
"""Rows and columns by which tilings are shifted: no two along one diagonal, so that generalisation has no slant."""

_RANK_TOLERANCE: Final = 1e-10
"""A column of norm 1 that lies nearer than this to the span of those before it depends on them."""


class HasStates(Protocol):
    """Any model: what features need to know of it is how many states there are."""

    @property
    def n_states(self) -> int: ...


@dataclass(frozen=True, eq=False)
class FeatureMap:
    """φ, in one of three forms: one-hot (neither array), a `matrix` (S, K), or the `active` features of each state.

    `active`, shape (S, n), numbers the features that are 1; −1 stands for none. Make one with the functions below.
    """

    name: str
    n_states: int
    n_features: int
    matrix: Matrix | None = None
    active: IntMatrix | None = None

    def __post_init__(self) -> None:
        for array in (self.matrix, self.active):
            if array is not None:
                read_only(array)

    def reward(self, weights: Vector) -> Vector:
        """R = φw, shape (S,), of weights, shape (K,). Raises InvalidFeatures. One-hot gives the weights themselves."""
        weights = _vector("weights", weights, f"{self.n_features} finite numbers, one a feature", self.n_features)
        if self.active is not None:
            # The weight behind the last one is what −1 finds: no feature, no reward.
            paid: Vector = np.append(weights, 0.0)[self.active].sum(axis=1)
            return paid
        if self.matrix is not None:
            # Not by BLAS, whose sums may be cut into as many parts as there are cores.
            linear: Vector = np.einsum("sk,k->s", self.matrix, weights)
            return linear
        return weights

    def counts(self, visits: Vector) -> Vector:
        """φᵀμ, shape (K,), of visits μ of shape (S,). Raises InvalidFeatures. One-hot gives the visits themselves."""
        visits = _vector("visits", visits, f"{self.n_states} finite numbers, one a state", self.n_states)
        if self.active is not None:
            each = np.repeat(visits, self.active.shape[1])
            counted = np.bincount(self.active.reshape(-1) + 1, each, self.n_features + 1)
            return np.ascontiguousarray(counted[1:], dtype=np.float64)
        if self.matrix is not None:
            summed: Vector = np.einsum("sk,s->k", self.matrix, visits)
            return summed
        return visits

    def dense(self) -> Matrix:
        """φ written out, shape (S, K)."""
        if self.matrix is not None:
            return self.matrix
        if self.active is None:
            return np.eye(self.n_states)
        written: Matrix = np.zeros((self.n_states, self.n_features + 1))
        for column in self.active.T:
            written[np.arange(self.n_states), column] += 1.0
        return np.ascontiguousarray(written[:, :-1])

    def fitting(self, model: HasStates) -> Self:
        """This very map, if it is one of the model's states. Raises InvalidFeatures."""
        if self.n_states != model.n_states:
            raise InvalidFeatures(
                f"The features are of {self.n_states} states; this model has {model.n_states}.", field="features"
            )
        return self


def features_of(name: str, model: World | GridMdp | HasStates) -> FeatureMap:
    """The features of this name; colours need a World, positions and tiles a grid. Raises InvalidFeatures."""
    match name:
        case "one_hot":
            return one_hot(model.n_states)
        case "colour":
            return colour_class(_as_world(name, model))
        case "position":
            return position(_as_grid(name, model))
        case "colour_position":
            return colour_and_position(_as_world(name, model))
        case "tiles":
            return tiles(_as_grid(name, model))
    raise InvalidFeatures(f"features must be one of {', '.join(FEATURE_NAMES)}, not {shown(name)}.", field="features")


def one_hot(n_states: int) -> FeatureMap:
    """A feature for each state: K = S, φw = w."""
    if not is_integer(n_states) or n_states < 1:
        raise InvalidFeatures(
            f"n_states must be a whole number of at least 1, not {shown(n_states)}.", field="n_states"
        )
    return FeatureMap("one_hot", n_states, n_states)


def colour_class(world: World) -> FeatureMap:
    """What a person sees of each square, red, blue or goal: never what it pays. Walls have no feature."""
    world = _as_world("colour", world)
    number = {colour: k for k, colour in enumerate(COLOUR_CLASSES)}
    seen = [[number.get(colour, -1)] for row in world.colours for colour in row]
    return FeatureMap("colour", world.n_states, len(COLOUR_CLASSES), active=np.array(seen, dtype=np.int64))


def position(model: World | GridMdp) -> FeatureMap:
    """Each step alike (1), and row and column scaled to [0, 1]."""
    model = _as_grid("position", model)
    matrix = np.column_stack([np.ones(model.n_states), _scaled_position(model)])
    return FeatureMap("position", model.n_states, 3, matrix=np.ascontiguousarray(matrix))


def colour_and_position(world: World) -> FeatureMap:
    """Red, blue, goal, row and column, the latter two scaled to [0, 1]."""
    matrix = np.column_stack([colour_class(world).dense(), _scaled_position(world)])
    return FeatureMap("colour_position", world.n_states, matrix.shape[1], matrix=np.ascontiguousarray(matrix))


def tiles(
    model: World | GridMdp, *, side: int = _TILE_SIDE, offsets: Sequence[Sequence[int]] = _TILE_SHIFTS
) -> FeatureMap:
    """Tile coding: tilings by squares of `side` × `side`, each shifted by its own (rows, columns) in `offsets`.

    Squares under one tile share its weight, so that a reward learned at one carries over to its neighbours. Raises
    InvalidFeatures unless side is at least 1 and each offset lies from 0 to side − 1.
    """
    model = _as_grid("tiles", model)
    _check_tilings(side, offsets)
    rows, cols = np.divmod(np.arange(model.n_states), model.cols)
    active: IntMatrix = np.empty((model.n_states, len(offsets)), dtype=np.int64)
    n_features = 0
    for tiling, (down, right) in enumerate(offsets):
        n_across = (model.cols - 1 + right) // side + 1
        n_down = (model.rows - 1 + down) // side + 1
        active[:, tiling] = n_features + (rows + down) // side * n_across + (cols + right) // side
        n_features += n_down * n_across
    return FeatureMap("tiles", model.n_states, n_features, active=active)


def from_matrix(matrix: Any, *, name: str = "matrix") -> FeatureMap:  # noqa: ANN401 - outside data
    """Any φ of shape (S, K), finite and of full column rank: else several weights would mean one reward.

    Raises InvalidFeatures, which names a column that depends on others, and those.
    """
    try:
        checked: Matrix = float_array(matrix).copy()
    except Refused as refused:
        raise InvalidFeatures(
            f"features must be a matrix of numbers, states × features; {refused}.", field="features"
        ) from None
    if checked.ndim != 2 or 0 in checked.shape:
        raise InvalidFeatures(
            f"features must be a matrix of shape (states, features); its shape is {checked.shape}.", field="features"
        )
    wrong = np.argwhere(~np.isfinite(checked))
    if len(wrong):
        raise InvalidFeatures(f"features must be finite; those of state {wrong[0][0]} are not.", field="features")
    _check_rank(checked)
    return FeatureMap(name, *checked.shape, matrix=checked)


def _vector(name: str, given: object, wanted: str, length: int) -> Vector:
    checked: Vector = finite_array(name, given, shape=(length,), wanted=wanted, error=InvalidFeatures)
    return checked


def _check_rank(matrix: Matrix) -> None:
    """Gram–Schmidt from left to right: the first column that leaves nothing new depends on those before it."""
    basis: list[Vector] = []
    for k, column in enumerate(matrix.T):
        size = float(np.abs(column).max())
        if size == 0.0:
            raise InvalidFeatures(f"Feature {k} is 0 in every state, so its weight means nothing.", field="features")
        rest = column / size / np.linalg.norm(column / size)
        for _ in range(2):  # twice is enough: what the first round leaves of rounding, the second takes
            for direction in basis:
                rest = rest - (direction @ rest) * direction
        left = float(np.linalg.norm(rest))
        if left < _RANK_TOLERANCE:
            raise InvalidFeatures(
                f"Feature {k} is a combination of {_those_behind(matrix, k)}: many weights would mean the same reward."
                " Leave one of them out.",
                field="features",
            )
        basis.append(rest / left)


def _those_behind(matrix: Matrix, k: int) -> str:
    """Which columns before k add up to it, in words."""
    sizes = np.linalg.norm(matrix[:, : k + 1], axis=0)
    shares = np.linalg.lstsq(matrix[:, :k] / sizes[:k], matrix[:, k] / sizes[k], rcond=None)[0]
    used = [str(j) for j in np.flatnonzero(np.abs(shares) > 1e-6)]
    return f"feature {used[0]}" if len(used) == 1 else f"features {', '.join(used[:-1])} and {used[-1]}"


def _check_tilings(side: int, offsets: Sequence[Sequence[int]]) -> None:
    if not is_integer(side) or int(side) < 1:
        raise InvalidFeatures(f"side must be a whole number of at least 1, not {shown(side)}.", field="side")
    if not is_list(offsets) or len(offsets) == 0:
        raise InvalidFeatures("offsets must name at least one tiling, such as (0, 0).", field="offsets")
    for offset in offsets:
        if (
            not is_list(offset)
            or len(offset) != 2
            or not all(is_integer(shift) and 0 <= int(shift) < side for shift in offset)
        ):
            raise InvalidFeatures(
                f"Each offset must be two whole numbers from 0 to {side - 1}, rows and columns, not {offset!r:.60}.",
                field="offsets",
            )


def _scaled_position(model: World | GridMdp) -> Matrix:
    rows, cols = np.divmod(np.arange(model.n_states), model.cols)
    return np.column_stack([rows / max(model.rows - 1, 1), cols / max(model.cols - 1, 1)])


def _as_world(name: str, model: object) -> World:
    if isinstance(model, World):
        return model
    raise InvalidFeatures(
        f"Features {name!r} are of what a person sees: they need a World, not a {type(model).__name__}.",
        field="features",
    )


def _as_grid(name: str, model: object) -> World | GridMdp:
    if isinstance(model, World | GridMdp):
        return model
    raise InvalidFeatures(
        f"Features {name!r} are of rows and columns: they need a World or a GridMdp, not a {type(model).__name__}.",
        field="features",
    )
