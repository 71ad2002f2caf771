"""Answers about pairs come to the order they state, or to the one they contradict least; the browser says the same."""

import json
import random
from itertools import combinations
from pathlib import Path
from typing import Any, Literal

import pytest

import irl_core as irl
from irl_core.preferences import Answer

VECTORS: list[dict[str, Any]] = json.loads(
    (Path(__file__).parent / "comparison_vectors.json").read_text(encoding="utf-8")
)


def answers_of(told: list[tuple[str, str, Literal["a", "b", "alike"]]]) -> list[Answer]:
    return [{"a": a, "b": b, "said": said} for a, b, said in told]


@pytest.mark.parametrize("vector", VECTORS, ids=lambda vector: str(vector["name"]))
def test_answers_come_to_the_order_that_the_browser_finds_too(vector: dict[str, Any]) -> None:
    order = irl.order_from_comparisons(vector["ids"], answers_of(vector["answers"]))
    assert [list(group) for group in order] == vector["order"]


@pytest.mark.parametrize("seed", range(20))
def test_answers_without_a_contradiction_give_exactly_the_order_meant(seed: int) -> None:
    rng = random.Random(seed)
    ids = [f"id {k}" for k in range(rng.randint(1, 12))]
    worth = {id_: rng.randrange(8) for id_ in ids}
    answers = [answer_of(worth, a, b) for a, b in combinations(ids, 2)]
    order = irl.order_from_comparisons(ids, rng.sample(answers, len(answers)))
    assert [{worth[id_] for id_ in group} for group in order] == [{w} for w in sorted(set(worth.values()))[::-1]]
    assert sorted(id_ for group in order for id_ in group) == sorted(ids)


@pytest.mark.parametrize("seed", range(10))
def test_no_move_of_one_thing_ends_more_contradictions(seed: int) -> None:
    rng = random.Random(seed)
    ids = [f"id {k}" for k in range(9)]
    answers = answers_of([(a, b, rng.choice(["a", "b"])) for a, b in combinations(ids, 2)])
    line = [id_ for group in irl.order_from_comparisons(ids, answers) for id_ in group]
    fewest = n_contradicted(line, answers)
    for id_ in ids:
        others = [one for one in line if one != id_]
        assert all(n_contradicted([*others[:k], id_, *others[k:]], answers) >= fewest for k in range(9))


def test_the_order_in_which_answers_came_does_not_matter() -> None:
    rng = random.Random(3)
    ids = [f"id {k}" for k in range(8)]
    pairs = [rng.sample(ids, 2) for _ in range(40)]
    answers = answers_of([(a, b, rng.choice(["a", "b", "alike"])) for a, b in pairs])
    orders = {irl.order_from_comparisons(ids, rng.sample(answers, 40)) for _ in range(20)}
    assert len(orders) == 1


@pytest.mark.parametrize(
    ("ids", "answers", "sentence"),
    [
        (["x", "x"], [], "x"),
        (["x", "y"], [{"a": "x", "b": "y", "said": "better"}], 'said is "a", "b" or "alike"'),
        (["x", "y"], [{"a": "x", "b": "x", "said": "a"}], "about two ids"),
        (["x", "y"], [{"a": "x", "b": 7, "said": "a"}], "about two ids"),
        (["x", "y"], [["x", "y", "a"]], "{a, b, said}"),
        (["x", "y"], {"a": "x"}, "a list of"),
        (["x", "y"], "abc", "a list of"),
    ],
)
def test_what_is_no_answer_is_refused_with_a_sentence(ids: list[str], answers: Any, sentence: str) -> None:
    with pytest.raises(irl.InvalidRanking, match=sentence):
        irl.order_from_comparisons(ids, answers)


def answer_of(worth: dict[str, int], a: str, b: str) -> Answer:
    said: Literal["a", "b", "alike"] = "alike" if worth[a] == worth[b] else "a" if worth[a] > worth[b] else "b"
    return {"a": a, "b": b, "said": said}


def n_contradicted(line: list[str], answers: list[Answer]) -> int:
    def is_contradicted(answer: Answer) -> bool:
        return (line.index(answer["a"]) < line.index(answer["b"])) != (answer["said"] == "a")

    return sum(is_contradicted(answer) for answer in answers)
