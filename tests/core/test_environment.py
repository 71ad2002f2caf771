"""The gridworld in Gymnasium: its own checks, episodes by seed, its table, its picture, and play by keyboard."""

import itertools
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from irl_core import World, generate_world, optimum
from irl_core.environment import ENVIRONMENT_ID, GridworldEnv
from irl_core.errors import InvalidWorld
from irl_core.mdp.toy_text import from_gymnasium
from irl_core.picture import draw_world
from tests import naive

UP, RIGHT, DOWN, LEFT = range(4)


def small_world(**changes):
    """Red, blue / wall, goal."""
    given: dict[str, Any] = {"rewards": np.array([[-3.0, -0.5], [-9.0, 4.0]]), "start": 0, "goals": (3,), "walls": (2,)}
    return World(2, 2, **(given | changes))


@pytest.mark.parametrize("render_mode", ["rgb_array", "ansi", None])
@pytest.mark.parametrize("slip", [0.0, 0.3])
def test_gymnasium_finds_no_fault(render_mode, slip):
    env = gymnasium.make(ENVIRONMENT_ID, slip=slip, render_mode=render_mode)
    check_env(env.unwrapped, skip_render_check=render_mode is None)


def test_it_is_registered_and_can_be_made_with_generator_numbers():
    env: Any = gymnasium.make(ENVIRONMENT_ID, world_seed=5, rows=4, cols=6, red_probability=0.5, slip=0.1, walls=(8,))
    assert env.unwrapped.world == generate_world(5, rows=4, cols=6, red_probability=0.5, slip=0.1, walls=(8,))
    assert env.observation_space.n == 24
    assert env.action_space.n == 4
    by_module = gymnasium.make(f"irl_core.environment:{ENVIRONMENT_ID}", render_mode="rgb_array")
    assert by_module.metadata["render_fps"] > 0


def test_a_step_pays_the_square_it_reaches_and_the_goal_ends_the_episode():
    env = GridworldEnv(small_world())
    assert env.reset()[0] == 0
    assert env.step(LEFT) == (0, -3.0, False, False, {"total": -3.0, "n_steps": 1, "direction": LEFT})
    assert env.step(DOWN)[:2] == (0, -3.0)  # a wall
    assert env.step(RIGHT)[:4] == (1, -0.5, False, False)
    assert env.step(DOWN)[:4] == (3, 4.0, True, False)
    assert env.step(DOWN)[:4] == (3, 0.0, True, False)


def test_an_episode_is_truncated_at_the_horizon_unless_it_arrives_there():
    env = GridworldEnv(small_world(horizon=3))
    env.reset()
    assert [env.step(UP)[3] for _ in range(3)] == [False, False, True]
    env.reset()
    env.step(UP)
    env.step(RIGHT)
    assert env.step(DOWN)[2:4] == (True, False)


def test_a_seed_gives_the_same_episode_again():
    def walk(seed):
        env = GridworldEnv(slip=0.5)
        env.reset(seed=seed)
        return [env.step(k % 4)[0] for k in range(30)]

    assert walk(3) == walk(3)
    assert walk(3) != walk(4)


def test_slips_are_as_likely_as_the_world_says():
    env = GridworldEnv(World(3, 3, np.zeros((3, 3)), 4, (8,), slip=0.3))
    env.reset(seed=0)
    taken = np.zeros(4)
    for _ in range(4000):
        env.state = 4
        taken[env.step(LEFT)[4]["direction"]] += 1
    np.testing.assert_allclose(taken / 4000, [0.1, 0.1, 0.1, 0.7], atol=0.025)


@pytest.mark.parametrize("slip", [0.0, 0.4])
def test_its_table_is_the_world_s_and_is_read_as_a_model(slip):
    world = generate_world(4, rows=4, cols=3, slip=slip, walls=(4,))
    env = GridworldEnv(world)
    T = naive.transitions(world)
    for state, action in itertools.product(range(12), range(4)):
        if state not in world.walls:
            found = np.zeros(12)
            for chance, reached, reward, ends in env.P[state][action]:
                found[reached] += chance
                assert ends == (reached in world.goals)
                assert reward == (0.0 if state in world.goals else world.reward[reached])
            np.testing.assert_allclose(found, T[state, action], atol=1e-15)
    mdp = from_gymnasium(env)
    assert mdp.horizon == world.horizon
    assert optimum(mdp) == pytest.approx(optimum(world), abs=1e-12)
    np.testing.assert_array_equal(mdp.starts, world.mdp.starts)


