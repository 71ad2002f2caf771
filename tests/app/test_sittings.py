"""The log of a sitting through the API: kept as it was sent, in order, by its owner alone."""

import threading
import uuid
from typing import Any

import pytest
from sqlalchemy import text

from app.rankings import sittings
from tests.factories import make_demonstration, make_ranking, make_world
from tests.sitting import Sitting, error, stored

NOBODYS = str(uuid.uuid4())


def test_events_are_kept_as_they_were_sent(client, sitting, ids):
    sitting.do("place", outcome="success", id=ids[0].upper(), group=2, joins=False)
    sitting.do("gap", outcome="success", above=ids[1], below=ids[2], value=None)
    assert sitting.send().json() == {"id": sitting.id, "n_events": 3}
    with client.app.state.database.read() as session:
        rows = session.execute(text("SELECT n, type, means, at_ms, event ->> 'id' FROM ranking_event ORDER BY n"))
        assert [tuple(row) for row in rows] == [
            (0, "begin", "page", 0.0, None), (1, "place", "mouse", 10.5, ids[0]), (2, "gap", "mouse", 21.0, None),
        ]  # fmt: skip


def test_sending_again_does_no_harm(client, sitting, ids):
    sitting.do("lift", outcome="success", id=ids[0])
    assert sitting.send().status_code == 200
    sitting.do("drop")
    for events in (sitting.log, sitting.log[1:], sitting.log[2:], sitting.log[:1]):
        assert sitting.send(events).json()["n_events"] == 3
    assert stored(client) == 3


def test_another_event_under_a_stored_number_is_a_conflict(client, sitting, ids):
    sitting.do("lift", outcome="success", id=ids[0])
    sitting.send()
    other = sitting.log[1] | {"id": ids[1]}
    assert error(sitting.send([other]), 409, "conflict")["fields"] == {"n": "1"}
    assert error(sitting.send([sitting.log[0], other, sitting.do("drop")]), 409, "conflict")
    assert stored(client) == 2


def test_a_gap_in_the_log_is_named(client, sitting, ids):
    sitting.do("watch", id=ids[0])
    sitting.do("watch", id=ids[1])
    assert error(sitting.send(sitting.log[1:]), 409, "log_gap")["fields"] == {"n_events": "0"}
    sitting.send(sitting.log[:1])
    assert error(sitting.send(sitting.log[2:]), 409, "log_gap")["fields"] == {"n_events": "1"}
    assert "2" in error(sitting.send([sitting.log[0], sitting.log[2]]), 422, "invalid")["fields"]["n"]
    assert stored(client) == 1


def test_an_order_alone_needs_a_log(client, sitting, ids):
    response = sitting.put("success", [[one] for one in ids], events=[])
    assert error(response, 409, "log_gap")["fields"] == {"n_events": "0"}


def test_another_visitors_sitting_tells_nothing(client, other_client, world, sitting):
    make_demonstration(other_client, world)
    sitting.send()
    theirs = Sitting(other_client, world)
    theirs.id = sitting.id
    theirs.begin()
    assert "order" not in error(theirs.send(), 404, "not_found")["message"]
    error(theirs.confirm("success", []), 404, "not_found")
    assert stored(client) == 1


def test_a_sitting_is_of_one_world(client, sitting):
    sitting.send()
    sitting.world = make_world(client, seed=6)
    error(sitting.send(), 404, "not_found")


def test_who_has_played_nothing_has_nothing_to_order(client, other_client, world):
    sitting = Sitting(other_client, world)
    sitting.begin()
    assert "nothing to order" in error(sitting.send(), 422, "invalid")["message"]
    assert stored(client, "sitting") == 0


def test_a_sitting_may_begin_with_empty_lists(client, world, ids):
    sitting = Sitting(client, world)
    sitting.begin(orders={"success": [], "failure": []})
    sitting.do("cards", means="page", outcome="success", added=ids, removed=[])
    assert sitting.send().status_code == 200


def test_more_than_the_most_in_a_body_is_refused(sitting, ids):
    for _ in range(501):
        sitting.do("watch", id=ids[0])
    error(sitting.send(), 422, "invalid")
    assert sitting.send(sitting.log[:500]).json()["n_events"] == 500
    assert sitting.send(sitting.log[500:]).json()["n_events"] == 502


