"""How attempts are played: measures, parents, time limits, and the table of steps."""

import csv
import io
import json
import re
import uuid
from pathlib import Path
from typing import get_args

import pytest

from app.demonstrations.record import Device, Record
from app.demonstrations.schemas import DemonstrationOut
from app.demonstrations.steps import ATTEMPT_COLUMNS, STEP_COLUMNS
from app.main import create_app
from irl_core import slip_direction
from tests.conftest import make_settings, open_client
from tests.factories import (
    attempt,
    best_path,
    make_demonstration,
    make_world,
    post_demonstration,
    record_of,
    step,
)

CODEBOOK = (Path(__file__).resolve().parents[2] / "docs" / "codebook.md").read_text(encoding="utf-8")


def listed(client, world):
    return client.get(f"/api/v1/worlds/{world['id']}/demonstrations").json()


def table(client, world):
    answer = client.get(f"/api/v1/worlds/{world['id']}/steps.csv")
    assert answer.headers["content-type"].startswith("text/csv")
    return list(csv.DictReader(io.StringIO(answer.text)))


def walk(client, world, actions, **changes):
    """An attempt with these actions that was given up."""
    body = attempt(world, failed=True, actions=actions, step_ms=[100.0] * len(actions), **changes)
    return post_demonstration(client, world, body)


def test_a_record_comes_back_as_it_was_sent(client):
    world = make_world(client)
    record = record_of(2)
    sent = walk(client, world, [1, 2], record=record)
    assert sent.status_code == 201, sent.text
    assert sent.json()["record"] == record
    assert listed(client, world) == [sent.json()]
    url = f"/api/v1/demonstrations/{sent.json()['id']}/discard"
    assert client.put(url).json() == sent.json() | {"discarded": True}


def test_an_attempt_without_a_record_is_welcome_too(client):
    world = make_world(client)
    played = make_demonstration(client, world)
    assert (played["record"], played["parent_id"], played["parent_step"]) == (None, None, None)
    assert played["slip_seeds"] == [[played["id"], 0]]


def test_the_same_again_with_its_record_is_the_same_body(client):
    world = make_world(client)
    body = attempt(world, failed=True, record=record_of(1))
    first, again = post_demonstration(client, world, body), post_demonstration(client, world, body)
    assert (first.status_code, again.status_code) == (201, 200)
    assert first.content == again.content


def test_the_same_id_with_another_record_or_parent_is_a_conflict(client):
    world = make_world(client)
    parent = walk(client, world, [1, 2, 3]).json()
    ordinary = attempt(world, failed=True, actions=[1, 2, 2], step_ms=[1, 2, 3], record=record_of(3))
    child = ordinary | {"id": str(uuid.uuid4()), "parent_id": parent["id"], "parent_step": 2}
    for body in (ordinary, child):
        assert post_demonstration(client, world, body).status_code == 201
    without = {name: value for name, value in ordinary.items() if name != "record"}
    other_record = {"record": record_of(3, elapsed_ms=1.0)}
    for changed in (
        without,
        ordinary | other_record,
        ordinary | {"parent_id": parent["id"], "parent_step": 2},
        child | {"parent_step": 1},
        child | other_record,
        child | {"parent_id": ordinary["id"]},
    ):
        assert post_demonstration(client, world, changed).status_code == 409
    assert post_demonstration(client, world, child).status_code == 200


