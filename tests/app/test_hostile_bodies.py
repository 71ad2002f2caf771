"""Bodies that no honest client sends: each is refused in our shape, none is stored, none is repeated."""

import json
import uuid

import pytest
from sqlalchemy import text

from app.worlds.schemas import WorldIn
from tests.factories import attempt, make_demonstration, make_world, record_of
from tests.sitting import Sitting

MARK = "<script>alert(7)</script>"

RAW = {
    "nothing but a brace": b"{",
    "not JSON": b"actions=1",
    "NaN": b'{"seed": NaN}',
    "Infinity": b'{"slip": Infinity}',
    "minus Infinity": b'{"slip": -Infinity}',
    "a number beyond floats": b'{"slip": 1e999}',
    "an integer of 400 digits": b'{"seed": 1' + b"0" * 400 + b"}",
    "an integer of 5,000 digits": b'{"seed": 1' + b"0" * 5_000 + b"}",
    "a name given twice": b'{"seed": 1, "seed": 2}',
    "nested 100,000 lists": b'{"walls": ' + b"[" * 100_000 + b"]" * 100_000 + b"}",
    "nested 100,000 objects": b'{"a":' * 100_000 + b"1" + b"}" * 100_000,
    "nested 500 lists": b'{"walls": ' + b"[" * 500 + b"]" * 500 + b"}",
    "unclosed lists": b"[" * 200_000,
    "a lone surrogate": b'{"seed": "\\ud800"}',
    "a lone surrogate as a name": b'{"\\udfff": 1}',
    "not UTF-8": b'{"seed": "\xff\xfe"}',
    "UTF-16": '{"seed": 1}'.encode("utf-16"),
    "UTF-32": '{"seed": 1}'.encode("utf-32"),
    "a byte order mark": b'\xef\xbb\xbf{"seed": 1}',
    "a null byte": b'{"seed": "\x00"}',
    "an escaped null": b'{"\\u0000": 1}',
    "a script as a name": json.dumps({MARK: 1}).encode(),
    "a script as a value": json.dumps({"seed": MARK}).encode(),
    "a very long name": json.dumps({"n" * 100_000: 1}).encode(),
    "many names": json.dumps({f"n{k}": k for k in range(20_000)}).encode(),
    "many walls of the wrong type": json.dumps({"walls": ["1"] * 100_000}).encode(),
    "a list": b"[]",
    "a string": b'"x"',
    "a number": b"7",
    "true": b"true",
    "pollution": b'{"__proto__": {"a": 1}, "constructor": 1}',
    "white space alone": b"   ",
    "trailing garbage": b'{"seed": 1} x',
    "a comment": b'{"seed": 1} // one',
    "single quotes": b"{'seed': 1}",
}
ODD_VALUES: list[object] = [
    None, True, False, 0, -1, 1.5, 1e308, 10**400, "", "x", "0", MARK, "\x00", [], [[]], [None], {}, {"a": 1},
    [10**400], ["x"] * 1000, [True], [{}], {"id": "x"}, "8f14e45f-ceea-467f-a1d2-0c6f1f9b2a11\n",
    "\u202e", "é" * 10_000,
]  # fmt: skip
TABLES = ("world", "visitor", "demonstration", "ranking", "run", "sitting", "ranking_event")


def n_rows(client) -> dict[str, int]:
    with client.app.state.database.read() as session:
        return {table: session.scalar(text(f"SELECT count(*) FROM {table}")) for table in TABLES}


def assert_refused(response) -> None:
    assert 400 <= response.status_code < 500, response.text[:500]
    assert response.headers["content-type"] == "application/json"
    error = response.json()["error"]
    assert set(error) == {"code", "message", "fields"}
    assert error["message"]
    assert len(response.content) < 20_000
    assert "<script" not in response.text
    response.text.encode("ascii")


def post_raw(client, url, body, method="POST"):
    return client.request(method, url, content=body, headers={"Content-Type": "application/json"})


