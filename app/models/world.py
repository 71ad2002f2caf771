"""The worlds. A world belongs to nobody: who has its link may play it."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, String
from sqlalchemy.orm import Mapped, mapped_column

from app.models.base import Base


class World(Base):
    """One grid with its rewards, named after what generated it: the same parameters give the same id."""

    __tablename__ = "world"

    id: Mapped[str] = mapped_column(String(36), primary_key=True)
    spec: Mapped[dict[str, Any]] = mapped_column(JSON, comment="what it was generated from: rows, cols, seed, …")
    world: Mapped[dict[str, Any]] = mapped_column(JSON, comment="irl_core.World.to_json(): squares, rewards, horizon")
    created_at: Mapped[datetime]
