"""One stream for all runs of a page: each event once and in order, frames thinned by time, the last never lost."""

import asyncio
import gzip
import itertools
import json
import threading
from contextlib import asynccontextmanager

import pytest
from sqlalchemy import insert

from app.db import Database
from app.kit import clock
from app.kit.bell import Bell, Ringer
from app.learning import events, steps, worker
from app.learning.stream import _following, every_event, many_runs
from app.learning.watcher import MOST_KEPT, Watcher
from app.models import Run, RunEvent, Worker
from tests.app.test_learning import ask, played  # noqa: F401 - `played` is a fixture
from tests.awaited import awaited
from tests.factories import make_demonstration

FOUR = ("meirl", "irlr", "irlf", "irlfr")


@pytest.fixture
def database(settings):
    opened = Database(settings)
    yield opened
    opened.close()


def parse(text):
    """Server-sent events as [(id, kind, data)]."""
    found = []
    for block in text.strip().split("\n\n"):
        fields = dict(line.split(": ", 1) for line in block.splitlines() if not line.startswith(":"))
        if fields:
            found.append((fields["id"], fields["event"], json.loads(fields["data"])))
    return found


def follow(client, *run_ids, frames=(), seen=None):
    """Read the stream of a page to its end."""
    params = [("run", one) for one in run_ids] + [("frames", one) for one in frames]
    answer = client.get("/api/v1/events", params=params, headers={} if seen is None else {"Last-Event-ID": seen})
    assert answer.status_code == 200, answer.text
    return parse(answer.text)


def numbers(id_):
    return [int(part) for part in id_.split(".")]


@asynccontextmanager
async def watching(database, settings):
    """The watcher of a web process, and what workers ring it by."""
    bell, ringer = Bell(settings.data_dir, "web"), Ringer(settings.data_dir)
    watcher = Watcher(database, bell)
    try:
        yield watcher, lambda: ringer.ring("web")
    finally:
        await watcher.close()
        bell.close()
        ringer.close()


async def read(stream):
    """Every event of a stream, as it comes."""
    return parse("".join([part.decode() async for part in stream]))


def learn_all(database, run_ids, tell):
    for run_id in run_ids:
        worker.learn_now(database, run_id, tell=tell)


def make_events(database, run_id, n, *, learner="meirl"):
    """Frames of a learner, as if a worker had stored them."""
    frame = {"learner": learner, "iterations": n, "reward": [0.0]}
    rows = [
        {"run_id": run_id, "number": k, "kind": "frame", "data": json.dumps(frame | {"iteration": k})}
        for k in range(1, n + 1)
    ]
    database.write(lambda session: session.execute(insert(RunEvent), rows))


def check_ids(found, of_run):
    """No number of a run twice, none out of order, and the vector only ever rises."""
    vectors = [numbers(id_) for id_, _, _ in found]
    for before, after in itertools.pairwise(vectors):
        assert all(a <= b for a, b in zip(before, after, strict=True)), "ids only rise"
    told = [data["number"] for _, kind, data in found if data["run_id"] == of_run and kind not in ("queue", "snapshot")]
    assert told == sorted(set(told)), "none twice, none out of order"


def test_one_stream_tells_of_all_runs_and_ends_when_all_have(client, played, database):  # noqa: F811
    done, cancelled = (ask(client, played, learners=["meirl"]).json()["id"] for _ in range(2))
    worker.learn_now(database, done)
    client.post(f"/api/v1/runs/{cancelled}/cancellation")
    found = follow(client, done, cancelled, frames=[done])
    snapshots = {data["run_id"]: data for _, kind, data in found if kind == "snapshot"}
    assert {run_id: one["status"] for run_id, one in snapshots.items()} == {done: "done", cancelled: "cancelled"}
    assert snapshots[done]["latest"]["meirl"]["iteration"] == 30
    assert snapshots[done]["latest"]["meirl"]["compute_ms"] > 0
    assert snapshots[cancelled]["reason"] == "You cancelled this run."
    assert [(kind, data["status"]) for _, kind, data in found if kind in ("done", "failed")] == [
        ("done", "done"),
        ("failed", "cancelled"),
    ]
    last = found[-1][0]
    again = client.get("/api/v1/events", params={"run": [done, cancelled]}, headers={"Last-Event-ID": last})
    assert again.status_code == 204, "a browser that has everything stops asking"


