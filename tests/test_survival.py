"""What was asked for is done, whoever is killed in the middle: the worker, or the web process with its worker."""

import itertools
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from tests import journey
from tests.live_server import LiveServer

# Long enough to be killed in the middle, on a fast machine too; no learner may stop before.
SETTINGS = {"iterations": 700, "tolerance": 1e-12}
LEARNERS = ["meirl", "irlfr"]


@pytest.fixture
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveServer]:
    live = LiveServer(tmp_path_factory.mktemp("survival"))
    live.start()
    yield live
    live.stop()


def test_a_run_whose_worker_is_killed_ends_once_with_the_same_result(server: LiveServer) -> None:
    check_survival(server, server.kill_worker)


def test_a_run_whose_web_process_is_killed_ends_once_with_the_same_result(server: LiveServer) -> None:
    def kill_and_start_again() -> None:
        server.kill()
        server.start()

    check_survival(server, kill_and_start_again)


def check_survival(server: LiveServer, strike: Callable[[], object]) -> None:
    client = journey.Client(server.address)
    world_id = played_and_ranked(client)
    undisturbed = finished(client, ask(client, world_id))
    struck = ask(client, world_id)
    n_frames = frames_seen(client, struck, at_least=3)
    assert client.get(f"/runs/{struck}")["status"] == "running", "the run ended before it could be struck"
    strike()
    survived = finished(client, struck)
    assert survived["learners"] == undisturbed["learners"]
    check_stored_once(server, struck, n_frames)
    assert not server.lost_files()


def played_and_ranked(client: journey.Client) -> str:
    world = client.post("/worlds", {"seed": 5})
    successes, failures = journey.play(client, journey.Grid(world), world["id"])
    journey.rank(client, world["id"], successes, failures)
    world_id: str = world["id"]
    return world_id


def ask(client: journey.Client, world_id: str) -> str:
    asked = {"learners": LEARNERS, "settings": SETTINGS, "seed": 7}
    run_id: str = client.post(f"/worlds/{world_id}/runs", asked)["id"]
    return run_id


def frames_seen(client: journey.Client, run_id: str, *, at_least: int) -> int:
    """Follow the run until it has shown some frames."""
    frames = (name for _, name, _ in client.events(f"/runs/{run_id}/events") if name == "frame")
    return len(list(itertools.islice(frames, at_least)))


def finished(client: journey.Client, run_id: str) -> dict[str, Any]:
    """Follow the stream to its end, then look at the run."""
    *_, last = client.events(f"/runs/{run_id}/events")
    assert last[1] == "done", last
    run: dict[str, Any] = client.get(f"/runs/{run_id}")
    assert run["status"] == "done"
    assert {name: result["iterations"] for name, result in run["learners"].items()} == dict.fromkeys(LEARNERS, 700)
    return run


def check_stored_once(server: LiveServer, run_id: str, n_frames: int) -> None:
    results = server.ask_database("SELECT learner FROM run_result WHERE run_id = ?", run_id)
    assert sorted(name for (name,) in results) == sorted(LEARNERS)
    events = server.ask_database("SELECT number, kind FROM run_event WHERE run_id = ? ORDER BY number", run_id)
    kinds = [kind for _, kind in events]
    assert [number for number, _ in events] == list(range(1, len(events) + 1))
    assert kinds.count("learner") == len(LEARNERS)
    assert kinds.count("done") == 1
    assert kinds[-1] == "done"
    assert kinds.count("frame") > n_frames
    assert server.ask_database("SELECT count(*) FROM run_checkpoint WHERE run_id = ?", run_id) == [(0,)]
