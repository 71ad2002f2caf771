"""Create the tables: visitors, worlds, demonstrations, rankings, runs and what runs show."""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision: str = "20261122_0207"
down_revision: str | None = None
branch_labels: Sequence[str] | None = None
depends_on: Sequence[str] | None = None


def upgrade() -> None:
    op.create_table(
        "visitor",
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("created_at", sa.DateTime(), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_visitor")),
    )
    op.create_table(
        "worker",
        sa.Column("name", sa.String(length=40), nullable=False),
        sa.Column("pid", sa.Integer(), nullable=False),
        sa.Column("seen_at", sa.DateTime(), nullable=False),
        sa.PrimaryKeyConstraint("name", name=op.f("pk_worker")),
    )
    op.create_table(
        "world",
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("spec", sa.JSON(), nullable=False, comment="what it was generated from: rows, cols, seed, …"),
        sa.Column("world", sa.JSON(), nullable=False, comment="irl_core.World.to_json(): squares, rewards, horizon"),
        sa.Column("created_at", sa.DateTime(), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_world")),
    )
    op.create_table(
        "demonstration",
        sa.Column("number", sa.Integer(), autoincrement=True, nullable=False, comment="the order of arrival"),
        sa.Column("id", sa.String(length=36), nullable=False, comment="made by the browser before the first step"),
        sa.Column("world_id", sa.String(length=36), nullable=False),
        sa.Column("visitor_id", sa.String(length=36), nullable=False),
        sa.Column("states", sa.JSON(), nullable=False, comment="T + 1 squares, by the server's own simulation"),
        sa.Column("actions", sa.JSON(), nullable=False, comment="T actions: 0 up, 1 right, 2 down, 3 left"),
        sa.Column("rewards", sa.JSON(), nullable=False, comment="T rewards of the squares reached"),
        sa.Column("step_ms", sa.JSON(none_as_null=True), nullable=True, comment="T times since the last step"),
        sa.Column("total", sa.Double(), nullable=False),
        sa.Column("outcome", sa.String(length=7), nullable=False),
        sa.Column("ending", sa.String(length=12), nullable=False),
        sa.Column("created_at", sa.DateTime(), nullable=False),
        sa.Column("discarded_at", sa.DateTime(), nullable=True),
        sa.CheckConstraint("ending IN ('goal', 'gave_up', 'out_of_steps')", name=op.f("ck_demonstration_ending")),
        sa.CheckConstraint("outcome IN ('success', 'failure')", name=op.f("ck_demonstration_outcome")),
        sa.ForeignKeyConstraint(["visitor_id"], ["visitor.id"], name=op.f("fk_demonstration_visitor_id_visitor")),
        sa.ForeignKeyConstraint(["world_id"], ["world.id"], name=op.f("fk_demonstration_world_id_world")),
        sa.PrimaryKeyConstraint("number", name=op.f("pk_demonstration")),
        sa.UniqueConstraint("id", name=op.f("uq_demonstration_id")),
    )
    op.create_index(
        "ix_demonstration_visitor_world", "demonstration", ["visitor_id", "world_id", "number"], unique=False
    )

    op.create_table(
        "ranking",
        sa.Column("id", sa.Integer(), nullable=False),
        sa.Column("world_id", sa.String(length=36), nullable=False),
        sa.Column("visitor_id", sa.String(length=36), nullable=False),
        sa.Column("outcome", sa.String(length=7), nullable=False),
        sa.Column("version", sa.Integer(), nullable=False),
        sa.Column("order", sa.JSON(), nullable=False, comment="groups in display order; a group of several is a tie"),
        sa.Column("start_order", sa.JSON(), nullable=False, comment="the order that was shown first, drawn at random"),
        sa.Column("created_at", sa.DateTime(), nullable=False),
        sa.CheckConstraint("outcome IN ('success', 'failure')", name=op.f("ck_ranking_outcome")),
        sa.ForeignKeyConstraint(["visitor_id"], ["visitor.id"], name=op.f("fk_ranking_visitor_id_visitor")),
        sa.ForeignKeyConstraint(["world_id"], ["world.id"], name=op.f("fk_ranking_world_id_world")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_ranking")),
        sa.UniqueConstraint(
            "visitor_id", "world_id", "outcome", "version", name=op.f("uq_ranking_visitor_id_world_id_outcome_version")
        ),
    )
    op.create_table(
        "run",
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("world_id", sa.String(length=36), nullable=False),
        sa.Column("visitor_id", sa.String(length=36), nullable=False),
        sa.Column("learners", sa.JSON(), nullable=False, comment="names, in the order in which they learn"),
        sa.Column("settings", sa.JSON(), nullable=False),
        sa.Column("seed", sa.Integer(), nullable=False),
        sa.Column("demonstrations", sa.JSON(), nullable=False, comment="the ids learned from, oldest first"),
        sa.Column(
            "rankings", sa.JSON(), nullable=False, comment="outcome → groups of ids, as confirmed at that moment"
        ),
        sa.Column("versions", sa.JSON(), nullable=False, comment="the software that was asked"),
        sa.Column("status", sa.String(length=9), nullable=False),
        sa.Column("reason", sa.String(), nullable=True, comment="why it failed, in words for the person who asked"),
        sa.Column("comparison", sa.JSON(none_as_null=True), nullable=True),
        sa.Column("rollouts", sa.JSON(none_as_null=True), nullable=True),
        sa.Column("created_at", sa.DateTime(), nullable=False),
        sa.Column("started_at", sa.DateTime(), nullable=True),
        sa.Column("finished_at", sa.DateTime(), nullable=True),
        sa.CheckConstraint(
            "status IN ('queued', 'running', 'done', 'failed', 'cancelled')", name=op.f("ck_run_status")
        ),
        sa.ForeignKeyConstraint(["visitor_id"], ["visitor.id"], name=op.f("fk_run_visitor_id_visitor")),
        sa.ForeignKeyConstraint(["world_id"], ["world.id"], name=op.f("fk_run_world_id_world")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_run")),
    )
    op.create_index("ix_run_visitor_world", "run", ["visitor_id", "world_id", "created_at"], unique=False)

    op.create_table(
        "run_checkpoint",
        sa.Column("run_id", sa.String(length=36), nullable=False),
        sa.Column("learner", sa.String(length=40), nullable=False),
        sa.Column("state", sa.JSON(), nullable=False, comment="irl_core.LearningState.to_json(), floats exact"),
        sa.ForeignKeyConstraint(["run_id"], ["run.id"], name=op.f("fk_run_checkpoint_run_id_run"), ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("run_id", "learner", name=op.f("pk_run_checkpoint")),
    )
    op.create_table(
        "run_event",
        sa.Column("run_id", sa.String(length=36), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False, comment="1, 2, …: the id of the server-sent event"),
        sa.Column("kind", sa.String(length=7), nullable=False),
        sa.Column("data", sa.String(), nullable=False, comment="JSON, ready to be sent"),
        sa.CheckConstraint("kind IN ('frame', 'learner', 'done', 'failed')", name=op.f("ck_run_event_kind")),
        sa.ForeignKeyConstraint(["run_id"], ["run.id"], name=op.f("fk_run_event_run_id_run"), ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("run_id", "number", name=op.f("pk_run_event")),
    )
    op.create_table(
        "run_result",
        sa.Column("run_id", sa.String(length=36), nullable=False),
        sa.Column("learner", sa.String(length=40), nullable=False),
        sa.Column("result", sa.JSON(), nullable=False),
        sa.Column("finished_at", sa.DateTime(), nullable=False),
        sa.ForeignKeyConstraint(["run_id"], ["run.id"], name=op.f("fk_run_result_run_id_run"), ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("run_id", "learner", name=op.f("pk_run_result")),
    )


def downgrade() -> None:
    op.drop_table("run_result")
    op.drop_table("run_event")
    op.drop_table("run_checkpoint")
    op.drop_index("ix_run_visitor_world", "run")
    op.drop_table("run")
    op.drop_table("ranking")
    op.drop_index("ix_demonstration_visitor_world", "demonstration")
    op.drop_table("demonstration")
    op.drop_table("world")
    op.drop_table("worker")
    op.drop_table("visitor")
