"""Demonstration files: what is written is read, what is wrong is named."""

import json

import pytest
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from irl_core import (
    InvalidFile,
    LearningProblem,
    Ranking,
    Settings,
    generate_world,
    learn,
    read_demonstration_file,
    simulate,
    write_demonstration_file,
)
from tests.core.examples import make_problem, ranked

WORLD = {"kind": "world", "rows": 2, "cols": 2, "rewards": [[0, -1], [-9, 4]], "start": 0, "goals": [3]}
GOOD = {"kind": "demonstration", "id": "good", "actions": [1, 2]}
BAD = {"kind": "demonstration", "id": "bad", "actions": [2, 1], "outcome": "failure", "total": -5}
RANKING = {"kind": "ranking", "outcome": "success", "order": [["good"]]}


def lines(*records):
    return [record if isinstance(record, str) else json.dumps(record) for record in records]


def test_what_is_written_is_read_again_and_learned_from_alike(tmp_path):
    problem = make_problem(iterations=10)
    rankings = ranked(problem.successes, problem.failures)
    path = tmp_path / "mine.jsonl"
    text = write_demonstration_file(
        problem.world,
        problem.demonstrations,
        rankings,
        world_id="w1",
        more={problem.successes[0].id: {"step_ms": [120.5]}},
    )
    path.write_text(text, encoding="utf-8")
    read = read_demonstration_file(path)
    assert read.world == problem.world
    assert read.demonstrations == problem.demonstrations
    assert read.rankings == tuple(rankings)
    assert read.to_text() == text
    assert '"step_ms": [120.5]' in text
    again = LearningProblem.build(read.world, read.demonstrations, read.rankings, Settings(iterations=10), problem.seed)
    assert learn("irlfr", again).to_json() == learn("irlfr", problem).to_json()


def test_a_ranking_says_each_place_as_people_and_as_the_paper_count_it():
    world = generate_world(3)
    played = [simulate(world, [1], attempt_id=name) for name in ("a", "b", "c", "d")]
    text = write_demonstration_file(world, played, [Ranking("failure", (("a",), ("b", "c"), ("d",)))])
    told = json.loads(text.splitlines()[-1])
    assert told["order"] == [["a"], ["b", "c"], ["d"]]
    assert told["display_rank"] == {"a": 1, "b": 2, "c": 2, "d": 4}
    assert told["paper_index"] == {"a": 4.0, "b": 2.5, "c": 2.5, "d": 1.0}
    assert read_demonstration_file(text.splitlines()).to_text() == text


def test_of_a_ranking_that_is_read_the_order_holds():
    told = RANKING | {"display_rank": {"good": 7}, "paper_index": "none", "version": 3}
    read = read_demonstration_file(lines(WORLD, GOOD, told))
    assert read.rankings == (Ranking("success", (("good",),)),)
    assert json.loads(read.to_text().splitlines()[-1]) == told


def test_slips_are_those_of_the_demonstrations_id():
    world = generate_world(3, slip=0.5)
    one = simulate(world, [1, 1, 2, 2], attempt_id="attempt-1")
    text = write_demonstration_file(world, [one])
    assert read_demonstration_file(text.splitlines()).demonstrations == (one,)
    record = json.loads(text.splitlines()[1])
    del record["slip_seeds"]
    assert read_demonstration_file(lines(world.to_json() | {"kind": "world"}, record)).demonstrations == (one,)
    with pytest.raises(InvalidFile, match=r"Line 2: states of demonstration 'attempt-2': played again it is another"):
        read_demonstration_file(lines(world.to_json() | {"kind": "world"}, record | {"id": "attempt-2"}))


def test_an_attempt_that_went_on_from_another_slips_by_the_seeds_in_its_line():
    world = generate_world(3, slip=0.5)
    one = simulate(world, [1, 1, 2, 2], id="child", slip_seeds=[("parent", 0), ("child", 2)])
    text = write_demonstration_file(world, [one])
    assert '"slip_seeds": [["parent", 0], ["child", 2]]' in text
    assert read_demonstration_file(text.splitlines()).demonstrations == (one,)
    with pytest.raises(InvalidFile, match=r"Line 2: states of demonstration 'child': played again it is another"):
        read_demonstration_file(text.replace('["child", 2]', '["other", 2]').splitlines())


