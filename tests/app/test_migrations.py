"""The layout of the database: it comes up, goes down and up again, and is what the models say."""

import pytest
from alembic import command
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext

from app.db import SQLITE, _alembic, make_engine, migrate
from app.models import Base
from tests.conftest import make_settings

BEFORE_RECORDS = "20261122_0310"
OLD_ROW = (
    "INSERT INTO demonstration (id, world_id, visitor_id, states, actions, rewards, total, outcome, ending, created_at)"
    " VALUES ('old', 'w', 'v', '[0, 1]', '[1]', '[-1.0]', -1.0, 'failure', 'gave_up', '2026-11-22 00:00:00')"
)
NEW_ROW = (
    "INSERT INTO demonstration (id, world_id, visitor_id, states, actions, rewards, total, outcome, ending, created_at,"
    " parent_id, parent_step, slip_seeds) VALUES ('new', 'w', 'v', '[0, 1]', '[1]', '[-1.0]', -1.0, 'failure',"
    " 'out_of_time', '2026-11-22 00:00:00', 'old', 1, '[]')"
)

OLD_RANKING = (
    'INSERT INTO ranking (world_id, visitor_id, outcome, version, "order", start_order, created_at)'
    " VALUES ('w', 'v', 'failure', 1, '[[\"old\"]]', '[\"old\"]', '2026-11-22 00:00:00')"
)


@pytest.fixture
def told(tmp_path):
    return make_settings(tmp_path)


@pytest.fixture
def database(told):
    """A connection to a database as it was before records, with one attempt in it."""
    command.upgrade(_alembic(told), BEFORE_RECORDS)
    connection = SQLITE.connect(told.database_path, isolation_level=None)
    connection.execute("PRAGMA foreign_keys = ON")
    connection.execute("INSERT INTO visitor VALUES ('v', '2026-11-22')")
    connection.execute("INSERT INTO world VALUES ('w', '{}', '{}', '2026-11-22')")
    connection.execute(OLD_ROW)
    yield connection
    connection.close()


def layout(connection):
    """What the tables and indices are made of, whatever the order of a table's constraints."""
    rows = connection.execute(
        "SELECT name, sql FROM sqlite_master WHERE sql NOT NULL AND tbl_name != 'alembic_version'"
    )
    return {name: sorted(part.strip(' ,)"\n\t') for part in sql.split("\n")[1:]) or sql for name, sql in rows}


def test_up_down_and_up_again_gives_the_same_layout(told, database):
    before = layout(database)
    command.upgrade(_alembic(told), "head")
    newest = layout(database)
    command.downgrade(_alembic(told), BEFORE_RECORDS)
    assert layout(database) == before
    command.upgrade(_alembic(told), "head")
    assert layout(database) == newest != before


def test_an_attempt_from_before_slips_by_its_id(told, database):
    command.upgrade(_alembic(told), "head")
    rows = database.execute("SELECT id, slip_seeds, parent_id, record FROM demonstration").fetchall()
    assert rows == [("old", '[["old",0]]', None, None)]


def test_who_ran_out_of_time_has_given_up_where_that_is_not_known(told, database):
    command.upgrade(_alembic(told), "head")
    database.execute(NEW_ROW)
    command.downgrade(_alembic(told), BEFORE_RECORDS)
    assert database.execute("SELECT id, ending FROM demonstration").fetchall() == [
        ("old", "gave_up"),
        ("new", "gave_up"),
    ]


def test_an_order_from_before_was_given_by_lists_and_outlives_its_sitting_columns(told, database):
    database.execute(OLD_RANKING)
    command.upgrade(_alembic(told), "head")
    asked = 'SELECT version, "order", way, given, sitting_id, n_events, untouched FROM ranking'
    assert database.execute(asked).fetchall() == [(1, '[["old"]]', "lists", None, None, None, None)]
    database.execute("INSERT INTO sitting VALUES ('s', 'v', 'w', 1, '2026-11-22')")
    database.execute("INSERT INTO ranking_event VALUES ('s', 0, 'begin', 'page', 0.0, '{}', '2026-11-22')")
    database.execute("UPDATE ranking SET sitting_id = 's', n_events = 1, way = 'pairwise'")
    command.downgrade(_alembic(told), BEFORE_RECORDS)
    assert database.execute('SELECT version, "order" FROM ranking').fetchall() == [(1, '[["old"]]')]


@pytest.mark.parametrize(("good", "bad"), [("'old', 1", "'nobody', 1"), ("'out_of_time'", "'bored'")])
def test_the_newest_layout_refuses_what_cannot_be(told, database, good, bad):
    command.upgrade(_alembic(told), "head")
    with pytest.raises(SQLITE.IntegrityError):
        database.execute(NEW_ROW.replace(good, bad))
    database.execute(NEW_ROW)


def test_the_newest_layout_is_that_of_the_models(told):
    migrate(told)
    engine = make_engine(told.database_url, "read")
    ours = {"include_name": lambda name, kind, _: kind != "table" or name in Base.metadata.tables}
    with engine.connect() as connection:
        assert compare_metadata(MigrationContext.configure(connection, opts=ours), Base.metadata) == []
    engine.dispose()