def test_a_stream_that_comes_back_is_sent_what_follows_and_no_snapshot(client, played, database):  # noqa: F811
    run_id = ask(client, played, learners=["meirl", "irlr"]).json()["id"]
    worker.learn_now(database, run_id)
    whole = json.loads(client.get(f"/api/v1/runs/{run_id}/frames").text)["frames"]
    found = follow(client, run_id, frames=[run_id], seen="2")
    assert [kind for _, kind, _ in found if kind in ("snapshot", "queue")] == []
    check_ids(found, run_id)
    for name in ("meirl", "irlr"):
        frames = [data["number"] for _, kind, data in found if kind == "frame" and data["learner"] == name]
        own = [one["number"] for one in whole if one["learner"] == name and one["number"] > 2]
        assert (frames[0], frames[-1]) == (own[0], own[-1]), "the first and the last always come"
        assert len(frames) <= 3
    assert found[0][2]["number"] == 3


def test_an_id_that_is_none_of_ours_begins_with_a_snapshot(client, played, database):  # noqa: F811
    run_id = ask(client, played, learners=["bc"]).json()["id"]
    worker.learn_now(database, run_id)
    for seen in ("", "x", "1.2", "-1", "1e3"):
        assert [kind for _, kind, _ in follow(client, run_id, seen=seen)] == ["snapshot", "done"], seen


def test_a_number_that_is_yet_to_come_is_none_of_ours_either(client, played, database, settings):  # noqa: F811
    run_id = ask(client, played, learners=["meirl"]).json()["id"]
    make_events(database, run_id, 5)

    async def watch():
        async with watching(database, settings) as (watcher, _):
            streams = every_event(watcher, run_id, 99), many_runs(watcher, [run_id], with_frames=[run_id], seen=[99])
            return [parse((await anext(stream)).decode())[0][:2] for stream in streams]

    assert awaited(watch()) == [("1", "frame"), ("5", "snapshot")]


def test_a_thousand_frames_behind_is_one_snapshot_away(client, played, database):  # noqa: F811
    run_id = ask(client, played, learners=["meirl"]).json()["id"]
    make_events(database, run_id, 1000)
    client.post(f"/api/v1/runs/{run_id}/cancellation")
    found = follow(client, run_id, frames=[run_id], seen="1")
    assert [kind for _, kind, _ in found] == ["snapshot", "failed"]
    assert found[0][2]["latest"]["meirl"]["iteration"] == 1000
    record = client.get(f"/api/v1/runs/{run_id}/frames", params={"after": 990}).json()
    assert [one["number"] for one in record["frames"]] == list(range(991, 1001))
    assert record["last"] == 1000
    near = follow(client, run_id, frames=[run_id], seen="900")
    assert [data["number"] for _, _, data in near] == [901, 950, 1000, 1001], "what is read at once, thinned"


def test_the_record_holds_every_frame_and_is_compressed_for_who_takes_it(client, played, database):  # noqa: F811
    run_id = ask(client, played).json()["id"]
    worker.learn_now(database, run_id)
    address = f"/api/v1/runs/{run_id}/frames"
    with client.stream("GET", address, headers={"Accept-Encoding": "gzip"}) as answer:
        squeezed = b"".join(answer.iter_raw())
    assert answer.headers["content-encoding"] == "gzip"
    plain = client.get(address, headers={"Accept-Encoding": "identity"})
    assert gzip.decompress(squeezed) == plain.content
    stored = [data for _, kind, data in parse(client.get(f"/api/v1/runs/{run_id}/events").text) if kind == "frame"]
    assert [{name: one[name] for name in one if name != "number"} for one in plain.json()["frames"]] == stored
    assert all(one["compute_ms"] >= 0 for one in stored)


