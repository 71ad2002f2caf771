"""What is locked, and what the wheel carries."""

import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

WITHOUT_THE_WEB = """
import sys
import irl_core
assert not {"app", "dbos", "fastapi", "pydantic", "sqlalchemy", "starlette", "uvicorn"} & set(sys.modules)
assert not {"gymnasium", "matplotlib", "numba", "scipy"} & set(sys.modules)
print(irl_core.__file__)
"""


def test_the_lock_files_agree() -> None:
    dev = versions("dev")
    for name in ("runtime", "build"):
        assert versions(name).items() <= dev.items(), f"requirements/{name}.txt and requirements/dev.txt differ"


def test_every_requirement_has_a_hash() -> None:
    for path in sorted((ROOT / "requirements").glob("*.txt")):
        for entry in re.split(r"\n(?=\S)", path.read_text(encoding="utf-8")):
            assert "==" not in entry or "--hash=sha256:" in entry, f"{path.name}: {entry.splitlines()[0]}"


def test_every_npm_package_has_a_hash_and_no_address() -> None:
    packages = json.loads((ROOT / "package-lock.json").read_text(encoding="utf-8"))["packages"]
    for name, package in packages.items():
        assert not name or package.get("integrity", "").startswith("sha512-"), name
        assert "resolved" not in package, name


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel, built from this folder."""
    folder = tmp_path_factory.mktemp("wheel")
    command = (sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation")
    done(*command, "-w", folder, ROOT)
    (built,) = folder.glob("irlfr-*.whl")
    return built


@pytest.mark.slow
def test_the_wheel_carries_pages_scripts_packages_and_migrations(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    manifest = json.loads((ROOT / "static" / "vendor" / "manifest.json").read_text(encoding="utf-8"))
    vendored = {f"app/static/vendor/{path}" for package in manifest["packages"].values() for path in package["files"]}
    wanted = {"app/main.py", "irl_core/planning.py", "app/templates/base.html", "app/migrations/env.py"} | vendored
    wanted |= {path.relative_to(ROOT).as_posix() for path in (ROOT / "irl_core").rglob("*.py")}
    wanted |= {"irl_core/py.typed"}
    assert wanted <= names, wanted - names
    assert not [name for name in names if "__pycache__" in name or name.startswith(("static/", "tests/"))]


@pytest.mark.slow
@pytest.mark.timeout(1200)  # a minute of processor time, which may be several minutes where others work, too
def test_the_tutorial_runs_where_nothing_but_the_wheel_and_its_locked_requirements_are_installed(
    wheel: Path, tmp_path: Path
) -> None:
    done(sys.executable, "-m", "venv", "--without-pip", tmp_path / "empty")
    python = tmp_path / "empty" / ("Scripts" if os.name == "nt" else "bin") / "python"
    pip: list[str | Path] = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check", "--python", python]
    install: list[str | Path] = [*pip, "install", "--no-compile", "--no-deps"]
    done(*install, "--require-hashes", "-r", ROOT / "requirements" / "runtime.txt")
    done(*install, wheel)
    done(*pip, "check")  # the lock leaves nothing out that the wheel asks for
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    for path in (ROOT / "tests" / "run_docs.py", ROOT / "docs" / "tutorial.md"):
        shutil.copy(path, elsewhere)
    told = done(python, "-c", WITHOUT_THE_WEB, cwd=elsewhere)
    assert Path(told.strip()).is_relative_to(tmp_path / "empty")
    assert "0 print something else" in done(python, "run_docs.py", "tutorial.md", cwd=elsewhere)


def done(*command: str | Path, cwd: Path = ROOT) -> str:
    """What a command prints; it sees no Python but its own, and must succeed."""
    environment = {name: value for name, value in os.environ.items() if name not in {"PYTHONPATH", "PYTHONHOME"}}
    parts = [str(part) for part in command]
    ran = subprocess.run(
        parts, cwd=cwd, env=environment, capture_output=True, encoding="utf-8", timeout=900, check=False
    )
    assert ran.returncode == 0, f"{' '.join(parts)}\n{ran.stdout}{ran.stderr}"
    return ran.stdout


def versions(name: str) -> dict[str, str]:
    text = (ROOT / "requirements" / f"{name}.txt").read_text(encoding="utf-8")
    return {line.split(" \\")[0]: "" for line in text.splitlines() if re.match(r"^[a-z0-9]\S*==", line)}
