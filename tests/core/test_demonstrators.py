"""Simulated people: what each kind does, that they play as everybody does, and the mistakes of their orders."""

import math
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from irl_core import InvalidSettings, LearningProblem, World, draw_playable_world, generate_world, optimum, simulate
from irl_core.demonstrators import DEMONSTRATORS, MOST_ATTEMPTS, demonstrate, rank_by_total
from irl_core.demonstrators.play import play
from irl_core.planning import hard_plan
from tests.core import naive_demonstrators as naive
from tests.core.examples import make_world

WALLED_AND_SLIPPERY = generate_world(11, rows=5, cols=6, slip=0.15, walls=(8, 14, 21))
KINDS = sorted(DEMONSTRATORS)


def rng(seed=0):
    return np.random.default_rng(seed)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("world", [generate_world(3), WALLED_AND_SLIPPERY], ids=["plain", "walls and slip"])
def test_a_demonstrator_leaves_what_was_asked_for_and_a_problem_accepts_it(kind, world):
    left = demonstrate(kind, world, rng(1), n_successes=2, n_failures=3)
    assert left is not None
    outcomes = Counter(one.outcome for one in left.demonstrations)
    assert outcomes == {"success": 2, "failure": 3}
    assert all(one.reached_goal and one.n_steps <= world.n_states for one in left.demonstrations)
    assert 5 <= left.n_attempts <= MOST_ATTEMPTS
    problem = LearningProblem.build(world, left.demonstrations, left.rankings)
    assert len(problem.successes) == 2
    assert problem.n_left_out == 0


@pytest.mark.parametrize("kind", KINDS)
def test_the_same_generator_gives_the_same_attempts(kind):
    first, second = (demonstrate(kind, WALLED_AND_SLIPPERY, rng(7)) for _ in range(2))
    assert first == second
    assert first != demonstrate(kind, WALLED_AND_SLIPPERY, rng(8))


@pytest.mark.parametrize("kind", KINDS)
def test_attempts_are_played_as_simulate_plays_them_slips_and_all(kind):
    left = demonstrate(kind, WALLED_AND_SLIPPERY, rng(2))
    assert left is not None
    for one in left.demonstrations:
        assert one == simulate(WALLED_AND_SLIPPERY, one.actions.tolist(), attempt_id=one.id)


def test_slips_differ_from_world_to_world():
    """Ids decide slips, so no two people may use the same ids."""
    people = [demonstrate("wanderer", WALLED_AND_SLIPPERY, rng(seed)) for seed in range(5)]
    ids = [one.id for left in people if left is not None for one in left.demonstrations]
    assert len(ids) == 30
    assert len(set(ids)) == len(ids)


@pytest.mark.parametrize("kind", KINDS)
def test_laws_are_probabilities(kind):
    for world in (generate_world(3), WALLED_AND_SLIPPERY, make_world(3, 3, goals=(8, 2), walls=(4,))):
        laws = DEMONSTRATORS[kind].laws(world, 4, rng())
        assert laws.shape == (4, world.n_states, 4)
        assert (laws >= 0.0).all()
        np.testing.assert_allclose(laws.sum(axis=2), 1.0, atol=1e-12)


def test_side_by_side_is_as_one_after_the_other():
    """The same numbers lead to the same actions as in the naive twin."""
    for world in (generate_world(5), WALLED_AND_SLIPPERY):
        laws = DEMONSTRATORS["mixture"].laws(world, 12, rng(3))
        ids = [f"a-{k}" for k in range(12)]
        fast = play(world, laws, ids, rng(4), patience=40)
        draws = rng(4).random((40, 12))
        assert fast == [naive.play_one(world, laws[k], ids[k], draws[:, k]) for k in range(12)]


