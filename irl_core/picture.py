"""A world as an image, by NumPy alone: the product's colours, edges smoothed, every length in pixels of the image.

The colour of a square says its kind and its depth the size of what it costs, as in the browser
(static/js/board/colours.js): blue squares by |r|, red ones by |r| / 7, each from a pale end to a full one, mixed in
OKLab (Ottosson 2020), where equal steps look equal. Shapes are drawn by their distance: a pixel is covered by ½ − d,
clipped to [0, 1], d pixels from the edge of the shape, negative inside.
"""

from typing import Final, TypeAlias

import numpy as np

from irl_core.arrays import Matrix
from irl_core.types import World

Image: TypeAlias = np.ndarray[tuple[int, int, int], np.dtype[np.uint8]]
_Rgb: TypeAlias = tuple[float, float, float]

_RED: Final = (178.0, 24.0, 43.0)
_MIDDLE: Final = (247.0, 247.0, 247.0)
_BLUE: Final = (33.0, 102.0, 172.0)
_GOAL: Final = (242.0, 194.0, 48.0)
_WALL: Final = (83.0, 89.0, 92.0)
_WALL_EDGE: Final = (59.0, 64.0, 67.0)
_PAPER: Final = (250.0, 250.0, 248.0)
_INK: Final = (27.0, 31.0, 33.0)
_AGENT: Final = (81.0, 88.0, 92.0)
_PALEST_BLUE: Final = 0.16
_PALEST_RED: Final = 0.3
_WORST_RED: Final = 7.0
_LINES_FROM: Final = 8
"""Pixels a side from which squares are parted by lines and hold shapes; smaller ones are a colour and a dot."""
_LOOKS: Final = ((0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0))

# sRGB, linear → cone responses → OKLab.
_TO_CONES: Final = np.array([
    [0.4122214708, 0.5363325363, 0.0514459929],
    [0.2119034982, 0.6806995451, 0.1073969566],
    [0.0883024619, 0.2817188376, 0.6299787005],
])  # fmt: skip
_TO_LAB: Final = np.array([
    [0.2104542553, 0.7936177850, -0.0040720468],
    [1.9779984951, -2.4285922050, 0.4505937099],
    [0.0259040371, 0.7827717662, -0.8086757660],
])  # fmt: skip


def draw_world(world: World, *, cell: int, agent: int | None = None, facing: int | None = None) -> Image:
    """The world with squares of `cell` pixels a side, shape (rows · cell, cols · cell, 3).

    `agent` is the state where the agent stands, `facing` the direction 0 … 3 in which it looks.
    """
    squares = _square_colours(world).reshape(world.rows, world.cols, 3)
    canvas = np.repeat(np.repeat(squares, cell, axis=0), cell, axis=1)
    if cell >= _LINES_FROM:
        _draw_lines(canvas, cell)
        for wall in world.walls:
            _draw_wall(_square(canvas, world, wall, cell))
        _draw_start(_square(canvas, world, world.start, cell))
        for goal in world.goals:
            _draw_flag(_square(canvas, world, goal, cell))
    if agent is not None:
        _draw_agent(_square(canvas, world, agent, cell), facing)
    return np.rint(canvas).astype(np.uint8)


def _square_colours(world: World) -> Matrix:
    """The colour of each state, shape (S, 3)."""
    kinds = np.array([colour for row in world.colours for colour in row])
    size = np.abs(world.reward)
    reds = _mixed(_MIDDLE, _RED, _PALEST_RED + (1.0 - _PALEST_RED) * np.minimum(size / _WORST_RED, 1.0))
    colours = _mixed(_MIDDLE, _BLUE, _PALEST_BLUE + (1.0 - _PALEST_BLUE) * np.minimum(size, 1.0))
    colours[kinds == "red"] = reds[kinds == "red"]
    colours[kinds == "goal"] = _GOAL
    colours[kinds == "wall"] = _WALL
    return colours


