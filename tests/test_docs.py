"""Words are tested too: what can be set, called and typed is in the docs, and no file leaks where it was made."""

import re
import subprocess
from pathlib import Path

import pytest
import typer.main

from app.cli import cli
from app.config import Settings
from app.main import create_app

ROOT = Path(__file__).resolve().parents[1]
README = ROOT / "README.md"

LEAKS = re.compile(
    r"/(?:home|Users|root|opt)/[a-z]"  # where a developer's machine keeps things
    r"|registry\.(?:npmjs|yarnpkg)\."
    r"|(?:files\.pythonhosted|pypi)\.org"
    r"|^\s*\"resolved\":"
    r"|^--(?:extra-)?index-url",
    re.MULTILINE,
)
MAY_NAME_THEM = {"tests/test_docs.py"}  # this file, which lists them


@pytest.mark.parametrize("name", sorted(Settings.model_fields))
def test_every_setting_is_in_the_readme(name: str) -> None:
    assert f"IRLFR_{name.upper()}" in README.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", sorted(typer.main.get_group(cli).commands))
def test_every_command_is_in_the_readme(name: str) -> None:
    assert f"irlfr {name}" in README.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["run", "test", "check", "bench"])
def test_every_command_of_dev_is_in_the_readme(name: str) -> None:
    assert f"python3 dev.py {name}" in README.read_text(encoding="utf-8")


def test_every_call_of_the_api_has_words() -> None:
    """/docs is made from these; tests/app looks at the page."""
    schema = create_app(Settings(allow_missing_assets=True)).openapi()
    calls = {f"{method} {path}": call for path, calls in schema["paths"].items() for method, call in calls.items()}
    assert len(calls) >= 15
    assert not [name for name, call in calls.items() if not call.get("summary") or not call.get("description")]


def test_no_tracked_file_names_a_machine_or_a_registry() -> None:
    leaks = [
        f"{name}: {found.group(0)!r}"
        for name in tracked_files()
        if name not in MAY_NAME_THEM and (found := LEAKS.search(text_of(ROOT / name)))
    ]
    assert not leaks


def tracked_files() -> list[str]:
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=False).stdout
    if not listed:
        pytest.skip("not a git checkout")
    return [name for name in listed.split("\0") if name and (ROOT / name).is_file()]


def text_of(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return ""  # a picture