EVENT = {"type": "undo", "at_ms": 1.0, "step": 0, "value": None}
CLIENT = record_of(1)["client"]
WRONG_RECORDS = {
    "another version": ({"version": 2}, "record.version"),
    "a version that is true": ({"version": True}, "record.version"),
    "a field nobody knows": ({"mood": 1}, "record.mood"),
    "a reaction time too few": ({"rt": []}, "record.rt"),
    "a device too many": ({"device": ["key", "key"]}, "record.device"),
    "a reaction before the stimulus": ({"rt": [-1]}, "record.rt.0"),
    "a reaction after more than a year": ({"rt": [366 * 86_400_000 + 1]}, "record.rt.0"),
    "a reaction time in words": ({"rt": ["1"]}, "record.rt.0"),
    "a true reaction time": ({"rt": [True]}, "record.rt.0"),
    "a device nobody knows": ({"device": ["foot"]}, "record.device.0"),
    "no device": ({"device": [None]}, "record.device.0"),
    "no list of events": ({"events": {}}, "record.events"),
    "an event nobody knows": ({"events": [EVENT | {"type": "sneeze"}]}, "record.events.0.type"),
    "an event before the beginning": ({"events": [EVENT | {"at_ms": -0.1}]}, "record.events.0.at_ms"),
    "an event without a time": ({"events": [{"type": "undo", "step": 0}]}, "record.events.0.at_ms"),
    "an event at half a step": ({"events": [EVENT | {"step": 0.5}]}, "record.events.0.step"),
    "an event after the last possible step": ({"events": [EVENT | {"step": 20_001}]}, "record.events.0.step"),
    "an event with a word for a value": ({"events": [EVENT | {"value": "x"}]}, "record.events.0.value"),
    "an event that says more": ({"events": [EVENT | {"who": 1}]}, "record.events.0.who"),
    "too many events": ({"events": [EVENT] * 5_001}, "record.events"),
    "too many tries thrown away": ({"abandoned": [{"n_steps": 1, "elapsed_ms": 1}] * 201}, "record.abandoned"),
    "an endless attempt": ({"elapsed_ms": 1e300}, "record.elapsed_ms"),
    "no client": ({"client": None}, "record.client"),
    "a client that is a list": ({"client": []}, "record.client"),
    "an agent with a line break": ({"client": CLIENT | {"agent": "a\nb"}}, "record.client.agent"),
    "a long agent": ({"client": CLIENT | {"agent": "x" * 101}}, "record.client.agent"),
    "a window with one side": ({"client": CLIENT | {"viewport": [1]}}, "record.client.viewport"),
    "a window of half pixels": ({"client": CLIENT | {"viewport": [1.5, 2]}}, "record.client.viewport.0"),
    "a pointer nobody knows": ({"client": CLIENT | {"pointer": "nose"}}, "record.client.pointer"),
    "a number for yes": ({"client": CLIENT | {"dark": 1}}, "record.client.dark"),
    "pixels of no size": ({"client": CLIENT | {"pixel_ratio": 0}}, "record.client.pixel_ratio"),
}


@pytest.mark.parametrize(("changes", "field"), WRONG_RECORDS.values(), ids=WRONG_RECORDS.keys())
def test_a_record_that_cannot_be_is_refused_by_its_field_and_nothing_is_stored(client, changes, field):
    world = make_world(client)
    response = walk(client, world, [1], record=record_of(1) | changes)
    assert response.status_code == 422, response.text
    assert list(response.json()["error"]["fields"]) == [field]
    assert listed(client, world) == []


def test_the_longest_attempt_with_the_largest_record_is_within_the_limits(client):
    n = 20_000
    world = make_world(client, rows=100, cols=100, step_limit=n)
    event = {"type": "resumed", "at_ms": 31_622_399_999.9, "step": 20_000, "value": -1234567890.1}
    record = record_of(
        n,
        rt=[86_399_999.9] * n,
        device=["gamepad"] * n,
        events=[event] * 5_000,
        abandoned=[{"n_steps": 20_000, "elapsed_ms": 604_799_999.9}] * 200,
    )
    body = attempt(world, failed=True, actions=[0] * n, step_ms=[86_399_999.9] * n, record=record)
    assert 1_000_000 < len(json.dumps(body)) < 2_000_000
    response = post_demonstration(client, world, body)
    assert response.status_code == 201, response.text[:300]
    assert response.json()["record"] == record


def test_trying_again_begins_with_the_steps_of_the_parent_and_slips_as_they_did(client):
    world = make_world(client, slip=0.6)
    actions = [1, 2, 1, 0, 3, 2]
    parent = walk(client, world, actions).json()
    child = walk(client, world, [*actions[:4], 2, 2, 2], parent_id=parent["id"], parent_step=4).json()
    assert child["slip_seeds"] == [[parent["id"], 0], [child["id"], 4]]
    assert child["states"][:5] == parent["states"][:5]
    assert child["rewards"][:4] == parent["rewards"][:4]
    for t in range(4, 7):
        direction = slip_direction(child["id"], t, 2, 0.6)
        assert child["states"][t + 1] == step(world, child["states"][t], direction)
    grandchild = walk(client, world, [*child["actions"][:5], 1], parent_id=child["id"], parent_step=5).json()
    assert grandchild["slip_seeds"] == [[parent["id"], 0], [child["id"], 4], [grandchild["id"], 5]]
    nephew = walk(client, world, [*actions[:2], 1], parent_id=child["id"], parent_step=2).json()
    assert nephew["slip_seeds"] == [[parent["id"], 0], [nephew["id"], 2]]
    assert [one["parent_id"] for one in listed(client, world)] == [None, parent["id"], child["id"], child["id"]]


