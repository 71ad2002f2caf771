"""Keep how orders came to be: sittings, their events, and which of them each confirmed version comes from."""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "20261122_1118"
down_revision: str | None = "20261122_0815"
branch_labels: Sequence[str] | None = None
depends_on: Sequence[str] | None = None


def upgrade() -> None:
    op.create_table(
        "sitting",
        sa.Column("id", sa.String(length=36), nullable=False, comment="made by the browser"),
        sa.Column("visitor_id", sa.String(length=36), nullable=False),
        sa.Column("world_id", sa.String(length=36), nullable=False),
        sa.Column(
            "n_events",
            sa.Integer(),
            nullable=False,
            comment="how many events are stored: they are numbered 0 … n_events − 1",
        ),
        sa.Column("created_at", sa.DateTime(), nullable=False),
        sa.ForeignKeyConstraint(["visitor_id"], ["visitor.id"], name=op.f("fk_sitting_visitor_id_visitor")),
        sa.ForeignKeyConstraint(["world_id"], ["world.id"], name=op.f("fk_sitting_world_id_world")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_sitting")),
    )
    op.create_index("ix_sitting_visitor_world", "sitting", ["visitor_id", "world_id", "created_at"], unique=False)
    op.create_table(
        "ranking_event",
        sa.Column("sitting_id", sa.String(length=36), nullable=False),
        sa.Column("n", sa.Integer(), nullable=False, comment="0, 1, 2 … in the sitting, without a gap"),
        sa.Column("type", sa.String(length=12), nullable=False),
        sa.Column("means", sa.String(length=6), nullable=False),
        sa.Column(
            "at_ms",
            sa.Double(),
            nullable=False,
            comment="since the sitting began, by the browser's clock; never falls",
        ),
        sa.Column("event", sa.JSON(), nullable=False, comment="the whole event as it was sent, n and all"),
        sa.Column("created_at", sa.DateTime(), nullable=False, comment="when it was received"),
        sa.CheckConstraint(
            "means IN ('mouse', 'touch', 'pen', 'key', 'button', 'page')", name=op.f("ck_ranking_event_means")
        ),
        sa.ForeignKeyConstraint(
            ["sitting_id"], ["sitting.id"], name=op.f("fk_ranking_event_sitting_id_sitting"), ondelete="CASCADE"
        ),
        sa.PrimaryKeyConstraint("sitting_id", "n", name=op.f("pk_ranking_event")),
    )
    with op.batch_alter_table("ranking") as ranking:
        for column in _columns():
            ranking.add_column(column)
        ranking.create_foreign_key(op.f("fk_ranking_sitting_id_sitting"), "sitting", ["sitting_id"], ["id"])
        ranking.create_unique_constraint(
            op.f("uq_ranking_sitting_id_outcome_n_events"), ["sitting_id", "outcome", "n_events"]
        )
        ranking.create_check_constraint(op.f("ck_ranking_way"), "way IN ('lists', 'pairwise', 'magnitude', 'segments')")


def downgrade() -> None:
    """The versions stay, with the order of each; how people came to them is lost."""
    with op.batch_alter_table("ranking") as ranking:
        ranking.drop_constraint(op.f("ck_ranking_way"), type_="check")
        ranking.drop_constraint(op.f("uq_ranking_sitting_id_outcome_n_events"), type_="unique")
        ranking.drop_constraint(op.f("fk_ranking_sitting_id_sitting"), type_="foreignkey")
        for column in _columns():
            ranking.drop_column(column.name)
    op.drop_table("ranking_event")
    op.drop_index("ix_sitting_visitor_world", "sitting")
    op.drop_table("sitting")


def _columns() -> tuple["sa.Column[object]", ...]:
    return (
        sa.Column("way", sa.String(length=9), nullable=False, server_default="lists", comment="how the person said it"),
        sa.Column(
            "given",
            sa.JSON(none_as_null=True),
            comment="what they said, where the way is not lists: answers, gaps or stretches",
        ),
        sa.Column("sitting_id", sa.String(length=36), comment="where it was confirmed"),
        sa.Column("n_events", sa.Integer(), comment="this many of the sitting's events give this version"),
        sa.Column("untouched", sa.Boolean(), comment="confirmed without a change to this list in the sitting"),
    )
