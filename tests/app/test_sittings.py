"""Sittings through the API: the log of how an order came to be, and the versions confirmed from it."""

import threading
import uuid
from typing import Any

import pytest
from sqlalchemy import text

from app.config import WAYS
from app.rankings import replay, sittings
from tests.factories import make_demonstration, make_ranking, make_world
from tests.sitting import Sitting

NOBODYS = str(uuid.uuid4())


@pytest.fixture
def world(client):
    return make_world(client)


@pytest.fixture
def ids(client, world):
    """Three successes."""
    return [make_demonstration(client, world)["id"] for _ in range(3)]


@pytest.fixture
def sitting(client, world, ids):
    """A sitting that has begun over three successes and a failure; nothing of it is sent."""
    make_demonstration(client, world, failed=True)
    begun = Sitting(client, world)
    begun.begin()
    return begun


def stored(client, table="ranking_event"):
    with client.app.state.database.read() as session:
        return session.scalar(text(f"SELECT count(*) FROM {table}"))


def error(response, status, code):
    """The error of a response that must have this status and code."""
    assert (response.status_code, response.json()["error"]["code"]) == (status, code), response.text
    return response.json()["error"]


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


def test_an_order_is_stored_with_the_sitting_that_led_to_it(client, sitting, ids):
    a, b, c = ids
    sitting.set("success", [[c], [a], [b]])
    sitting.send()
    sitting.do("place", outcome="success", id=b, group=1, joins=True, means="key")
    ranking = sitting.confirm("success", [[c], [a, b]], based_on=0).json()
    told = {
        name: ranking[name] for name in ("version", "way", "given", "sitting_id", "n_events", "untouched", "counts")
    }
    assert told == {
        "version": 1, "way": "lists", "given": None, "sitting_id": sitting.id, "n_events": 4, "untouched": False,
        "counts": True,
    }  # fmt: skip
    assert ranking["weights"] == {c: 3 / 6, a: 1.5 / 6, b: 1.5 / 6}
    assert stored(client) == 4


def test_the_same_confirmation_again_gives_the_version_it_gave(client, world, sitting, ids):
    order = [ids[:1], ids[1:]]
    sitting.set("success", order)
    first = sitting.confirm("success", order, based_on=0).json()
    assert sitting.put("success", order, based_on=0).json() == first
    assert sitting.put("success", order, events=[]).json() == first
    client.put(f"/api/v1/demonstrations/{ids[0]}/discard")
    sitting.do("visible")
    sitting.send()
    assert sitting.put("success", order, events=sitting.log[:3]).json() == first
    error(sitting.put("success", order[::-1], events=sitting.log[:3]), 422, "log_differs")
    assert (
        "must be its confirm" in error(sitting.put("failure", order, events=sitting.log[:3]), 422, "invalid")["message"]
    )
    client.delete(f"/api/v1/demonstrations/{ids[0]}/discard")
    make_ranking(client, world, "success", ids)
    assert sitting.put("success", order, events=sitting.log[:3]).json() == first | {"counts": False}
    assert stored(client, "ranking") == 2


def test_a_confirm_that_the_log_went_past_still_gives_its_version(client, sitting, ids):
    order = [ids[:1], ids[1:]]
    sitting.set("success", order)
    sitting.do("confirm", outcome="success", untouched=False)
    led_here = list(sitting.log)
    sitting.set("success", order[::-1])
    sitting.send()
    ranking = sitting.put("success", order, events=led_here).json()
    assert (ranking["order"], ranking["n_events"]) == (order, 3)


def test_confirming_twice_gives_two_versions(client, sitting, ids):
    order = [ids[:1], ids[1:]]
    sitting.set("success", order)
    versions = [sitting.confirm("success", order, based_on=k).json() for k in range(2)]
    assert [(one["version"], one["n_events"]) for one in versions] == [(1, 3), (2, 4)]


