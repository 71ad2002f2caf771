"""The paper's experiment: pure chunks, honest figures, tables and a picture that say what the figures say."""

import json
import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from irl_core import LEARNERS, InvalidSettings, InvalidWorld, IrlError, Settings, compare, generate_world
from irl_core.errors import DivergentPartition
from irl_core.experiment import (
    ExperimentSpec,
    LearnerOutcome,
    WorldOutcome,
    draw_figure,
    markdown,
    run_chunk,
    summarise,
    tables,
)
from irl_core.experiment import chunk as chunks
from irl_core.learners import LearningProblem, learn
from irl_core.many_worlds.bootstrap import Resamples, draw, estimate
from tests.core import naive_experiment as naive

PAPER = ("meirl", "irlr", "irlf", "irlfr")
SPEC = ExperimentSpec(
    learners=("meirl", "irlfr"), seed=5, rows=4, cols=4, n_episodes=20, settings=Settings(iterations=30)
)


@pytest.fixture(scope="module")
def outcomes():
    return [one for kind in ("wanderer", "shortest_path") for one in run_chunk(SPEC, kind, 0, 4)]


def outcome_of(index, returns, *, human=(-1.0, 1.0), optimum=10.0, kind="wanderer"):
    """A world in which the learners earned these returns, by every measure."""
    learners = {
        name: LearnerOutcome("converged", 10, 0.01, earned, earned, earned)
        for name, earned in zip(PAPER, returns, strict=False)
    }
    return WorldOutcome(kind, index, 100 + index, 0, 9, optimum, human, learners)


def test_a_chunk_is_the_same_however_it_is_cut(outcomes):
    parts = [run_chunk(SPEC, "wanderer", first, last) for first, last in pairwise((0, 1, 3, 4))]
    assert [one for part in parts for one in part] == outcomes[:4]


def test_what_takes_part_beside_it_changes_no_learners_outcome(outcomes):
    alone = run_chunk(replace(SPEC, learners=("irlfr",)), "wanderer", 0, 2)
    assert [one.learners["irlfr"] for one in alone] == [one.learners["irlfr"] for one in outcomes[:2]]


def test_kinds_play_the_same_worlds(outcomes):
    not_redrawn = [
        (one, two) for one, two in zip(outcomes[:4], outcomes[4:], strict=True) if one.n_redrawn == two.n_redrawn
    ]
    assert not_redrawn
    assert all(one.world_seed == two.world_seed for one, two in not_redrawn)


def test_specs_and_outcomes_are_the_same_after_json(outcomes):
    assert ExperimentSpec.from_json(json.loads(json.dumps(SPEC.to_json()))) == SPEC
    assert ExperimentSpec.from_json({}) == ExperimentSpec()
    assert [WorldOutcome.from_json(json.loads(json.dumps(one.to_json()))) for one in outcomes] == outcomes


def test_the_figures_are_those_of_compare():
    """What is exact is measured as the comparison page does it; the episodes are the experiment's own."""
    [outcome] = run_chunk(SPEC, "wanderer", 2, 3)
    world, shown, n_redrawn = chunks.play_world(SPEC, "wanderer", 2)
    assert (world.seed, n_redrawn) == (outcome.world_seed, outcome.n_redrawn)
    assert world == generate_world(outcome.world_seed, rows=4, cols=4)
    problem = LearningProblem.build(world, shown.demonstrations, shown.rankings, SPEC.settings, outcome.world_seed)
    results = [learn(name, problem) for name in SPEC.learners]
    comparison = compare(world, shown.demonstrations, results, seed=outcome.world_seed, n_episodes=20)
    entries = {entry.who: entry for entry in comparison.entries}
    assert outcome.optimum == entries["optimal"].expected_return
    assert outcome.human_mean == entries["human"].mean_return
    for name, learned in outcome.learners.items():
        assert learned.expected_return == entries[name].expected_return
        assert learned.greedy_return == entries[name].greedy_return


def test_slip_ranking_noise_and_more_attempts_reach_the_demonstrator():
    spec = replace(SPEC, slip=0.2, ranking_noise=5.0, n_successes=4, n_failures=2, learners=("meirl",))
    orders = []
    for index in range(4):
        world, shown, _ = chunks.play_world(spec, "wanderer", index)
        assert world.slip == 0.2
        assert [one.outcome for one in shown.demonstrations] == 4 * ["success"] + 2 * ["failure"]
        totals = {one.id: one.total for one in shown.demonstrations}
        orders.append([totals[id_] for id_ in shown.rankings[0].ids])
    assert any(order != sorted(order, reverse=True) for order in orders), "noise of 5 points makes mistakes"


