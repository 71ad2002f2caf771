"""`irlfr experiment`: what it writes, that processes change nothing, and how it refuses and stops."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable

import pytest
from typer.testing import CliRunner

from app import experiment_command
from app.cli import cli
from irl_core.experiment import WorldOutcome, markdown, summarise

runner = CliRunner()
SMALL = ["experiment", "--worlds", "2", "--rows", "4", "--cols", "4", "--learners", "meirl,irlr", "--seed", "3"]
QUICK = [*SMALL, "--demonstrators", "wanderer,shortest_path", "--set", "iterations=10", "--episodes", "5"]
FILES = ("results.json", "outcomes.jsonl", "table.md", "figure.svg")


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    folder = tmp_path_factory.mktemp("one") / "new" / "folder"
    done = runner.invoke(cli, [*QUICK, "--processes", "1", "--out", str(folder)])
    assert done.exit_code == 0, done.output
    assert "Share of the optimum" in done.output
    assert str(folder) in done.output.replace("\n", "")
    return folder


def test_it_writes_tables_a_figure_and_every_outcome(written):
    results = json.loads((written / "results.json").read_text())
    outcomes = [
        WorldOutcome.from_json(json.loads(line)) for line in (written / "outcomes.jsonl").read_text().splitlines()
    ]
    assert [(one.demonstrator, one.index) for one in outcomes] == [
        ("wanderer", 0),
        ("wanderer", 1),
        ("shortest_path", 0),
        ("shortest_path", 1),
    ]
    assert results["spec"]["settings"]["iterations"] == 10
    assert results["spec"]["n_episodes"] == 5
    assert results["n_worlds"] == 2
    assert set(results["versions"]) == {"python", "irlfr", "numpy", "scipy", "numba"}
    summaries = summarise(outcomes, seed=3)
    assert [one.to_json() for one in summaries] == results["summaries"]
    assert (written / "table.md").read_text() == markdown(summaries)
    assert (written / "figure.svg").read_text().startswith("<?xml")


def test_processes_change_nothing(written, tmp_path):
    """In a process of its own: what the command does to the environment stays there."""
    done = subprocess.run(
        [sys.executable, "-m", "app.cli", *QUICK, "--processes", "2", "--out", str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    for name in FILES:
        assert (tmp_path / name).read_bytes() == (written / name).read_bytes(), name


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--learners", "gail"], "no learner 'gail'; there are meirl"),
        (["--demonstrators", "genius"], "no demonstrator 'genius'; there are mixture"),
        (["--set", "learning_rate=-1"], "learning_rate must be a finite number"),
        (["--set", "haste=1"], "no setting 'haste'"),
        (["--seed", "-4"], "seed must be a whole number"),
        (["--slip", "2"], "slip must be a finite number"),
        (["--failures", "0", "--learners", "irlf"], "n_failures must be at least 1"),
    ],
)
def test_bad_input_is_a_sentence(arguments, words, tmp_path):
    done = runner.invoke(cli, ["experiment", "--worlds", "1", "--out", str(tmp_path / "out"), *arguments])
    assert done.exit_code == 2
    assert words in done.output
    assert "Traceback" not in done.output
    assert not (tmp_path / "out").exists()


def test_a_folder_that_cannot_be_written_is_said_before_the_work(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setattr(experiment_command, "run_chunk", lambda *_: pytest.fail("It ran."))
    done = runner.invoke(cli, [*QUICK, "--processes", "1", "--out", str(tmp_path / "file" / "below")])
    assert done.exit_code == 2
    assert "file" in done.output


@pytest.mark.skipif(os.name == "nt", reason="Windows has no group of processes to send Ctrl-C to")
def test_ctrl_c_ends_in_a_sentence_and_leaves_no_process(tmp_path):
    """As a terminal does it: the signal goes to every process of the group.

    What runs in the background of a shell ignores Ctrl-C and hands that down; a handler of ours is not handed down.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        _interrupt_an_experiment(tmp_path)
    finally:
        signal.signal(signal.SIGINT, before)


def _interrupt_an_experiment(tmp_path):
    out = tmp_path / "out"
    command = [sys.executable, "-m", "app.cli", "experiment", "--worlds", "2000", "--processes", "2"]
    with subprocess.Popen(
        [*command, "--learners", "meirl", "--out", str(out)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as running:
        wait_until(out.exists)
        time.sleep(1.0)
        os.killpg(running.pid, signal.SIGINT)
        _, errors = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "Stopped before the end; nothing was written." in errors
    assert "Traceback" not in errors
    assert not list(out.iterdir())
    wait_until(lambda: not group_lives(running.pid))


def group_lives(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def wait_until(is_so: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 30.0
    while not is_so():
        assert time.monotonic() < deadline
        time.sleep(0.05)
