"""How well a confirmed order agrees with the true totals, through the API."""

from itertools import combinations

import pytest

from app.main import create_app
from tests.conftest import make_settings, open_client
from tests.factories import attempt, best_path, make_demonstration, make_ranking, make_world, post_demonstration


@pytest.fixture
def world(client):
    return make_world(client)


def play(client, world, actions, ending):
    body = attempt(world, actions=actions, step_ms=[100.0] * len(actions), ending=ending)
    response = post_demonstration(client, world, body)
    assert response.status_code == 201, response.text
    return response.json()


def play_better_and_worse(client, world, n):
    """Successes from the best to the worst: each bumps into the edge above the start once more than the last."""
    played = [play(client, world, [0] * bumps + best_path(world), "goal") for bumps in range(n)]
    totals = [one["total"] for one in played]
    assert totals == sorted(set(totals), reverse=True)
    assert {one["outcome"] for one in played} == {"success"}
    return played


def agreement(client, world, outcome="success"):
    return client.get(f"/api/v1/worlds/{world['id']}/rankings/{outcome}/agreement")


def test_by_hand_one_pair_of_three_is_swapped(client, world):
    best, middle, worst = (one["id"] for one in play_better_and_worse(client, world, 3))
    make_ranking(client, world, "success", [best, worst, middle])
    told = agreement(client, world).json()
    assert told == {
        "version": 1, "tau_b": pytest.approx(1 / 3), "n_pairs": 3, "n_agreeing": 2, "n_swapped": 1, "n_tied": 0,
        "swapped": [[worst, middle]],
    }  # fmt: skip


def test_of_failures_the_worst_belongs_on_top(client, world):
    steps = [play(client, world, [0] * n, "gave_up") for n in range(1, 4)]
    worst_first = [one["id"] for one in sorted(steps, key=lambda one: one["total"])]
    make_ranking(client, world, "failure", worst_first)
    assert agreement(client, world, "failure").json()["tau_b"] == 1.0
    make_ranking(client, world, "failure", worst_first[::-1])
    told = agreement(client, world, "failure").json()
    assert (told["tau_b"], told["version"], told["n_swapped"]) == (-1.0, 2, 3)
    assert told["swapped"][0] == [worst_first[-1], worst_first[0]]


def test_it_is_of_the_newest_version_whatever_was_discarded_since(client, world):
    played = play_better_and_worse(client, world, 3)
    ids = [one["id"] for one in played]
    make_ranking(client, world, "success", ids)
    make_ranking(client, world, "success", ids[::-1])
    client.put(f"/api/v1/demonstrations/{ids[0]}/discard")
    told = agreement(client, world).json()
    assert (told["version"], told["tau_b"], told["n_pairs"]) == (2, -1.0, 3)


def test_swapped_pairs_come_with_the_largest_difference_first(client, world):
    totals = {one["id"]: one["total"] for one in play_better_and_worse(client, world, 4)}
    best, second, third, worst = totals
    make_ranking(client, world, "success", [third, best, worst, second])
    differences = [totals[below] - totals[above] for above, below in agreement(client, world).json()["swapped"]]
    assert differences == sorted(differences, reverse=True)
    order = [third, best, worst, second]
    assert len(differences) == sum(totals[above] < totals[below] for above, below in combinations(order, 2))


def test_where_all_is_tied_there_is_no_coefficient(client, world):
    ids = [one["id"] for one in play_better_and_worse(client, world, 2)]
    url = f"/api/v1/worlds/{world['id']}/rankings/success"
    assert client.put(url, json={"order": [ids], "confirmed": True}).status_code == 200
    told = agreement(client, world).json()
    assert (told["tau_b"], told["n_pairs"], told["n_tied"], told["swapped"]) == (None, 1, 1, [])


def test_without_a_confirmed_order_there_is_nothing_to_compare(client, other_client, world):
    played = make_demonstration(client, world)
    make_demonstration(other_client, world)
    assert agreement(client, world).status_code == 404
    make_ranking(client, world, "success", [played["id"]])
    assert agreement(client, world).status_code == 200
    for answer in (agreement(other_client, world), agreement(open_client(client.app), world)):
        assert answer.status_code == 404
        assert "not confirmed an order of your successes" in answer.json()["error"]["message"]
    assert agreement(client, world, "failure").status_code == 404
    assert agreement(client, world, "draw").status_code == 422


def test_a_study_can_keep_it_back(settings):
    told = make_settings(settings.data_dir, show_agreement=False)
    with open_client(create_app(told)) as client:
        world = make_world(client)
        assert agreement(client, world).status_code == 403
        make_ranking(client, world, "success", [make_demonstration(client, world)["id"]])
        answer = agreement(client, world)
        assert (answer.status_code, answer.json()["error"]["code"]) == (403, "not_shown")