def test_a_learner_that_refuses_a_world_is_counted_and_comes_last(monkeypatch):
    def refuse(problem, name):
        if name == "meirl":
            raise DivergentPartition("The sum is infinite.")
        return learn(name, problem)

    monkeypatch.setattr(chunks, "_run_to_the_end", refuse)
    refused = run_chunk(SPEC, "wanderer", 0, 2)
    assert refused[0].learners["meirl"].refusal == "The sum is infinite."
    restored = [WorldOutcome.from_json(json.loads(json.dumps(one.to_json(), allow_nan=False))) for one in refused]
    [summary] = summarise(restored)
    meirl, irlfr = summary.learners
    assert meirl.outcomes == {"refused": 2}
    assert meirl.above_human == 0.0
    assert math.isnan(meirl.share["soft"].value)
    assert (meirl.mean_place["soft"], irlfr.mean_place["soft"]) == (2.0, 1.0)
    assert summary.wins["soft"][1][0] == 1.0
    json.dumps(summary.to_json(), allow_nan=False)
    assert "refused 2" in markdown([summary])


def test_places_and_wins_by_hand():
    """Returns (MEIRL, IRLR, IRLF, IRLFR): IRLR and IRLF tie in the first world."""
    [summary] = summarise([outcome_of(0, (1.0, 5.0, 5.0, 8.0)), outcome_of(1, (6.0, 4.0, 2.0, 0.0))])
    assert [one.mean_place["soft"] for one in summary.learners] == [2.5, 2.25, 2.75, 2.5]
    assert summary.wins["soft"] == (
        (0.5, 0.5, 0.5, 0.5),
        (0.5, 0.5, 0.75, 0.5),
        (0.5, 0.25, 0.5, 0.5),
        (0.5, 0.5, 0.5, 0.5),
    )
    assert [one.above_human for one in summary.learners] == [1.0, 1.0, 1.0, 0.5]
    assert summary.learner("meirl").share["greedy"].value == 0.35
    assert summary.human.value == 0.0
    assert summary.best_attempt.value == 0.1
    assert summary.difference("irlfr", "meirl", measure="soft").value == pytest.approx(0.05)


@given(arrays(np.float64, (7, 4), elements=st.integers(-5, 12).map(float)))
def test_places_and_wins_agree_with_counting(returns):
    [summary] = summarise([outcome_of(index, row) for index, row in enumerate(returns.tolist())])
    assert [one.mean_place["soft"] for one in summary.learners] == pytest.approx(naive.mean_places(returns))
    assert np.array(summary.wins["soft"]) == pytest.approx(naive.wins(returns))
    assert sum(one.mean_place["soft"] for one in summary.learners) == pytest.approx(10.0)


def test_the_order_of_worlds_changes_no_figure(outcomes):
    forth = [one.to_json() for one in summarise(outcomes)]
    back = [one.to_json() for one in summarise(outcomes[3::-1] + outcomes[:3:-1])]
    assert forth == back


def test_table_one_by_hand():
    worlds = [
        outcome_of(0, (1.0, 5.0, 5.0, 8.0)),
        outcome_of(1, (6.0, 4.0, 2.0, 1.0)),
        outcome_of(2, (3.0, 4.0, 5.0, -4.0)),
    ]
    [summary] = summarise(worlds)
    assert summary.table_one["Human demonstrations"].startswith("In 2 of 3 experiments, the human's average reward")
    assert summary.table_one["IRLFR"] == (
        "Performed the best in 1, 2nd best in 0, 3rd best in 0, 4th best in 2 of 3 experiments; surpassed"
        " MEIRL 1 times, IRLR 1 times, IRLF 1 times."
    )
    assert "2nd best in 2, 3rd best in 1" not in summary.table_one["IRLR"]
    assert summary.table_one["IRLR"].startswith("Performed the best in 0, 2nd best in 3,"), (
        "a tie takes the better place"
    )


def test_intervals_agree_with_the_naive_bootstrap():
    generator = np.random.default_rng(3)
    optima, returns = generator.uniform(5.0, 12.0, 60), generator.normal(3.0, 2.0, 60)
    found = estimate(Resamples(optima, draw(60, 0)).shares(returns[:, None])[:, 0])
    low, high = naive.bootstrap(optima, returns, generator)
    assert found.value == pytest.approx(returns.sum() / optima.sum(), abs=1e-15)
    assert (found.low, found.high) == pytest.approx((low, high), abs=0.012)
    assert found.low < found.value < found.high


def test_intervals_cover_what_they_should():
    """Of 200 samples of 40 worlds about 95 % have the truth, 0.3, within their interval."""
    generator = np.random.default_rng(8)
    covered = 0
    for sample in range(200):
        optima = generator.uniform(5.0, 12.0, 40)
        returns = 0.3 * optima + generator.normal(0.0, 2.0, 40)
        found = estimate(Resamples(optima, draw(40, sample)).shares(returns[:, None])[:, 0])
        covered += found.low <= 0.3 <= found.high
    assert 0.88 <= covered / 200 <= 0.99