def test_what_goes_on_from_nothing_is_refused_in_words(client, other_client):
    world, elsewhere = make_world(client), make_world(client, seed=6)
    parent, arrived = walk(client, world, [1, 2, 3]).json(), make_demonstration(client, world)
    path = best_path(world)
    foreign, far = make_demonstration(other_client, world), walk(client, elsewhere, [1, 2, 3]).json()
    n_before = len(listed(client, world))

    def refusal(actions, parent_id, parent_step):
        answer = walk(client, world, actions, parent_id=parent_id, parent_step=parent_step)
        assert answer.status_code == 422, answer.text
        return answer.json()["error"]

    unknown = refusal([1, 2, 2], str(uuid.uuid4()), 2)
    assert unknown == refusal([1, 2, 2], foreign["id"], 2) == refusal([1, 2, 2], far["id"], 2)
    assert "no such attempt" in unknown["message"]
    assert "over" in refusal([1, 2, 3, 1, 1], parent["id"], 4)["message"]
    assert "over" in refusal([*path, 1], arrived["id"], len(path))["message"]
    assert "first 2 actions" in refusal([1, 1, 2], parent["id"], 2)["message"]
    assert "one of its own" in refusal([1, 2], parent["id"], 2)["message"]
    assert list(refusal([1, 2, 2], parent["id"], None)["fields"]) == ["parent_step"]
    assert list(refusal([1, 2, 2], None, 2)["fields"]) == ["parent_id"]
    assert list(refusal([1, 2, 2], parent["id"], 0)["fields"]) == ["parent_step"]
    assert list(refusal([1, 2, 2], "the first", 2)["fields"]) == ["parent_id"]
    assert len(listed(client, world)) == n_before


def test_one_may_go_on_from_an_attempt_that_was_discarded(client):
    world = make_world(client)
    parent = walk(client, world, [1, 2]).json()
    client.put(f"/api/v1/demonstrations/{parent['id']}/discard")
    assert walk(client, world, [1, 1], parent_id=parent["id"], parent_step=1).status_code == 201


def test_time_runs_out_only_where_there_is_a_limit(client):
    limited, unlimited = make_world(client, time_limit_s=30), make_world(client)
    late = walk(client, limited, [1, 2], ending="out_of_time")
    assert (late.status_code, late.json()["ending"], late.json()["outcome"]) == (201, "out_of_time", "failure")
    refused = walk(client, unlimited, [1, 2], ending="out_of_time")
    assert refused.status_code == 422
    assert "no time limit" in refused.json()["error"]["fields"]["ending"]
    arrived = post_demonstration(client, limited, attempt(limited, ending="out_of_time"))
    assert "at a goal" in arrived.json()["error"]["fields"]["ending"]


def test_the_table_of_steps_has_a_row_for_each_step_and_is_mine_alone(client, other_client):
    world = make_world(client, slip=0.3)
    parent = walk(client, world, [1, 2, 0], record=record_of(3)).json()
    record = record_of(3, rt=[None, None, 250.5], device=["copied", "copied", "tap"])
    child = walk(client, world, [1, 2, 1], parent_id=parent["id"], parent_step=2, record=record).json()
    client.put(f"/api/v1/demonstrations/{parent['id']}/discard")
    plain = walk(client, world, [3]).json()
    make_demonstration(other_client, make_world(other_client))
    rows = table(client, world)
    assert [(row["attempt"], row["step"]) for row in rows] == [*zip("1112223", "1231231", strict=True)]
    assert [row["discarded"] for row in rows] == ["true"] * 3 + ["false"] * 4
    first, last, bare = rows[0], rows[5], rows[6]
    assert {name: first[name] for name in ("state", "row", "col", "action", "device", "rt", "step_ms")} == {
        "state": "0", "row": "0", "col": "0", "action": "1", "device": "key", "rt": "180.5", "step_ms": "100.0",
    }  # fmt: skip
    assert (first["undone"], first["blurs"], first["hidden"]) == ("1", "1", "0")
    assert (first["abandoned"], first["viewport_width"], first["dark"]) == ("1", "1280", "true")
    assert (last["parent_id"], last["parent_step"], last["device"]) == (parent["id"], "2", "tap")
    assert int(last["direction"]) == slip_direction(child["id"], 2, 1, 0.3)
    assert [int(row["direction"]) for row in rows[:2]] == [
        slip_direction(parent["id"], t, action, 0.3) for t, action in enumerate([1, 2])
    ]
    assert [float(row["reward"]) for row in rows] == parent["rewards"] + child["rewards"] + plain["rewards"]
    assert {
        bare[name]
        for name in ("rt", "device", "agent", "elapsed_ms", "parent_id", "abandoned", "undone", "blurs", "hidden")
    } == {""}
    assert table(other_client, world) == []