def test_every_shortest_path_is_as_likely():
    """Their number from each square, and the product of the chances along each, by walking all of them."""
    for world in (replace(WALLED_AND_SLIPPERY, slip=0.0), make_world(3, 4, goals=(6, 9), walls=(2,))):
        law = DEMONSTRATORS["shortest_path"].laws(world, 1, rng())[0]
        paths = naive.shortest_paths(world)
        chances = [math.prod(law[s, a] for s, a in path) for path in paths]
        assert len(paths) > 2
        np.testing.assert_allclose(chances, 1.0 / len(paths))


def test_boltzmann_prefers_by_value():
    """The log odds of two actions are β (Q(a) − Q(b)), with one β in [0.2, 3] for the whole attempt."""
    world = generate_world(9)
    value = hard_plan(world, world.reward).values[-1]
    worth = (world.reward + value)[world.next_states]
    for law in DEMONSTRATORS["boltzmann"].laws(world, 5, rng(1)):
        here = 10
        ratios = np.log(law[here] / law[here, 0])[1:] / (worth[here] - worth[here, 0])[1:]
        beta = ratios[np.isfinite(ratios)][0]
        assert 0.2 <= beta <= 3.0
        np.testing.assert_allclose(np.log(law / law[:, :1]), beta * (worth - worth[:, :1]), atol=1e-9)


def test_myopic_sees_the_third_step_and_not_the_fourth():
    """Two corridors of equal length lead to the goal, one above and one below a wall; one square above is dear."""

    def chances(dear):
        rewards = np.full((3, 6), -0.5)
        rewards[1, 5] = 9.0
        rewards[dear] = -50.0
        world = World(3, 6, rewards, start=6, goals=(11,), walls=(7, 8, 9, 10))
        return DEMONSTRATORS["myopic"].laws(world, 1, rng())[0, world.start].tolist()

    one_slip_in_ten = 0.1 / 4
    assert chances((0, 2)) == pytest.approx([one_slip_in_ten, one_slip_in_ten, 0.9 + one_slip_in_ten, one_slip_in_ten])
    assert chances((0, 3)) == pytest.approx([0.475, one_slip_in_ten, 0.475, one_slip_in_ten])


def test_wanderer_plans_by_shade_and_slips_by_its_share():
    world = generate_world(4)
    costs = np.sqrt(-world.reward * np.where(world.reward < -1.0, 4.0, 0.5), where=world.reward < 0.0, out=np.zeros(49))
    best = naive.best_first_steps(world, costs)
    for law in DEMONSTRATORS["wanderer"].laws(world, 6, rng(2)):
        share = 4.0 * law.min(axis=1)[[s for s in range(world.n_states) if not best[s].all()]]
        assert 0.0 <= share[0] <= 0.5
        np.testing.assert_allclose(share, share[0])
        np.testing.assert_allclose(law, (1 - share[0]) * best / best.sum(axis=1, keepdims=True) + share[0] / 4)


def test_perceptual_takes_best_paths_of_another_impression_each_time():
    world = generate_world(4)
    impressions = rng(5).standard_normal((3, world.n_states))
    costs = np.maximum(-world.reward, 0.01) * np.exp(1.6 * impressions)
    laws = DEMONSTRATORS["perceptual"].laws(world, 3, rng(5))
    for law, cost in zip(laws, costs, strict=True):
        best = naive.best_first_steps(world, cost)
        np.testing.assert_array_equal(law > 0.0, best)
    assert not np.array_equal(laws[0], laws[1])


def test_mixture_is_now_like_one_now_like_another():
    """Of 60 attempts about a fifth takes shortest paths; other kinds, too, rule actions out, but not all do."""
    laws = DEMONSTRATORS["mixture"].laws(generate_world(6), 60, rng(0))
    shortest = DEMONSTRATORS["shortest_path"].laws(generate_world(6), 1, rng())[0]
    is_shortest = sum(np.array_equal(law, shortest) for law in laws)
    has_zeros = sum(bool((law == 0.0).any()) for law in laws)
    assert 3 <= is_shortest <= 25
    assert is_shortest < has_zeros < 45