def test_a_sitting_has_an_end(sitting, ids):
    late = sitting.do("watch", id=ids[0]) | {"n": 20_000}
    assert "events.0" in next(iter(error(sitting.send([late]), 422, "invalid")["fields"]))


WRONG = {
    "a second begin": lambda s, _: s.begin(),
    "a card that nobody played": lambda s, _: s.do("place", outcome="success", id=NOBODYS, group=0, joins=True),
    "a card of the other list": lambda s, ids: s.do("place", outcome="failure", id=ids[0], group=0, joins=False),
    "a place beyond the others": lambda s, ids: s.do("place", outcome="success", id=ids[0], group=3, joins=False),
    "a tie with no group": lambda s, ids: s.do("place", outcome="success", id=ids[0], group=2, joins=True),
    "a card swapped with itself": lambda s, ids: s.do("swap", outcome="success", id=ids[0], **{"with": ids[0]}),
    "an order that lacks a card": lambda s, ids: s.set("success", [[ids[0]], [ids[1]]]),
    "an order with a card twice": lambda s, ids: s.set("success", [[ids[0]], [ids[1]], [ids[2], ids[0]]]),
    "a drop without a lift": lambda s, _: s.do("drop"),
    "putting back what is not lifted": lambda s, _: s.do("put_back"),
    "an undo of nothing": lambda s, _: s.do("undo"),
    "a redo of nothing": lambda s, _: s.do("redo"),
    "an answer about one card": lambda s, ids: s.do("answer", outcome="success", a=ids[0], b=ids[0], said="a"),
    "a gap within one card": lambda s, ids: s.do("gap", outcome="success", above=ids[0], below=ids[0], value=5),
    "a stretch that runs back": lambda s, ids: s.do("stretch", id=ids[0], **{"from": 3, "to": 2}, kind="good"),
    "a stretch past the end": lambda s, ids: s.do("stretch", id=ids[0], **{"from": 1, "to": 5000}, kind="good"),
    "a card that is there added": lambda s, ids: s.do("cards", outcome="success", added=[ids[0]], removed=[]),
    "a card that is not there removed": lambda s, _: s.do("cards", outcome="failure", added=[], removed=[NOBODYS]),
    "a foreign card added": lambda s, _: s.do("cards", outcome="success", added=[NOBODYS], removed=[]),
    "a replay of a foreign card": lambda s, _: s.do("watch", id=NOBODYS),
    "a comparison with a foreign card": lambda s, ids: s.do("compare", a=ids[0], b=NOBODYS),
    "a time before the last": lambda s, _: s.do("hidden", at_ms=10.4),
}  # fmt: skip


def test_what_cannot_have_happened_is_refused_by_its_number_and_nothing_is_stored(client, sitting, ids):
    sitting.do("visible")
    good = list(sitting.log)
    for what, wrong in WRONG.items():
        sitting.log = [*good]
        refused = error(sitting.send([*good, wrong(sitting, ids) | {"n": 2}]), 422, "invalid")
        assert refused["fields"]["n"] == "2", what
        assert refused["message"].startswith("Event 2 of this sitting cannot be: "), what
        assert stored(client) == stored(client, "sitting") == 0
    assert sitting.send(good).json()["n_events"] == 2


def test_a_sitting_begins_with_ones_own_attempts_as_they_were_drawn(client, other_client, world, ids):
    drawn, failed = Sitting(client, world).drawn()["success"], make_demonstration(client, world, failed=True)["id"]
    foreign = make_demonstration(other_client, world)["id"]
    elsewhere = make_demonstration(client, make_world(client, seed=6), failed=True)["id"]
    wrong = [
        [drawn[::-1], [failed]], [[*drawn, foreign], []], [drawn, [elsewhere]], [[*drawn, failed], []], [[], drawn],
        [[*drawn, drawn[0]], []], [[NOBODYS], []],
    ]  # fmt: skip
    as_drawn, as_left = [dict.fromkeys(("success", "failure"), origin) for origin in ("random", "draft")]
    for origins, told in ((as_drawn, wrong), (as_left, wrong[1:])):
        for success, failure in told:
            sitting = Sitting(client, world)
            orders = {"success": [[one] for one in success], "failure": [[one] for one in failure]}
            sitting.begin(orders=orders, origins=origins)
            assert error(sitting.send(), 422, "invalid")["fields"]["n"] == "0"
    tied = Sitting(client, world)
    tied.begin(orders={"success": [drawn], "failure": []})
    error(tied.send(), 422, "invalid")
    assert stored(client, "sitting") == 0