def test_without_attempts_the_table_is_its_header(client):
    world = make_world(client)
    answer = open_client(client.app).get(f"/api/v1/worlds/{world['id']}/steps.csv")
    assert answer.text == ",".join(ATTEMPT_COLUMNS + STEP_COLUMNS) + "\r\n"
    assert "attachment" in answer.headers["content-disposition"]


def test_many_attempts_come_in_their_order(client):
    world = make_world(client)
    ids = [walk(client, world, [1]).json()["id"] for _ in range(17)]
    rows = table(client, world)
    assert [row["demonstration_id"] for row in rows] == ids
    assert [int(row["attempt"]) for row in rows] == list(range(1, 18))


@pytest.mark.parametrize("agent", ["=1+1", "+1", "-1", "@SUM(A1)"])
def test_no_text_begins_a_formula(client, agent):
    world = make_world(client)
    record = record_of(1)
    record["client"] = record["client"] | {"agent": agent}
    walk(client, world, [1], record=record)
    (row,) = table(client, world)
    assert row["agent"] == f"'{agent}"
    assert row["reward"].startswith("-")


def test_a_text_with_commas_and_quotes_stays_one_cell(client):
    world = make_world(client)
    record = record_of(1)
    record["client"] = record["client"] | {"agent": 'a "b", c'}
    walk(client, world, [1], record=record)
    assert table(client, world)[0]["agent"] == 'a "b", c'


def test_a_runs_file_says_where_its_attempts_come_from(client):
    world = make_world(client)
    parent = make_demonstration(client, world)
    child = walk(client, world, [*parent["actions"][:2], 0], parent_id=parent["id"], parent_step=2).json()
    run = client.post(f"/api/v1/worlds/{world['id']}/runs", json={"learners": ["meirl"]}).json()
    lines = client.get(f"/api/v1/runs/{run['id']}/demonstrations.jsonl").text.splitlines()
    told = [json.loads(line) for line in lines if '"demonstration"' in line]
    assert [one["slip_seeds"] for one in told] == [parent["slip_seeds"], child["slip_seeds"]]
    assert [one.get("parent_id") for one in told] == [None, parent["id"]]


def test_a_study_decides_whether_totals_are_shown_and_held_keys_move(settings):
    told = make_settings(settings.data_dir, show_totals=False, hold_to_move=True)
    with open_client(create_app(told)) as client:
        (island,) = re.findall(r'id="page-data"[^>]*>(.*?)</script>', client.get("/").text, re.DOTALL)
        assert json.loads(island)["options"] == {"show_totals": False, "hold_to_move": True}


def section(title):
    """The rows of the tables under a heading of the codebook: first cells, without their backticks."""
    text = re.split(r"^## ", CODEBOOK, flags=re.MULTILINE)
    (found,) = [part for part in text if part.startswith(title)]
    return re.findall(r"^\| `([^`]+)` \|", found, flags=re.MULTILINE)


def test_the_codebook_has_every_column_of_the_table_in_its_order():
    assert tuple(section("The table of steps")) == ATTEMPT_COLUMNS + STEP_COLUMNS


def test_the_codebook_has_every_field_of_an_attempt():
    assert set(section("An attempt")) == set(DemonstrationOut.model_fields)


def test_the_codebook_has_every_field_of_a_record_and_every_event():
    schema = Record.model_json_schema()
    events = schema["$defs"]["Event"]["properties"]["type"]["enum"]
    assert section("The record") == [*fields_of(schema, schema), *events]


def fields_of(schema, part):
    """The fields of a record with their paths: `events[].type`, `client.agent`."""
    for name, one in part["properties"].items():
        inner = one.get("items", one)
        if "$ref" in inner:
            mark = "[]" if "items" in one else ""
            named = schema["$defs"][inner["$ref"].rpartition("/")[2]]
            yield from (f"{name}{mark}.{field}" for field in fields_of(schema, named))
        else:
            yield f"{name}[]" if "items" in one and name != "viewport" else name


@pytest.mark.parametrize("word", get_args(Device))
def test_the_codebook_has_every_device(word):
    assert f"`{word}`" in CODEBOOK
