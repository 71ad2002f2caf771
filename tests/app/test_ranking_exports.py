"""Rankings to take away: the table of places, the table of events, the file; and the codebook that explains them."""

import csv
import io
import json
import re
import uuid
from importlib import import_module
from pathlib import Path

import pytest

from app.rankings import exports
from app.rankings.event_export import EVENT_COLUMNS
from app.rankings.events import EVENTS, MOST_EVENTS
from app.rankings.exports import RANKING_COLUMNS
from app.rankings.schemas import AgreementOut, RankingOut
from app.worlds.queries import find_world
from irl_core import LearningProblem, display_ranks, paper_index, rank_weights, read_demonstration_file
from irl_core.preferences.comparisons import order_from_comparisons
from irl_core.preferences.gaps import positions_from_gaps
from irl_core.preferences.stretches import order_from_stretches
from tests.conftest import open_client
from tests.factories import best_path, make_demonstration, make_ranking, make_world, record_of

CODEBOOK = (Path(__file__).resolve().parents[2] / "docs" / "codebook.md").read_text(encoding="utf-8")
CLIENT = {name: value for name, value in record_of(1)["client"].items() if name != "hold_to_move"}


@pytest.fixture
def world(client):
    return make_world(client)


def successes(client, world, n):
    return [make_demonstration(client, world)["id"] for _ in range(n)]


def confirm(client, world, order, outcome="success"):
    body = {"order": order, "confirmed": True}
    response = client.put(f"/api/v1/worlds/{world['id']}/rankings/{outcome}", json=body)
    assert response.status_code == 200, response.text
    return response.json()


class Log:
    """A sitting as a page sends it."""

    def __init__(self, client, world, orders, *, way="lists", came_from="draft", agent="desktop Chromium"):
        self.client, self.world, self.id, self.events = client, world, str(uuid.uuid4()), []
        client_told = CLIENT | {"agent": agent}
        self.add("begin", "page", orders=orders, way=way, client=client_told, based_on={"success": 0, "failure": 0},
                 **{"from": {"success": came_from, "failure": came_from}})  # fmt: skip

    def add(self, type_, means="mouse", /, **fields):
        n = len(self.events)
        self.events.append({"n": n, "at_ms": 10.5 * n, "type": type_, "means": means, **fields})

    def confirm(self, order, outcome="success", *, untouched=False):
        """Confirm with everything that happened so far, and return the version."""
        self.add("confirm", "button", outcome=outcome, untouched=untouched)
        body = {
            "order": order, "confirmed": True, "untouched": untouched,
            "sitting": {"id": self.id, "events": self.events},
        }  # fmt: skip
        response = self.client.put(f"/api/v1/worlds/{self.world['id']}/rankings/{outcome}", json=body)
        assert response.status_code == 200, response.text
        return response.json()

    def send(self):
        url = f"/api/v1/worlds/{self.world['id']}/sittings/{self.id}/events"
        for start in range(0, len(self.events), 500):
            response = self.client.post(url, json={"events": self.events[start : start + 500]})
            assert response.status_code == 200, response.text


def table(client, world, name):
    answer = client.get(f"/api/v1/worlds/{world['id']}/{name}.csv")
    assert answer.status_code == 200
    assert answer.headers["content-type"].startswith("text/csv")
    return list(csv.DictReader(io.StringIO(answer.text)))


def lines(client, world):
    answer = client.get(f"/api/v1/worlds/{world['id']}/rankings.jsonl")
    assert answer.headers["content-type"].startswith("application/jsonl")
    return [json.loads(line) for line in answer.text.splitlines()]


