"""Worlds, their generator, and playing in them."""

import json
from functools import reduce
from operator import add
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from irl_core import (
    ImpossibleDemonstration,
    InvalidWorld,
    World,
    draw_playable_world,
    generate_world,
    simulate,
    slip_direction,
    success_is_possible,
)
from tests import naive
from tests.core.examples import DOWN, LEFT, RIGHT, SMALL_WORLDS, UP, make_world

SLIP_VECTORS = json.loads(Path(__file__).with_name("slip_vectors.json").read_text(encoding="utf-8"))


def test_a_generated_world_is_the_papers():
    worlds = [generate_world(seed) for seed in range(200)]
    rewards = np.array([world.reward[:-1] for world in worlds])
    assert all(world.start == 0 and world.goals == (48,) and world.reward[48] == 14.0 for world in worlds)
    assert all(world.horizon == 98 for world in worlds)
    assert (rewards < -1).mean() == pytest.approx(0.3, abs=0.02)
    assert rewards[rewards < -1].mean() == pytest.approx(-4.0, abs=0.1)
    assert rewards[rewards > -1].mean() == pytest.approx(-0.5, abs=0.02)
    assert rewards.min() > -7
    assert rewards.max() < 0


def test_the_same_seed_gives_the_same_world_on_every_machine():
    assert generate_world(42, rows=2, cols=3).rewards.tolist() == [
        [-0.35613487991933546, -0.17723838672917003, -0.5565858011726689],
        [-0.7727612782152231, -4.775211854604512, 5.0],
    ]


def test_more_red_only_turns_more_squares_of_the_same_world_red():
    few, many = generate_world(3, red_probability=0.2), generate_world(3, red_probability=0.6)
    same = few.reward == many.reward
    assert (many.reward[~same] < -1).all()
    assert (few.reward[~same] > -1).all()
    assert generate_world(3, red_probability=0.0).reward.min() > -1


def test_colours_are_those_of_the_rewards():
    world = World(2, 3, np.array([[-0.5, -1.0, -1.5], [0.0, -7.0, 5.0]]), 0, (5,), walls=(3,))
    assert world.colours == (("blue", "blue", "red"), ("wall", "red", "goal"))


@pytest.mark.parametrize(
    ("rows", "cols", "horizon"), [(7, 7, 98), (2, 2, 8), (10, 10, 160), (100, 100, 1600), (2, 100, 400)]
)
def test_the_horizon_is_the_smaller_of_two_rules(rows, cols, horizon):
    assert generate_world(0, rows=rows, cols=cols).horizon == horizon


def test_the_horizon_is_never_less_than_twice_the_shortest_path():
    """Every other row of 29×30 is walled but for one end: 28 steps down, 15 rows of 29 steps along."""
    walls = [row * 30 + col for row in range(1, 29, 2) for col in range(30) if col != (29 if row % 4 == 1 else 0)]
    world = generate_world(0, rows=29, cols=30, walls=walls)
    assert world.horizon == 2 * (28 + 15 * 29) > 8 * (29 + 30)


def test_neighbours_stay_at_edges_walls_and_goals():
    world = make_world(2, 3, walls=(1,))
    assert world.next_states[0].tolist() == [0, 0, 3, 0]
    assert world.next_states[4].tolist() == [4, 5, 4, 3]
    assert world.next_states[5].tolist() == [5, 5, 5, 5]
    assert world.next_states[1].tolist() == [1, 1, 1, 1]


@pytest.mark.parametrize("world", SMALL_WORLDS.values(), ids=SMALL_WORLDS)
def test_a_world_survives_its_json(world):
    assert World.from_json(json.loads(json.dumps({**world.to_json(), "id": "w", "colours": None}))) == world


def test_the_arrays_of_a_world_are_read_only():
    world = generate_world(0)
    for array in (world.rewards, world.reward, world.next_states):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_a_world_keeps_a_copy_of_its_rewards():
    rewards = np.array([[0.0, -1.0], [-1.0, 1.0]])
    world = World(2, 2, rewards, 0, (3,))
    rewards[0, 1] = 99.0
    assert world.reward[1] == -1.0


