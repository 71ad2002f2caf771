"""The real app over a real SQLite file, fresh for each test."""

import shutil
import warnings
from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi import FastAPI

from app.config import Settings
from app.db import SQLITE, migrate

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # starlette asks for the successor of httpx, which is not in our lock
    from fastapi.testclient import TestClient

TEST_KEY = "a key for tests and for nothing else"


def make_settings(folder: Path, **changes: object) -> Settings:
    """Settings of a server whose data lie in `folder`, whatever the environment says."""
    told = {
        "database_url": f"sqlite:///{folder / 'irlfr.sqlite3'}",
        "secret_key": TEST_KEY,
        "allow_missing_assets": True,
        "workers": 0,
    }
    return Settings.model_validate(told | changes)


def open_client(app: FastAPI) -> TestClient:
    """Return a browser without cookies; as a context manager it opens and closes the app."""
    return TestClient(app, raise_server_exceptions=True)


@pytest.fixture(scope="session")
def migrated_database(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One empty file with all tables; migrating takes a second, copying does not."""
    settings = make_settings(tmp_path_factory.mktemp("migrated"))
    migrate(settings)
    connection = SQLITE.connect(settings.database_path)
    connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    connection.close()
    return settings.database_path


@pytest.fixture
def settings(tmp_path: Path, migrated_database: Path) -> Settings:
    """Settings with a database of this test's own, migrated and empty."""
    made = make_settings(tmp_path)
    shutil.copy(migrated_database, made.database_path)
    return made


@pytest.fixture
def app(settings: Settings) -> FastAPI:
    """The app; `client` opens and closes it."""
    from app.main import create_app

    return create_app(settings)


@pytest.fixture
def client(app: FastAPI) -> Iterator[TestClient]:
    """A browser that comes for the first time."""
    with open_client(app) as opened:
        yield opened


@pytest.fixture
def other_client(client: TestClient, app: FastAPI) -> TestClient:
    """Another browser on the same server."""
    return open_client(app)
