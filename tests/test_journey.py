"""The journey of tests/journey.py, against the server as people start it."""

import http.client
from collections.abc import Iterator

import pytest

from tests import journey
from tests.live_server import LiveServer


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveServer]:
    live = LiveServer(tmp_path_factory.mktemp("journey"))
    live.start()
    yield live
    live.stop()


def test_a_stranger_recomputes_every_figure_of_the_api(server: LiveServer) -> None:
    rows = journey.journey(server.address, seed=5)
    assert len(rows) > 30
    assert journey.worst(rows) <= journey.TOLERANCE, rows


def test_also_in_a_world_with_a_start_goals_paint_and_limits_of_its_own(server: LiveServer) -> None:
    painted = [[5, 20.0], [15, -3.0], [16, -3.0], [24, 4.0]]
    more = {"cols": 6, "start": 14, "goals": [5, 24], "walls": [8, 21], "painted": painted}
    rows = journey.journey(server.address, seed=5, size=5, step_limit=40, time_limit_s=60, **more)
    assert len(rows) > 30
    assert journey.worst(rows) <= journey.TOLERANCE, rows


def test_an_address_longer_than_servers_read_is_answered_in_a_sentence(server: LiveServer) -> None:
    connection = http.client.HTTPConnection("127.0.0.1", server.port)
    connection.request("GET", "/?walls=" + "1," * 100_000)
    answer = connection.getresponse()
    assert answer.status == 422
    assert "This address is too long: 200,006 characters, where 60,000 can be read." in answer.read().decode()
    connection.close()