def test_lines_may_come_in_any_order_blank_ones_and_unknown_fields_included():
    extra = {**GOOD, "step_ms": [1, 2], "mood": {"x": [None]}}
    read = read_demonstration_file(lines(RANKING, "", extra, BAD, "  ", WORLD))
    assert [one.id for one in read.demonstrations] == ["good", "bad"]
    assert read_demonstration_file(read.to_text().splitlines()).records == read.records
    assert json.loads(read.to_text().splitlines()[1]) == extra


def test_discarded_demonstrations_are_kept_and_left_out():
    read = read_demonstration_file(lines(WORLD, {**GOOD, "discarded": True}, BAD, RANKING))
    assert [one.id for one in read.demonstrations] == ["bad"]
    assert [one.id for one in read.sections[0].discarded] == ["good"]
    assert read.rankings[0].groups == ()


def test_of_two_rankings_the_later_holds():
    second = {**GOOD, "id": "second"}
    newer = {**RANKING, "order": [["second"], ["good"]]}
    read = read_demonstration_file(lines(WORLD, GOOD, second, {**RANKING, "order": [["good", "second"]]}, newer))
    assert [ranking.groups for ranking in read.rankings] == [(("second",), ("good",))]


def test_a_file_may_hold_several_worlds():
    other = {**WORLD, "id": "b", "rows": 2, "rewards": [[0, -9], [-1, 4]]}
    read = read_demonstration_file(
        lines(
            {**WORLD, "id": "a"},
            other,
            {**GOOD, "world_id": "a"},
            {**GOOD, "world_id": "b"},
            {**BAD, "id": "x", "world_id": "a"},
        )
    )
    assert [section.world_id for section in read.sections] == ["a", "b"]
    assert [[one.outcome for one in section.demonstrations] for section in read.sections] == [
        ["success", "failure"],
        ["failure"],
    ]
    with pytest.raises(InvalidFile, match="holds 2 worlds"):
        _ = read.world


def claim(**changes):
    return lines(WORLD, {**GOOD, **changes})


WRONG = [
    (lines(GOOD), None, "kind", 'no line of kind "world"'),
    ([], None, "kind", "no line"),
    (lines(WORLD, {"kind": "run"}), 2, "kind", "must be world, demonstration or ranking, not 'run'"),
    (lines(WORLD, {}), 2, "kind", "not None"),
    (lines(WORLD, "[1]"), 2, None, "one JSON object"),
    (lines(WORLD, "{oops"), 2, None, "not JSON"),
    (lines(WORLD, "[" * 100_000), 2, None, "not JSON"),
    (lines(WORLD, '{"kind": "demonstration", "x": NaN}'), 2, None, "NaN is not a number"),
    (lines(WORLD, '{"kind": "demonstration", "x": 1e999}'), 2, None, "too large"),
    (lines(WORLD, '{"kind": "demonstration", "x": ' + "9" * 5000 + "}"), 2, None, "not JSON"),
    (lines(WORLD, '{"kind": "world", "kind": "world"}'), 2, None, "twice"),
    (lines({**WORLD, "rewards": [[0, 1]]}), 1, "rewards", "2 rows of 2 numbers"),
    (lines({**WORLD, "rows": 200}), 1, "rows", "from 2 to 100, not 200"),
    (lines(WORLD, WORLD), 1, "id", "id must be a text"),
    (lines({**WORLD, "id": "a"}, {**WORLD, "id": "a"}), 2, "id", "there twice"),
    (lines({**WORLD, "id": "a"}, {**GOOD, "world_id": "b"}), 2, "world_id", "no world 'b'"),
    (claim(id=None), 2, "id", "id must be a text"),
    (claim(id="\ud800"), 2, "id", "id must be a text"),
    (lines(WORLD, GOOD, GOOD), 3, "id", "there twice"),
    (claim(actions=None), 2, "actions", "must be a list"),
    (claim(actions=[1, 2, 1]), 2, "actions", "Step 2"),
    (claim(actions=[True]), 2, "actions", "not True"),
    (claim(ending="gave_up"), 2, "ending", "the agent is at a goal"),
    (claim(total=4), 2, "total", "it is 3.0, not 4"),
    (claim(total="3"), 2, "total", "it is 3.0"),
    (claim(outcome="failure"), 2, "outcome", "'success', not 'failure'"),
    (claim(states=[0, 2, 3]), 2, "states", "another"),
    (claim(states=3), 2, "states", "another"),
    (claim(rewards=[-1, 5]), 2, "rewards", "another"),
    (claim(discarded="yes"), 2, "discarded", "true or false"),
    (claim(ending="out_of_time"), 2, "ending", "at a goal"),
    (claim(slip_seeds="good"), 2, "slip_seeds", "list of pairs"),
    (claim(slip_seeds=0), 2, "slip_seeds", "list of pairs"),
    (claim(slip_seeds=[["good", 0, 1]]), 2, "slip_seeds", "list of pairs"),
    (claim(slip_seeds=[["good", 1]]), 2, "slip_seeds", "must begin with 0"),
    (claim(slip_seeds=[["a", 0], ["b", 2]]), 2, "slip_seeds", "below the 2"),
    (claim(slip_seeds=[["a", 0], ["b", 0]]), 2, "slip_seeds", "rise"),
    (claim(slip_seeds=[["a", 0.0]]), 2, "slip_seeds", "begin with 0"),
    (claim(slip_seeds=[[5, 0]]), 2, "slip_seeds", "a text"),
    (lines(WORLD, GOOD, {**RANKING, "order": [["bad"]]}), 3, "order", "'bad' is no success"),
    (lines(WORLD, GOOD, BAD, {**RANKING, "order": [["bad"]]}), 4, "order", "'bad' is no success"),
    (lines(WORLD, GOOD, {**RANKING, "order": [["good"], ["good"]]}), 3, "order", "twice"),
    (lines(WORLD, GOOD, {**RANKING, "order": "good"}), 3, "order", "list of groups"),
    (lines(WORLD, GOOD, {**RANKING, "outcome": "best"}), 3, "outcome", "success"),
    (lines(WORLD, "x" * 1_000_001), 2, None, "at most 1000000 characters"),
]


