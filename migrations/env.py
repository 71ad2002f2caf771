"""Run the migrations, each in a transaction of its own, so that one killed midway can simply be run again."""

from alembic import context

from app.config import Settings
from app.db import make_engine
from app.models import Base

url: str = context.config.attributes.get("url") or Settings().database_url


def is_ours(name: str | None, kind: str, _: object) -> bool:
    """Leave the job engine's tables, which share the file, to the job engine."""
    return kind != "table" or name in Base.metadata.tables


engine = make_engine(url, "write")
with engine.connect() as connection:
    context.configure(
        connection=connection,
        target_metadata=Base.metadata,
        render_as_batch=True,
        transactional_ddl=True,
        transaction_per_migration=True,
        include_name=is_ours,
    )
    with context.begin_transaction():
        context.run_migrations()
engine.dispose()
