"""Worlds of one's own: another start, other goals, painted squares, limits."""

import json
from typing import Any

import gymnasium
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from irl_core import (
    InvalidFile,
    InvalidWorld,
    World,
    draw_playable_world,
    generate_world,
    read_demonstration_file,
    simulate,
    success_is_possible,
    write_demonstration_file,
)
from irl_core.environment import ENVIRONMENT_ID
from irl_core.picture import draw_world
from tests.core.examples import DOWN, LEFT, RIGHT, UP

OWN: dict[str, Any] = {
    "rows": 5,
    "cols": 6,
    "start": 14,
    "goals": (24, 5),
    "walls": (8, 21),
    "painted": {24: 20.0, 9: -6.0},
}


@given(seed=st.integers(0, 2**53 - 1), red=st.floats(0, 1), data=st.data())
@settings(max_examples=60, deadline=None)
def test_goals_walls_and_paint_change_no_other_square(seed, red, data):
    squares = data.draw(st.permutations(range(20)))
    goals, painted = squares[1:4], {square: -float(square % 8) for square in squares[4:9]}
    plain = generate_world(seed, rows=4, cols=5, red_probability=red)
    own = generate_world(seed, rows=4, cols=5, red_probability=red, start=squares[0], goals=goals, painted=painted)
    for square in range(19):
        expected = 9.0 if square in goals else painted.get(square, plain.reward[square])
        assert own.reward[square] == expected
    assert own.goals == tuple(goals)
    assert own.start == squares[0]


def test_without_anything_of_ones_own_the_world_is_what_it_was():
    same = generate_world(5, start=0, goals=None, painted=None, step_limit=None, time_limit_s=None)
    assert same == generate_world(5)
    assert generate_world(5, goals=[48], painted={}, step_limit=98) == same


def test_the_last_square_is_an_ordinary_one_where_goals_are_given():
    world = generate_world(5, goals=[6])
    assert world.goal == 6
    assert -7.0 < world.reward[48] < 0.0
    assert world.colours[6][6] in {"red", "blue"}


def test_every_goal_pays_as_many_as_there_are_rows_and_columns_unless_it_is_painted():
    world = generate_world(5, goals=[48, 6, 42], painted={6: 0.0, 42: 200})
    assert [world.reward[goal] for goal in (48, 6, 42)] == [14.0, 0.0, 200.0]


def test_a_painted_minus_zero_is_zero():
    painted: Any = {3: -0.0, np.int64(4): np.float64(-1.5)}
    world = generate_world(5, painted=painted)
    assert str(world.reward[3]) == "0.0"
    assert world.reward[4] == -1.5
    assert json.loads(json.dumps(world.to_json()))["rewards"][0][4] == -1.5


def test_an_attempt_begins_at_the_start_and_ends_at_either_goal():
    world = generate_world(5, **OWN)
    near, far = simulate(world, [RIGHT, UP, RIGHT, RIGHT, UP]), simulate(world, [DOWN, LEFT, LEFT, DOWN])
    assert (near.states.tolist(), near.ending) == ([14, 15, 9, 10, 11, 5], "goal")
    assert (far.states.tolist(), far.rewards[-1], far.outcome) == ([14, 20, 19, 18, 24], 20.0, "success")


def test_the_step_limit_is_the_horizon():
    free, tight = generate_world(5, **OWN), generate_world(5, **OWN, step_limit=4)
    assert (free.horizon, free.shortest_way) == (60, 4)
    assert (tight.horizon, tight.mdp.horizon) == (4, 4)
    assert simulate(tight, [UP] * 4).ending == "out_of_steps"


def test_a_step_limit_may_leave_no_time_for_a_success():
    dear_way_and_free_detour = {1: -7.0, 2: 6.0, 7: 0.0, 8: 0.0, 9: 0.0}
    assert success_is_possible(generate_world(5, goals=[2], painted=dear_way_and_free_detour, step_limit=4))
    assert not success_is_possible(generate_world(5, goals=[2], painted=dear_way_and_free_detour, step_limit=3))


def test_a_drawn_world_keeps_what_was_asked_for():
    world = draw_playable_world(1, **OWN, slip=0.1, step_limit=30, time_limit_s=20, red_probability=0.6)
    assert success_is_possible(world)
    asked = {"start": 14, "goals": (24, 5), "walls": (8, 21), "horizon": 30, "time_limit_s": 20, "slip": 0.1}
    assert {name: getattr(world, name) for name in asked} == asked
    assert world.seed is not None
    again = generate_world(world.seed, **OWN, slip=0.1, step_limit=30, time_limit_s=20, red_probability=0.6)
    assert world == again


