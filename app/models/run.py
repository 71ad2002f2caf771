"""The runs, what they showed on the way, and what came out."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, CheckConstraint, Double, ForeignKey, Index, String
from sqlalchemy.orm import Mapped, mapped_column

from app.models.base import Base

RUN_STATUSES = ("queued", "running", "done", "failed", "cancelled")


class Run(Base):
    """Learners applied to a snapshot of one visitor's demonstrations and rankings in one world."""

    __tablename__ = "run"
    __table_args__ = (
        CheckConstraint(f"status IN {RUN_STATUSES}", name="status"),
        Index("ix_run_visitor_world", "visitor_id", "world_id", "created_at"),
    )

    id: Mapped[str] = mapped_column(String(36), primary_key=True)
    world_id: Mapped[str] = mapped_column(ForeignKey("world.id"))
    visitor_id: Mapped[str] = mapped_column(ForeignKey("visitor.id"))
    learners: Mapped[list[str]] = mapped_column(JSON, comment="names, in the order in which they learn")
    settings: Mapped[dict[str, Any]] = mapped_column(JSON)
    seed: Mapped[int]
    demonstrations: Mapped[list[str]] = mapped_column(JSON, comment="the ids learned from, oldest first")
    rankings: Mapped[dict[str, Any]] = mapped_column(
        JSON, comment="outcome → groups of ids, as confirmed at that moment"
    )
    versions: Mapped[dict[str, str]] = mapped_column(JSON, comment="the software that was asked")
    status: Mapped[str] = mapped_column(String(9))
    reason: Mapped[str | None] = mapped_column(comment="why it failed, in words for the person who asked")
    n_vain_starts: Mapped[int] = mapped_column(
        default=0, server_default="0", comment="how often a worker has begun it since its last step forward"
    )
    comparison: Mapped[dict[str, Any] | None] = mapped_column(JSON(none_as_null=True))
    rollouts: Mapped[dict[str, Any] | None] = mapped_column(JSON(none_as_null=True))
    created_at: Mapped[datetime]
    started_at: Mapped[datetime | None]
    finished_at: Mapped[datetime | None]


class RunResult(Base):
    """What one learner of a run came to; the key keeps it from being stored twice."""

    __tablename__ = "run_result"

    run_id: Mapped[str] = mapped_column(ForeignKey("run.id", ondelete="CASCADE"), primary_key=True)
    learner: Mapped[str] = mapped_column(String(40), primary_key=True)
    result: Mapped[dict[str, Any]] = mapped_column(JSON)
    compute_ms: Mapped[float] = mapped_column(
        Double, default=0.0, server_default="0", comment="how long the learner itself computed, in milliseconds"
    )
    finished_at: Mapped[datetime]


class RunCheckpoint(Base):
    """How far a learner of a run has come: what a worker takes up after its predecessor died. Gone when it finishes."""

    __tablename__ = "run_checkpoint"

    run_id: Mapped[str] = mapped_column(ForeignKey("run.id", ondelete="CASCADE"), primary_key=True)
    learner: Mapped[str] = mapped_column(String(40), primary_key=True)
    state: Mapped[dict[str, Any]] = mapped_column(JSON, comment="irl_core.LearningState.to_json(), floats exact")
    compute_ms: Mapped[float] = mapped_column(
        Double, default=0.0, server_default="0", comment="how long the learner itself has computed, in milliseconds"
    )


class RunEvent(Base):
    """One event of a run's stream, in order: what a browser that comes late, or back, is sent."""

    __tablename__ = "run_event"
    __table_args__ = (CheckConstraint("kind IN ('frame', 'learner', 'done', 'failed')", name="kind"),)

    run_id: Mapped[str] = mapped_column(ForeignKey("run.id", ondelete="CASCADE"), primary_key=True)
    number: Mapped[int] = mapped_column(primary_key=True, comment="1, 2, …: the id of the server-sent event")
    kind: Mapped[str] = mapped_column(String(7))
    data: Mapped[str] = mapped_column(comment="JSON, ready to be sent")


class RunShare(Base):
    """A key to a run: who has a link with it may see the run, and change nothing."""

    __tablename__ = "run_share"

    key: Mapped[str] = mapped_column(String(43), primary_key=True, comment="256 random bits, URL-safe")
    run_id: Mapped[str] = mapped_column(ForeignKey("run.id", ondelete="CASCADE"), index=True)
    created_at: Mapped[datetime]
    revoked_at: Mapped[datetime | None]


class Worker(Base):
    """A sign of life of each worker process."""

    __tablename__ = "worker"

    name: Mapped[str] = mapped_column(String(40), primary_key=True)
    pid: Mapped[int]
    seen_at: Mapped[datetime]
    ready_at: Mapped[datetime | None] = mapped_column(comment="since when it takes runs; null while it compiles")
