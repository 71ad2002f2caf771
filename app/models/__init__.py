"""Every table of the database."""

from app.models.base import Base
from app.models.demonstration import Demonstration
from app.models.ranking import Ranking
from app.models.run import RUN_STATUSES, Run, RunCheckpoint, RunEvent, RunResult, Worker
from app.models.visitor import Visitor
from app.models.world import World

__all__ = [
    "RUN_STATUSES",
    "Base",
    "Demonstration",
    "Ranking",
    "Run",
    "RunCheckpoint",
    "RunEvent",
    "RunResult",
    "Visitor",
    "Worker",
    "World",
]