def _mixed(pale: _Rgb, full: _Rgb, depth: np.ndarray[tuple[int], np.dtype[np.float64]]) -> Matrix:
    """The way from one colour to another in OKLab, shape (len(depth), 3)."""
    start, end = _to_lab(pale), _to_lab(full)
    lab = start + depth[:, None] * (end - start)
    linear = np.linalg.solve(_TO_CONES, np.linalg.solve(_TO_LAB, lab.T) ** 3).T
    linear = np.clip(linear, 0.0, 1.0)
    encoded: Matrix = 255.0 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return encoded


def _to_lab(colour: _Rgb) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    c = np.array(colour) / 255.0
    linear = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    lab: np.ndarray[tuple[int], np.dtype[np.float64]] = _TO_LAB @ np.cbrt(_TO_CONES @ linear)
    return lab


def _draw_lines(canvas: np.ndarray, cell: int) -> None:
    width = max(1, cell // 32)
    for axis in (0, 1):
        for edge in range(cell, canvas.shape[axis], cell):
            lines = canvas.swapaxes(0, axis)
            lines[edge - width // 2 - width % 2 : edge + width // 2] = _PAPER


def _square(canvas: np.ndarray, world: World, state: int, cell: int) -> np.ndarray:
    """The pixels of one square, a view to draw in."""
    row, col = divmod(state, world.cols)
    return canvas[row * cell : (row + 1) * cell, col * cell : (col + 1) * cell]


def _draw_wall(square: np.ndarray) -> None:
    x, y, size = _places(square)
    outside = np.maximum(np.abs(x - 0.5), np.abs(y - 0.5)) - 0.38
    _paint(square, np.abs(outside) - 0.015, size, _WALL_EDGE)


def _draw_start(square: np.ndarray) -> None:
    x, y, size = _places(square)
    luminous = float(square.mean()) > 140.0
    _paint(square, np.abs(np.hypot(x - 0.5, y - 0.5) - 0.39) - 0.0225, size, _INK if luminous else _PAPER)


def _draw_flag(square: np.ndarray) -> None:
    x, y, size = _places(square)
    pole = np.maximum(np.abs(x - 0.36) - 0.025, np.abs(y - 0.5) - 0.3)
    slope = 0.14 / 0.38
    cloth = np.maximum(0.36 - x, (np.abs(y - 0.34) - 0.14 + slope * (x - 0.36)) / np.hypot(1.0, slope))
    _paint(square, np.minimum(pole, cloth), size, _INK)


def _draw_agent(square: np.ndarray, facing: int | None) -> None:
    x, y, size = _places(square)
    ahead, down = (0.0, 0.0) if facing is None else _LOOKS[facing]
    _paint(square, np.hypot(x - 0.5, y - 0.5) - 0.34, size, _PAPER)
    _paint(square, np.hypot(x - 0.5, y - 0.5) - 0.3, size, _AGENT)
    if size < 2 * _LINES_FROM:
        return
    for side in (-0.11, 0.11):
        eye_x, eye_y = 0.5 + side + 0.03 * ahead, 0.48 + 0.03 * down
        _paint(square, np.hypot(x - eye_x, y - eye_y) - 0.095, size, _PAPER)
        _paint(square, np.hypot(x - eye_x - 0.04 * ahead, y - eye_y - 0.04 * down) - 0.05, size, _INK)


def _places(square: np.ndarray) -> tuple[Matrix, Matrix, int]:
    """Where the middle of each pixel lies in the square, x and y from 0 to 1, and the square's side in pixels."""
    size = len(square)
    middles = (np.arange(size) + 0.5) / size
    x, y = np.meshgrid(middles, middles)
    return x, y, size


def _paint(square: np.ndarray, distance: Matrix, size: int, colour: _Rgb) -> None:
    """Colour what lies inside, `distance` < 0 in sides of the square."""
    cover = np.clip(0.5 - distance * size, 0.0, 1.0)[..., None]
    square += cover * (np.array(colour) - square)