@pytest.mark.parametrize("raw", RAW.values(), ids=RAW.keys())
def test_hostile_bytes_to_every_call(client, raw):
    world = make_world(client)
    played = make_demonstration(client, world)
    before = n_rows(client)
    root = f"/api/v1/worlds/{world['id']}"
    assert_refused(post_raw(client, "/api/v1/worlds", raw))
    assert_refused(post_raw(client, f"{root}/demonstrations", raw))
    assert_refused(post_raw(client, f"{root}/rankings/success", raw, "PUT"))
    assert_refused(post_raw(client, f"{root}/sittings/{uuid.uuid4()}/events", raw))
    assert_refused(post_raw(client, f"{root}/runs", raw))
    assert post_raw(client, f"/api/v1/demonstrations/{played['id']}/discard", raw, "PUT").status_code < 500
    assert n_rows(client) == before


def test_odd_values_in_every_field(client):
    world = make_world(client)
    played = make_demonstration(client, world)
    before = n_rows(client)
    root = f"/api/v1/worlds/{world['id']}"
    bodies = {
        ("POST", f"{root}/demonstrations"): attempt(world),
        ("PUT", f"{root}/rankings/success"): {"order": [[played["id"]]], "confirmed": True},
        ("POST", f"{root}/sittings/{uuid.uuid4()}/events"): {"events": [{}]},
    }
    for (method, url), good in bodies.items():
        for name in good:
            for value in ODD_VALUES:
                if good[name] != value or isinstance(value, bool):
                    response = post_raw(client, url, json.dumps(good | {name: value}).encode(), method)
                    if (name, value) != ("confirmed", True):
                        assert_refused(response)
    after = n_rows(client)
    assert after == before | {"ranking": after["ranking"]}


def test_odd_values_beside_an_order_are_refused(client):
    world = make_world(client)
    order = [[make_demonstration(client, world)["id"]]]
    sitting = {"id": str(uuid.uuid4()), "events": []}
    for name, fine in {"based_on": (None, 0), "untouched": (True, False), "sitting": (None,)}.items():
        odd = [value for value in ODD_VALUES if not any(value is one for one in fine)]
        bodies = [{name: value} for value in odd]
        bodies += [{"sitting": sitting | {part: value}} for part in ("id", "events", "n") for value in odd]
        for body in bodies:
            told = json.dumps({"order": order, "confirmed": True} | body).encode()
            assert_refused(post_raw(client, f"/api/v1/worlds/{world['id']}/rankings/success", told, "PUT"))
    assert n_rows(client)["ranking"] == n_rows(client)["sitting"] == 0


EVENT_PATHS = [
    ("begin", "n"), ("begin", "orders"), ("begin", "orders", "success"), ("begin", "orders", "success", 0),
    ("begin", "orders", "success", 0, 0), ("begin", "from"), ("begin", "from", "failure"),
    ("begin", "based_on", "success"), ("begin", "way"), ("begin", "client"), ("begin", "client", "agent"),
    ("begin", "client", "hold_to_move"), ("place", "n"), ("place", "at_ms"), ("place", "type"), ("place", "means"),
    ("place", "outcome"), ("place", "id"), ("place", "group"), ("place", "joins"), ("place", "__proto__"),
    ("set", "order"), ("set", "order", 0), ("set", "by"), ("swap", "with"), ("answer", "said"), ("gap", "value"),
    ("stretch", "from"), ("stretch", "to"), ("stretch", "kind"), ("cards", "added"), ("cards", "removed"),
    ("resumed", "away_ms"), ("confirm", "untouched"),
]  # fmt: skip


def a_log_of_everything(client, world):
    a, b = (make_demonstration(client, world)["id"] for _ in range(2))
    tried, here = Sitting(client, world), {"outcome": "success"}
    tried.begin()
    tried.do("place", **here, id=a, group=0, joins=False)
    tried.do("set", **here, order=[[b], [a]], by="score")
    tried.do("swap", **here, id=a, **{"with": b})
    tried.do("answer", **here, a=a, b=b, said="alike")
    tried.do("gap", **here, above=a, below=b, value=5)
    tried.do("stretch", id=a, **{"from": 1, "to": 2}, kind="good")
    tried.do("cards", **here, added=[], removed=[])
    tried.do("resumed", away_ms=5.5)
    tried.do("confirm", **here, untouched=False)
    return tried