def test_by_hand_each_attempt_of_a_version_has_a_row_with_both_ways_to_count(client, world):
    a, b, c, d = successes(client, world, 4)
    ranking = confirm(client, world, [[d], [a, c], [b]])
    rows = table(client, world, "rankings")
    assert [row["demonstration_id"] for row in rows] == [d, a, c, b]
    assert [row["display_rank"] for row in rows] == ["1", "2", "2", "4"]
    assert [row["paper_index"] for row in rows] == ["4.0", "2.5", "2.5", "1.0"]
    assert [row["tied_with"] for row in rows] == ["0", "1", "1", "0"]
    assert [float(row["theta"]) for row in rows] == [0.4, 0.25, 0.25, 0.1]
    assert [ranking["start_order"][int(row["start_place"]) - 1] for row in rows] == [d, a, c, b]
    (same,) = {tuple(row[name] for name in RANKING_COLUMNS[:10]) for row in rows}
    assert same == (
        world["id"], "success", "1", "true", "lists", same[5], "", "", "", "4"
    )  # fmt: skip


def test_every_version_is_there_oldest_first_and_the_newest_of_each_list_counts(client, world):
    a, b = successes(client, world, 2)
    failed = make_demonstration(client, world, failed=True)["id"]
    make_ranking(client, world, "success", [a, b])
    make_ranking(client, world, "failure", [failed])
    make_ranking(client, world, "success", [b, a])
    rows = table(client, world, "rankings")
    assert [(row["outcome"], row["version"], row["counts"]) for row in rows] == [
        *[("success", "1", "false")] * 2, ("failure", "1", "true"), *[("success", "2", "true")] * 2,
    ]  # fmt: skip
    told = [line for line in lines(client, world) if line["kind"] == "ranking"]
    assert [(line["outcome"], line["version"], line["counts"]) for line in told] == [
        ("success", 1, False), ("failure", 1, True), ("success", 2, True),
    ]  # fmt: skip


def test_by_hand_every_event_has_a_row_with_the_orders_after_it(client, world):
    a, b, c = successes(client, world, 3)
    failed = make_demonstration(client, world, failed=True)["id"]
    log = Log(client, world, {"success": [[a], [b], [c]], "failure": [[failed]]})
    log.add("watch", id=failed)
    log.add("place", outcome="success", id=c, group=0, joins=False)
    log.add("lift", "key", outcome="success", id=a)
    log.add("place", "key", outcome="success", id=a, group=1, joins=True)
    log.add("put_back", "key")
    log.add("swap", "button", outcome="success", id=a, **{"with": b})
    log.add("undo", "button")
    log.add("confirm", outcome="failure", untouched=True)
    log.confirm([[c], [a], [b]])
    rows = table(client, world, "ranking-events")
    assert [row["type"] for row in rows] == [event["type"] for event in log.events]
    assert [json.loads(row["event"]) for row in rows] == log.events
    assert [json.loads(row["success_order"]) for row in rows] == [
        *[[[a], [b], [c]]] * 2, *[[[c], [a], [b]]] * 2, [[c], [b, a]], [[c], [a], [b]], [[c], [b], [a]],
        *[[[c], [a], [b]]] * 3,
    ]  # fmt: skip
    assert {row["failure_order"] for row in rows} == {json.dumps([[failed]])}
    assert [(row["rank_before"], row["rank_after"]) for row in rows] == [
        ("", ""), ("1", "1"), ("3", "1"), ("2", "2"), ("2", "2"), ("2", "2"), ("2", "3"), ("", ""), ("", ""), ("", ""),
    ]  # fmt: skip
    assert [row["demonstration_id"] for row in rows] == ["", failed, c, a, a, a, a, "", "", ""]
    assert [row["outcome"] for row in rows] == [
        "", "failure", *["success"] * 5, "", "failure", "success"
    ]  # fmt: skip
    assert [row["other_id"] for row in rows if row["other_id"]] == [b]
    assert [row["changed"] for row in rows] == [
        "true" if n in {2, 4, 5, 6, 7} else "false" for n in range(10)
    ]  # fmt: skip
    assert [row["version"] for row in rows] == [*[""] * 9, "1"]
    assert [row["means"] for row in rows[:5]] == ["page", "mouse", "mouse", "key", "key"]
    assert [float(row["at_ms"]) for row in rows] == [10.5 * n for n in range(10)]
    assert {(row["sitting"], row["sitting_id"], row["way"]) for row in rows} == {("1", log.id, "lists")}