def test_the_time_limit_belongs_to_the_world_and_survives_json_and_files():
    timed, plain = generate_world(5, time_limit_s=90), generate_world(5)
    assert timed != plain
    assert hash(timed) != hash(plain)
    assert (timed.to_json()["time_limit_s"], plain.to_json()["time_limit_s"]) == (90, None)
    assert World.from_json(json.loads(json.dumps(timed.to_json()))) == timed
    text = write_demonstration_file(timed, [simulate(timed, [RIGHT], attempt_id="a")])
    assert read_demonstration_file(text.splitlines()).world == timed
    older = {name: value for name, value in plain.to_json().items() if name != "time_limit_s"}
    assert World.from_json(older) == plain
    assert np.array_equal(timed.mdp.next_states, plain.mdp.next_states)


def test_a_file_with_an_impossible_limit_names_its_line():
    world = {**generate_world(5, rows=2, cols=2).to_json(), "kind": "world", "time_limit_s": 1}
    with pytest.raises(InvalidFile, match="Line 1: time_limit_s must be a whole number from 5") as refusal:
        read_demonstration_file([json.dumps(world)])
    assert (refusal.value.line, refusal.value.field) == (1, "time_limit_s")


REFUSED = [
    ({"start": 48}, "start", "The start cannot be the last square, 48: it is the goal, unless goals say otherwise."),
    ({"start": 49}, "start", "start must be a whole number from 0 to 48, not 49."),
    ({"start": 1.0}, "start", "not 1.0"),
    ({"goals": []}, "goals", "at least one goal"),
    ({"goals": [0]}, "goals", r"The start, square 0 \(row 1, column 1\), cannot be a goal too; move one of them."),
    ({"goals": [5, 5]}, "goals", "goals names a square twice."),
    ({"goals": 48}, "goals", "goals must be a list of square numbers, not 48."),
    ({"goals": [49]}, "goals", "by their whole numbers, 0 to 48, not 49."),
    ({"goals": [-1]}, "goals", "not -1"),
    (
        {"walls": [0]},
        "walls",
        r"The start, square 0 \(row 1, column 1\), cannot be a wall too; open it or move the start.",
    ),
    ({"walls": [6], "goals": [6]}, "walls", r"The goal, square 6 \(row 1, column 7\), cannot be a wall too"),
    ({"walls": [1, 7]}, "walls", "the walls close the way. Open one of them."),
    ({"painted": [[3, -1]]}, "painted", "painted must be rewards by square, not a list."),
    ({"painted": {49: -1}}, "painted", "0 to 48, not 49"),
    ({"painted": {"3": -1}}, "painted", "not '3'"),
    ({"painted": {3: 1}}, "painted", r"square 3 \(row 1, column 4\) is no goal and can pay -7 to 0, not 1."),
    ({"painted": {3: -7.5}}, "painted", "-7 to 0, not -7.5"),
    ({"painted": {3: float("nan")}}, "painted", "not nan"),
    ({"painted": {3: True}}, "painted", "not True"),
    ({"painted": {48: 201}}, "painted", "is a goal and can pay 0 to 200, not 201"),
    ({"painted": {3: -1}, "walls": [3]}, "painted", "is a wall and pays nothing; open it or leave it unpainted"),
    ({"step_limit": 11}, "step_limit", r"from 12 \(the shortest way to a goal\) to 98, not 11."),
    ({"step_limit": 99}, "step_limit", "to 98, not 99"),
    ({"step_limit": 50.0}, "step_limit", "not 50.0"),
    ({"time_limit_s": 4}, "time_limit_s", "time_limit_s must be a whole number from 5 to 3600, not 4."),
    ({"time_limit_s": True}, "time_limit_s", "not True"),
]


@pytest.mark.parametrize(("asked", "field", "said"), REFUSED, ids=[str(asked) for asked, _, _ in REFUSED])
def test_what_makes_no_world_is_refused_with_the_field_and_what_would_be_right(asked, field, said):
    for make in (generate_world, draw_playable_world):
        with pytest.raises(InvalidWorld, match=said) as refusal:
            make(5, **asked)
        assert refusal.value.field == field


def test_the_environment_and_the_picture_know_the_start_and_every_goal():
    world = generate_world(5, **OWN)
    env = gymnasium.make(ENVIRONMENT_ID, world=world, render_mode="rgb_array")
    assert env.reset(seed=1)[0] == 14
    for action in (RIGHT, UP, RIGHT, RIGHT):
        assert not env.step(action)[2]
    reached, reward, ended, _, _ = env.step(UP)
    assert (reached, reward, ended) == (5, world.reward[5], True)
    picture = draw_world(world, cell=4)
    goal_colours = {tuple(picture[4 * (goal // 6), 4 * (goal % 6)]) for goal in (24, 5)}
    assert len(goal_colours) == 1
