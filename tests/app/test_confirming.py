"""Confirming an order through the API, with the sitting that led to it: once, whole, and which version counts."""

from app.config import WAYS
from app.rankings import replay
from tests.factories import make_demonstration, make_ranking
from tests.sitting import Sitting, error, stored


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
