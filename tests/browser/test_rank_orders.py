"""Any order, ties included, can be given by mouse, by finger and by keyboard: seen, kept and meant are the same."""

import random
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from tests.browser import ranking, walk, ways

#: So many orders are given on one page, lest a test take longer than a test may.
A_BATCH = 10
DEVICES: dict[str, dict[str, Any]] = {
    "mouse": {"viewport": {"width": 1280, "height": 800}},
    "touch": {"viewport": {"width": 360, "height": 740}, "has_touch": True, "is_mobile": True},
    "key": {"viewport": {"width": 1280, "height": 800}},
}


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    if "seeds" in metafunc.fixturenames:
        n = metafunc.config.getoption("--rank-orders")
        batches = [range(first, min(n, first + A_BATCH)) for first in range(0, n, A_BATCH)]
        metafunc.parametrize("seeds", batches, ids=lambda seeds: f"{seeds[0]}-{seeds[-1]}")


@pytest.mark.parametrize("size", [3, 6, 20, 40])
@pytest.mark.parametrize("means", DEVICES)
def test_any_order_can_be_given(browser: Browser, base_url: str, means: str, size: int, seeds: range) -> None:
    with ways.visit(browser, base_url, reduced_motion="reduce", **DEVICES[means]) as page:
        world_id = ranking.played_before(page, base_url, successes=size, seed=6)
        ranking.open_lists(page, world_id, n_cards=size)
        for seed in seeds:
            order = ranking.order_shown(page, "success")
            target = other_order(order, random.Random(f"{means} {size} {seed}"))
            rank(page, means, order, target)
            assert ranking.order_shown(page, "success") == target
            walk.confirm_order(page)
            kept = walk.ContextClient(page, base_url).get(f"/worlds/{world_id}/rankings")["success"]["order"]
            assert kept == target


def other_order(order: ranking.Order, rng: random.Random) -> ranking.Order:
    """Any but the one there is, which could not be confirmed anew."""
    ids = sorted(id_ for group in order for id_ in group)
    return next(target for target in iter(lambda: ranking.any_order(ids, rng), None) if target != order)


def rank(page: Page, means: str, order: ranking.Order, target: ranking.Order) -> None:
    if means == "key":
        ranking.rank_by_keys(page, order, target)
    else:
        ranking.rank_by_hand(ranking.Mouse(page) if means == "mouse" else ranking.Finger(page), order, target)