def test_differences_are_paired_by_world():
    """A learner that is always 1 point ahead is so with certainty, however much worlds differ."""
    generator = np.random.default_rng(1)
    worlds = [outcome_of(k, (earned, earned + 1.0)) for k, earned in enumerate(generator.normal(0.0, 20.0, 30))]
    [summary] = summarise(worlds)
    ahead = summary.difference("irlr", "meirl")
    assert (ahead.value, ahead.low, ahead.high) == pytest.approx((0.1, 0.1, 0.1))
    assert summary.learner("irlr").share["soft"].high - summary.learner("irlr").share["soft"].low > 0.5


def test_tables_are_whole(outcomes):
    summaries = summarise(outcomes)
    for table in tables(summaries):
        assert all(len(row) == len(table.header) for row in table.rows), table.title
    text = markdown(summaries)
    for words in ("Wanderer", "Shortest path", "MEIRL", "Human, best attempt", "Table I", "95 %"):
        assert words in text
    assert "nan" not in text


def test_the_same_figures_give_the_same_picture(outcomes, tmp_path):
    for name in ("one.svg", "two.svg", "one.png"):
        draw_figure(summarise(outcomes), tmp_path / name)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()
    assert (tmp_path / "one.png").stat().st_size > 5_000


def test_a_learner_far_below_is_drawn_at_the_edge(tmp_path):
    far = [outcome_of(k, (-500.0 - k, 5.0 + k)) for k in range(3)]
    draw_figure(summarise(far), tmp_path / "far.svg")
    assert (tmp_path / "far.svg").exists()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"learners": ("gail",)}, "no learner 'gail'; there are meirl"),
        ({"learners": ()}, "at least one learner"),
        ({"seed": -1}, "seed must be a whole number"),
        ({"rows": 1}, "rows must be a whole number from 2"),
        ({"n_successes": 0}, "n_successes"),
        ({"n_failures": 0}, "learns from failures"),
        ({"n_episodes": 0.5}, "n_episodes"),
        ({"slip": 0.95}, "slip"),
        ({"ranking_noise": float("nan")}, "ranking_noise"),
    ],
)
def test_a_spec_that_makes_no_experiment_is_refused_in_words(change, words):
    with pytest.raises(InvalidSettings, match=words):
        ExperimentSpec(**change)


def test_an_unknown_field_of_a_spec_is_refused():
    with pytest.raises(InvalidSettings, match="no 'n_world'; it has learners"):
        ExperimentSpec.from_json({"n_world": 3})


def test_bad_chunks_and_outcomes_are_refused(outcomes):
    with pytest.raises(InvalidSettings, match="no demonstrator 'genius'"):
        run_chunk(SPEC, "genius", 0, 1)
    with pytest.raises(InvalidSettings, match="not from 3 to 1"):
        run_chunk(SPEC, "wanderer", 3, 1)
    with pytest.raises(IrlError, match="comes twice"):
        summarise([outcomes[0], outcomes[0]])
    with pytest.raises(IrlError, match="the same learners"):
        summarise([outcome_of(0, (1.0,)), outcome_of(1, (1.0, 2.0))])
    with pytest.raises(IrlError, match="took no part"):
        summarise(outcomes)[0].learner("irlf")


def test_where_nobody_fails_the_search_for_worlds_ends_in_words(monkeypatch):
    monkeypatch.setattr(chunks, "MOST_REDRAWN", 2)
    spec = replace(SPEC, rows=2, cols=2, red_probability=0.0)
    with pytest.raises(InvalidWorld, match="In none of 2 worlds of 2×2 squares has shortest_path both 3 successes"):
        run_chunk(spec, "shortest_path", 0, 1)


@pytest.mark.parametrize("name", sorted(LEARNERS))
def test_every_learner_can_take_part(name):
    settings = Settings(iterations=5)
    [outcome] = run_chunk(ExperimentSpec(learners=(name,), rows=4, cols=4, settings=settings), "mixture", 0, 1)
    assert all(math.isfinite(outcome.learners[name].score(measure)) for measure in ("episodes", "soft"))


def test_who_learns_no_reward_has_no_plan(tmp_path):
    spec = replace(SPEC, learners=("meirl", "random", "trex"), settings=Settings(iterations=5))
    [summary] = summarise(run_chunk(spec, "mixture", 0, 3))
    assert math.isnan(summary.learner("random").share["greedy"].value)
    assert math.isfinite(summary.learner("random").share["soft"].value)
    greedy_wins = next(table for table in tables([summary]) if "who beats whom, best plan" in table.title)
    assert greedy_wins.header == ("row beats column", "MEIRL", "T-REX (linear)")
    assert "nan" not in markdown([summary])
    draw_figure([summary], tmp_path / "figure.svg")
