"""The demonstrations, exactly as they were played."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, CheckConstraint, ForeignKey, Index, String
from sqlalchemy.orm import Mapped, mapped_column

from app.models.base import Base


class Demonstration(Base):
    """One attempt in one world by one visitor. Nothing but `discarded_at` ever changes."""

    __tablename__ = "demonstration"
    __table_args__ = (
        CheckConstraint("outcome IN ('success', 'failure')", name="outcome"),
        CheckConstraint("ending IN ('goal', 'gave_up', 'out_of_steps', 'out_of_time')", name="ending"),
        Index("ix_demonstration_visitor_world", "visitor_id", "world_id", "number"),
    )

    number: Mapped[int] = mapped_column(primary_key=True, autoincrement=True, comment="the order of arrival")
    id: Mapped[str] = mapped_column(String(36), unique=True, comment="made by the browser before the first step")
    world_id: Mapped[str] = mapped_column(ForeignKey("world.id"))
    visitor_id: Mapped[str] = mapped_column(ForeignKey("visitor.id"))
    states: Mapped[list[int]] = mapped_column(JSON, comment="T + 1 squares, by the server's own simulation")
    actions: Mapped[list[int]] = mapped_column(JSON, comment="T actions: 0 up, 1 right, 2 down, 3 left")
    rewards: Mapped[list[float]] = mapped_column(JSON, comment="T rewards of the squares reached")
    step_ms: Mapped[list[float] | None] = mapped_column(JSON(none_as_null=True), comment="T times since the last step")
    total: Mapped[float]
    outcome: Mapped[str] = mapped_column(String(7))
    ending: Mapped[str] = mapped_column(String(12))
    parent_id: Mapped[str | None] = mapped_column(
        ForeignKey("demonstration.id"), comment="the attempt from which this one was tried again"
    )
    parent_step: Mapped[int | None] = mapped_column(comment="steps copied from the parent")
    slip_seeds: Mapped[list[list[Any]]] = mapped_column(
        JSON, comment="pairs: a seed, and the step from which it decides"
    )
    record: Mapped[dict[str, Any] | None] = mapped_column(
        JSON(none_as_null=True),
        deferred=True,
        deferred_raiseload=True,
        comment="how it was played: demonstrations/record.py; large, so loaded only where it is asked for",
    )
    created_at: Mapped[datetime]
    discarded_at: Mapped[datetime | None]