CALIBRATION = {  # the human's mean and best attempt as shares of the optimum, of the prototype
    "mixture": (-0.09, 0.87),
    "boltzmann": (-0.27, 0.73),
    "myopic": (0.25, 0.90),
    "shortest_path": (-0.15, 0.63),
    "wanderer": (-0.13, 0.90),
    "perceptual": (0.09, 0.87),
}


@pytest.mark.parametrize("kind", KINDS)
def test_people_do_about_as_well_as_the_prototypes(kind):
    """±0.1 over 500 worlds (see the module); 100 worlds are given 0.05 more for chance."""
    totals, optima = [], []
    for index in range(100):
        worlds = rng([0, index])
        left = None
        while left is None:
            world = draw_playable_world(worlds)
            left = demonstrate(kind, world, rng([1, index]))
        totals.append([one.total for one in left.demonstrations])
        optima.append(optimum(world))
    mean, best = np.mean(totals) / np.mean(optima), np.mean(np.max(totals, axis=1)) / np.mean(optima)
    assert (mean, best) == pytest.approx(CALIBRATION[kind], abs=0.15)


def test_who_never_fails_is_given_up():
    """In a world where every square pays, nobody can fail."""
    paying = World(3, 3, np.full((3, 3), 0.1), 0, (8,))
    assert demonstrate("shortest_path", paying, rng()) is None
    assert demonstrate("shortest_path", paying, rng(), n_failures=0) is not None


def test_an_order_without_noise_is_by_total_and_equal_totals_tie():
    world = World(2, 2, np.array([[-0.5, -0.5], [-0.5, 4.0]]), 0, (3,))
    straight, other_way, round_about = (
        simulate(world, actions, attempt_id=id_) for actions, id_ in [([1, 2], "a"), ([2, 1], "b"), ([1, 3, 1, 2], "c")]
    )
    ranking = rank_by_total("success", [round_about, straight, other_way], rng())
    assert ranking.groups == (("a", "b"), ("c",))
    assert rank_by_total("success", [round_about, straight], rng(), ties_within=1.0).groups == (("a", "c"),)
    assert rank_by_total("success", [round_about, straight], rng(), ties_within=0.99).groups == (("a",), ("c",))


def test_failures_are_ordered_worst_first():
    world = World(2, 2, np.array([[-0.5, -9.0], [-5.0, 4.0]]), 0, (3,))
    bad, worse = (simulate(world, actions, attempt_id=id_) for actions, id_ in [([2, 1], "bad"), ([1, 2], "worse")])
    assert rank_by_total("failure", [bad, worse], rng()).groups == (("worse",), ("bad",))


@pytest.mark.parametrize("outcome", ["success", "failure"])
@given(noise=st.floats(0.3, 3.0))
def test_two_attempts_are_swapped_as_often_as_stated(outcome, noise):
    """1 / (1 + e^{Δ / noise}), within five standard errors of 400 orders."""
    world = World(2, 2, np.array([[-0.5, -0.5], [-1.0, 4.0]]), 0, (3,))
    better, worse = simulate(world, [1, 2], attempt_id="better"), simulate(world, [2, 1], attempt_id="worse")
    expected_last = "worse" if outcome == "success" else "better"
    generator = rng(3)
    n_swapped = sum(
        rank_by_total(outcome, [better, worse], generator, noise=noise).ids[0] == expected_last for _ in range(400)
    )
    chance = 1.0 / (1.0 + math.exp((better.total - worse.total) / noise))
    assert n_swapped / 400 == pytest.approx(chance, abs=5 * math.sqrt(chance * (1 - chance) / 400))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"kind": "genius"}, "no demonstrator 'genius'; there are mixture"),
        ({"n_successes": -1}, "successes"),
        ({"n_failures": 2.5}, "not 2.5"),
        ({"ranking_noise": math.nan}, "ranking_noise must be a finite number"),
        ({"ties_within": -1.0}, "ties_within"),
    ],
)
def test_bad_input_is_refused_in_words(arguments, words):
    kind = arguments.pop("kind", "mixture")
    with pytest.raises(InvalidSettings, match=words):
        demonstrate(kind, generate_world(3), rng(), **arguments)
