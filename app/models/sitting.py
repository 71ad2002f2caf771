"""The sittings: how people came to their orders, event by event. Nothing here is ever changed or taken out."""

from datetime import datetime
from typing import Any, Literal, TypeAlias, get_args

from sqlalchemy import JSON, CheckConstraint, ForeignKey, Index, String
from sqlalchemy.orm import Mapped, mapped_column

from app.models.base import Base

Means: TypeAlias = Literal["mouse", "touch", "pen", "key", "button", "page"]
MEANS: tuple[Means, ...] = get_args(Means)


class Sitting(Base):
    """One person's work on the orders of one world, from the first look at the page to the last."""

    __tablename__ = "sitting"
    __table_args__ = (Index("ix_sitting_visitor_world", "visitor_id", "world_id", "created_at"),)

    id: Mapped[str] = mapped_column(String(36), primary_key=True, comment="made by the browser")
    visitor_id: Mapped[str] = mapped_column(ForeignKey("visitor.id"))
    world_id: Mapped[str] = mapped_column(ForeignKey("world.id"))
    n_events: Mapped[int] = mapped_column(comment="how many events are stored: they are numbered 0 … n_events − 1")
    created_at: Mapped[datetime]


class RankingEvent(Base):
    """One event of a sitting's log; rankings/replay.py says what each means."""

    __tablename__ = "ranking_event"
    __table_args__ = (CheckConstraint(f"means IN {MEANS}", name="means"),)

    sitting_id: Mapped[str] = mapped_column(ForeignKey("sitting.id", ondelete="CASCADE"), primary_key=True)
    n: Mapped[int] = mapped_column(primary_key=True, comment="0, 1, 2 … in the sitting, without a gap")
    type: Mapped[str] = mapped_column(String(12))
    means: Mapped[Means] = mapped_column(String(6))
    at_ms: Mapped[float] = mapped_column(comment="since the sitting began, by the browser's clock; never falls")
    event: Mapped[dict[str, Any]] = mapped_column(JSON, comment="the whole event as it was sent, n and all")
    created_at: Mapped[datetime] = mapped_column(comment="when it was received")
