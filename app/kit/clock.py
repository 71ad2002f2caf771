"""The time of day, always in UTC."""

from datetime import UTC, datetime


def now() -> datetime:
    """Return the present moment, aware of its zone."""
    return datetime.now(UTC)
