"""The command line, in processes of its own where it matters and in this one where it does not."""

import json
import re
import socket
import threading

from typer.testing import CliRunner

from app.cli import _listen as listen
from app.cli import cli
from app.db import Database
from app.learning import worker
from irl_core import LEARNERS
from tests.app.test_learning import ask, played  # noqa: F401 - `played` is a fixture
from tests.live_server import free_port

runner = CliRunner()


def test_learn_gives_the_numbers_of_the_web_run(client, played, settings, tmp_path):  # noqa: F811
    run_id = ask(client, played, settings={"iterations": 40, "lambda_min": 4.0}).json()["id"]
    database = Database(settings)
    worker.learn_now(database, run_id)
    database.close()
    file = tmp_path / "run.jsonl"
    file.write_text(client.get(f"/api/v1/runs/{run_id}/demonstrations.jsonl").text)
    out = tmp_path / "out.json"
    done = runner.invoke(
        cli, ["learn", str(file), "--seed", "7", "--set", "iterations=40", "--set", "lambda_min=4.0", "--out", str(out)]
    )
    assert done.exit_code == 0, done.output
    assert "IRLFR" in done.output
    result = json.loads(out.read_text())
    run = client.get(f"/api/v1/runs/{run_id}").json()
    comparison = client.get(f"/api/v1/runs/{run_id}/comparison").json()
    assert result["learners"] == run["learners"]
    assert result["comparison"]["entries"] == comparison["entries"]
    assert result["rollouts"] == client.get(f"/api/v1/runs/{run_id}/rollouts").json()
    assert result["settings"] == run["settings"]


def test_learn_prints_every_learner_there_is(client, played, tmp_path):  # noqa: F811
    run_id = ask(client, played).json()["id"]
    file = tmp_path / "run.jsonl"
    file.write_text(client.get(f"/api/v1/runs/{run_id}/demonstrations.jsonl").text)
    done = runner.invoke(cli, ["learn", str(file), "--learners", "all", "--set", "iterations=5"])
    assert done.exit_code == 0, done.output
    printed = " ".join(re.sub(r"[^\w()+.-]+", " ", done.output).split())
    for learner in LEARNERS.values():
        assert learner.title.split()[0] in printed
    result = json.loads(file.with_suffix(".result.json").read_text())
    assert list(result["learners"]) == list(LEARNERS)


def test_learn_refuses_in_words(tmp_path):
    file = tmp_path / "broken.jsonl"
    file.write_text('{"kind": "world"')
    for arguments, word in [
        ([str(tmp_path / "missing.jsonl")], "No such file"),
        ([str(file)], "Line 1"),
        ([str(file), "--set", "iterations"], "lacks its value"),
        ([str(file), "--learners", "gail"], "no learner 'gail'"),
    ]:
        done = runner.invoke(cli, ["learn", *arguments])
        assert done.exit_code == 2
        assert word in done.output
        assert "Traceback" not in done.output


def test_doctor_finds_what_is_missing(settings, monkeypatch, tmp_path):
    monkeypatch.setenv("IRLFR_DATABASE_URL", settings.database_url)
    found = runner.invoke(cli, ["doctor"])
    assert found.exit_code == 1, "no worker runs"
    assert "irlfr worker" in found.output
    assert f"{settings.database_path}: ok" in found.output
    monkeypatch.setenv("IRLFR_DATABASE_URL", f"sqlite:///{tmp_path}/nothing/here.sqlite3")
    missing = runner.invoke(cli, ["doctor"])
    assert missing.exit_code == 1
    assert "there is no file" in missing.output


def test_settings_that_make_no_sense_are_refused_in_words(monkeypatch):
    monkeypatch.setenv("IRLFR_PORT", "99999")
    monkeypatch.setenv("IRLFR_SECRET_KEY", "short")
    done = runner.invoke(cli, ["doctor"])
    assert done.exit_code == 2
    assert "IRLFR_PORT" in done.output
    assert "32 characters" in done.output


def test_every_command_has_help():
    for command in ("serve", "worker", "learn", "doctor"):
        done = runner.invoke(cli, [command, "--help"])
        assert done.exit_code == 0
        assert len(done.output) > 100


def test_no_half_of_an_answer_waits_for_the_receipt_of_the_other(settings):
    """Nagle's algorithm is off on every connection; with it, answers on a kept connection took 40 ms more."""
    with (
        listen(settings.model_copy(update={"port": free_port()})) as listener,
        socket.create_connection(listener.getsockname()),
        listener.accept()[0] as connection,
    ):
        assert connection.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)


def test_doctor_asks_the_server(settings, monkeypatch):
    """A server that answers something else than ready, then none."""
    monkeypatch.setenv("IRLFR_DATABASE_URL", settings.database_url)
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
        monkeypatch.setenv("IRLFR_PORT", str(port))

        def answer() -> None:
            connection, _ = listener.accept()
            with connection:
                connection.recv(4096)
                connection.sendall(b"HTTP/1.1 503 Busy\r\nContent-Length: 0\r\nConnection: close\r\n\r\n")

        thread = threading.Thread(target=answer, daemon=True)
        thread.start()
        assert f"http://127.0.0.1:{port} answers 503" in runner.invoke(cli, ["doctor"]).output
        thread.join(5)
    found = runner.invoke(cli, ["doctor"])
    assert "does not answer" in found.output
    assert found.exit_code == 1
