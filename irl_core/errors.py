"""Everything that can be wrong with what irl_core is given.

    IrlError
    ├── InvalidWorld               a size, reward, wall, goal or horizon that makes no world
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


class InvalidWorld(IrlError):
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
