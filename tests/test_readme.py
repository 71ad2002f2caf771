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
    assert len(lines) >= 6
    assert lines[0].startswith("1 ")
    assert any("MEIRL" in line for line in lines)


def test_every_file_it_links_to_is_there() -> None:
    links = [link.partition("#")[0] for link in re.findall(r"\]\(([^)]+)\)", TEXT) if "://" not in link]
    assert len(links) >= 10
    assert not [link for link in links if link and not (ROOT / link).exists()]


def test_every_learner_is_in_the_table() -> None:
    import irl_core

    assert not [name for name in irl_core.LEARNERS if f"(`{name}`)" not in TEXT]


@pytest.mark.parametrize("group", ["paper", "model", "birlfr", "model_free", "baseline"])
def test_the_tables_of_settings_have_the_defaults_of_the_code(group: str) -> None:
    """The paper's in the README, the others on their page: name and default stand in the same row."""
    import irl_core

    text = TEXT if group == "paper" else (ROOT / "docs" / "settings.md").read_text(encoding="utf-8")
    rows = [[cell.strip() for cell in line.split("|")] for line in text.splitlines() if line.startswith("|")]
    documented = {row[2]: row[3] for row in rows if len(row) > 3}
    for setting in irl_core.Settings.describe():
        if setting["group"] == group:
            name, default = f"`{setting['name']}`", setting["default"]
            assert documented[name] == (f"`{default}`" if isinstance(default, str) else f"{default:g}")


def test_every_setting_is_of_a_group_that_is_tested() -> None:
    import irl_core

    groups = {setting["group"] for setting in irl_core.Settings.describe()}
    assert groups == {"paper", "model", "birlfr", "model_free", "baseline"}