def test_a_sitting_may_begin_with_what_was_discarded_since(client, sitting, ids):
    client.put(f"/api/v1/demonstrations/{ids[0]}/discard")
    assert sitting.send().status_code == 200
    sitting.do("cards", means="page", outcome="success", added=[], removed=[ids[0]])
    assert sitting.send().status_code == 200


def test_a_sitting_may_begin_with_an_order_of_before(client, world, sitting, ids):
    make_ranking(client, world, "success", ids[::-1])
    again = Sitting(client, world)
    origins = {"success": "version", "failure": "draft"}
    again.begin(orders={"success": [[one] for one in ids[::-1]], "failure": []}, origins=origins)
    assert again.send().status_code == 200


def test_two_requests_at_once_store_every_event_once(client, sitting, ids):
    sitting.send()
    for _ in range(60):
        sitting.do("watch", id=ids[0])
    answers = []
    senders = [threading.Thread(target=lambda: answers.append(sitting.send(sitting.log[1:]))) for _ in range(6)]
    for sender in senders:
        sender.start()
    for sender in senders:
        sender.join()
    assert [answer.json() for answer in answers] == [{"id": sitting.id, "n_events": 61}] * 6
    assert stored(client) == 61


@pytest.mark.parametrize("is_begun", [True, False])
def test_a_request_that_another_one_overtakes_after_its_check_begins_anew(client, sitting, ids, monkeypatch, is_begun):
    if is_begun:
        sitting.send()
    sitting.do("watch", id=ids[0])
    check = sittings._check
    overtakers: list[Any] = []

    def overtaken(*told):
        batch = check(*told)
        if not overtakers:
            overtakers.append(None)  # the overtaker itself is checked undisturbed
            overtakers[0] = sitting.send()
        return batch

    monkeypatch.setattr(sittings, "_check", overtaken)
    assert sitting.send().json() == overtakers[0].json() == {"id": sitting.id, "n_events": 2}
    assert stored(client) == 2


def test_a_log_is_gone_through_again_by_a_server_that_has_forgotten_it(client, sitting, ids):
    sitting.set("success", [ids])
    sitting.send()
    client.app.state.sittings._known._logs.clear()
    sitting.do("undo")
    assert sitting.send().status_code == 200
    sitting.do("undo")
    assert "nothing to undo" in error(sitting.send(), 422, "invalid")["message"]


def test_a_server_remembers_no_more_than_it_may(client, world, sitting, ids, monkeypatch):
    monkeypatch.setattr("app.rankings.sittings.MOST_KNOWN", 250)
    known = client.app.state.sittings._known._logs
    for _ in range(4):
        one = Sitting(client, world)
        one.begin()
        one.send()
        for _ in range(4):
            one.do("watch", id=ids[0])
            assert one.send().status_code == 200
    assert len(known) == 2  # of a hundred and some each


def test_what_is_asked_again_of_an_early_event_forgets_no_later_one(client, sitting, ids):
    sitting.set("success", [ids])
    assert sitting.confirm("success", [ids]).status_code == 200
    early = list(sitting.log)
    sitting.do("watch", id=ids[0])
    for _ in range(2):  # what is remembered is what was stored before a request
        sitting.send()
    assert sitting.put("success", [ids], events=early).status_code == 200
    assert client.app.state.sittings._known._logs[sitting.id].n_events == 4


def test_a_log_that_would_take_all_memory_is_refused(client, sitting, ids, monkeypatch):
    monkeypatch.setattr("app.rankings.log.MOST_HELD", 100)
    for _ in range(20):
        sitting.do("answer", outcome="success", a=ids[0], b=ids[1], said="a")
    assert "too long" in error(sitting.send(), 422, "invalid")["message"]
    monkeypatch.setattr("app.rankings.log.MOST_CARRIED", 50)
    del sitting.log[4:]
    for _ in range(20):
        sitting.do("cards", outcome="success", added=[], removed=[])
    assert "too long" in error(sitting.send(), 422, "invalid")["message"]
    assert stored(client) == 0
