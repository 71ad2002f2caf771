"""Rankings through the API: exactly what is kept, every version kept."""

import uuid

import pytest
from sqlalchemy import text

from tests.factories import make_demonstration, make_ranking, make_world


@pytest.fixture
def world(client):
    return make_world(client)


def put(client, world, order, *, outcome="success", confirmed=True):
    body = {"order": order, "confirmed": confirmed}
    return client.put(f"/api/v1/worlds/{world['id']}/rankings/{outcome}", json=body)


def test_weights_rise_with_the_place_and_ties_share(client, world):
    a, b, c = (make_demonstration(client, world)["id"] for _ in range(3))
    assert put(client, world, [[b], [a], [c]]).json()["weights"] == {b: 3 / 6, a: 2 / 6, c: 1 / 6}
    ranking = put(client, world, [[b], [a, c]]).json()
    assert ranking["weights"] == {b: 3 / 6, a: 1.5 / 6, c: 1.5 / 6}
    assert ranking["version"] == 2
    assert ranking["order"] == [[b], [a, c]]
    assert sorted(ranking["start_order"]) == sorted([a, b, c])


def test_failures_are_ranked_on_their_own(client, world):
    success, failure = make_demonstration(client, world), make_demonstration(client, world, failed=True)
    ranking = make_ranking(client, world, "failure", [failure["id"]])
    shown = client.get(f"/api/v1/worlds/{world['id']}/rankings").json()
    assert shown == {"success": None, "failure": ranking}
    response = put(client, world, [[success["id"], failure["id"]]])
    assert response.status_code == 422
    assert "other outcome" in response.json()["error"]["message"]


def test_every_version_is_kept(client, world):
    a, b = (make_demonstration(client, world)["id"] for _ in range(2))
    orders = [[a, b], [b, a], [b, a]]
    assert [make_ranking(client, world, "success", order)["version"] for order in orders] == [1, 2, 3]
    with client.app.state.database.read() as session:
        assert session.scalar(text("SELECT count(*) FROM ranking")) == 3


def test_the_start_order_stays_and_a_new_attempt_disturbs_no_other(client, world):
    ids = [make_demonstration(client, world)["id"] for _ in range(6)]
    before = make_ranking(client, world, "success", ids)["start_order"]
    new = make_demonstration(client, world)["id"]
    after = make_ranking(client, world, "success", [*ids, new])["start_order"]
    assert [one for one in after if one != new] == before


def test_an_order_of_something_else_is_refused_with_every_reason(client, other_client, world):
    a, b, gone = (make_demonstration(client, world)["id"] for _ in range(3))
    foreign = make_demonstration(other_client, world)["id"]
    client.put(f"/api/v1/demonstrations/{gone}/discard")
    wrong = {
        "missing": [[a]],
        "twice": [[a], [b], [a]],
        "discarded": [[a], [b], [gone]],
        "not yours": [[a], [b], [foreign]],
        "or of another world": [[a], [b], [str(uuid.uuid4())]],
    }
    for word, order in wrong.items():
        response = put(client, world, order)
        assert response.status_code == 422, order
        assert word in response.json()["error"]["message"]
        assert "order" in response.json()["error"]["fields"]
    assert client.get(f"/api/v1/worlds/{world['id']}/rankings").json()["success"] is None


@pytest.mark.parametrize("order", [[], [[]], [["x"]], ["x"], [None], "x", {}, [[1]], [[True]], [[["x"]]], None])
def test_what_is_no_order_is_refused(client, world, order):
    make_demonstration(client, world)
    assert put(client, world, order).status_code == 422


@pytest.mark.parametrize("confirmed", [False, None, 1, "true", []])
def test_an_untouched_list_is_not_an_answer(client, world, confirmed):
    played = make_demonstration(client, world)["id"]
    response = put(client, world, [[played]], confirmed=confirmed)
    assert response.status_code == 422
    assert "confirmed" in response.json()["error"]["fields"]


def test_nothing_to_order_is_said_in_words(client, other_client, world):
    for one in (client, other_client):
        response = put(one, world, [])
        assert response.status_code == 422
        assert "nothing to order" in response.json()["error"]["message"]


def test_more_than_forty_can_be_ranked(client, world):
    ids = [make_demonstration(client, world)["id"] for _ in range(45)]
    assert sum(make_ranking(client, world, "success", ids)["weights"].values()) == pytest.approx(1)


def test_there_are_two_outcomes(client, world):
    assert put(client, world, [], outcome="draw").status_code == 422
