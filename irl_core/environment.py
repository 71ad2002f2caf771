"""The gridworld as a Gymnasium environment, "irlfr/Gridworld-v0", registered when this module is imported.

    import gymnasium, irl_core.environment
    env = gymnasium.make("irlfr/Gridworld-v0", world_seed=42, slip=0.1, render_mode="rgb_array")

or, without the import, `gymnasium.make("irl_core.environment:irlfr/Gridworld-v0")`. Observations are states, numbered
row by row; actions 0 up, 1 right, 2 down, 3 left. A step pays the reward of the square it reaches, a goal pays once and
terminates, and after the world's horizon of steps the episode is truncated. Slips are drawn from the environment's own
generator (`simulate` decides them by the attempt's id instead), so a seed gives the same episode again.

`P` and `initial_state_distrib` are as in Gymnasium's toy-text environments: `from_gymnasium` reads them.
To walk by keyboard (arrows or W A S D): `gymnasium.utils.play.play(env, wait_on_player=True)`.
"""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, Final

import gymnasium
from gymnasium import spaces

from irl_core.arrays import Vector
from irl_core.checks import is_integer, shown
from irl_core.errors import ImpossibleDemonstration, InvalidWorld
from irl_core.grid import N_ACTIONS
from irl_core.gridworld import DEFAULT_RED_PROBABILITY, DEFAULT_SIDE, generate_world
from irl_core.picture import Image, draw_world
from irl_core.types import World, check_world

ENVIRONMENT_ID: Final = "irlfr/Gridworld-v0"
DEFAULT_WORLD_SEED: Final = 7
ACTION_NAMES: Final = ("up", "right", "down", "left")
_IMAGE_SIDE: Final = 512
_LARGEST_CELL: Final = 64
_SMALLEST_CELL: Final = 4
_ARROW_KEYS: Final = (1073741906, 1073741903, 1073741905, 1073741904)  # SDL's up, right, down, left
_LETTERS: Final = {"red": "r", "blue": "b", "goal": "G", "wall": "#"}

Ways = list[tuple[float, int, float, bool]]
"""What an action may lead to: probability, next state, reward, whether the episode ends there."""


