"""Demonstrations through the API: simulated again, stored once, never lost."""

import uuid

import pytest
from sqlalchemy import text

from tests.conftest import open_client
from tests.factories import attempt, best_path, make_demonstration, make_world, post_demonstration, step


def count(client, table: str = "demonstration") -> int:
    with client.app.state.database.read() as session:
        return session.scalar(text(f"SELECT count(*) FROM {table}"))


def test_a_success_is_worked_out_on_the_server(client):
    world = make_world(client)
    demonstration = make_demonstration(client, world)
    states, rewards = [world["start"]], []
    for action in best_path(world):
        states.append(step(world, states[-1], action))
        rewards.append(world["rewards"][states[-1] // 7][states[-1] % 7])
    assert demonstration["states"] == states
    assert demonstration["rewards"] == rewards
    assert demonstration["total"] == pytest.approx(sum(rewards), abs=1e-12)
    assert (demonstration["outcome"], demonstration["ending"]) == ("success", "goal")
    assert demonstration["discarded"] is False
    assert demonstration["world_id"] == world["id"]


def test_giving_up_is_a_failure(client):
    demonstration = make_demonstration(client, make_world(client), failed=True)
    assert (demonstration["outcome"], demonstration["ending"]) == ("failure", "gave_up")


def test_bumping_into_the_edge_pays_the_square_again(client):
    world = make_world(client)
    body = attempt(world, failed=True, actions=[0, 3], step_ms=[1, 2])
    demonstration = post_demonstration(client, world, body).json()
    assert demonstration["states"] == [0, 0, 0]
    assert demonstration["rewards"] == [world["rewards"][0][0]] * 2


def test_the_same_again_is_the_same_body_and_stored_once(client):
    world = make_world(client)
    body = attempt(world)
    first, again = post_demonstration(client, world, body), post_demonstration(client, world, body)
    assert (first.status_code, again.status_code) == (201, 200)
    assert first.content == again.content
    assert count(client) == 1


def test_the_same_id_with_other_content_is_a_conflict(client, other_client):
    world, other_world = make_world(client), make_world(client, seed=6)
    body = attempt(world, failed=True)
    assert post_demonstration(client, world, body).status_code == 201
    for changes in ({"actions": [2]}, {"step_ms": [7]}, {"actions": [1, 1], "step_ms": [1, 2]}):
        assert post_demonstration(client, world, body | changes).status_code == 409
    assert post_demonstration(client, other_world, body).status_code == 409
    assert post_demonstration(other_client, world, body).status_code == 409
    assert count(client) == 1


IMPOSSIBLE = {
    "an action of 4": {"actions": [4]},
    "a negative action": {"actions": [-1]},
    "a boolean": {"actions": [True]},
    "a float": {"actions": [1.0]},
    "a string": {"actions": ["1"]},
    "nothing": {"actions": [None]},
    "a list": {"actions": [[1]]},
    "a huge number": {"actions": [10**400]},
    "no list": {"actions": 1},
    "an object": {"actions": {"0": 1}},
    "no steps": {"actions": [], "step_ms": []},
    "too many steps": {"actions": [0] * 99, "step_ms": [1] * 99},
    "absurdly many steps": {"actions": [0] * 50_000, "step_ms": [1] * 50_000},
    "a goal that was not reached": {"ending": "goal"},
    "an ending nobody knows": {"ending": "won"},
    "out of steps after one": {"ending": "out_of_steps"},
    "a time too few": {"step_ms": []},
    "a time too many": {"step_ms": [1, 2]},
    "a negative time": {"step_ms": [-1]},
    "more than a day": {"step_ms": [86_400_001]},
    "a time in words": {"step_ms": ["1"]},
    "a true time": {"step_ms": [True]},
    "an endless time": {"step_ms": [10**400]},
    "a total the client claims": {"total": 100},
    "an outcome the client claims": {"outcome": "success"},
    "no UUID": {"id": "1"},
    "a number as id": {"id": 5},
    "no id": {"id": None},
    "no actions": {"actions": None},
    "no times": {"step_ms": None},
    "no ending": {"ending": None},
}


@pytest.mark.parametrize("changes", IMPOSSIBLE.values(), ids=IMPOSSIBLE.keys())
def test_the_impossible_is_refused_and_nothing_stored(client, changes):
    world = make_world(client)
    body = attempt(world, failed=True) | changes
    response = post_demonstration(client, world, {name: value for name, value in body.items() if value is not None})
    assert response.status_code == 422, response.text
    error = response.json()["error"]
    assert error["fields"]
    assert set(error) == {"code", "message", "fields"}
    assert count(client) == 0


def test_a_move_after_the_goal_is_refused_naming_the_step(client):
    world = make_world(client)
    path = best_path(world)
    response = post_demonstration(client, world, attempt(world, actions=[*path, 1], step_ms=[1] * (len(path) + 1)))
    assert response.status_code == 422
    assert f"Step {len(path)}" in response.json()["error"]["message"]


def test_the_list_is_oldest_first_and_mine_alone(client, other_client):
    world = make_world(client)
    mine = [make_demonstration(client, world, failed=failed) for failed in (True, False, True)]
    theirs = make_demonstration(other_client, world)
    url = f"/api/v1/worlds/{world['id']}/demonstrations"
    assert client.get(url).json() == mine
    assert other_client.get(url).json() == [theirs]
    assert open_client(client.app).get(url).json() == []


def test_discard_and_restore_as_often_as_one_likes(client, other_client):
    world = make_world(client)
    played = make_demonstration(client, world)
    url = f"/api/v1/demonstrations/{played['id']}/discard"
    for _ in range(2):
        assert client.put(url).json() == played | {"discarded": True}
    assert client.get(f"/api/v1/worlds/{world['id']}/demonstrations").json() == [played | {"discarded": True}]
    make_demonstration(other_client, world)
    assert other_client.delete(url).status_code == 404
    for _ in range(2):
        assert client.delete(url).json() == played
    assert client.put(f"/api/v1/demonstrations/{uuid.uuid4()}/discard").status_code == 404


def test_slips_follow_the_id(client):
    world = make_world(client, slip=0.5)
    body = attempt(world, failed=True, actions=[1] * 10, step_ms=[1] * 10)
    states = [post_demonstration(client, world, body | {"id": str(uuid.UUID(int=k))}) for k in range(1, 9)]
    assert len({str(one.json()["states"]) for one in states if one.status_code == 201}) > 1


def test_the_acknowledged_is_there_after_reopening(client, app, settings):
    world = make_world(client)
    played = make_demonstration(client, world)
    from app.main import create_app

    cookies = dict(client.cookies)
    with open_client(create_app(settings)) as reopened:
        reopened.cookies.update(cookies)
        assert reopened.get(f"/api/v1/worlds/{world['id']}/demonstrations").json() == [played]


def test_acknowledgement_means_flushed_to_the_disk(client):
    with client.app.state.database._writers.connect() as connection:
        assert connection.exec_driver_sql("PRAGMA synchronous").scalar() == 2
        assert connection.exec_driver_sql("PRAGMA journal_mode").scalar() == "wal"
