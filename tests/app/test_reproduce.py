"""The command and the file that the Compare page gives compute the same figures again, on any machine."""

import json
import shlex
import subprocess

from typer.testing import CliRunner

from app.cli import cli
from app.db import Database
from app.learning import worker
from hatch_build import node_command
from tests.app.test_learning import ask, played  # noqa: F401 - a fixture
from tests.live_server import ROOT

PRINT_COMMAND = """
import { fileName, reproduceCommand } from "#js/comparisons/reproduce.js";
const run = JSON.parse(process.argv.at(-1));
console.log(JSON.stringify([fileName(run), reproduceCommand(run)]));
"""


def test_the_page_s_command_and_file_give_the_same_figures(client, played, settings, tmp_path, monkeypatch):  # noqa: F811
    chosen = {"iterations": 40, "lambda_min": 4.0, "tolerance": 1e-7, "initial_weights": "uniform", "episodes": 60}
    asked = ask(client, played, learners=["irlfr", "birlfr", "model_free"], settings=chosen, seed=12345)
    run_id = asked.json()["id"]
    database = Database(settings)
    worker.learn_now(database, run_id)
    database.close()
    run = client.get(f"/api/v1/runs/{run_id}").json()

    name, command = of_the_page(run)
    (tmp_path / name).write_text(client.get(f"/api/v1/runs/{run_id}/demonstrations.jsonl").text)
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(cli, shlex.split(command)[1:])
    assert done.exit_code == 0, done.output
    result = json.loads((tmp_path / name).with_suffix(".result.json").read_text())

    assert timeless(result["comparison"]["entries"]) == timeless(
        client.get(f"/api/v1/runs/{run_id}/comparison").json()["entries"]
    )
    assert timeless(list(result["learners"].values())) == timeless(list(run["learners"].values()))
    assert result["rollouts"] == client.get(f"/api/v1/runs/{run_id}/rollouts").json()
    assert (result["settings"], list(result["learners"])) == (run["settings"], list(run["learners"]))


def of_the_page(run):
    """The file's name and the command, as the page's own script writes them."""
    known = {name: run[name] for name in ("id", "seed", "settings")} | {"learners": dict.fromkeys(run["learners"])}
    call = [*node_command(), "--input-type=module", "--eval", PRINT_COMMAND, "--", json.dumps(known)]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, timeout=60, check=True)
    return json.loads(done.stdout)


def timeless(parts):
    """Everything but how long it took, which no machine repeats."""
    return [{name: value for name, value in part.items() if name != "compute_ms"} for part in parts]