def test_the_table_of_events_gives_every_stored_version(client, world):
    ids = successes(client, world, 4)
    for k in range(3):
        log = Log(client, world, {"success": [[one] for one in ids], "failure": []})
        log.add("place", outcome="success", id=ids[3], group=k, joins=True)
        log.confirm([[*([ids[j]]), *([ids[3]] if j == k else [])] for j in range(3)])
        log.add("swap", outcome="success", id=ids[0], **{"with": ids[1]})
        stands = [[ids[1], *([ids[3]] if k == 0 else [])], [ids[0], *([ids[3]] if k == 1 else [])],
                  [ids[2], *([ids[3]] if k == 2 else [])]]  # fmt: skip
        log.confirm(stands)
    versions = client.get(f"/api/v1/worlds/{world['id']}/rankings/success/versions").json()
    at = {(row["sitting_id"], int(row["n"])): row for row in table(client, world, "ranking-events")}
    assert len(versions) == 6
    for version in versions:
        row = at[version["sitting_id"], version["n_events"] - 1]
        assert json.loads(row["success_order"]) == version["order"]
        assert (row["type"], int(row["version"])) == ("confirm", version["version"])
    assert {row["sitting"] for row in at.values()} == {"1", "2", "3"}


def test_a_long_log_and_many_versions_come_whole(client, world):
    ids = successes(client, world, 23)
    order = [[one] for one in ids]
    log = Log(client, world, {"success": order, "failure": []})
    for n in range(450):
        log.add("swap", outcome="success", id=ids[n % 23], **{"with": ids[(n + 1) % 23]})
    log.send()
    rows = table(client, world, "ranking-events")
    assert [int(row["n"]) for row in rows] == list(range(451))
    for _ in range(23):
        confirm(client, world, order)
    rows = table(client, world, "rankings")
    assert [int(row["version"]) for row in rows] == [version for version in range(1, 24) for _ in ids]
    told = lines(client, world)
    assert [line["kind"] for line in told] == ["world", *["demonstration"] * 23, *["ranking"] * 23]
    assert [line["id"] for line in told if line["kind"] == "demonstration"] == ids


def test_the_file_is_read_by_our_own_library_and_learned_from(client, world):
    a, b, gone = successes(client, world, 3)
    failed = make_demonstration(client, world, failed=True)["id"]
    confirm(client, world, [[gone], [a], [b]])
    confirm(client, world, [[b], [gone, a]])
    confirm(client, world, [[failed]], "failure")
    client.put(f"/api/v1/demonstrations/{gone}/discard")
    text = client.get(f"/api/v1/worlds/{world['id']}/rankings.jsonl").text
    file = read_demonstration_file(text.splitlines())
    assert file.to_text() == text
    assert {ranking.outcome: ranking.groups for ranking in file.rankings} == {
        "success": ((b,), (a,)), "failure": ((failed,),),
    }  # fmt: skip
    assert [one.id for one in file.sections[0].discarded] == [gone]
    assert file.sections[0].world_id == world["id"]
    problem = LearningProblem.build(file.world, file.demonstrations, file.rankings)
    assert len(problem.demonstrations) == 3


