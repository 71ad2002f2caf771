"""One SQLite library in each process: two on one file undo each other's locks and destroy it."""

import os
import sqlite3
import subprocess
import sys
import time

import pytest

from app.db import SQLITE, Database, migrate
from app.learning.jobs import Jobs
from tests.conftest import make_settings


@pytest.fixture
def no_other_library(monkeypatch):
    if SQLITE is sqlite3:
        pytest.skip("here the standard library's own SQLite is the one in use")

    def refuse(*_, **__):
        raise AssertionError("the file was opened by another SQLite library")

    monkeypatch.setattr(sqlite3, "connect", refuse)
    monkeypatch.setattr(sqlite3.dbapi2, "connect", refuse)


def test_migrating_and_serving_open_the_file_by_one_library(no_other_library, tmp_path):
    settings = make_settings(tmp_path)
    migrate(settings)
    database, jobs = Database(settings), Jobs(settings)
    jobs._client.check_connection()
    jobs.close()
    database.close()


def test_a_worker_opens_the_file_by_one_library(tmp_path):
    """Its process has the locks and the data of one library only, whatever DBOS does by itself."""
    settings = make_settings(tmp_path)
    code = (
        "import sqlite3, sys\n"
        "def refuse(*_, **__): sys.stderr.write('ANOTHER LIBRARY'); raise AssertionError\n"
        "from app import db\n"
        "if db.SQLITE is not sqlite3: sqlite3.connect = sqlite3.dbapi2.connect = refuse\n"
        "from app.config import Settings\n"
        "from app.learning.worker import work\n"
        "work(Settings(), name='worker-1', follow_stdin=True)\n"
    )
    environment = os.environ | {"IRLFR_DATABASE_URL": settings.database_url}
    process = subprocess.Popen(
        [sys.executable, "-c", code], env=environment, stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    deadline = time.monotonic() + 30
    while time.monotonic() < deadline and process.poll() is None and not _shows_life(settings):
        time.sleep(0.1)
    is_alive = _shows_life(settings)
    _, errors = process.communicate(timeout=15)
    assert is_alive, errors
    assert "ANOTHER LIBRARY" not in errors
    assert process.returncode == 0


def _shows_life(settings) -> bool:
    from app.learning.queries import worker_is_alive

    if not settings.database_path.exists():
        return False
    database = Database(settings)
    try:
        with database.read() as session:
            return worker_is_alive(session)
    except SQLITE.OperationalError:
        return False
    except Exception as error:
        if "no such table" in str(error):
            return False
        raise
    finally:
        database.close()
