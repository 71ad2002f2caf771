"""What must hold of a sitting whatever a person does: any events, in any order."""

import random
import string
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from app.config import WAYS
from app.models import Ranking
from app.models import Sitting as StoredSitting
from app.rankings import queries, replay
from app.rankings.content import OUTCOMES, flat
from app.rankings.replay import InvalidEvent, State
from irl_core import rank_weights
from tests.factories import attempt, make_world, post_demonstration
from tests.sitting import Sitting

COMMON = settings(max_examples=250, deadline=None, suppress_health_check=[HealthCheck.too_slow])
CARDS = string.ascii_letters
POOL = dict.fromkeys(OUTCOMES, CARDS)

Json = dict[str, Any]


@st.composite
def begins(draw):
    """Two lists of up to seven cards in any order, ties included."""
    n, m = draw(st.integers(0, 7)), draw(st.integers(0, 7))
    ids = CARDS[:n], CARDS[n : n + m]
    told = {outcome: grouped(one, draw(st.integers(0, 10**6))) for outcome, one in zip(OUTCOMES, ids, strict=True)}
    return {"type": "begin", "orders": told, "way": draw(st.sampled_from(WAYS))}


def grouped(ids, seed: int) -> list[list[str]]:
    """One of all orders of these cards."""
    rng = random.Random(seed)
    groups: list[list[str]] = []
    for one in rng.sample(list(ids), len(ids)):
        if groups and rng.random() < 0.3:
            groups[-1].append(one)
        else:
            groups.append([one])
    return groups


CHANGES = ("place", "place", "place", "swap", "set", "answer", "gap", "stretch")
REST = ("lift", "drop", "put_back", "undo", "undo", "redo", "cards", "way", "watch", "confirm")
FIELDS = ("n", "at_ms", "type", "means", "outcome", "id", "order", "group", "from", "added", "way", "client")
IN_ONE_LIST = ("place", "swap", "set", "answer", "gap", "lift", "cards", "confirm")
numbers = st.integers(0, 60)


def gestures(kinds: tuple[str, ...]):
    """What a hand may do: a kind of event, and numbers that choose among what is there."""
    return st.tuples(st.sampled_from(kinds), st.sampled_from(OUTCOMES), numbers, numbers, numbers, st.booleans())


changes = gestures(CHANGES)
events = gestures(CHANGES + REST)


def event_of(state: State, gesture, pool) -> Json:
    """The event that a gesture comes to where things stand so; now and then one that cannot be."""
    kind, outcome, i, j, k, flag = gesture
    ids = flat(state.orders[outcome]) or ["nobody"]
    one, other = ids[i % len(ids)], ids[j % len(ids)]
    new = pool[outcome][i % len(pool[outcome])]
    painted = [None, "good", "bad"][k % 3]
    fields = {
        "place": {"id": one, "group": j % (len(state.orders[outcome]) + 1), "joins": flag},
        "swap": {"id": one, "with": other},
        "set": {"order": grouped(ids, i + 61 * j + 3721 * k), "by": "score"},
        "answer": {"a": one, "b": other, "said": ["a", "b", "alike"][k % 3]},
        "gap": {"above": one, "below": other, "value": None if flag else k + 1},
        "stretch": {"id": one, "from": j % 9 + 1, "to": j % 9 + 1 + k % 4, "kind": painted},
        "lift": {"id": one},
        "cards": {"added": [] if flag else [new], "removed": [other] if k % 2 else []},
        "way": {"way": WAYS[i % 4]},
        "watch": {"id": new},
        "confirm": {"untouched": flag},
    }
    return {"type": kind} | ({"outcome": outcome} if kind in IN_ONE_LIST else {}) | fields.get(kind, {})


def walk(begin: Json, told) -> Iterator[tuple[Json, State, State]]:
    """Every event that can be, with the state before and after it; the others change nothing."""
    yield from walk_from(replay.begin(begin), told)


def walk_from(state: State, told, pool=POOL) -> Iterator[tuple[Json, State, State]]:
    for gesture in told:
        event = event_of(state, gesture, pool)
        try:
            after = replay.apply(state, event)
        except InvalidEvent:
            continue
        yield event, state, after
        state = after


