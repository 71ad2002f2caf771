"""A link that opens a run: to whoever has its key, to look at; until it is revoked."""

import pytest

from app.learning import worker
from tests.app.test_learning import ask, database, played  # noqa: F401 - fixtures
from tests.app.test_pages import island
from tests.factories import make_demonstration

SEEN_BY_KEY = ("", "/events", "/frames", "/comparison", "/rollouts", "/demonstrations.jsonl")


@pytest.fixture
def run(client, played, database):  # noqa: F811
    """A run that is done."""
    made = ask(client, played, learners=["meirl"]).json()
    worker.learn_now(database, made["id"])
    return made


def share(client, run):
    response = client.post(f"/api/v1/runs/{run['id']}/shares")
    assert response.status_code == 201, response.text
    return response.json()


def test_a_key_opens_the_run_its_comparison_and_what_it_learned_from(client, other_client, run):
    made = share(client, run)
    assert made["address"] == f"/runs/{run['id']}/comparison?key={made['key']}"
    for path in SEEN_BY_KEY:
        theirs, mine = (
            asking.get(f"/api/v1/runs/{run['id']}{path}", params=told)
            for asking, told in ((other_client, {"key": made["key"]}), (client, {}))
        )
        assert (theirs.status_code, theirs.text.replace('"is_own":false', '"is_own":true')) == (200, mine.text)
    assert other_client.get(made["address"]).status_code == 200


def test_a_key_opens_nothing_else_and_changes_nothing(client, other_client, played, run):  # noqa: F811
    key = share(client, run)["key"]
    other_run = ask(client, played, learners=["meirl"]).json()
    for path in SEEN_BY_KEY:
        assert other_client.get(f"/api/v1/runs/{other_run['id']}{path}", params={"key": key}).status_code == 404
    for method, path in (
        ("POST", "/cancellation"),
        ("POST", "/shares"),
        ("GET", "/shares"),
        ("DELETE", f"/shares/{key}"),
        ("DELETE", ""),
    ):
        answer = other_client.request(method, f"/api/v1/runs/{run['id']}{path}", params={"key": key})
        assert answer.status_code == 404, (method, path)
    assert other_client.get(f"/api/v1/worlds/{played['id']}/demonstrations", params={"key": key}).json() == []


def test_sharing_twice_gives_one_link_and_revoking_closes_it_for_good(client, other_client, run):
    made = share(client, run)
    assert share(client, run) == made
    address = f"/api/v1/runs/{run['id']}/shares"
    assert client.get(address).json() == [made]
    for _ in range(2):
        assert client.delete(f"{address}/{made['key']}").status_code == 204
    assert client.delete(f"{address}/unknown").status_code == 404
    assert client.get(address).json() == []
    assert other_client.get(f"/api/v1/runs/{run['id']}", params={"key": made["key"]}).status_code == 404
    assert other_client.get(made["address"]).status_code == 404
    assert share(client, run)["key"] != made["key"], "a revoked key never opens again"


def test_the_pages_of_a_shared_run_show_its_snapshot_and_not_what_came_after(client, other_client, played, run):  # noqa: F811
    key = share(client, run)["key"]
    later = make_demonstration(client, played)["id"]
    earliest = client.get(f"/api/v1/worlds/{played['id']}/demonstrations").json()[0]["id"]
    client.put(f"/api/v1/demonstrations/{earliest}/discard")
    own = island(client.get(f"/runs/{run['id']}"))
    assert (own["is_own"], own["key"], own["run"]["is_own"]) == (True, None, True)
    assert len(own["demonstrations"]) == 7
    for page in (f"/runs/{run['id']}", f"/runs/{run['id']}/comparison"):
        answer = other_client.get(page, params={"key": key})
        assert answer.status_code == 200
        assert later not in answer.text
        seen = island(answer)
        assert (seen["is_own"], seen["key"], seen["run"]["is_own"]) == (False, key, False)
        assert [one["discarded"] for one in seen["demonstrations"]] == [False] * 6, "what was discarded since counted"
        assert [len(seen["rankings"][outcome]["order"]) for outcome in ("success", "failure")] == [3, 3]


def test_a_shared_run_that_is_not_done_leads_to_where_it_can_be_watched(client, other_client, played):  # noqa: F811
    waiting = ask(client, played).json()
    made = share(client, waiting)
    answer = other_client.get(made["address"], follow_redirects=False)
    assert (answer.status_code, answer.headers["location"]) == (303, f"/runs/{waiting['id']}?key={made['key']}")
    assert other_client.get(answer.headers["location"]).status_code == 200
