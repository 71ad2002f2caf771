"""The settings of the learners: the paper's symbols, their defaults and ranges, what they mean, and for whom."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from typing import Any, Final, Literal, Self, TypeAlias

from irl_core.checks import Refused, real_number, shown, whole_number
from irl_core.errors import InvalidSettings
from irl_core.features import FEATURE_NAMES, FeatureName
from irl_core.inference.base import INFERENCE_KINDS, InferenceKind

Group: TypeAlias = Literal["paper", "model", "birlfr", "model_free", "baseline"]
"""The paper's descent; the model underneath (paths, features, optimiser); single learners; the baselines."""

_WHOLE: Final = {"iterations", "episodes"}


def _number(
    default: float,
    *,
    symbol: str,
    minimum: float,
    maximum: float,
    help: str,  # noqa: A002 - the word the page uses
    group: Group = "paper",
) -> Any:  # noqa: ANN401 - a dataclass field, typed by its annotation
    about = {"symbol": symbol, "minimum": minimum, "maximum": maximum, "choices": None, "help": help, "group": group}
    return field(default=default, metadata=about)


def _choice(
    default: str,
    *,
    symbol: str,
    choices: tuple[str, ...],
    help: str,  # noqa: A002 - as above
    group: Group = "paper",
) -> Any:  # noqa: ANN401 - as above
    about = {
        "symbol": symbol,
        "minimum": None,
        "maximum": None,
        "choices": list(choices),
        "help": help,
        "group": group,
    }
    return field(default=default, metadata=about)