def test_a_line_of_the_file_says_all_of_a_version(client, world):
    a, b, c = successes(client, world, 3)
    log = Log(client, world, {"success": [[a], [b], [c]], "failure": []}, way="pairwise")
    log.add("answer", "key", outcome="success", a=a, b=c, said="b")
    log.add("set", "page", outcome="success", order=[[c], [a, b]], by="pairwise")
    ranking = log.confirm([[c], [a, b]])
    (line,) = [line for line in lines(client, world) if line["kind"] == "ranking"]
    assert line == {
        "kind": "ranking",
        "world_id": world["id"],
        **ranking,
        "display_rank": display_ranks(ranking["order"]),
        "paper_index": paper_index(ranking["order"]),
    }
    assert line["given"] == [{"a": a, "b": c, "said": "b"}]
    assert (line["way"], line["sitting_id"], line["n_events"]) == ("pairwise", log.id, 4)
    assert line["weights"] == rank_weights([[c], [a, b]])
    rows = table(client, world, "rankings")
    assert {(row["way"], row["sitting_id"], row["n_events"], row["untouched"]) for row in rows} == {
        ("pairwise", log.id, "4", "false")
    }


def exported(client, world):
    """What was given and the order, as the file has them last."""
    return [(line["given"], line["order"]) for line in lines(client, world) if line["kind"] == "ranking"][-1]


def test_answers_marks_and_gaps_that_are_exported_can_be_converted_again(client, world):
    a, b, c = ids = successes(client, world, 3)
    start = {"success": [[one] for one in ids], "failure": []}
    log = Log(client, world, start, way="pairwise")
    log.add("answer", outcome="success", a=a, b=c, said="b")
    log.add("answer", outcome="success", a=a, b=b, said="alike")
    log.add("set", "page", outcome="success", order=[[c], [a, b]], by="pairwise")
    log.confirm([[c], [a, b]])
    given, order = exported(client, world)
    assert [list(group) for group in order_from_comparisons(ids, given)] == order
    log = Log(client, world, start, way="segments")
    log.add("stretch", id=b, kind="good", **{"from": 1, "to": 3})
    log.add("stretch", id=b, kind="bad", **{"from": 3, "to": 3})
    log.add("set", "page", outcome="success", order=[[b], [a, c]], by="segments")
    log.confirm([[b], [a, c]])
    given, order = exported(client, world)
    assert given == {b: [{"from": 1, "to": 2, "kind": "good"}, {"from": 3, "to": 3, "kind": "bad"}]}
    n_steps = {one: len(best_path(world)) for one in ids}
    assert [list(group) for group in order_from_stretches(given, n_steps, outcome="success")] == order
    log = Log(client, world, start, way="magnitude")
    log.add("gap", outcome="success", above=a, below=b, value=70)
    log.add("gap", outcome="success", above=b, below=c, value=5)
    log.confirm(start["success"])
    given, order = exported(client, world)
    assert positions_from_gaps(order, given) == {a: 75, b: 5, c: 0}


def test_the_file_of_a_run_counts_both_ways(client, world):
    a, b = successes(client, world, 2)
    confirm(client, world, [[b], [a]])
    run = client.post(f"/api/v1/worlds/{world['id']}/runs", json={"learners": ["meirl"]}).json()
    text = client.get(f"/api/v1/runs/{run['id']}/demonstrations.jsonl").text
    (told,) = [json.loads(line) for line in text.splitlines() if '"kind": "ranking"' in line]
    assert (told["display_rank"], told["paper_index"]) == ({b: 1, a: 2}, {b: 2.0, a: 1.0})
    assert read_demonstration_file(text.splitlines()).rankings[0].groups == ((b,), (a,))


@pytest.mark.parametrize(("name", "columns"), [("rankings", RANKING_COLUMNS), ("ranking-events", EVENT_COLUMNS)])
def test_who_has_ranked_nothing_gets_a_header_alone(client, other_client, world, name, columns):
    ids = successes(client, world, 2)
    Log(client, world, {"success": [[one] for one in ids], "failure": []}).confirm([[one] for one in ids])
    for other in (other_client, open_client(client.app)):
        answer = other.get(f"/api/v1/worlds/{world['id']}/{name}.csv")
        assert answer.text == ",".join(columns) + "\r\n"
        assert f'filename="irlfr-{world["id"][:8]}-{name}.csv"' in answer.headers["content-disposition"]
        assert [line["kind"] for line in lines(other, world)] == ["world"]
    assert table(client, world, name)