def test_odd_values_in_an_event_are_stored_as_they_are_or_refused(client):
    world = make_world(client)
    tried = a_log_of_everything(client, world)
    log = {event["type"]: event for event in tried.log}
    n_stored = 0
    for kind, *path in EVENT_PATHS:
        for value in ODD_VALUES:
            tried.id = str(uuid.uuid4())
            events = [*tried.log[: log[kind]["n"]], replaced(log[kind], path, value)]
            url = f"/api/v1/worlds/{world['id']}/sittings/{tried.id}/events"
            response = post_raw(client, url, json.dumps({"events": events}).encode())
            if response.status_code == 200:
                n_stored += len(events)
                assert last_event(client, tried.id) == events[-1]
            else:
                assert_refused(response)
    assert n_rows(client)["ranking_event"] == n_stored
    table = client.get(f"/api/v1/worlds/{world['id']}/ranking-events.csv")
    assert (table.status_code, len(table.text.splitlines())) == (200, 1 + n_stored)


def last_event(client, sitting_id):
    with client.app.state.database.read() as session:
        asked = text("SELECT event FROM ranking_event WHERE sitting_id = :id ORDER BY n DESC LIMIT 1")
        return json.loads(session.scalar(asked, {"id": sitting_id}))


RECORD_PATHS = [
    ("version",), ("rt",), ("rt", 1), ("device",), ("device", 0), ("events",), ("events", 0), ("events", 0, "type"),
    ("events", 0, "at_ms"), ("events", 0, "step"), ("events", 0, "value"), ("elapsed_ms",), ("abandoned",),
    ("abandoned", 0), ("abandoned", 0, "n_steps"), ("client",), ("client", "agent"), ("client", "viewport"),
    ("client", "viewport", 1), ("client", "pixel_ratio"), ("client", "refresh_hz"), ("client", "pointer"),
    ("client", "dark"), ("client", "__proto__"),
]  # fmt: skip


@pytest.mark.parametrize("path", RECORD_PATHS, ids=str)
def test_odd_values_in_a_record_are_stored_as_they_are_or_refused(client, path):
    world = make_world(client)
    for value in ODD_VALUES:
        record = replaced(record_of(2), path, value)
        body = attempt(world, failed=True, actions=[1, 1], step_ms=[1, 1], record=record)
        response = post_raw(client, f"/api/v1/worlds/{world['id']}/demonstrations", json.dumps(body).encode())
        if response.status_code == 201:
            assert response.json()["record"] == record
        else:
            assert_refused(response)
    table = client.get(f"/api/v1/worlds/{world['id']}/steps.csv")
    assert table.status_code == 200
    assert len(table.text.splitlines()) == 1 + 2 * n_rows(client)["demonstration"]


def test_odd_values_for_a_parent_are_refused(client):
    world = make_world(client)
    played = make_demonstration(client, world, failed=True)
    good = attempt(world, failed=True, actions=[1, 1], step_ms=[1, 1], parent_id=played["id"], parent_step=1)
    for name in ("parent_id", "parent_step"):
        for value in ODD_VALUES:
            body = json.dumps(good | {name: value}).encode()
            assert_refused(post_raw(client, f"/api/v1/worlds/{world['id']}/demonstrations", body))
    assert n_rows(client)["demonstration"] == 1


def replaced(body, path, value):
    """The body with another value at this path."""
    if not path:
        return value
    copied = list(body) if isinstance(body, list) else dict(body)
    copied[path[0]] = replaced(body[path[0]] if path[1:] else None, path[1:], value)
    return copied


def test_odd_worlds_never_break_anything(client):
    for name in WorldIn.model_fields:
        for value in ODD_VALUES:
            response = post_raw(client, "/api/v1/worlds", json.dumps({"seed": 1, name: value}).encode())
            if response.status_code != 201:
                assert_refused(response)