def test_by_hand_a_success_is_possible_when_the_goal_pays_for_the_way():
    dear = World(2, 2, np.array([[0.0, -3.0], [-2.0, 1.9]]), 0, (3,))
    fair = World(2, 2, np.array([[0.0, -3.0], [-2.0, 2.0]]), 0, (3,))
    assert not success_is_possible(dear)
    assert success_is_possible(fair)
    assert fair.to_json()["success_possible"] is True


def test_a_success_may_need_rewards_collected_on_a_loop():
    world = World(2, 2, np.array([[0.0, -9.0], [1.0, -5.0]]), 0, (3,))
    assert success_is_possible(world)  # bump into the edge of square 2 five times


def test_a_playable_world_is_drawn_and_its_seed_is_on_record():
    world = draw_playable_world(1, red_probability=0.6)
    assert success_is_possible(world)
    assert world.seed is not None
    assert world == generate_world(world.seed, red_probability=0.6)
    assert world == draw_playable_world(np.random.default_rng(1), red_probability=0.6)


def test_where_no_world_is_playable_the_drawing_ends():
    with pytest.raises(InvalidWorld, match="fewer red squares") as refusal:
        draw_playable_world(1, rows=20, cols=20, red_probability=1.0)
    assert refusal.value.field == "red_probability"


def test_by_hand_an_attempt_pays_what_it_reaches_also_at_the_edge():
    world = World(2, 2, np.array([[-0.25, -0.5], [-2.0, 4.0]]), 0, (3,))
    one = simulate(world, [UP, RIGHT, DOWN], attempt_id="a")
    assert one.states.tolist() == [0, 0, 1, 3]
    assert one.rewards.tolist() == [-0.25, -0.5, 4.0]
    assert (one.total, one.outcome, one.ending, one.id) == (3.25, "success", "goal", "a")


@pytest.mark.parametrize(
    ("actions", "ending", "outcome", "found"),
    [
        ([RIGHT, DOWN], None, "failure", "goal"),
        ([RIGHT], None, "failure", "gave_up"),
        ([RIGHT], "gave_up", "failure", "gave_up"),
        ([LEFT] * 8, None, "failure", "out_of_steps"),
        ([LEFT] * 8, "gave_up", "failure", "gave_up"),
        ([DOWN, RIGHT], "goal", "success", "goal"),
    ],
)
def test_how_an_attempt_ends(actions, ending, outcome, found):
    world = World(2, 2, np.array([[0.0, -3.0], [-1.0, 1.0]]), 0, (3,))
    one = simulate(world, actions, ending=ending)
    assert (one.outcome, one.ending) == (outcome, found)


@pytest.mark.parametrize("n_steps", [1, 7, 8])
def test_who_runs_out_of_time_has_failed_if_the_world_has_a_time_limit(n_steps):
    rewards = np.array([[0.0, -3.0], [-1.0, 1.0]])
    limited = World(2, 2, rewards, 0, (3,), time_limit_s=60)
    one = simulate(limited, [LEFT] * n_steps, ending="out_of_time")
    assert (one.outcome, one.ending) == ("failure", "out_of_time")
    assert simulate(limited, [LEFT] * n_steps).ending in {"gave_up", "out_of_steps"}
    with pytest.raises(ImpossibleDemonstration, match="no time limit"):
        simulate(World(2, 2, rewards, 0, (3,)), [LEFT] * n_steps, ending="out_of_time")
    with pytest.raises(ImpossibleDemonstration, match="at a goal"):
        simulate(limited, [DOWN, RIGHT], ending="out_of_time")


def test_the_total_is_the_exact_sum_rounded_once():
    ulp = 2.0**-52
    cost = -0.75 * ulp
    world = World(2, 4, np.array([[0, -1, cost, cost], [0, 1 + 3 * ulp, cost, cost]]), 0, (5,))
    one = simulate(world, [RIGHT, RIGHT, RIGHT, DOWN, LEFT, LEFT], attempt_id="a")
    assert reduce(add, one.rewards.tolist()) < 0.0  # sum() itself is careful from Python 3.12 on
    assert (one.total, one.outcome) == (0.0, "success")


