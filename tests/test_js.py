"""The tests of the JavaScript modules, which run in Node without a browser."""

import os
import subprocess
from pathlib import Path

import pytest

from hatch_build import node_command

ROOT = Path(__file__).resolve().parents[1]
FILES = sorted((ROOT / "tests" / "js").glob("**/*.test.js"))


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.name))
def test_javascript(file: Path) -> None:
    environment = os.environ | {"NODE_OPTIONS": "", "NO_COLOR": "1"}
    command = [*node_command(), "--test", "--test-reporter=spec", str(file)]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_there_are_javascript_tests() -> None:
    assert FILES
