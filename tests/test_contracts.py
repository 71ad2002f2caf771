"""The import contracts of pyproject.toml hold, and each one fails when it is broken."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

VIOLATIONS = {
    "irl_core needs no web app": ("irl_core/weights.py", "import pydantic"),
    "irl_core leans one way": ("irl_core/mdp/grid.py", "import irl_core.inference"),
    "app leans one way": ("app/worlds/queries.py", "import app.rankings.service"),
    "A room leans one way": ("app/worlds/schemas.py", "import app.worlds.service"),
    "What crosses the wire and what is asked never computes": ("app/rankings/schemas.py", "import irl_core"),
    "The kit knows no domain word": ("app/kit/clock.py", "import irl_core"),
}


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """A copy of the Python code, to plant violations in."""
    for name in ("app", "irl_core"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    return tmp_path


def test_the_contracts_hold(copy: Path) -> None:
    done = lint_imports(copy)
    assert done.returncode == 0, done.stdout


def test_every_contract_is_broken_by_its_violation(copy: Path) -> None:
    for file, line in VIOLATIONS.values():
        path = copy / file
        path.write_text(f"{path.read_text(encoding='utf-8')}\n{line}\n", encoding="utf-8")
    done = lint_imports(copy)
    assert done.returncode == 1, done.stdout + done.stderr
    assert {name for name in VIOLATIONS if f"{name} BROKEN" in done.stdout} == set(VIOLATIONS), done.stdout


def test_a_new_module_of_app_needs_its_place(copy: Path) -> None:
    (copy / "app" / "newcomer.py").write_text('"""A module without a place."""\n', encoding="utf-8")
    done = lint_imports(copy)
    assert done.returncode == 1
    assert "newcomer" in done.stdout


def lint_imports(folder: Path) -> subprocess.CompletedProcess[str]:
    command = [str(Path(sys.executable).parent / "lint-imports"), "--no-cache"]
    environment = os.environ | {"PYTHONPATH": str(folder), "COLUMNS": "200"}
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120, check=False
    )
