"""Keys that open a run to whoever has its link; how long learners computed; when a worker was ready to take runs."""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "20261122_1425"
down_revision: str | None = "20261122_1118"
branch_labels: Sequence[str] | None = None
depends_on: Sequence[str] | None = None


def upgrade() -> None:
    op.create_table(
        "run_share",
        sa.Column("key", sa.String(43), nullable=False),
        sa.Column("run_id", sa.String(36), nullable=False),
        sa.Column("created_at", sa.DateTime(), nullable=False),
        sa.Column("revoked_at", sa.DateTime(), nullable=True),
        sa.ForeignKeyConstraint(["run_id"], ["run.id"], name=op.f("fk_run_share_run_id_run"), ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("key", name=op.f("pk_run_share")),
    )
    op.create_index(op.f("ix_run_share_run_id"), "run_share", ["run_id"])
    for table in ("run_checkpoint", "run_result"):
        with op.batch_alter_table(table) as changed:
            changed.add_column(sa.Column("compute_ms", sa.Double(), nullable=False, server_default="0"))
    with op.batch_alter_table("worker") as worker:
        worker.add_column(sa.Column("ready_at", sa.DateTime(), nullable=True))


def downgrade() -> None:
    with op.batch_alter_table("worker") as worker:
        worker.drop_column("ready_at")
    for table in ("run_result", "run_checkpoint"):
        with op.batch_alter_table(table) as changed:
            changed.drop_column("compute_ms")
    op.drop_table("run_share")