def test_a_live_stream_thins_frames_and_tells_of_the_queue(client, played, database, settings):  # noqa: F811
    first, second = (ask(client, played, learners=FOUR[:2]).json()["id"] for _ in range(2))

    async def watch():
        async with watching(database, settings) as (watcher, ring):
            stream = many_runs(watcher, [first, second], with_frames=[first], seen=None)
            reading = asyncio.create_task(read(stream))
            await asyncio.sleep(0)
            for run_id in (first, second):
                await asyncio.to_thread(worker.learn_now, database, run_id, tell=ring)
            return await reading

    found = awaited(watch())
    snapshots = {data["run_id"]: data for _, kind, data in found if kind == "snapshot"}
    assert [(snapshots[one]["status"], snapshots[one]["ahead"]) for one in (second,)] == [("queued", 1)]
    assert snapshots[second]["worker"] == "none"
    ahead = [data["ahead"] for _, kind, data in found if kind == "queue" and data["run_id"] == second]
    assert ahead == [0, None], "next, then begun"
    for run_id in (first, second):
        check_ids(found, run_id)
    of = {one: [(kind, data) for _, kind, data in found if data["run_id"] == one] for one in (first, second)}
    assert {kind for kind, _ in of[second]} == {"snapshot", "queue", "progress", "learner", "done"}
    for name in FOUR[:2]:
        frames = [data["iteration"] for kind, data in of[first] if kind == "frame" and data["learner"] == name]
        assert frames[-1] == 30, "the last frame always comes"
        progress = [data["iteration"] for kind, data in of[second] if kind == "progress" and data["learner"] == name]
        assert progress[-1] == 30


def test_a_run_deleted_while_it_is_watched_ends_its_streams(client, played, database, settings):  # noqa: F811
    run_id = ask(client, played).json()["id"]
    run = steps.begin(database, run_id)
    steps.advance(database, run, "meirl")

    async def watch():
        async with watching(database, settings) as (watcher, _):
            readings = [
                asyncio.create_task(read(stream))
                for stream in (
                    many_runs(watcher, [run_id], with_frames=[run_id], seen=None),
                    every_event(watcher, run_id, 0),
                )
            ]
            await asyncio.sleep(0.1)
            deleted = await asyncio.to_thread(client.delete, f"/api/v1/runs/{run_id}")
            assert deleted.status_code == 204
            return await asyncio.gather(*readings)

    for found in awaited(watch()):
        _, kind, data = found[-1]
        assert (kind, data["status"]) == ("failed", "deleted")
    assert client.get(f"/api/v1/runs/{run_id}").status_code == 404
    with pytest.raises(steps.NoLongerWanted):
        steps.advance(database, run, "meirl")
    worker.learn_now(database, run_id)  # its job may still come
    with database.read() as session:
        assert session.get(Run, run_id) is None
        assert not session.query(RunEvent).count()


def test_a_look_that_was_overtaken_does_not_bring_an_ended_run_back(client, played, database, settings):  # noqa: F811
    """A page is loaded again at the end of a run: the new stream knows of the end, an older look does not."""
    run_id = ask(client, played, learners=["bc"]).json()["id"]
    has_looked, go_on = threading.Event(), threading.Event()

    async def watch():
        async with watching(database, settings) as (watcher, _):
            watcher._start_to_look, find_news = lambda: None, watcher._find_news

            def slow(newest):
                found = find_news(newest)
                has_looked.set()
                go_on.wait()
                return found

            watcher._find_news = slow
            async with watcher.watching([run_id]):
                look = asyncio.create_task(watcher._look())
                await asyncio.to_thread(has_looked.wait)
            await asyncio.to_thread(worker.learn_now, database, run_id)
            async with watcher.watching([run_id]) as (feed,):
                go_on.set()
                await look
                return feed.standing

    assert awaited(watch()).status == "done"


def test_no_stream_runs_ahead_of_what_the_last_look_found(client, played, database, settings):  # noqa: F811
    """It would pass the numbers that it waits for, and never wait again: nor would anybody else get a turn."""
    run_id = ask(client, played, learners=["meirl"]).json()["id"]
    make_events(database, run_id, 5)

    async def watch():
        async with watching(database, settings) as (watcher, _), watcher.watching([run_id]) as (feed,):
            watcher._task.cancel()  # no look finds what comes now
            frame = {"learner": "meirl", "iteration": 6, "iterations": 9, "reward": []}
            await asyncio.to_thread(database.write, lambda session: events.append(session, run_id, "frame", frame))
            return feed.newest, [one.number for one in await _following(watcher, feed, 0)]

    assert awaited(watch()) == (5, [1, 2, 3, 4, 5])