def test_a_reset_may_go_on_in_another_world():
    env = GridworldEnv()
    before = env.P[0][RIGHT]
    env.reset(options={"world_seed": 12})
    assert env.world == generate_world(12)
    assert env.P[0][RIGHT] != before
    other = generate_world(13, slip=0.2)
    env.reset(options={"world": other})
    assert env.world is other
    env.reset()
    assert env.world is other


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"world": generate_world(1, rows=3, cols=3)}, "must be a World of 7 × 7"),
        ({"world": 3}, "must be a World"),
        ({"seed": 3}, 'may name "world" or "world_seed", one of them, not seed'),
        ({"world": generate_world(1), "world_seed": 1}, "one of them"),
        ({"world_seed": -1}, "seed must be"),
    ],
)
def test_options_that_fit_no_world_are_refused(options, says):
    with pytest.raises(InvalidWorld, match=says):
        GridworldEnv().reset(options=options)


def test_modes_that_do_not_exist_are_refused():
    with pytest.raises(ValueError, match="not 'human'"):
        GridworldEnv(render_mode="human")


def test_without_a_mode_there_is_a_warning_and_no_picture():
    with pytest.warns(UserWarning, match="Nothing is rendered"):
        assert GridworldEnv().render() is None


def test_as_text_the_agent_stands_in_brackets():
    env = GridworldEnv(small_world(), render_mode="ansi")
    assert env.render() == "start, total 0.00\n[r] b\n #  G\n"
    env.step(RIGHT)
    assert env.render() == "right, total -0.50\n r [b]\n #  G\n"


def test_the_picture_has_the_product_s_colours():
    """Full red and full blue are those of the board, the goal is gold; costs in between lie between."""
    rewards = np.array([[-7.0, -1.0, -1.01], [-0.0, -4.0, 6.0]])
    image = draw_world(World(2, 3, rewards, 0, (5,)), cell=64)
    assert image.shape == (128, 192, 3)
    assert image.dtype == np.uint8
    corner = {state: image[state // 3 * 64 + 6, state % 3 * 64 + 6].tolist() for state in range(6)}
    assert corner[0] == [178, 24, 43]
    assert corner[1] == [33, 102, 172]
    assert corner[5] == [242, 194, 48]
    assert corner[2][0] > corner[2][2]  # the palest red is still red, the palest blue still blue
    assert corner[3][2] > corner[3][0]
    assert corner[0][1] < corner[4][1] < corner[2][1]


@pytest.mark.parametrize("facing", [None, UP, RIGHT, DOWN, LEFT])
def test_the_agent_is_seen_and_looks_where_it_goes(facing):
    world = small_world()
    empty, image = draw_world(world, cell=64), draw_world(world, cell=64, agent=1, facing=facing)
    changed = (empty != image).any(axis=2)
    assert changed[:64, 64:].mean() > 0.25
    assert not changed[64:].any()
    assert not changed[:, :64].any()
    eyes = np.argwhere(image[:64, 64:].sum(axis=2) < 100).mean(axis=0) - 31.5
    assert np.abs(eyes[1]) < 0.5 or np.sign(eyes[1]) == {RIGHT: 1, LEFT: -1}[facing]


@pytest.mark.parametrize(("rows", "cols", "side"), [(2, 2, 128), (7, 7, 448), (10, 40, 480), (100, 100, 500)])
def test_pictures_fit_a_screen(rows, cols, side):
    image = GridworldEnv(rows=rows, cols=cols, render_mode="rgb_array").render()
    assert isinstance(image, np.ndarray)
    assert max(image.shape[:2]) == side


def test_it_can_be_played_by_keyboard(monkeypatch):
    """Down (S) and right (an arrow), then the window is closed."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    pygame = pytest.importorskip("pygame")
    from gymnasium.utils.play import play

    env, walked = GridworldEnv(small_world(walls=()), render_mode="rgb_array"), []
    presses = iter([(pygame.K_s, True), (pygame.K_s, False), (pygame.K_RIGHT, True), (pygame.K_RIGHT, False), None])

    def events():
        press = next(presses, None)
        if press is None:
            return [pygame.event.Event(pygame.QUIT)]
        key, is_down = press
        return [pygame.event.Event(pygame.KEYDOWN if is_down else pygame.KEYUP, key=key)]

    monkeypatch.setattr(pygame.event, "get", events)
    play(
        env,
        wait_on_player=True,
        fps=1000,
        callback=lambda before, after, action, reward, *_: walked.append((after, action, reward)),
    )
    assert walked == [(2, DOWN, -9.0), (3, RIGHT, 4.0)]
