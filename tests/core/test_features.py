"""Feature maps against their matrices written out, and by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from irl_core import World, generate_world
from irl_core.errors import InvalidFeatures
from irl_core.features import (
    FEATURE_NAMES,
    colour_and_position,
    colour_class,
    features_of,
    from_matrix,
    one_hot,
    position,
    tiles,
)
from irl_core.mdp import GridMdp
from tests.core.examples import make_world


def walled_world():
    """Red, blue / wall, goal."""
    return World(2, 2, np.array([[-3.0, -0.5], [-9.0, 4.0]]), 0, (3,), walls=(2,))


@given(
    name=st.sampled_from(FEATURE_NAMES),
    shape=st.tuples(st.integers(2, 6), st.integers(2, 6)),
    seed=st.integers(0, 2**32),
)
@settings(max_examples=40, deadline=None)
def test_rewards_and_counts_are_products_with_the_matrix_written_out(name, shape, seed):
    world = generate_world(seed, rows=shape[0], cols=shape[1])
    features, rng = features_of(name, world), np.random.default_rng(seed)
    matrix = features.dense()
    weights, visits = rng.normal(size=features.n_features), rng.random(world.n_states)
    assert matrix.shape == (features.n_states, features.n_features)
    np.testing.assert_allclose(features.reward(weights), matrix @ weights, rtol=0, atol=1e-13)
    np.testing.assert_allclose(features.counts(visits), matrix.T @ visits, rtol=0, atol=1e-13)


@pytest.mark.parametrize("name", FEATURE_NAMES)
def test_counts_are_the_gradient_of_a_reward_summed_over_visits(name):
    """⟨φw, μ⟩ = ⟨w, φᵀμ⟩: the two directions are adjoint."""
    world, rng = generate_world(5), np.random.default_rng(0)
    features = features_of(name, world)
    weights, visits = rng.normal(size=features.n_features), rng.random(world.n_states)
    assert features.reward(weights) @ visits == pytest.approx(weights @ features.counts(visits), rel=1e-12)


def test_one_hot_costs_nothing():
    features, weights = one_hot(4), np.arange(4.0)
    assert features.reward(weights) is weights
    assert features.counts(weights) is weights
    np.testing.assert_array_equal(features.dense(), np.eye(4))


def test_colours_are_what_a_person_sees_and_walls_have_none():
    features = colour_class(walled_world())
    np.testing.assert_array_equal(features.dense(), [[1, 0, 0], [0, 1, 0], [0, 0, 0], [0, 0, 1]])
    np.testing.assert_array_equal(features.reward(np.array([-2.0, -1.0, 5.0])), [-2, -1, 0, 5])


def test_colours_say_nothing_of_what_a_square_pays():
    world = generate_world(3)
    rewards = np.where(world.rewards < -1.0, -1.5, world.rewards)
    repainted = World(world.rows, world.cols, rewards, world.start, world.goals)
    np.testing.assert_array_equal(colour_class(world).dense(), colour_class(repainted).dense())


def test_positions_are_scaled_to_1():
    features = position(GridMdp(3, 2, (5,)))
    np.testing.assert_array_equal(
        features.dense(), [[1, 0, 0], [1, 0, 1], [1, 0.5, 0], [1, 0.5, 1], [1, 1, 0], [1, 1, 1]]
    )
    single_row = position(GridMdp(1, 3, (2,)))
    np.testing.assert_array_equal(single_row.dense()[:, 1], 0.0)


def test_colour_and_position_side_by_side():
    np.testing.assert_array_equal(
        colour_and_position(walled_world()).dense(),
        [[1, 0, 0, 0, 0], [0, 1, 0, 0, 1], [0, 0, 0, 1, 0], [0, 0, 1, 1, 1]],
    )


def test_tiles_by_hand():
    """A row of four under tiles of two: pairs (0 1)(2 3), and shifted by one (0)(1 2)(3)."""
    features = tiles(GridMdp(1, 4, (3,)), side=2, offsets=((0, 0), (0, 1)))
    assert features.n_features == 5
    np.testing.assert_array_equal(features.active, [[0, 2], [0, 3], [1, 3], [1, 4]])


@pytest.mark.parametrize("shape", [(7, 7), (3, 8), (1, 6)])
def test_every_tile_covers_a_square_and_every_square_has_one_of_each_tiling(shape):
    matrix = tiles(GridMdp(shape[0], shape[1], (shape[0] * shape[1] - 1,))).dense()
    assert (matrix.sum(axis=0) >= 1).all()
    np.testing.assert_array_equal(matrix.sum(axis=1), 3)


def test_a_matrix_is_taken_as_it_is_and_copied():
    given_matrix = np.array([[1.0, 0.0], [1.0, 2.0], [0.0, -1.0]])
    features = from_matrix(given_matrix, name="mine")
    given_matrix[:] = 0.0
    assert (features.name, features.n_states, features.n_features) == ("mine", 3, 2)
    np.testing.assert_array_equal(features.reward(np.array([1.0, 10.0])), [1, 21, -10])


@pytest.mark.parametrize(
    ("matrix", "says"),
    [
        ([[1.0, 2.0], [2.0, 4.0], [0.5, 1.0]], "Feature 1 is a combination of feature 0"),
        ([[1.0, 0.0, 1.0], [0.0, 1.0, -1.0], [0.0, 0.0, 0.0]], "Feature 2 is a combination of features 0 and 1"),
        ([[1e-8, 1e8 * 3], [2e-8, 1e8 * 6]], "Feature 1 is a combination of feature 0"),
        ([[1.0, 0.0], [2.0, 0.0]], "Feature 1 is 0 in every state"),
        ([[1.0, 0.0, 0.5], [0.0, 1.0, 0.5]], "Feature 2 is a combination of features 0 and 1"),
        ([[1.0, np.nan], [0.0, 1.0]], "those of state 0 are not"),
        ([[1.0, np.inf], [0.0, 1.0]], "must be finite"),
        ([1.0, 2.0], r"its shape is \(2,\)"),
        ([[]], "its shape is"),
        ([["a"]], "matrix of numbers"),
    ],
)
def test_a_matrix_that_cannot_tell_weights_apart_is_refused_by_column(matrix, says):
    with pytest.raises(InvalidFeatures, match=says) as refusal:
        from_matrix(matrix)
    assert refusal.value.field == "features"


def test_columns_of_very_different_sizes_are_independent_all_the_same():
    assert from_matrix([[1e-9, 0.0], [0.0, 1e9], [1e-9, 1e9]]).n_features == 2


@pytest.mark.parametrize(
    ("refused", "field"),
    [
        (lambda: features_of("pixels", make_world()), "features"),
        (lambda: features_of("colour", GridMdp(2, 2, (3,))), "features"),
        (lambda: features_of("tiles", one_hot(3)), "features"),
        (lambda: tiles(make_world(), side=0), "side"),
        (lambda: tiles(make_world(), offsets=()), "offsets"),
        (lambda: tiles(make_world(), side=2, offsets=((0, 2),)), "offsets"),
        (lambda: one_hot(3).reward(np.zeros(2)), "weights"),
        (lambda: one_hot(3).counts(np.zeros(4)), "visits"),
        (lambda: one_hot(3).fitting(make_world()), "features"),
    ],
)
def test_what_does_not_fit_is_refused(refused, field):
    with pytest.raises(InvalidFeatures) as refusal:
        refused()
    assert refusal.value.field == field