@pytest.mark.parametrize(("text", "line", "field", "said"), WRONG, ids=[f"{k} {w[3]}" for k, w in enumerate(WRONG)])
def test_what_is_wrong_is_named_by_line_and_field(text, line, field, said):
    with pytest.raises(InvalidFile) as refusal:
        read_demonstration_file(text)
    assert (refusal.value.line, refusal.value.field) == (line, field)
    assert said in str(refusal.value)
    assert len(str(refusal.value)) < 300


def test_a_file_that_is_not_there_or_not_text_is_refused(tmp_path):
    with pytest.raises(InvalidFile, match="cannot be read: No such file"):
        read_demonstration_file(tmp_path / "none.jsonl")
    (tmp_path / "picture").write_bytes(b"\x89PNG\xff\xfe")
    with pytest.raises(InvalidFile, match="not UTF-8"):
        read_demonstration_file(tmp_path / "picture")


def test_too_many_lines_are_refused(monkeypatch):
    monkeypatch.setattr("irl_core.files.MAX_LINES", 2)
    with pytest.raises(InvalidFile, match="at most 2 lines"):
        read_demonstration_file(lines(WORLD, GOOD, BAD))


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=6,
)


def line_at_fault(text):
    """The line that is refused, None if all are read; any other exception fails the test."""
    try:
        read_demonstration_file(text)
    except InvalidFile as error:
        return error.line
    return None


@given(line=st.text() | JSON.map(json.dumps))
@hypothesis_settings(max_examples=80)
def test_any_line_is_read_or_refused(line):
    assert line_at_fault([json.dumps(WORLD), line]) in {None, 2}


@given(field=st.sampled_from(["rows", "cols", "rewards", "start", "goals", "walls", "slip", "horizon"]), value=JSON)
@hypothesis_settings(max_examples=120)
def test_any_world_field_is_read_or_refused(field, value):
    assert line_at_fault(lines({**WORLD, field: value})) in {None, 1}


@given(
    field=st.sampled_from(
        ["id", "actions", "ending", "slip_seeds", "states", "rewards", "total", "outcome", "world_id"]
    ),
    value=JSON,
)
@hypothesis_settings(max_examples=120)
def test_any_demonstration_field_is_read_or_refused(field, value):
    assert line_at_fault(lines(WORLD, {**GOOD, field: value})) in {None, 2}


@given(outcome=st.just("success") | JSON, order=JSON)
@hypothesis_settings(max_examples=80)
def test_any_ranking_is_read_or_refused(outcome, order):
    assert line_at_fault(lines(WORLD, GOOD, {"kind": "ranking", "outcome": outcome, "order": order})) in {None, 3}
