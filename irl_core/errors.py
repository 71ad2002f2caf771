"""Everything that can be wrong with what irl_core is given.

    IrlError
    ├── InvalidModel               numbers that make no Markov decision process
    │   └── InvalidWorld           a size, reward, wall, goal or horizon that makes no world
    ├── InvalidReward              a reward that is not S finite numbers
    ├── InvalidPolicy              a policy that is not S × A probabilities
    ├── InvalidFeatures            a feature map of the wrong shape, or one that cannot tell weights apart
    ├── DivergentPartition         the sum over paths of any length is infinite for this reward
    ├── ImpossibleDemonstration    an attempt that cannot have happened in its world
    ├── InvalidRanking             unknown, doubled or misplaced demonstrations in an order
    ├── InvalidSettings            a learner's setting out of its range
    ├── MissingDemonstrations      a learner lacks what it learns from
    └── InvalidFile                a demonstration file that cannot be read

Each says what was found, where, and what would be right; `field` names the argument at fault.
"""


class IrlError(Exception):
    """Anything irl_core refuses; `str(error)` is a sentence for people."""

    def __init__(self, message: str, *, field: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.field = field


class InvalidModel(IrlError):
    """These numbers do not make a Markov decision process."""


class InvalidReward(IrlError):
    """This is not a reward for this model."""


class InvalidPolicy(IrlError):
    """This is not a policy, or not a plan, for this model."""


class InvalidFeatures(IrlError):
    """This is not a feature map for this model."""


class DivergentPartition(IrlError):
    """The sum over paths of any length is infinite; `spectral_radius` is ρ ≥ 1 where it was computed."""

    def __init__(self, message: str, *, spectral_radius: float | None = None) -> None:
        super().__init__(message, field="reward")
        self.spectral_radius = spectral_radius


class InvalidWorld(InvalidModel):
    """These numbers do not make a world."""


class ImpossibleDemonstration(IrlError):
    """This attempt cannot have happened; `step` is the first impossible one, counted from 0."""

    def __init__(self, reason: str, *, step: int | None = None, field: str = "actions") -> None:
        where = "" if step is None else f"Step {step}: "
        super().__init__(where + reason, field=field)
        self.step = step
        self.reason = reason


class InvalidRanking(IrlError):
    """This is not an order of these demonstrations."""


class InvalidSettings(IrlError):
    """A setting is out of its range."""


class MissingDemonstrations(IrlError):
    """A learner lacks the demonstrations or the ranking it learns from."""


class InvalidFile(IrlError):
    """A demonstration file cannot be read; `line` counts from 1."""

    def __init__(self, reason: str, *, line: int | None = None, field: str | None = None) -> None:
        where = "" if line is None else f"Line {line}: "
        super().__init__(where + reason, field=field)
        self.line = line
        self.reason = reason
