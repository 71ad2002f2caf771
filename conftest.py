"""Options of the whole test run, and its order."""

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--screenshots", action="store_true", help="write screenshots of every page to docs/screenshots")
    parser.addoption("--rank-orders", type=int, default=1, help="how many random orders each way to rank is given")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Browser walks go last: playwright leaves an event loop running in the main thread, which others do not expect."""
    items.sort(key=lambda item: "browser" in item.path.parts)