@pytest.mark.parametrize(
    "media_type",
    [
        "text/plain",
        "application/x-www-form-urlencoded",
        "multipart/form-data; boundary=x",
        "application/jsonx",
        "",
        None,
    ],
)
def test_another_media_type_is_415(client, media_type):
    headers = {} if media_type is None else {"Content-Type": media_type}
    response = client.post("/api/v1/worlds", content=b'{"seed": 1}', headers=headers)
    assert response.status_code == 415
    assert_refused(response)


def test_a_charset_is_fine(client):
    headers = {"Content-Type": "Application/JSON; charset=utf-8"}
    assert client.post("/api/v1/worlds", content=b'{"seed": 1}', headers=headers).status_code == 201


def test_more_than_the_limit_is_413_declared_or_not(client):
    large = b'{"walls": [' + b"1," * 1_100_000 + b"1]}"
    response = post_raw(client, "/api/v1/worlds", large)
    assert response.status_code == 413
    assert_refused(response)

    def chunks():
        for start in range(0, len(large), 50_000):
            yield large[start : start + 50_000]

    response = client.post("/api/v1/worlds", content=chunks(), headers={"Content-Type": "application/json"})
    assert response.status_code == 413
    assert n_rows(client)["world"] == 0


def test_addresses_that_are_none(client):
    for url in (
        "/api/v1/worlds/%00", "/api/v1/worlds/%ff%fe", "/api/v1/worlds/" + "a" * 5000, "/api/v1/runs/1",
        "/api/v1/worlds/..%2f..%2fetc%2fpasswd", "/api/v1/%3Cscript%3E", "/api/v1/worlds/%F0%9F%98%80/demonstrations",
        "/api/v1/", "/api/v2/worlds",
    ):  # fmt: skip
        assert_refused(client.get(url))
    assert_refused(client.patch("/api/v1/worlds"))
    assert_refused(client.delete("/api/v1/worlds"))


def test_a_broken_database_is_503_with_retry_after_and_no_acknowledgement(client, monkeypatch):
    from sqlalchemy.exc import OperationalError

    from app.kit.writer import WriterIsBusy

    world = make_world(client)
    for error in (OperationalError("INSERT", {}, Exception("database or disk is full")), WriterIsBusy()):

        def fail(work, error=error):
            raise error

        with monkeypatch.context() as patch:
            patch.setattr(client.app.state.database._writer, "submit", fail)
            response = client.post(f"/api/v1/worlds/{world['id']}/demonstrations", json=attempt(world))
        assert response.status_code == 503
        assert response.headers["retry-after"]
        assert "INSERT" not in response.text
    make_demonstration(client, world)


def test_an_error_nobody_foresaw_keeps_the_shape_and_the_headers(client, monkeypatch):
    def fail(work):
        raise RuntimeError(MARK)

    monkeypatch.setattr(client.app.state.database, "write", fail)
    response = client.post("/api/v1/worlds", json={})
    assert response.status_code == 500
    assert response.json()["error"]["code"] == "internal"
    assert MARK not in response.text
    assert "content-security-policy" in response.headers
    assert "set-cookie" not in response.headers


def test_odd_values_in_every_field_and_setting_of_a_run(client):
    world = make_world(client)
    make_demonstration(client, world)
    before = n_rows(client)
    url = f"/api/v1/worlds/{world['id']}/runs"
    settings = ("iterations", "learning_rate", "tolerance", "lambda_start", "initial_weights", "unfinished_failures")
    good = {"learners": ["meirl"], "seed": 1}
    bodies = [good | {name: value} for name in ("learners", "settings") for value in ODD_VALUES if value != {}]
    bodies += [good | {"seed": value} for value in ODD_VALUES if value not in (None, 0) or isinstance(value, bool)]
    wrong = [value for value in ODD_VALUES if value not in (0, 1e308) or isinstance(value, bool)]
    bodies += [good | {"settings": {name: value}} for name in settings for value in wrong if value != 1.5]
    bodies += [good | {"settings": {name: 10**300}} for name in settings]
    for body in bodies:
        assert_refused(post_raw(client, url, json.dumps(body).encode()))
    for name in settings:
        assert_refused(post_raw(client, url, b'{"learners": ["meirl"], "settings": {"%s": 1e999}}' % name.encode()))
    assert n_rows(client) == before
