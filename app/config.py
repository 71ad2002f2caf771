"""The settings: one frozen value, and the only reader of the environment."""

import contextlib
import os
import secrets
import tempfile
from functools import cached_property
from pathlib import Path
from typing import Annotated, Literal, TypeAlias, get_args

from pydantic import Field, SecretStr, field_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

DEFAULT_DATABASE_URL = "sqlite:///data/irlfr.sqlite3"

Way: TypeAlias = Literal["lists", "pairwise", "magnitude", "segments"]
WAYS: tuple[Way, ...] = get_args(Way)
"""How a person can say what their order is."""


class Settings(BaseSettings):
    """Everything that can be set from outside, as `IRLFR_…` variables or in a `.env` file."""

    model_config = SettingsConfigDict(env_prefix="IRLFR_", env_file=".env", extra="ignore", frozen=True)

    database_url: str = Field(default=DEFAULT_DATABASE_URL, description="Where the data live: an SQLite URL.")
    host: str = Field(default="127.0.0.1", description="The address the web server listens on.")
    port: Annotated[int, Field(ge=1, le=65535)] = Field(default=8000, description="The port the web server listens on.")
    secret_key: SecretStr | None = Field(
        default=None,
        description="Signs the visitors' cookies, at least 32 characters. Made and kept beside the database if unset.",
    )
    https: bool = Field(default=False, description="Served over https: cookies are Secure and HSTS is sent.")
    workers: Annotated[int, Field(ge=0, le=64)] = Field(
        default=1, description="How many learning workers `irlfr serve` starts; 0 leaves them to `irlfr worker`."
    )
    max_body_bytes: Annotated[int, Field(ge=1024)] = Field(
        default=2_000_000,
        description="The largest request body accepted, in bytes; the longest attempt takes 1.1 million.",
    )
    write_queue_length: Annotated[int, Field(ge=1)] = Field(
        default=1000, description="How many writes may wait for the disk before the server answers 503."
    )
    show_totals: bool = Field(
        default=True, description="Participants see the running total and what each attempt came to."
    )
    hold_to_move: bool = Field(
        default=False, description="A key that is held goes on moving; otherwise each press is one step."
    )
    show_agreement: bool = Field(
        default=True, description="Participants see, once they have confirmed an order, how it agrees with the totals."
    )
    show_policy: bool = Field(
        default=True, description="Participants see, while they order, what would be learned from the order so far."
    )
    rank_by: Annotated[tuple[Way, ...], NoDecode] = Field(
        default=WAYS,
        description="How attempts may be put in order, `pairwise` or `lists,pairwise`; the first is shown first.",
    )
    allow_missing_assets: bool = Field(
        default=False, description="Start without the browser's third-party packages (for tests of the API)."
    )

    @field_validator("database_url")
    @classmethod
    def _is_sqlite_file(cls, url: str) -> str:
        if not url.startswith("sqlite:///") or url == "sqlite:///:memory:" or len(url) == len("sqlite:///"):
            message = "must be an SQLite file: sqlite:///relative/path or sqlite:////absolute/path"
            raise ValueError(message)
        return url

    @field_validator("rank_by", mode="before")
    @classmethod
    def _split(cls, told: object) -> object:
        return [one.strip() for one in told.split(",")] if isinstance(told, str) else told

    @field_validator("rank_by")
    @classmethod
    def _names_each_once(cls, ways: tuple[Way, ...]) -> tuple[Way, ...]:
        if not ways or len(set(ways)) < len(ways):
            message = f"must name at least one of {', '.join(WAYS)}, and each at most once"
            raise ValueError(message)
        return ways

    @field_validator("secret_key")
    @classmethod
    def _is_long_enough(cls, key: SecretStr | None) -> SecretStr | None:
        if key is not None and len(key.get_secret_value()) < 32:
            message = "must have at least 32 characters; make one with: openssl rand -hex 32"
            raise ValueError(message)
        return key

    @property
    def database_path(self) -> Path:
        """The SQLite file."""
        return Path(self.database_url.removeprefix("sqlite:///"))

    @property
    def data_dir(self) -> Path:
        """The folder of the database; locks and the secret key live beside it."""
        return self.database_path.parent

    @cached_property
    def signing_key(self) -> str:
        """The secret key, made and kept in `secret_key` beside the database at first use."""
        if self.secret_key is not None:
            return self.secret_key.get_secret_value()
        path = self.data_dir / "secret_key"
        if not path.exists():
            _make_key_file(path)
        return path.read_text(encoding="ascii")


def _make_key_file(path: Path) -> None:
    """Write a fresh key that only this user can read; of two processes that try at once, the first wins."""
    path.parent.mkdir(parents=True, exist_ok=True)
    descriptor, draft = tempfile.mkstemp(dir=path.parent)  # mkstemp makes it readable by its owner alone
    with os.fdopen(descriptor, "w", encoding="ascii") as file:
        file.write(secrets.token_hex())
    with contextlib.suppress(FileExistsError):
        os.link(draft, path)  # unlike a rename, this never replaces a key that is already in use
    Path(draft).unlink()