def test_copied_steps_slip_as_they_did_and_the_others_by_the_attempts_own_id():
    world = generate_world(2, slip=0.6)
    actions = [UP, RIGHT, UP, DOWN, LEFT, UP, UP]
    seeds = [("grandparent", 0), ("parent", 2), ("child", 5)]
    one = simulate(world, actions, id="child", slip_seeds=seeds)
    assert one.slip_seeds == tuple(seeds)
    assert one.states.tolist()[:3] == simulate(world, actions[:2], attempt_id="grandparent").states.tolist()
    for t, intended in enumerate(actions):
        seed = "grandparent" if t < 2 else "parent" if t < 5 else "child"
        direction = naive.slipped(seed, t, intended, world.slip)
        assert one.states[t + 1] == naive.step(world, int(one.states[t]), direction)
    assert simulate(world, actions, attempt_id="a").slip_seeds == (("a", 0),)


@pytest.mark.parametrize(
    ("seeds", "said"),
    [
        ([], "begin with 0"),
        ([("a", 1)], "begin with 0"),
        ([("a", 0), ("b", 2), ("c", 1)], "rise"),
        ([("a", 0), ("b", 3)], "below the 3"),
        ([("a", 0), ("b", True)], "rise"),
        ([("a", 0.0)], "begin with 0"),
        ([("\ud800", 0)], "a text"),
        ([(7, 0)], "a text"),
        (["a"], "list of pairs"),
        ("a0", "list of pairs"),
        ({"a": 0}, "list of pairs"),
        (7, "list of pairs"),
    ],
)
def test_slip_seeds_that_decide_no_step_or_twice_are_refused(seeds, said):
    with pytest.raises(ImpossibleDemonstration, match=said) as refusal:
        simulate(make_world(2, 2, slip=0.2), [LEFT] * 3, slip_seeds=seeds)
    assert refusal.value.field == "slip_seeds"


WRONG_ACTIONS = [
    ([], "at least one step", None),
    ([4], "0 up, 1 right, 2 down or 3 left, not 4", 0),
    ([1, -1], "not -1", 1),
    ([True], "not True", 0),
    ([1.0], "not 1.0", 0),
    (["1"], "not '1'", 0),
    ([None], "not None", 0),
    ([[1]], "not a list", 0),
    ([10**400], "more than 18 digits", 0),
    ([1, 2, 1], "already reached", 2),
    ([3] * 9, r"9 steps are more than this world allows \(8\)", 8),
    ("12", "must be a list", None),
    (12, "must be a list", None),
    ({"0": 1}, "must be a list", None),
]


@pytest.mark.parametrize(("actions", "said", "step"), WRONG_ACTIONS, ids=[said for _, said, _ in WRONG_ACTIONS])
def test_an_impossible_attempt_is_refused_and_the_step_is_named(actions, said, step):
    world = World(2, 2, np.array([[0.0, -3.0], [-1.0, 1.0]]), 0, (3,))
    with pytest.raises(ImpossibleDemonstration, match=said) as refusal:
        simulate(world, actions)
    assert refusal.value.step == step
    assert refusal.value.field == "actions"


@pytest.mark.parametrize(
    ("actions", "ending"),
    [([1], "goal"), ([1, 2], "gave_up"), ([1, 2], "out_of_steps"), ([1], "out_of_steps"), ([1], "won"), ([1], 7)],
)
def test_an_ending_that_does_not_fit_is_refused(actions, ending):
    with pytest.raises(ImpossibleDemonstration) as refusal:
        simulate(make_world(2, 2), actions, ending=ending)
    assert refusal.value.field == "ending"


@pytest.mark.parametrize("attempt_id", ["\ud800", "x" * 201, 7])
def test_an_attempt_id_that_cannot_be_hashed_is_refused(attempt_id):
    with pytest.raises(ImpossibleDemonstration, match="id must be a text"):
        simulate(make_world(2, 2, slip=0.2), [1], attempt_id=attempt_id)


@given(
    seed=st.integers(0, 10**6), attempt_id=st.text(max_size=20).filter(lambda text: text.isprintable()), data=st.data()
)
@settings(max_examples=40, deadline=None)
def test_playing_agrees_with_the_slow_twin(seed, attempt_id, data):
    world = generate_world(seed, rows=4, cols=5, slip=0.4)
    actions = data.draw(st.lists(st.integers(0, 3), min_size=1, max_size=world.horizon))
    states, rewards = naive.play(world, actions, attempt_id)
    n_steps = next((t for t, state in enumerate(states) if state in world.goals), len(actions))
    one = simulate(world, actions[:n_steps], attempt_id=attempt_id)
    assert one.states.tolist() == states[: n_steps + 1]
    assert one.rewards.tolist() == rewards[:n_steps]
    assert one.total == pytest.approx(sum(rewards[:n_steps]), abs=1e-12)


