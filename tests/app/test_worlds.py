"""Worlds through the API."""

import pytest

from app.worlds import schemas
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
        ("walls", [1, 7]), ("id", "x"), ("start", -1), ("start", 49), ("start", 48), ("start", 1.0), ("start", "0"),
        ("start", None), ("start", True), ("goals", []), ("goals", [0]), ("goals", [49]), ("goals", [3, 3]),
        ("goals", [3.0]), ("goals", "48"), ("goals", 48), ("goals", list(range(1, 102))), ("goals", ["1"] * 100_000),
        ("painted", [[3, -8]]), ("painted", [[3, 1]]), ("painted", [[48, -1]]), ("painted", [[48, 201]]),
        ("painted", [[3, "1"]]), ("painted", [[3, True]]), ("painted", [[3, None]]), ("painted", [[3.0, -1]]),
        ("painted", [[49, -1]]), ("painted", [[3]]), ("painted", [[3, -1, 0]]), ("painted", [3]), ("painted", None),
        ("painted", {"3": -1}), ("painted", "3:-1"), ("painted", [[3, -1], [4, -1], [3, -1]]),
        ("painted", [[3, -(10**400)]]),
        ("step_limit", 11), ("step_limit", 99), ("step_limit", 0), ("step_limit", 50.0), ("step_limit", "50"),
        ("time_limit_s", 4), ("time_limit_s", 3601), ("time_limit_s", 60.0), ("time_limit_s", "60"),
        ("time_limit_s", False),
    ],
)  # fmt: skip
def test_what_makes_no_world_is_refused_naming_the_field(client, field, value):
    response = client.post("/api/v1/worlds", json={field: value})
    assert response.status_code == 422, response.text
    assert any(name.split(".")[0] == field for name in response.json()["error"]["fields"]), response.text
    assert len(response.content) < 10_000


@pytest.mark.parametrize(
    ("parameters", "world_id"),
    [
        ({}, "e7937d2d-b4d5-5d72-9015-45b0b6cfe473"),
        ({"rows": 4, "cols": 6, "red_probability": 0.5, "slip": 0.1, "walls": [9, 8]},
         "6bc6e740-cc91-55ab-8617-80c4963ab583"),
        ({"start": 0, "goals": None, "painted": [], "step_limit": None, "time_limit_s": None},
         "e7937d2d-b4d5-5d72-9015-45b0b6cfe473"),
        ({"goals": [48], "step_limit": 98, "painted": [[48, 14]]}, "e7937d2d-b4d5-5d72-9015-45b0b6cfe473"),
    ],
)  # fmt: skip
def test_a_world_keeps_the_id_it_had_before_there_were_goals_and_paint(client, parameters, world_id):
    assert make_world(client, **parameters)["id"] == world_id


def test_a_world_can_have_a_start_goals_paint_and_limits_of_its_own(client):
    world = make_world(
        client,
        start=24,
        goals=[48, 6],
        painted=[[20, -1], [12, -3.5], [6, 0], [5, -0.0]],
        step_limit=60,
        time_limit_s=90,
    )
    rewards = [reward for row in world["rewards"] for reward in row]
    assert (world["start"], world["goal"], world["goals"]) == (24, 48, [48, 6])
    assert (rewards[48], rewards[6], rewards[12], rewards[20], str(rewards[5])) == (14.0, 0.0, -3.5, -1.0, "0.0")
    assert (world["colours"][0][6], world["colours"][6][6], world["colours"][1][5]) == ("goal", "goal", "red")
    assert (world["horizon"], world["time_limit_s"]) == (60, 90)
    assert world["spec"] == {
        "seed": PLAYABLE_SEED, "start": 24, "goals": [48, 6], "step_limit": 60, "time_limit_s": 90,
        "painted": [[5, 0.0], [6, 0.0], [12, -3.5], [20, -1.0]],
    }  # fmt: skip
    assert client.get(f"/api/v1/worlds/{world['id']}").json() == world