def test_a_hundred_streams_over_four_runs_miss_nothing_that_matters(client, played, database, settings):  # noqa: F811
    """The small version of bench/streams.py, without a server in between."""
    quick = {"iterations": 10}
    run_ids = [ask(client, played, learners=["meirl"], settings=quick).json()["id"] for _ in range(4)]

    async def watch():
        async with watching(database, settings) as (watcher, ring):
            streams = [many_runs(watcher, run_ids, with_frames=run_ids, seen=None) for _ in range(100)]
            readings = [asyncio.create_task(read(stream)) for stream in streams]
            await asyncio.sleep(0.05)
            learning = threading.Thread(target=learn_all, args=(database, run_ids, ring))
            learning.start()
            found = await asyncio.gather(*readings)
            learning.join()
            return found, watcher.n_streams

    streams, n_left = awaited(watch())
    assert n_left == 0
    for found in streams:
        for run_id in run_ids:
            check_ids(found, run_id)
            assert [kind for _, kind, data in found if data["run_id"] == run_id][-1] == "done"
            frames = [data for _, kind, data in found if kind == "frame" and data["run_id"] == run_id]
            assert frames[-1]["iteration"] == 10


def test_a_feed_keeps_only_so_many_events(client, played, database, settings):  # noqa: F811
    run_id = ask(client, played, learners=["meirl"]).json()["id"]

    async def watch():
        async with watching(database, settings) as (watcher, ring), watcher.watching([run_id]) as (feed,):
            make_events(database, run_id, MOST_KEPT + 60)
            while feed.newest < MOST_KEPT + 60:
                ring()
                await asyncio.sleep(0.01)
            return len(feed.kept), feed.after(59), feed.after(MOST_KEPT + 59)

    n_kept, from_before, newest = awaited(watch())
    assert n_kept == MOST_KEPT
    assert from_before is None, "what is no longer kept is read from the table"
    assert [one.number for one in newest] == [MOST_KEPT + 60]


def test_places_in_the_queue_are_fair_between_visitors(client, other_client, played, database):  # noqa: F811
    mine = [ask(client, played, learners=["meirl"]).json() for _ in range(3)]
    assert [run["ahead"] for run in mine] == [0, 1, 2]
    make_demonstration(other_client, played)
    theirs = ask(other_client, played, learners=["meirl"]).json()
    assert theirs["ahead"] == 1, "of another's three only the first comes before"
    assert theirs["worker"] == "none"
    sign = {"name": "worker-1", "pid": 1, "seen_at": clock.now()}
    database.write(lambda session: session.execute(insert(Worker), sign))
    assert client.get(f"/api/v1/runs/{mine[0]['id']}").json()["worker"] == "warming"


def test_a_run_that_diverges_says_so_and_keeps_its_last_finite_weights(client, played, database):  # noqa: F811
    wild = {"learning_rate": 10.0, "lambda_start": 0.01, "lambda_min": 1e-9, "lambda_decay": 0.5}
    run_id = ask(client, played, learners=["irlf"], settings=wild).json()["id"]
    worker.learn_now(database, run_id)
    run = client.get(f"/api/v1/runs/{run_id}").json()
    assert run["status"] == "done", run["reason"]
    result = run["learners"]["irlf"]
    assert (result["outcome"], result["iterations"] > 0) == ("diverged", True)
    assert any(value for row in result["reward"] for value in row), "the last finite weights, not those it began with"
    json.dumps(result, allow_nan=False)
    (frames, learner) = (
        [data for _, kind, data in parse(client.get(f"/api/v1/runs/{run_id}/events").text) if kind == wanted]
        for wanted in ("frame", "learner")
    )
    assert learner[0]["outcome"] == "diverged"
    json.dumps(frames, allow_nan=False)