@given(begins(), st.lists(events, max_size=60))
@COMMON
def test_every_order_stays_a_permutation_with_ties_of_the_cards_there_are(begin, told):
    there = {outcome: sorted(flat(begin["orders"][outcome])) for outcome in OUTCOMES}
    for event, _, after in walk(begin, told):
        if event["type"] == "cards":
            outcome = event["outcome"]
            there[outcome] = sorted({*there[outcome]} - {*event["removed"]} | {*event["added"]})
        for content in (*after.history.past, after.history.present, *after.history.future):
            for outcome in OUTCOMES:
                assert sorted(flat(content.orders[outcome])) == there[outcome]
                assert all(content.orders[outcome])


@given(begins(), st.lists(events, max_size=60))
@COMMON
def test_weights_sum_to_one_rise_with_rank_and_ties_share(begin, told):
    for _, _, after in walk(begin, told):
        for order in after.orders.values():
            if order:
                check_weights(order)


def check_weights(order):
    weights, n = rank_weights(order), len(flat(order))
    assert sum(weights.values()) == pytest.approx(1)
    rows = [[weights[one] for one in group] for group in order]
    assert all(len(set(row)) == 1 for row in rows)
    assert all(above[0] > below[0] for above, below in pairwise(rows))
    plain = [2 * i / (n * (n + 1)) for i in range(n, 0, -1)]
    for group in order:
        shares, plain = plain[: len(group)], plain[len(group) :]
        assert weights[group[0]] == pytest.approx(sum(shares) / len(shares))


@given(begins(), st.lists(events, max_size=40), changes)
@COMMON
def test_undo_after_any_change_gives_back_exactly_what_was_before(begin, told, change):
    state = settled(begin, told)
    for _, before, after in walk_from(state, [change]):
        if after.history != before.history:
            undone = replay.apply(after, {"type": "undo"})
            assert undone.history.present == before.history.present
            assert undone.history.past == before.history.past
            assert replay.apply(undone, {"type": "redo"}) == after


@given(begins(), st.lists(events, max_size=40), st.integers(1, 40))
@COMMON
def test_as_many_redos_as_undos_change_nothing(begin, told, most):
    state = settled(begin, told)
    k = min(most, len(state.history.past))
    back = again(state, "undo", k)
    assert len(back.history.future) == len(state.history.future) + k
    assert again(back, "redo", k) == state


@given(begins(), st.lists(events, max_size=20), numbers, st.sampled_from(OUTCOMES), st.lists(changes, max_size=8))
@COMMON
def test_a_lift_with_all_that_follows_is_one_step_and_can_be_put_back(begin, told, at, outcome, moves):
    before = settled(begin, told)
    ids = flat(before.orders[outcome])
    assume(ids)
    card = ids[at % len(ids)]
    lifted = replay.apply(before, {"type": "lift", "outcome": outcome, "id": card})
    moved = last_of(walk_from(lifted, moves), lifted)
    assert replay.apply(moved, {"type": "put_back"}).history == before.history
    dropped = replay.apply(moved, {"type": "drop"})
    assert (dropped.mark, dropped.lifted) == (None, None)
    if dropped.history != before.history:
        assert replay.apply(dropped, {"type": "undo"}).history.present == before.history.present
        assert len(dropped.history.past) == len(before.history.past) + 1


@given(begins(), st.lists(events, max_size=60))
@COMMON
def test_a_list_is_touched_by_what_changes_it_and_by_nothing_else(begin, told):
    for event, before, after in walk(begin, told):
        touches = event["type"] in {"place", "swap", "set", "answer", "gap", "stretch"}
        changed = before.history.present != after.history.present
        for outcome in OUTCOMES:
            assert after.touched[outcome] >= before.touched[outcome]
            if after.touched[outcome] != before.touched[outcome]:
                assert touches
                assert changed
        if touches and changed:
            assert any(after.touched.values())