def test_the_last_event_must_be_the_confirm_of_this_list(client, sitting, ids):
    order = [ids[:1], ids[1:]]
    sitting.set("success", order)
    assert "sitting" in error(sitting.put("success", order), 422, "invalid")["fields"]
    sitting.do("confirm", outcome="failure", untouched=True)
    error(sitting.put("success", order), 422, "invalid")
    assert stored(client) == stored(client, "ranking") == 0


def test_an_order_that_the_log_does_not_lead_to_is_refused(client, sitting, ids):
    sitting.set("success", [ids[:1], ids[1:]])
    error(sitting.confirm("success", [ids[:2], ids[2:]]), 422, "log_differs")
    assert stored(client) == stored(client, "ranking") == 0


def test_an_untouched_random_order_is_no_answer_until_it_is_said_to_be(client, sitting):
    drawn = [[one] for one in sitting.drawn()["success"]]
    assert "untouched" in error(sitting.confirm("success", drawn), 422, "untouched")["fields"]
    assert sitting.put("success", drawn, untouched=True).json()["untouched"] is True


def test_one_card_needs_no_touch_nor_does_an_order_of_before(client, world, sitting, ids):
    failed = sitting.log[0]["orders"]["failure"]
    assert sitting.confirm("failure", failed).json()["untouched"] is True
    make_ranking(client, world, "success", ids)
    again, order = Sitting(client, world), [[one] for one in ids]
    again.begin(orders={"success": order, "failure": []}, origins={"success": "version", "failure": "random"})
    assert again.confirm("success", order).json()["untouched"] is True


def test_what_was_moved_and_moved_back_is_touched(client, sitting):
    drawn = [[one] for one in sitting.drawn()["success"]]
    sitting.set("success", drawn[::-1])
    sitting.do("undo")
    assert sitting.confirm("success", drawn).json()["untouched"] is False


def test_attempts_that_came_meanwhile_are_named_and_nothing_is_lost(client, world, sitting, ids):
    order = [ids[:1], ids[1:]]
    sitting.set("success", order)
    sitting.send()
    new = [make_demonstration(client, world)["id"] for _ in range(2)]
    refused = error(sitting.confirm("success", order), 409, "new_attempts")
    assert refused["fields"] == {"missing": ", ".join(sorted(new))}
    assert stored(client) == 2
    sitting.do("cards", outcome="success", added=new, removed=[], means="page")
    ranking = sitting.confirm("success", [*order, [new[0]], [new[1]]]).json()
    assert (ranking["version"], ranking["n_events"]) == (1, 5)


def test_what_the_log_knows_and_the_order_lacks_is_missing_as_ever(client, sitting, ids):
    sitting.set("success", [ids])
    refused = error(sitting.confirm("success", [[ids[0]], [ids[1]]]), 422, "invalid")
    assert "missing" in refused["message"]


def test_what_was_discarded_meanwhile_is_named(client, sitting, ids):
    order = [ids[:1], ids[1:]]
    sitting.set("success", order)
    client.put(f"/api/v1/demonstrations/{ids[1]}/discard")
    refused = error(sitting.confirm("success", order), 422, "invalid")
    assert f"discarded (restore it first): {ids[1]}" in refused["message"]
    sitting.do("cards", outcome="success", added=[], removed=[ids[1]], means="page")
    assert sitting.confirm("success", [[ids[0]], [ids[2]]]).json()["version"] == 1


def test_two_tabs_that_confirm_in_turn_keep_both_versions_and_one_counts(client, world, ids):
    first, second = Sitting(client, world), Sitting(client, world)
    orders = [[ids[:2], ids[2:]], [ids]]
    for tab, order in zip((first, second), orders, strict=True):
        tab.begin()
        tab.set("success", order)
    assert first.confirm("success", orders[0], based_on=0).json()["version"] == 1
    assert error(second.confirm("success", orders[1], based_on=0), 409, "stale_version")["fields"] == {"version": "1"}
    assert second.put("success", orders[1], based_on=1).json()["version"] == 2
    versions = client.get(f"/api/v1/worlds/{world['id']}/rankings/success/versions").json()
    assert [(one["version"], one["order"], one["counts"], one["sitting_id"]) for one in versions] == [
        (2, orders[1], True, second.id), (1, orders[0], False, first.id),
    ]  # fmt: skip
    newest = client.get(f"/api/v1/worlds/{world['id']}/rankings").json()["success"]
    assert newest == versions[0]