def test_the_slip_table_that_the_browser_shares_holds():
    assert len(SLIP_VECTORS) == 200
    for row in SLIP_VECTORS:
        told = (row["attempt_id"], row["step"], row["intended"], row["slip"])
        assert slip_direction(*told) == naive.slipped(*told) == row["direction"], row


def test_slips_are_as_frequent_as_said_and_go_each_way_alike():
    n = 30_000
    turns = np.array([slip_direction("attempt", t, RIGHT, 0.3) for t in range(n)])
    share = np.bincount(turns, minlength=4) / n
    np.testing.assert_allclose(share, [0.1, 0.7, 0.1, 0.1], atol=0.01)


WRONG_WORLDS = [
    ({"rows": 1}, "rows"),
    ({"rows": 101}, "rows"),
    ({"rows": 2.0}, "rows"),
    ({"cols": True}, "cols"),
    ({"cols": "7"}, "cols"),
    ({"seed": -1}, "seed"),
    ({"seed": 2**53}, "seed"),
    ({"seed": None}, "seed"),
    ({"red_probability": 1.1}, "red_probability"),
    ({"red_probability": float("nan")}, "red_probability"),
    ({"red_probability": None}, "red_probability"),
    ({"slip": -0.1}, "slip"),
    ({"slip": 0.91}, "slip"),
    ({"slip": float("inf")}, "slip"),
    ({"slip": "0.1"}, "slip"),
    ({"walls": [0]}, "walls"),
    ({"walls": [48]}, "walls"),
    ({"walls": [49]}, "walls"),
    ({"walls": [5, 5]}, "walls"),
    ({"walls": [1.5]}, "walls"),
    ({"walls": "12"}, "walls"),
    ({"walls": 3}, "walls"),
    ({"walls": [1, 7]}, "walls"),
]


@pytest.mark.parametrize(("wrong", "field"), WRONG_WORLDS, ids=[str(wrong) for wrong, _ in WRONG_WORLDS])
def test_a_world_that_cannot_be_is_refused_and_the_field_is_named(wrong, field):
    with pytest.raises(InvalidWorld) as refusal:
        generate_world(**{"seed": 1, **wrong})
    assert refusal.value.field == field
    assert field in str(refusal.value).lower() or "wall" in str(refusal.value)


WRONG_JSON = [
    ({"rewards": [[0, 0], [0]]}, "rewards"),
    ({"rewards": [[0, 0], [0, "1"]]}, "rewards"),
    ({"rewards": [[0, 0], [0, float("nan")]]}, "rewards"),
    ({"rewards": [[0, 0], [0, 1e7]]}, "rewards"),
    ({"rewards": [[0, 0], [0, True]]}, "rewards"),
    ({"rewards": [[0, 0], [0, 10**400]]}, "rewards"),
    ({"rewards": "0000"}, "rewards"),
    ({"rewards": None}, "rewards"),
    ({"goals": []}, "goals"),
    ({"goals": [0]}, "goals"),
    ({"goals": [4]}, "goals"),
    ({"goals": None}, "goals"),
    ({"start": 4}, "start"),
    ({"start": None}, "start"),
    ({"horizon": 1}, "horizon"),
    ({"horizon": 9}, "horizon"),
    ({"horizon": True}, "horizon"),
    ({"rows": 10**30}, "rows"),
]


@pytest.mark.parametrize(("wrong", "field"), WRONG_JSON, ids=[str(wrong)[:60] for wrong, _ in WRONG_JSON])
def test_json_that_is_no_world_is_refused_and_the_field_is_named(wrong, field):
    good = {"rows": 2, "cols": 2, "rewards": [[0, -1], [-1, 1]], "start": 0, "goals": [3]}
    World.from_json(good)
    with pytest.raises(InvalidWorld) as refusal:
        World.from_json({**good, **wrong})
    assert refusal.value.field == field
    with pytest.raises(InvalidWorld, match="rows is missing"):
        World.from_json({})
