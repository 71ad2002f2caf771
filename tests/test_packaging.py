"""What is locked, and what the wheel carries."""

import json
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


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


@pytest.mark.slow
def test_the_wheel_carries_pages_scripts_packages_and_migrations(tmp_path: Path) -> None:
    command = [
        sys.executable,
        "-m",
        "pip",
        "wheel",
        "--quiet",
        "--no-deps",
        "--no-build-isolation",
        "-w",
        str(tmp_path),
    ]
    done = subprocess.run([*command, str(ROOT)], capture_output=True, text=True, timeout=200, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (wheel,) = tmp_path.glob("irlfr-*.whl")
    names = set(zipfile.ZipFile(wheel).namelist())
    manifest = json.loads((ROOT / "static" / "vendor" / "manifest.json").read_text(encoding="utf-8"))
    vendored = {f"app/static/vendor/{path}" for package in manifest["packages"].values() for path in package["files"]}
    wanted = {"app/main.py", "irl_core/planning.py", "app/templates/base.html", "app/migrations/env.py"} | vendored
    assert wanted <= names, wanted - names
    assert not [name for name in names if "__pycache__" in name or name.startswith(("static/", "tests/"))]


def versions(name: str) -> dict[str, str]:
    text = (ROOT / "requirements" / f"{name}.txt").read_text(encoding="utf-8")
    return {line.split(" \\")[0]: "" for line in text.splitlines() if re.match(r"^[a-z0-9]\S*==", line)}