def test_the_last_square_is_an_ordinary_one_where_goals_are_given(client):
    plain, other = make_world(client), make_world(client, goals=[6])
    changed = {
        (row, col) for row in range(7) for col in range(7) if plain["rewards"][row][col] != other["rewards"][row][col]
    }
    assert changed == {(0, 6), (6, 6)}
    assert -7 <= other["rewards"][6][6] <= 0


def test_a_world_stored_before_there_were_limits_has_none(client):
    from sqlalchemy import update

    from app.models import World

    world = make_world(client)
    old = {name: world[name] for name in world if name not in {"id", "spec", "time_limit_s"}}
    client.app.state.database.write(lambda session: session.execute(update(World).values(world=old)))
    assert client.get(f"/api/v1/worlds/{world['id']}").json() == world


def test_a_drawn_world_has_what_was_asked_for_and_can_be_won(client):
    body = {"start": 24, "goals": [0, 48], "painted": [[23, -7], [25, -7]], "walls": [17], "time_limit_s": 30}
    drawn = client.post("/api/v1/worlds", json=body).json()
    assert drawn["success_possible"]
    assert {name: drawn[name] for name in ("start", "goals", "walls", "time_limit_s")} == {
        name: body[name] for name in ("start", "goals", "walls", "time_limit_s")
    }
    assert client.post("/api/v1/worlds", json=drawn["spec"]).json() == drawn


@pytest.mark.parametrize(
    ("body", "sentence"),
    [
        ({"rows": 1}, "rows: must be at least 2."),
        ({"slip": 0.95}, "slip: must be at most 0.9."),
        ({"seed": 2**53}, "seed: must be at most 9007199254740991."),
        ({"goals": []}, "goals: must have at least 1 entries."),
        ({"painted": [[3, -8]]}, "painted.0.1: must be at least -7."),
        ({"painted": [[3, -1], [3, -2]]}, "painted: must name each square once; 3 is there twice."),
        ({"walls": [48]}, "The goal, square 48 (row 7, column 7), cannot be a wall too; open it or move the goal."),
        ({"walls": [1, 7]}, "No goal can be reached from the start: the walls close the way. Open one of them."),
        ({"step_limit": 11}, "step_limit must be a whole number from 12 (the shortest way to a goal) to 98, not 11."),
    ],
)
def test_a_refusal_says_what_would_be_right(client, body, sentence):
    assert sentence in client.post("/api/v1/worlds", json=body).json()["error"]["message"]


def test_what_crosses_the_wire_has_the_limits_of_the_science():
    from irl_core import gridworld, types

    assert schemas.SIDE == (types.MIN_SIDE, types.MAX_SIDE)
    assert schemas.SEED == (0, types.MAX_SEED)
    assert schemas.SLIP == (0.0, types.MAX_SLIP)
    assert schemas.TIME_LIMIT_S == (types.MIN_TIME_LIMIT_S, types.MAX_TIME_LIMIT_S)
    assert (schemas.REWARD, schemas.GOAL_REWARD) == (gridworld.REWARDS, gridworld.GOAL_REWARDS)


def test_a_world_may_be_painted_from_end_to_end(client):
    painted = [[square, -(square % 70) / 10] for square in range(9_999)]
    world = make_world(client, rows=100, cols=100, painted=painted)
    assert [reward for row in world["rewards"] for reward in row][:9_999] == [reward for _, reward in painted]
    assert len(world["spec"]["painted"]) == 9_999


def test_too_many_red_squares_are_refused_in_words(client):
    response = client.post("/api/v1/worlds", json={"red_probability": 1, "rows": 20, "cols": 20})
    assert response.status_code == 422
    assert "fewer red squares" in response.json()["error"]["message"]


def test_no_such_world(client):
    assert client.get("/api/v1/worlds/00000000-0000-0000-0000-000000000000").status_code == 404
    assert client.get("/api/v1/worlds/not-a-uuid").status_code == 422
