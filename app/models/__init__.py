"""Every table of the database."""

from app.models.base import Base
from app.models.demonstration import Demonstration
from app.models.ranking import Ranking
from app.models.run import RUN_STATUSES, Run, RunCheckpoint, RunEvent, RunResult, RunShare, Worker
from app.models.sitting import RankingEvent, Sitting
from app.models.visitor import Visitor
from app.models.world import World

__all__ = [
    "RUN_STATUSES",
    "Base",
    "Demonstration",
    "Ranking",
    "RankingEvent",
    "Run",
    "RunCheckpoint",
    "RunEvent",
    "RunResult",
    "RunShare",
    "Sitting",
    "Visitor",
    "Worker",
    "World",
]
