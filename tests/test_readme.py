"""What the README shows works as shown."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_example_of_the_library_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (code,) = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
    exec(compile(code, "README.md", "exec"), {})  # our own
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 6
    assert lines[0].startswith("1 ")


def test_every_file_it_links_to_is_there() -> None:
    links = [link for link in re.findall(r"\]\(([^)]+)\)", TEXT) if "://" not in link]
    assert len(links) >= 10
    assert not [link for link in links if not (ROOT / link).exists()]


def test_the_table_of_settings_has_the_defaults_of_the_code() -> None:
    import irl_core

    for setting in irl_core.Settings.describe():
        row = next(line for line in TEXT.splitlines() if f"`{setting['name']}`" in line)
        assert (
            f"{setting['default']:g}" in row
            if isinstance(setting["default"], float)
            else str(setting["default"]) in row
        )
