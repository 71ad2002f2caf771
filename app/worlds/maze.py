"""Mazes on a grid whose sides are odd: rooms at even rows and columns, walls between them."""

import random

STEPS = ((-2, 0), (0, 2), (2, 0), (0, -2))


def carve_maze(rows: int, cols: int, *, n_openings: int, rng: random.Random) -> tuple[list[int], list[int]]:
    """Carve a perfect maze by a walk that enters rooms not seen before and backs up where there are none.

    Then open further walls between rooms, so that there is more than one way. Returns the walls and these openings.
    """
    is_open = {(0, 0)}
    trail = [(0, 0)]
    while trail:
        row, col = trail[-1]
        ahead = [(row + down, col + right) for down, right in STEPS if _is_room(rows, cols, row + down, col + right)]
        unseen = [room for room in ahead if room not in is_open]
        if not unseen:
            trail.pop()
            continue
        room = unseen[int(rng.random() * len(unseen))]
        is_open |= {room, ((row + room[0]) // 2, (col + room[1]) // 2)}
        trail.append(room)
    closed = [(row, col) for row in range(rows) for col in range(cols) if (row, col) not in is_open]
    openings = _some(n_openings, [wall for wall in closed if (wall[0] + wall[1]) % 2], rng)
    walls = [row * cols + col for row, col in closed if (row, col) not in openings]
    return walls, sorted(row * cols + col for row, col in openings)


def _is_room(rows: int, cols: int, row: int, col: int) -> bool:
    return 0 <= row < rows and 0 <= col < cols


def _some(n: int, places: list[tuple[int, int]], rng: random.Random) -> set[tuple[int, int]]:
    """Pick n of the places; by rng.random alone, whose numbers no version of Python changes."""
    left = list(places)
    return {left.pop(int(rng.random() * len(left))) for _ in range(min(n, len(left)))}
