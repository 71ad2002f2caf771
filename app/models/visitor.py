"""Who came: a browser, known by its signed cookie and by nothing else."""

from datetime import datetime

from sqlalchemy import String
from sqlalchemy.orm import Mapped, mapped_column

from app.models.base import Base


class Visitor(Base):
    """One browser that has created something here."""

    __tablename__ = "visitor"

    id: Mapped[str] = mapped_column(String(36), primary_key=True)
    created_at: Mapped[datetime]
