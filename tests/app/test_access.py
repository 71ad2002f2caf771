"""Who may do what: every route with nobody's cookie, the owner's and another visitor's. A route without a row fails."""

import json
from collections.abc import Iterator

import pytest
from fastapi.routing import APIRoute
from sqlalchemy import insert

from app.kit.clock import now
from app.models import Run, Visitor
from tests.conftest import open_client
from tests.factories import attempt, make_demonstration, make_ranking, make_world
from tests.sitting import Sitting

RUN_ID = "11111111-2222-4333-8444-555555555555"

# method and path: (no cookie, the owner, another visitor)
EVERYBODY = {
    ("GET", "/"): (200, 303, 303),
    ("GET", "/docs"): (200, 200, 200),
    ("GET", "/healthz"): (200, 200, 200),
    ("GET", "/readyz"): (503, 503, 503),
    ("POST", "/api/v1/worlds"): (201, 201, 201),
    ("GET", "/api/v1/worlds/preview"): (200, 200, 200),
    ("GET", "/worlds/new"): (200, 200, 200),
    ("GET", "/worlds/surprise"): (303, 303, 303),
    ("GET", "/api/v1/worlds/{world_id}"): (200, 200, 200),
    ("GET", "/worlds/{world_id}"): (200, 200, 200),
    ("GET", "/worlds/{world_id}/rank"): (200, 200, 200),
    ("GET", "/worlds/{world_id}/learn"): (200, 200, 200),
    ("POST", "/api/v1/worlds/{world_id}/demonstrations"): (409, 200, 409),
    ("GET", "/api/v1/worlds/{world_id}/demonstrations"): (200, 200, 200),
    ("GET", "/api/v1/worlds/{world_id}/steps.csv"): (200, 200, 200),
    ("GET", "/api/v1/worlds/{world_id}/rankings"): (200, 200, 200),
    ("GET", "/api/v1/worlds/{world_id}/rankings/{outcome}/versions"): (200, 200, 200),
    ("GET", "/api/v1/worlds/{world_id}/rankings.csv"): (200, 200, 200),
    ("GET", "/api/v1/worlds/{world_id}/rankings.jsonl"): (200, 200, 200),
    ("GET", "/api/v1/worlds/{world_id}/ranking-events.csv"): (200, 200, 200),
    ("GET", "/api/v1/worlds/{world_id}/runs"): (200, 200, 200),
    ("POST", "/api/v1/worlds/{world_id}/runs"): (422, 202, 202),  # each of what they have played themselves
    ("POST", "/api/v1/worlds/{world_id}/previews"): (422, 422, 422),  # as above: nobody has a failure yet
    ("GET", "/results"): (200, 200, 200),  # each of their own; whose, tests/app/test_results.py says
    ("GET", "/api/v1/results"): (200, 200, 200),
    ("GET", "/api/v1/results.csv"): (200, 200, 200),
    ("GET", "/api/v1/results/comparisons.csv"): (200, 200, 200),
}
OWNER_ONLY = {
    ("PUT", "/api/v1/demonstrations/{demonstration_id}/discard"): (404, 200, 404),
    ("DELETE", "/api/v1/demonstrations/{demonstration_id}/discard"): (404, 200, 404),
    ("PUT", "/api/v1/worlds/{world_id}/rankings/{outcome}"): (422, 200, 422),
    ("POST", "/api/v1/worlds/{world_id}/sittings/{sitting_id}/events"): (404, 200, 404),
    ("GET", "/api/v1/worlds/{world_id}/rankings/{outcome}/agreement"): (404, 200, 404),
    ("GET", "/worlds/{world_id}/compare"): (303, 303, 303),
    ("GET", "/api/v1/runs/{run_id}"): (404, 200, 404),
    ("GET", "/api/v1/runs/{run_id}/events"): (404, 204, 404),
    ("POST", "/api/v1/runs/{run_id}/cancellation"): (404, 409, 404),
    ("GET", "/api/v1/runs/{run_id}/frames"): (404, 200, 404),
    ("GET", "/api/v1/events"): (404, 204, 404),
    ("DELETE", "/api/v1/runs/{run_id}"): (404, 204, 404),
    ("POST", "/api/v1/runs/{run_id}/shares"): (404, 201, 404),
    ("GET", "/api/v1/runs/{run_id}/shares"): (404, 200, 404),
    ("DELETE", "/api/v1/runs/{run_id}/shares/{key}"): (404, 404, 404),
    ("GET", "/api/v1/runs/{run_id}/comparison"): (404, 409, 404),
    ("GET", "/api/v1/runs/{run_id}/rollouts"): (404, 409, 404),
    ("POST", "/api/v1/runs/{run_id}/what-ifs"): (404, 409, 404),
    ("GET", "/api/v1/runs/{run_id}/influence"): (404, 409, 404),
    ("GET", "/api/v1/runs/{run_id}/uncertainty"): (404, 409, 404),
    ("GET", "/api/v1/runs/{run_id}/demonstrations.jsonl"): (404, 200, 404),
    ("GET", "/runs/{run_id}"): (404, 200, 404),
    ("GET", "/runs/{run_id}/comparison"): (404, 303, 404),
}
MATRIX = EVERYBODY | OWNER_ONLY