@dataclass(frozen=True, kw_only=True)
class Settings:
    """How a learner descends. Wrong values raise InvalidSettings, which names the field."""

    learning_rate: float = _number(
        0.1, symbol="α", minimum=1e-9, maximum=10.0, help="How far each iteration moves the learned reward."
    )
    iterations: int = _number(
        500, symbol="n", minimum=1, maximum=100_000, help="The most iterations a learner may take."
    )
    tolerance: float = _number(
        1e-4,
        symbol="ε",
        minimum=1e-12,
        maximum=1.0,
        help="The learner has converged when no square's expected visits differ from the attempts' by this much.",
    )
    lambda_start: float = _number(
        10.0, symbol="λ₀", minimum=1e-9, maximum=1e9, help="How little the failures count at first: more is less."
    )
    lambda_decay: float = _number(
        0.95, symbol="α_λ", minimum=1e-9, maximum=1.0, help="λ is multiplied by this after each iteration."
    )
    lambda_min: float = _number(
        5.0,
        symbol="λ_min",
        minimum=1e-9,
        maximum=1e9,
        help="λ falls no lower. Small values let the failures count for much, but below about 2 learning oscillates.",
    )
    lambda_rule: Literal["schedule", "curvature"] = _choice(
        "schedule",
        symbol="λ",
        choices=("schedule", "curvature"),
        help="Follow the paper's schedule; or besides keep λ at twice the curvature or more, where failures hardly make"
        " learning oscillate.",
    )
    initial_weights: Literal["zero", "uniform"] = _choice(
        "zero",
        symbol="w₀",
        choices=("zero", "uniform"),
        help="The reward before the first iteration: 0 everywhere, or drawn from U[−1, 1] with the run's seed.",
    )
    unfinished_failures: Literal["leave_out", "include"] = _choice(
        "leave_out",
        symbol="F",
        choices=("leave_out", "include"),
        help="Whether to learn from failures that never reached the goal. The model is about paths that do.",
    )

    inference: InferenceKind = _choice(  # noqa: RUF009 - it makes a field
        "path",
        symbol="P(ζ)",
        group="model",
        choices=INFERENCE_KINDS,
        help="Which distribution a reward implies: over paths of at most N steps, of any length, by maximum causal"
        " entropy, or the paper's Algorithm 1 to the letter (which is no gradient).",
    )
    discount: float = _number(
        1.0,
        symbol="γ",
        group="model",
        minimum=0.01,
        maximum=1.0,
        help="How much a later step counts, for causal inference.",
    )
    features: FeatureName = _choice(  # noqa: RUF009 - as above
        "one_hot",
        symbol="φ",
        group="model",
        choices=FEATURE_NAMES,
        help="What the reward is a sum of: each square its own, or few features that squares share.",
    )
    optimiser: Literal["descent", "newton", "lbfgs"] = _choice(
        "descent",
        symbol="min",
        group="model",
        choices=("descent", "newton", "lbfgs"),
        help="The paper's descent; or, for MEIRL and IRLR, an exact optimiser (IRLF and IRLFR have no objective).",
    )
    l2: float = _number(
        0.0,
        symbol="ℓ₂",
        group="model",
        minimum=0.0,
        maximum=1e6,
        help="How strongly large weights are held back: the ridge ℓ₂/2 · ‖w‖².",
    )

    episodes: int = _number(
        500,
        symbol="n_ζ",
        group="model_free",
        minimum=10,
        maximum=100_000,
        help="How many episodes the model-free learner plays in each iteration: the more, the less noise.",
    )
    use_colours: Literal["yes", "no"] = _choice(
        "yes",
        symbol="k",
        group="birlfr",
        choices=("yes", "no"),
        help="Bayesian IRLFR: whether it sees the colours that people see, and takes red to cost more than blue.",
    )
    preference_l2: float = _number(
        1.0,
        symbol="ℓ₂ᵀ",
        group="baseline",
        minimum=1e-9,
        maximum=1e6,
        help="T-REX: how strongly large weights are held back; orders can always be met better by larger ones.",
    )
    score_l2: float = _number(
        1.0,
        symbol="ℓ₂ˢ",
        group="baseline",
        minimum=1e-9,
        maximum=1e6,
        help="Score-based IRL: how strongly large weights are held back; there are more squares than scores.",
    )
    cloning_prior: float = _number(
        0.001,
        symbol="α_BC",
        group="baseline",
        minimum=1e-9,
        maximum=1e6,
        help="Behavioural cloning: how often each action counts as seen where some success came, before looking.",
    )

    def __post_init__(self) -> None:
        for one in fields(self):
            object.__setattr__(self, one.name, _checked(one.name, getattr(self, one.name), one.metadata))
        if self.lambda_min > self.lambda_start:
            raise InvalidSettings(
                f"lambda_min must be at most lambda_start ({self.lambda_start:g}), not {self.lambda_min:g}.",
                field="lambda_min",
            )

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Self:
        """Settings from a mapping of some of them; an unknown name is refused."""
        known = [one.name for one in fields(cls)]
        for name in data:
            if name not in known:
                raise InvalidSettings(
                    f"There is no setting {shown(name)}; there are {', '.join(known)}.", field="settings"
                )
        return cls(**data)

    def to_json(self) -> dict[str, Any]:
        """Every setting by its name."""
        return asdict(self)

    @classmethod
    def describe(cls) -> list[dict[str, Any]]:
        """What a page needs to ask for each: name, symbol, default, minimum, maximum, choices, help, group."""
        return [{"name": one.name, "default": one.default, **one.metadata} for one in fields(cls)]


def _checked(name: str, value: object, about: Mapping[str, Any]) -> object:
    try:
        if about["choices"] is not None:
            return _one_of(value, about["choices"])
        if name in _WHOLE:
            return whole_number(value, minimum=about["minimum"], maximum=about["maximum"])
        return real_number(value, minimum=about["minimum"], maximum=about["maximum"])
    except Refused as refused:
        raise InvalidSettings(f"{name} {refused}.", field=name) from None


def _one_of(value: object, choices: list[str]) -> str:
    for choice in choices:
        if isinstance(value, str) and value == choice:
            return choice
    raise Refused(f"must be {' or '.join(choices)}, not {shown(value)}")
