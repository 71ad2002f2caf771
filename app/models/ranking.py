"""The rankings: every version that was ever confirmed, the newest counts."""

from datetime import datetime

from sqlalchemy import JSON, CheckConstraint, ForeignKey, String, UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column

from app.models.base import Base


class Ranking(Base):
    """One confirmed order of one visitor's demonstrations of one outcome in one world."""

    __tablename__ = "ranking"
    __table_args__ = (
        UniqueConstraint("visitor_id", "world_id", "outcome", "version"),
        CheckConstraint("outcome IN ('success', 'failure')", name="outcome"),
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    world_id: Mapped[str] = mapped_column(ForeignKey("world.id"))
    visitor_id: Mapped[str] = mapped_column(ForeignKey("visitor.id"))
    outcome: Mapped[str] = mapped_column(String(7))
    version: Mapped[int]
    order: Mapped[list[list[str]]] = mapped_column(JSON, comment="groups in display order; a group of several is a tie")
    start_order: Mapped[list[str]] = mapped_column(JSON, comment="the order that was shown first, drawn at random")
    created_at: Mapped[datetime]