def test_what_was_confirmed_earlier_in_the_sitting_is_no_conflict_even_if_its_answer_was_lost(client, sitting, ids):
    sitting.set("success", [ids])
    lost = sitting.confirm("success", [ids], based_on=0)
    sitting.set("success", [ids[:1], ids[1:]])
    assert (lost.status_code, sitting.confirm("success", [ids[:1], ids[1:]], based_on=0).json()["version"]) == (200, 2)


def test_a_confirmation_that_comes_after_a_later_one_of_its_sitting_does_not_count(client, sitting, ids):
    sitting.set("success", [ids])
    sitting.do("confirm", outcome="success", untouched=False)
    late = list(sitting.log)
    sitting.set("success", [ids[:1], ids[1:]])
    assert sitting.confirm("success", [ids[:1], ids[1:]], based_on=0).json()["version"] == 1
    error(sitting.put("success", [ids], events=late, based_on=0), 409, "stale_version")


def test_a_stale_version_is_named_without_a_sitting_too(client, world, ids):
    make_ranking(client, world, "success", ids)
    url, body = f"/api/v1/worlds/{world['id']}/rankings/success", {"order": [ids], "confirmed": True}
    assert error(client.put(url, json=body | {"based_on": 0}), 409, "stale_version")["fields"] == {"version": "1"}
    ranking = client.put(url, json=body | {"based_on": 1}).json()
    untold = {name: ranking[name] for name in ("way", "given", "sitting_id", "n_events", "untouched")}
    assert untold == {"way": "lists", "given": None, "sitting_id": None, "n_events": None, "untouched": None}


def test_each_way_is_stored_as_it_was_said(client, sitting, ids):
    a, b, c = ids
    order, failed = [[a], [b, c]], sitting.log[0]["orders"]["failure"][0][0]
    sitting.set("success", order)
    sitting.do("answer", outcome="success", a=a, b=c, said="a")
    sitting.do("gap", outcome="success", above=a, below=b, value=60)
    sitting.do("stretch", id=b, **{"from": 2, "to": 4}, kind="bad")
    sitting.do("stretch", id=b, **{"from": 3, "to": 3}, kind="good")
    sitting.do("stretch", id=failed, **{"from": 1, "to": 1}, kind="bad")
    given = []
    for way in WAYS:
        sitting.do("way", way=way)
        ranking = sitting.confirm("success", order).json()
        assert ranking["way"] == way
        given.append(ranking["given"])
    marked = [
        {"from": 2, "to": 2, "kind": "bad"},
        {"from": 3, "to": 3, "kind": "good"},
        {"from": 4, "to": 4, "kind": "bad"},
    ]
    assert given == [
        None, [{"a": a, "b": c, "said": "a"}], [{"above": a, "below": b, "value": 60}], {b: marked},
    ]  # fmt: skip


def test_the_log_rebuilds_every_stored_version(client, world, sitting, ids):
    for k, order in enumerate([[ids[:1], ids[1:]], [ids], [[ids[2]], [ids[0], ids[1]]]]):
        sitting.set("success", order)
        sitting.do("answer", outcome="success", a=ids[0], b=ids[1 + k % 2], said="alike")
        sitting.do("way", way=WAYS[k])
        assert sitting.confirm("success", order).status_code == 200
    for version in client.get(f"/api/v1/worlds/{world['id']}/rankings/success/versions").json():
        state = replay.rebuild(sitting.log[: version["n_events"]])
        assert [list(group) for group in state.orders["success"]] == version["order"]
        assert replay.given(state, "success") == version["given"]