def test_what_comes_while_a_table_is_sent_is_not_in_it(client, world):
    a, b = successes(client, world, 2)
    ranking = confirm(client, world, [[a], [b]])
    database = client.app.state.database
    with database.read() as session:
        visitor_id = session.connection().exec_driver_sql("SELECT visitor_id FROM ranking").scalar()
        stored = find_world(session, world["id"])
    assert stored
    pieces = exports.rankings_file(database, visitor_id, stored)
    begun = next(pieces)
    new = make_demonstration(client, world)["id"]
    confirm(client, world, [[new], [b], [a]])
    file = read_demonstration_file([begun, *pieces])
    assert [list(group) for group in file.rankings[0].groups] == ranking["order"]


@pytest.mark.parametrize("agent", ["=1+1", "+1", "-1", "@SUM(A1)", 'a "b", c'])
def test_no_text_begins_a_formula_and_each_stays_one_cell(client, world, agent):
    (one,) = successes(client, world, 1)
    Log(client, world, {"success": [[one]], "failure": []}, agent=agent).confirm([[one]])
    for name in ("rankings", "ranking-events"):
        for row in table(client, world, name):
            assert not any(cell.startswith(("=", "+", "-", "@", "\t", "\r")) for cell in row.values())
    assert json.loads(table(client, world, "ranking-events")[0]["event"])["client"]["agent"] == agent


def section(title):
    """A section of the codebook."""
    (found,) = [part for part in re.split(r"^## ", CODEBOOK, flags=re.MULTILINE) if part.startswith(f"{title}\n")]
    return found


def first_cells(text):
    return re.findall(r"^\| `([^`]+)` \|", text, flags=re.MULTILINE)


@pytest.mark.parametrize(
    ("title", "names"),
    [
        ("The table of rankings", list(RANKING_COLUMNS)),
        ("The table of events", list(EVENT_COLUMNS)),
        ("An order", list(RankingOut.model_fields)),
        ("The file of rankings", ["display_rank", "paper_index"]),
        ("Agreement", list(AgreementOut.model_fields)),
        ("What each way comes to", ["lists", "pairwise", "magnitude", "segments"]),
    ],
)
def test_the_codebook_has_every_column_and_field_in_its_order(title, names):
    assert first_cells(section(title)) == names


def test_the_codebook_has_every_event_with_its_fields():
    told = re.findall(r"^\| `(\w+)` \|([^|]*)\|", section("The log of a sitting"), flags=re.MULTILINE)
    of_every_event = ["n", "at_ms", "type", "means"]
    assert [name for name, _ in told[:4]] == of_every_event
    fields = {
        name: [field.alias or key for key, field in kind.model_fields.items() if key not in of_every_event]
        for name, kind in EVENTS.items()
    }
    assert {name: re.findall(r"`(\w+)`", cell) for name, cell in told[4:]} == fields
    assert f"at most {MOST_EVENTS:,} events" in section("The log of a sitting")


def test_every_function_the_codebook_names_is_there():
    names = re.findall(r"`(irl_core\.[\w.]+)`", CODEBOOK)
    for name in names:
        module, _, function = name.rpartition(".")
        assert callable(getattr(import_module(module), function)), name
    assert len(names) >= 4


def test_the_codebooks_example_of_ranks_and_indices_holds():
    example = re.search(r"^\| place \*p\* (.*?)\n\n", section("An order"), flags=re.MULTILINE | re.DOTALL)
    assert example
    cells = [line.split("|")[2:-1] for line in example[0].strip().splitlines()]
    _, ranks, indices, weights = [[float(cell) for cell in row] for row in cells]
    order = [["a"], ["b", "c"], ["d"]]
    assert ranks == list(display_ranks(order).values())
    assert indices == list(paper_index(order).values())
    assert weights == list(rank_weights(order).values())