class GridworldEnv(gymnasium.Env[Any, Any]):
    """A world to walk in: one that is given, or the generated one of `world_seed` and the numbers beside it.

    `reset(options={"world": World})` or `reset(options={"world_seed": 3})` goes on in another world of the same size.
    """

    metadata = {"render_modes": ["rgb_array", "ansi"], "render_fps": 8}  # noqa: RUF012 - as Gymnasium has it

    def __init__(
        self,
        world: World | None = None,
        *,
        world_seed: int = DEFAULT_WORLD_SEED,
        rows: int = DEFAULT_SIDE,
        cols: int = DEFAULT_SIDE,
        red_probability: float = DEFAULT_RED_PROBABILITY,
        slip: float = 0.0,
        walls: Sequence[int] = (),
        render_mode: str | None = None,
    ) -> None:
        if render_mode is not None and render_mode not in self.metadata["render_modes"]:
            raise ValueError(f'render_mode must be "rgb_array", "ansi" or None, not {render_mode!r}.')
        self._generate = {
            "rows": rows, "cols": cols, "red_probability": red_probability, "slip": slip, "walls": walls,
        }  # fmt: skip
        self.world = self._generated(world_seed) if world is None else check_world(world)
        self.render_mode = render_mode
        self.observation_space = spaces.Discrete(self.world.n_states)
        self.action_space = spaces.Discrete(N_ACTIONS)
        self.state, self._n_steps, self._total = self.world.start, 0, 0.0
        self._facing: int | None = None

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> tuple[int, dict[str, Any]]:
        """Back to the start, in this world or the one that the options name. Raises InvalidWorld."""
        super().reset(seed=seed)
        if options:
            self._enter(options)
        self.state, self._n_steps, self._total, self._facing = self.world.start, 0, 0.0, None
        return self.state, self._info(None)

    def step(self, action: int) -> tuple[int, float, bool, bool, dict[str, Any]]:
        """One step. `info` has the total so far, the number of steps, and the direction really taken."""
        if not is_integer(action) or not 0 <= int(action) < N_ACTIONS:
            raise ImpossibleDemonstration(f"an action is 0 up, 1 right, 2 down or 3 left, not {shown(action)}.")
        direction = self._direction(int(action))
        if self.state not in self.world.goals:
            self.state = int(self.world.next_states[self.state, direction])
            reward = float(self.world.reward[self.state])
            self._n_steps += 1
        else:
            reward = 0.0
        self._total += reward
        self._facing = direction
        arrived = self.state in self.world.goals
        return self.state, reward, arrived, not arrived and self._n_steps >= self.horizon, self._info(direction)

    def render(self) -> Image | str | None:
        """The board: an image of at most 512 pixels a side, or text with the agent in brackets."""
        if self.render_mode == "rgb_array":
            longer = max(self.world.rows, self.world.cols)
            cell = max(_SMALLEST_CELL, min(_LARGEST_CELL, _IMAGE_SIDE // longer))
            return draw_world(self.world, cell=cell, agent=self.state, facing=self._facing)
        if self.render_mode == "ansi":
            return self._text()
        gymnasium.logger.warn('Nothing is rendered: make the environment with render_mode="rgb_array" or "ansi".')
        return None

    @property
    def horizon(self) -> int:
        """Steps after which an episode is truncated."""
        return self.world.horizon

    @property
    def initial_state_distrib(self) -> Vector:
        """Where episodes start, shape (S,)."""
        return self.world.mdp.starts

    @cached_property
    def _table(self) -> dict[int, dict[int, Ways]]:
        actions, states = range(N_ACTIONS), range(self.world.n_states)
        return {state: {action: self._ways(state, action) for action in actions} for state in states}

    @property
    def P(self) -> dict[int, dict[int, Ways]]:  # noqa: N802 - Gymnasium's name for it
        """What each action in each state may lead to, with what probability, reward and end."""
        return self._table

    @staticmethod
    def get_keys_to_action() -> dict[tuple[int, ...], int]:
        """Arrows and W, D, S, A, for gymnasium.utils.play."""
        arrows: dict[tuple[int, ...], int] = {(key,): action for action, key in enumerate(_ARROW_KEYS)}
        return arrows | {(ord(letter),): action for action, letter in enumerate("wdsa")}

    def _enter(self, options: Mapping[str, Any]) -> None:
        unknown = sorted(set(options) - {"world", "world_seed"})
        if unknown or len(options) > 1:
            raise InvalidWorld(
                f'options may name "world" or "world_seed", one of them, not {", ".join(map(str, options))}.',
                field="options",
            )
        world = options["world"] if "world" in options else self._generated(options["world_seed"])
        if not isinstance(world, World) or (world.rows, world.cols) != (self.world.rows, self.world.cols):
            raise InvalidWorld(
                f"The world of a reset must be a World of {self.world.rows} × {self.world.cols} squares, as the one"
                " before: observations are its states.",
                field="options",
            )
        self.world = world
        self.__dict__.pop("_table", None)

    def _generated(self, world_seed: int) -> World:
        return generate_world(world_seed, **self._generate)  # type: ignore[arg-type]  # it checks them itself

    def _direction(self, intended: int) -> int:
        """Where a step really goes: as intended, or with slip p in each of the other directions with p / 3."""
        if self.world.slip == 0.0:
            return intended
        u = float(self.np_random.random())
        if u >= self.world.slip:
            return intended
        return (intended + 1 + min(2, int(u / self.world.slip * 3))) % N_ACTIONS

    def _ways(self, state: int, action: int) -> Ways:
        if state in self.world.goals:
            return [(1.0, state, 0.0, True)]
        aside = self.world.slip / (N_ACTIONS - 1)
        chances = {d: 1.0 - self.world.slip if d == action else aside for d in range(N_ACTIONS)}
        reached = {d: int(self.world.next_states[state, d]) for d in range(N_ACTIONS)}
        return [
            (chances[d], reached[d], float(self.world.reward[reached[d]]), reached[d] in self.world.goals)
            for d in range(N_ACTIONS)
            if chances[d] > 0.0
        ]

    def _info(self, direction: int | None) -> dict[str, Any]:
        return {"total": self._total, "n_steps": self._n_steps, "direction": direction}

    def _text(self) -> str:
        squares = [_LETTERS[colour] for row in self.world.colours for colour in row]
        shown = [f"[{letter}]" if state == self.state else f" {letter} " for state, letter in enumerate(squares)]
        rows = ["".join(shown[first : first + self.world.cols]) for first in range(0, len(shown), self.world.cols)]
        taken = "start" if self._facing is None else ACTION_NAMES[self._facing]
        return "\n".join([f"{taken}, total {self._total:.2f}", *(row.rstrip() for row in rows)]) + "\n"


if ENVIRONMENT_ID not in gymnasium.registry:
    gymnasium.register(id=ENVIRONMENT_ID, entry_point="irl_core.environment:GridworldEnv")
