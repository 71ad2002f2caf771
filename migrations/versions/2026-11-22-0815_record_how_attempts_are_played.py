"""Record how attempts are played: parents, the seeds of slips, measures; and let them run out of time."""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "20261122_0815"
down_revision: str | None = "20261122_0310"
branch_labels: Sequence[str] | None = None
depends_on: Sequence[str] | None = None

OLD_ENDINGS = "ending IN ('goal', 'gave_up', 'out_of_steps')"
NEW_ENDINGS = "ending IN ('goal', 'gave_up', 'out_of_steps', 'out_of_time')"


def upgrade() -> None:
    for column in (
        sa.Column("parent_id", sa.String(length=36), comment="the attempt from which this one was tried again"),
        sa.Column("parent_step", sa.Integer(), comment="steps copied from the parent"),
        sa.Column("slip_seeds", sa.JSON(), comment="pairs: a seed, and the step from which it decides"),
        sa.Column(
            "record",
            sa.JSON(none_as_null=True),
            comment="how it was played: demonstrations/record.py; large, so loaded only where it is asked for",
        ),
    ):
        op.add_column("demonstration", column)
    op.execute("UPDATE demonstration SET slip_seeds = json_array(json_array(id, 0))")
    with op.batch_alter_table("demonstration") as demonstration:
        demonstration.drop_constraint(op.f("ck_demonstration_ending"), type_="check")
        demonstration.create_check_constraint(op.f("ck_demonstration_ending"), NEW_ENDINGS)
        demonstration.alter_column("slip_seeds", existing_type=sa.JSON(), nullable=False)
        demonstration.create_foreign_key(
            op.f("fk_demonstration_parent_id_demonstration"), "demonstration", ["parent_id"], ["id"]
        )


def downgrade() -> None:
    """Who ran out of time is said to have given up: the older layout knows nothing nearer."""
    op.execute("UPDATE demonstration SET ending = 'gave_up' WHERE ending = 'out_of_time'")
    with op.batch_alter_table("demonstration") as demonstration:
        demonstration.drop_constraint(op.f("ck_demonstration_ending"), type_="check")
        demonstration.create_check_constraint(op.f("ck_demonstration_ending"), OLD_ENDINGS)
        demonstration.drop_constraint(op.f("fk_demonstration_parent_id_demonstration"), type_="foreignkey")
        for name in ("record", "slip_seeds", "parent_step", "parent_id"):
            demonstration.drop_column(name)
