"""The journey of tests/journey.py, against the server as people start it."""

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