@given(begins(), st.lists(events, max_size=60))
@COMMON
def test_stretches_are_in_order_apart_and_as_long_as_they_can_be(begin, told):
    for _, _, after in walk(begin, told):
        for marked in after.history.present.stretches.values():
            assert marked
            for one, other in pairwise(marked):
                assert one.last < other.first
                assert one.kind != other.kind or one.last + 1 < other.first


@given(begins(), st.lists(events, max_size=60))
@COMMON
def test_the_valid_events_alone_rebuild_the_state_at_any_number_of_them(begin, told):
    steps = list(walk(begin, told))
    valid = [begin, *(event for event, _, _ in steps)]
    for n, (_, _, after) in enumerate(steps, start=2):
        assert replay.rebuild(valid[:n]) == after


ONE_SERVER = settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture]
)


@pytest.fixture
def played(client):
    """A world with four successes and three failures, each of a dozen steps, in the order drawn for them."""
    world = make_world(client)
    actions: Json = {"actions": [1, 3] * 7, "step_ms": [1.0] * 14}
    bodies = [attempt(world) for _ in range(4)] + [attempt(world, failed=True, **actions) for _ in range(3)]
    for body in bodies:
        post_demonstration(client, world, body)
    return world, Sitting(client, world).drawn()


parts_of_a_sitting = st.lists(st.tuples(st.lists(events, max_size=12), st.sampled_from(OUTCOMES)), max_size=4)


@given(parts_of_a_sitting)
@ONE_SERVER
def test_the_stored_log_rebuilds_every_version_whatever_was_done(client, played, parts):
    world, ids = played
    sitting = Sitting(client, world)
    state = replay.begin(sitting.begin(ids))
    for told, outcome in parts:
        for event, _, after in walk_from(state, told, ids):
            sitting.do(event.pop("type"), **event)
            state = after
        missing = [one for one in ids[outcome] if one not in flat(state.orders[outcome])]
        state = replay.apply(state, sitting.do("cards", outcome=outcome, added=missing, removed=[]))
        response = sitting.confirm(outcome, [list(group) for group in state.orders[outcome]], untouched=True)
        assert response.status_code == 200, response.text
        state = replay.apply(state, sitting.log[-1])
    check_log(client, sitting)


def check_log(client, sitting):
    """Rebuild each version from what the database holds of this sitting."""
    with client.app.state.database.read() as session:
        stored = queries.stored_events(session, sitting.id, 0, len(sitting.log))
        rows = session.query(Ranking).filter_by(sitting_id=sitting.id).all()
    n_confirmed = sum(event["type"] == "confirm" for event in stored)
    assert stored == (sitting.log if rows else [])
    assert len(rows) <= n_confirmed
    for row in rows:
        state = replay.rebuild(stored[: row.n_events])
        assert [list(group) for group in state.orders[row.outcome]] == row.order
        assert (replay.given(state, row.outcome), state.way) == (row.given, row.way)


junk = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(max_size=5),
    lambda inside: (
        st.lists(inside, max_size=3) | st.dictionaries(st.sampled_from(FIELDS) | st.text(max_size=5), inside)
    ),
    max_leaves=20,
)


@given(st.lists(junk | st.dictionaries(st.sampled_from(FIELDS), junk), min_size=1, max_size=4))
@ONE_SERVER
def test_junk_is_refused_and_leaves_the_store_unchanged(client, played, told):
    world, ids = played
    sitting = Sitting(client, world)
    for events_sent in (told, [sitting.begin(ids), *told]):
        response = sitting.send(events_sent)
        assert response.status_code == 422
        assert response.json()["error"]["code"] == "invalid"
    with client.app.state.database.read() as session:
        assert session.query(StoredSitting).filter_by(id=sitting.id).all() == []


def settled(begin, told) -> State:
    """The state after these events, with nothing lifted."""
    state = last_of(walk(begin, told), replay.begin(begin))
    return replay.apply(state, {"type": "drop"}) if state.mark else state


def last_of(steps, state: State) -> State:
    for _, _, after in steps:
        state = after
    return state


def again(state: State, kind: str, times: int) -> State:
    for _ in range(times):
        state = replay.apply(state, {"type": kind})
    return state
