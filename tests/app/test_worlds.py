"""Worlds through the API."""

import pytest

from tests.factories import PLAYABLE_SEED, make_world


def test_everything_is_optional(client):
    for response in (client.post("/api/v1/worlds", json={}), client.post("/api/v1/worlds")):
        assert response.status_code == 201
        world = response.json()
        assert (world["rows"], world["cols"], world["start"], world["goal"], world["horizon"]) == (7, 7, 0, 48, 98)
        assert world["success_possible"]


def test_a_world_has_the_fields_of_the_contract(client):
    world = make_world(client, rows=4, cols=6)
    assert [len(row) for row in world["rewards"]] == [6] * 4
    assert [len(row) for row in world["colours"]] == [6] * 4
    assert world["rewards"][3][5] == 10.0
    assert world["colours"][3][5] == "goal"
    assert world["seed"] == PLAYABLE_SEED
    assert client.get(f"/api/v1/worlds/{world['id']}").json() == world


def test_the_same_parameters_give_the_same_world(client, other_client):
    first = make_world(client, slip=0, walls=[9, 8])
    assert make_world(client, slip=0.0, walls=[8, 9, 8]) == first
    assert make_world(other_client, slip=0.0, walls=[8, 9]) == first
    assert make_world(client, slip=0.1, walls=[8, 9])["id"] != first["id"]


def test_a_drawn_world_can_be_made_again_from_its_seed(client):
    drawn = client.post("/api/v1/worlds", json={"rows": 5, "cols": 8}).json()
    assert make_world(client, rows=5, cols=8, seed=drawn["seed"]) == drawn


def test_the_world_of_the_factories_is_playable(client):
    assert make_world(client)["success_possible"]


def test_anyone_with_the_link_sees_a_world(client, other_client):
    world = make_world(client)
    assert other_client.get(f"/api/v1/worlds/{world['id']}").json() == world


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("rows", 1), ("rows", 101), ("rows", True), ("rows", 7.0), ("rows", "7"), ("rows", None), ("cols", 10**400),
        ("seed", -1), ("seed", 2**53), ("seed", 1.5), ("seed", "1"), ("red_probability", 1.1),
        ("red_probability", -0.1),
        ("red_probability", "0.3"), ("red_probability", 10**400), ("slip", 0.95), ("slip", True), ("walls", [0]),
        ("walls", [48]), ("walls", [49]), ("walls", [-1]), ("walls", ["1"]), ("walls", "12"), ("walls", {"1": 2}),
        ("walls", [1, 7]), ("goals", [3]), ("id", "x"),
    ],
)  # fmt: skip
def test_what_makes_no_world_is_refused_naming_the_field(client, field, value):
    response = client.post("/api/v1/worlds", json={field: value})
    assert response.status_code == 422, response.text
    assert any(name.split(".")[0] == field for name in response.json()["error"]["fields"]), response.text


def test_too_many_red_squares_are_refused_in_words(client):
    response = client.post("/api/v1/worlds", json={"red_probability": 1, "rows": 20, "cols": 20})
    assert response.status_code == 422
    assert "fewer red squares" in response.json()["error"]["message"]


def test_no_such_world(client):
    assert client.get("/api/v1/worlds/00000000-0000-0000-0000-000000000000").status_code == 404
    assert client.get("/api/v1/worlds/not-a-uuid").status_code == 422
