"""What is said when learning again at once comes to nothing. Nothing was stored, so nothing is lost."""

from collections.abc import Iterator
from contextlib import contextmanager

from app.errors import Conflict, Unavailable, Unprocessable
from app.kit.companion import Failed, Superseded
from app.kit.companion_process import CompanionError, Overdue
from app.retraining.computing import TooSlow
from irl_core import InvalidRanking, MissingDemonstrations

SUPERSEDED = "Something newer was asked for meanwhile, so this was left."
TOO_SLOW = (
    "Learning takes too long here to wait for it. Press Learn, which has all the time it needs, or try a smaller world"
    " or fewer iterations."
)
TOO_SLOW_AGAIN = (
    "Learning again takes too long here to wait for it. It is quicker for another learner, with fewer iterations, or in"
    " a smaller world."
)
TOO_LARGE = "The learner ran out of memory. Try a smaller world."
IMPOSSIBLE_CHANGES = {
    "swap": "These two cannot trade places: they must stand in one order.",
    "relabel": "This attempt never reached the goal, so it cannot be called a success.",
}
FAILED = "Something went wrong inside the learner; the server's log has the details."
NOT_NOW = "Learning at once is busy or just starting on this server. Please try again in a moment."


@contextmanager
def in_words(*, too_slow: str = TOO_SLOW_AGAIN) -> Iterator[None]:
    """Turn what can go wrong in the companion into what people are told. Raises AppError, or irl_core's refusals."""
    try:
        yield
    except Superseded as error:
        raise Conflict(SUPERSEDED, code="superseded") from error
    except (TooSlow, Overdue) as error:
        raise Unprocessable(too_slow, code="too_slow") from error
    except MemoryError as error:
        raise Unprocessable(TOO_LARGE, code="too_large") from error
    except Failed as error:
        raise Unprocessable(FAILED, code="learner_failed") from error
    except CompanionError as error:
        raise Unavailable(NOT_NOW) from error
    except MissingDemonstrations as error:
        raise missing_demonstrations(error.message) from error
    except InvalidRanking as error:
        sentence = IMPOSSIBLE_CHANGES.get(error.field or "", error.message)
        raise Unprocessable(sentence, fields={"change": sentence}) from error


def missing_demonstrations(sentence: str) -> Unprocessable:
    """Say why a learner cannot learn from this."""
    return Unprocessable(sentence, code="missing_demonstrations", fields={"learner": sentence})
