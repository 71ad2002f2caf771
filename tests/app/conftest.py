"""Three successes in a world, and a sitting over them, for the tests of the log and of confirming."""

import pytest

from tests.factories import make_demonstration, make_world
from tests.sitting import Sitting


@pytest.fixture
def world(client):
    return make_world(client)


@pytest.fixture
def ids(client, world):
    """Three successes."""
    return [make_demonstration(client, world)["id"] for _ in range(3)]


@pytest.fixture
def sitting(client, world, ids):
    """A sitting that has begun over three successes and a failure; nothing of it is sent."""
    make_demonstration(client, world, failed=True)
    begun = Sitting(client, world)
    begun.begin()
    return begun
