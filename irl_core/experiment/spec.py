"""What an experiment is: which learners, in which worlds, from how many demonstrations. JSON both ways."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Self

from irl_core.checks import Refused, real_number, shown, whole_number
from irl_core.errors import InvalidSettings
from irl_core.gridworld import DEFAULT_RED_PROBABILITY, DEFAULT_SIDE
from irl_core.learners import LEARNERS, Settings
from irl_core.types import MAX_SEED, MAX_SIDE, MAX_SLIP, MIN_SIDE

_WHOLE = {
    "seed": (0, MAX_SEED),
    "rows": (MIN_SIDE, MAX_SIDE),
    "cols": (MIN_SIDE, MAX_SIDE),
    "n_successes": (1, 100),
    "n_failures": (0, 100),
    "n_episodes": (1, 100_000),
}
_REAL = {
    "red_probability": (0.0, 1.0),
    "slip": (0.0, MAX_SLIP),
    "ranking_noise": (0.0, 1e6),
    "ties_within": (0.0, 1e6),
}


@dataclass(frozen=True, kw_only=True)
class ExperimentSpec:
    """The paper's experiment (Sec. V) by default: 7×7, three successes and three failures, 50 episodes.

    `ranking_noise` and `ties_within`, in points of reward, are the mistakes and ties of the demonstrator's order (see
    `irl_core.demonstrators.ranking`). Raises InvalidSettings, which names the field.
    """

    learners: tuple[str, ...] = field(default_factory=lambda: tuple(LEARNERS))
    seed: int = 0
    rows: int = DEFAULT_SIDE
    cols: int = DEFAULT_SIDE
    red_probability: float = DEFAULT_RED_PROBABILITY
    slip: float = 0.0
    n_successes: int = 3
    n_failures: int = 3
    n_episodes: int = 50
    ranking_noise: float = 0.0
    ties_within: float = 0.0
    settings: Settings = field(default_factory=Settings)

    def __post_init__(self) -> None:
        object.__setattr__(self, "learners", _learners(self.learners))
        for name, (least, most) in _WHOLE.items():
            _check(name, lambda value, a=least, b=most: whole_number(value, minimum=a, maximum=b), self)
        for name, (lowest, highest) in _REAL.items():
            _check(name, lambda value, a=lowest, b=highest: real_number(value, minimum=a, maximum=b), self)
        if not isinstance(self.settings, Settings):
            raise InvalidSettings(f"settings must be Settings, not {shown(self.settings)}.", field="settings")
        needy = [name for name in self.learners if LEARNERS[name].uses_failures]
        if needy and self.n_failures == 0:
            raise InvalidSettings(
                f"{needy[0]} learns from failures too: n_failures must be at least 1, not 0.", field="n_failures"
            )

    def to_json(self) -> dict[str, Any]:
        """Every field by its name."""
        plain = {one.name: getattr(self, one.name) for one in fields(self)}
        return plain | {"learners": list(self.learners), "settings": self.settings.to_json()}

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Self:
        """The spec that `to_json` wrote; what is left out is as in the paper, an unknown name is refused."""
        known = [one.name for one in fields(cls)]
        unknown = [name for name in data if name not in known]
        if unknown:
            raise InvalidSettings(f"An experiment has no {shown(unknown[0])}; it has {', '.join(known)}.", field="spec")
        return cls(**(dict(data) | {"settings": Settings.from_json(data.get("settings", {}))}))


def _learners(names: Iterable[str]) -> tuple[str, ...]:
    if isinstance(names, str) or not isinstance(names, Iterable):
        raise InvalidSettings(f"learners must be a list of names, not {shown(names)}.", field="learners")
    listed = tuple(dict.fromkeys(names))
    for name in listed:
        if name not in LEARNERS:
            raise InvalidSettings(
                f"There is no learner {shown(name)}; there are {', '.join(LEARNERS)}.", field="learners"
            )
    if not listed:
        raise InvalidSettings(f"An experiment needs at least one learner of {', '.join(LEARNERS)}.", field="learners")
    return listed


def _check(name: str, checked: Any, spec: ExperimentSpec) -> None:  # noqa: ANN401 - one of two checks
    try:
        object.__setattr__(spec, name, checked(getattr(spec, name)))
    except Refused as refused:
        raise InvalidSettings(f"{name} {refused}.", field=name) from None