def routes(app) -> Iterator[tuple[str, str]]:
    """Every method and path of the app, wherever its router was included."""
    waiting = list(app.router.routes)
    while waiting:
        route = waiting.pop()
        if isinstance(route, APIRoute):
            yield from ((method, route.path) for method in route.methods or ())
        elif hasattr(route, "original_router"):
            waiting.extend(route.original_router.routes)


def test_every_route_has_a_row_and_every_row_a_route(app):
    assert set(routes(app)) == set(MATRIX)


@pytest.mark.parametrize(("method", "path"), MATRIX)
def test_who_may(client, other_client, method, path):
    world = make_world(client)
    played = make_demonstration(client, world)
    make_demonstration(other_client, world)
    make_ranking(client, world, "success", [played["id"]])
    store_ended_run(client, world, played)
    sitting = Sitting(client, world)
    sitting.begin()
    assert sitting.send().status_code == 200
    ids = {"world_id": world["id"], "demonstration_id": played["id"], "run_id": RUN_ID, "sitting_id": sitting.id}
    url = path.format(**ids, outcome="success", key="unknown")
    body = body_for(method, path, world, played)
    if path == "/api/v1/events":
        url += f"?run={RUN_ID}"
    answers = [
        asking.request(method, url, follow_redirects=False, headers={"Last-Event-ID": "9"}, **body)
        for asking in (open_client(client.app), client, other_client)
    ]
    assert tuple(answer.status_code for answer in answers) == MATRIX[method, path]
    if path.startswith(("/api/v1/worlds/{world_id}/", "/worlds/{world_id}")):
        for answer in (answers[0], answers[2]):
            assert played["id"] not in answer.text or answer.status_code == 422


def body_for(method, path, world, played):
    if path.endswith("/demonstrations") and method == "POST":
        return {"json": attempt(world, attempt_id=played["id"])}
    if "rankings/{outcome}" in path:
        return {"json": {"order": [[played["id"]]], "confirmed": True}}
    if path.endswith("/runs") and method == "POST":
        return {"json": {"learners": ["meirl"]}}
    if path.endswith("/events") and method == "POST":
        return {"json": {"events": [{"n": 1, "at_ms": 1, "type": "watch", "means": "mouse", "id": played["id"]}]}}
    last = path.rpartition("/")[2]
    if last in {"previews", "what-ifs", "influence", "uncertainty"}:
        return again_for(last, played)
    return {"json": {}} if (method, path) == ("POST", "/api/v1/worlds") else {}


def again_for(last, played):
    """What is asked for when something is to be learned again."""
    return {
        "previews": {"json": {"learner": "irlfr", "orders": {}}},
        "what-ifs": {"json": {"learner": "meirl", "change": {"drop": played["id"]}}},
    }.get(last, {"params": {"learner": "meirl"}})


def store_ended_run(client, world, played):
    """A run of `client`'s that was cancelled before it began."""
    columns = {
        "id": RUN_ID, "world_id": world["id"], "learners": ["meirl"], "settings": {}, "seed": 1, "rankings": {},
        "demonstrations": [played["id"]], "versions": {}, "status": "cancelled", "created_at": now(),
    }  # fmt: skip

    def store(session):
        visitor_id = session.query(Visitor.id).order_by(Visitor.created_at).limit(1).scalar()
        session.execute(insert(Run), columns | {"visitor_id": visitor_id})

    client.app.state.database.write(store)


def test_a_foreign_id_in_a_body_tells_nothing(client, other_client):
    world = make_world(client)
    foreign = make_demonstration(client, world)["id"]
    make_demonstration(other_client, world)
    unknown = "99999999-2222-4333-8444-555555555555"
    url = f"/api/v1/worlds/{world['id']}/rankings/success"
    answers = [other_client.put(url, json={"order": [[one]], "confirmed": True}) for one in (foreign, unknown)]
    assert answers[0].status_code == answers[1].status_code == 422
    assert answers[0].text.replace(foreign, "") == answers[1].text.replace(unknown, "")
    assert json.loads(answers[0].text)["error"]["code"] == "invalid"
