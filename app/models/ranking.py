"""The rankings: every version that was ever confirmed, the newest counts."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, CheckConstraint, ForeignKey, String, UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column

from app.config import WAYS, Way
from app.models.base import Base


class Ranking(Base):
    """One confirmed order of one visitor's demonstrations of one outcome in one world."""

    __tablename__ = "ranking"
    __table_args__ = (
        UniqueConstraint("visitor_id", "world_id", "outcome", "version"),
        UniqueConstraint("sitting_id", "outcome", "n_events"),
        CheckConstraint("outcome IN ('success', 'failure')", name="outcome"),
        CheckConstraint(f"way IN {WAYS}", name="way"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    world_id: Mapped[str] = mapped_column(ForeignKey("world.id"))
    visitor_id: Mapped[str] = mapped_column(ForeignKey("visitor.id"))
    outcome: Mapped[str] = mapped_column(String(7))
    version: Mapped[int]
    order: Mapped[list[list[str]]] = mapped_column(JSON, comment="groups in display order; a group of several is a tie")
    start_order: Mapped[list[str]] = mapped_column(JSON, comment="the order that was shown first, drawn at random")
    way: Mapped[Way] = mapped_column(
        String(9), default="lists", server_default="lists", comment="how the person said it"
    )
    given: Mapped[dict[str, Any] | list[Any] | None] = mapped_column(
        JSON(none_as_null=True), comment="what they said, where the way is not lists: answers, gaps or stretches"
    )
    sitting_id: Mapped[str | None] = mapped_column(ForeignKey("sitting.id"), comment="where it was confirmed")
    n_events: Mapped[int | None] = mapped_column(comment="this many of the sitting's events give this version")
    untouched: Mapped[bool | None] = mapped_column(comment="confirmed without a change to this list in the sitting")
    created_at: Mapped[datetime]
