"""The benchmark of many streams would notice what it says did not happen."""

import json

from bench.learn_watchers import Found, Seen


def count(*events: tuple[str, int, int], ending: str = "done") -> Found:
    """What is found of a stream that was sent these (kind, number, iteration) of a learner whose last is at 9."""
    seen, found = Seen(), Found()
    for kind, number, iteration in events:
        frame = {"learner": "irlr", "iteration": iteration, "number": number}
        data = {"latest": {"irlr": frame}, "number": number} if kind == "snapshot" else frame
        seen.take({"event": kind, "id": str(number), "data": json.dumps(data)})
    seen.take({"event": ending, "id": "99", "data": json.dumps({"number": 99, "status": ending})})
    found.count(seen, {"irlr": 9})
    return found


def test_a_whole_stream_has_nothing_amiss() -> None:
    assert count(("snapshot", 3, 2), ("frame", 4, 5), ("frame", 7, 9)) == Found(n_streams=1, n_frames=2)
    assert count(("snapshot", 7, 9)) == Found(n_streams=1)


def test_each_fault_is_counted() -> None:
    assert count(("frame", 4, 5)).without_last_frame == 1
    assert count(("frame", 4, 9), ending="failed").without_end == 1
    assert count(("frame", 4, 5), ("frame", 4, 9)).doubled == 1
    assert count(("frame", 5, 5), ("frame", 4, 9)).out_of_order == 1
