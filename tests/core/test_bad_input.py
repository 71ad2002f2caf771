"""Whatever a stranger hands to the public functions: an IrlError that names the argument, never anything else."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import irl_core as irl
from irl_core import features
from irl_core.demonstrators import demonstrate, rank_by_total
from irl_core.experiment import ExperimentSpec, run_chunk, summarise
from irl_core.influence import influence, what_if
from irl_core.maxent import fit_maxent
from irl_core.simulators import TableSimulator
from tests.core.examples import make_world

WORLD = make_world(3, 4)
GRID = WORLD.mdp
SPARSE = GRID.to_sparse()
S = GRID.n_states
REWARD = np.full(S, -2.0)
UNIFORM = np.full((S, 4), 0.25)
WALKED = irl.simulate(WORLD, [1, 1, 1, 2, 2], id="walked")
PROBLEM = irl.LearningProblem.build(WORLD, [WALKED])

NO_NUMBERS = {
    "none": None,
    "text": "abc",
    "texts": ["-2"] * S,
    "truth values": np.ones(S, dtype=bool),
    "complex": REWARD + 1j,
    "dates": np.zeros(S, dtype="datetime64[s]"),
    "objects": np.array([object()] * S),
    "larger than a float": [-(10**400)] * S,
    "lists of several lengths": [[1.0], [1.0, 2.0]],
    "one number": -2.0,
    "too few": REWARD[:-1],
    "a matrix": REWARD.reshape(3, 4),
    "nothing": [],
    "nan": np.where(np.arange(S) == 3, np.nan, -2.0),
    "infinite": np.where(np.arange(S) == 3, np.inf, -2.0),
    "too large": REWARD * 1e300,
}
REWARD_TAKERS = {
    "path": lambda given: irl.infer(WORLD, given),
    "path_infinite": lambda given: irl.infer(WORLD, given, inference="path_infinite"),
    "causal": lambda given: irl.infer(WORLD, given, inference="causal"),
    "ziebart": lambda given: irl.infer(WORLD, given, inference="ziebart"),
    "sparse": lambda given: irl.infer(SPARSE, given),
    "soft_plan": lambda given: irl.soft_plan(WORLD, given),
    "hard_plan": lambda given: irl.hard_plan(WORLD, given),
    "greedy_plan": lambda given: irl.greedy_plan(WORLD, given),
    "greedy_plan of a sparse model": lambda given: irl.greedy_plan(SPARSE, given),
    "spectral_radius": lambda given: irl.spectral_radius(WORLD, given),
    "spectral_radius of a sparse model": lambda given: irl.spectral_radius(SPARSE, given),
}


@pytest.mark.parametrize("given", NO_NUMBERS.values(), ids=NO_NUMBERS)
@pytest.mark.parametrize("take", REWARD_TAKERS.values(), ids=REWARD_TAKERS)
def test_what_is_no_reward_is_refused_with_its_name(take, given):
    with pytest.raises(irl.InvalidReward) as refused:
        take(given)
    assert refused.value.field == "reward"
    assert "finite" in str(refused.value) or "lie within" in str(refused.value)


@pytest.mark.parametrize("given", NO_NUMBERS.values(), ids=NO_NUMBERS)
@pytest.mark.parametrize("kind", ["path", "path_infinite"])
def test_a_batch_refuses_what_is_no_reward(kind, given):
    rewards: Any = None if given is None else [given]
    with pytest.raises(irl.InvalidReward) as refused:
        irl.infer_batch([WORLD], rewards, inference=kind)
    assert refused.value.field == "rewards"


@pytest.mark.parametrize(
    "given",
    [
        REWARD.tolist(),
        REWARD.astype(np.float32),
        REWARD.astype(np.int64),
        REWARD.astype(">f8"),
        REWARD.astype(np.longdouble),
        np.repeat(REWARD, 2)[::2],
        np.asfortranarray(np.stack([REWARD, REWARD]))[0],
    ],
    ids=["list", "float32", "int", "big-endian", "long double", "every second", "column"],
)
@pytest.mark.parametrize("take", [take for name, take in REWARD_TAKERS.items() if name.startswith("spectral")])
def test_any_layout_of_the_same_numbers_gives_the_same_bits(take, given):
    assert take(given) == take(REWARD)
    assert np.array_equal(irl.infer(WORLD, given).visitation, irl.infer(WORLD, REWARD).visitation)


NO_POLICIES = {
    "none": None,
    "text": "abc",
    "too few rows": UNIFORM[:-1],
    "another number of actions": np.full((S, 5), 0.2),
    "a vector": UNIFORM.reshape(-1),
    "nan": UNIFORM * np.nan,
    "below 0": np.c_[UNIFORM[:, :2], UNIFORM[:, :1] * 3, -UNIFORM[:, :1]],
    "sums of 2": UNIFORM * 2,
    "sums of 0": UNIFORM * 0,
    "truth values": UNIFORM > 0,
    "complex": UNIFORM + 0j,
    "a plan of another model": irl.optimal_plan(make_world(3, 3)),
}
POLICY_TAKERS = {
    "expected_return": lambda given: irl.expected_return(WORLD, given),
    "expected_return of a sparse model": lambda given: irl.expected_return(SPARSE, given),
    "expected_visits": lambda given: irl.expected_visits(GRID, given),
    "expected_visits of a sparse model": lambda given: irl.expected_visits(SPARSE, given),
    "rollouts": lambda given: irl.rollouts(WORLD, given, 2, np.random.default_rng(0)),
    "rollouts of a sparse model": lambda given: irl.rollouts(SPARSE, given, 2, np.random.default_rng(0)),
}


@pytest.mark.parametrize("given", NO_POLICIES.values(), ids=NO_POLICIES)
@pytest.mark.parametrize("take", POLICY_TAKERS.values(), ids=POLICY_TAKERS)
def test_what_is_no_policy_is_refused_with_its_name(take, given):
    with pytest.raises(irl.InvalidPolicy) as refused:
        take(given)
    assert refused.value.field == "policy"


@pytest.mark.parametrize("given", [UNIFORM[:-1], UNIFORM * np.nan, np.full((S, 5), 0.2), None, UNIFORM.reshape(-1)])
@pytest.mark.parametrize("model", [GRID, SPARSE], ids=["grid", "sparse"])
def test_no_simulator_reads_beyond_a_policy(model, given):
    with pytest.raises(irl.InvalidPolicy):
        TableSimulator(model).play(given, 3, np.random.default_rng(0))


STARTS = GRID.starts[None]


@pytest.mark.parametrize(
    "starts",
    [
        STARTS * np.nan,
        STARTS * 0,
        -STARTS,
        STARTS * 2,
        STARTS[:, 1:],
        STARTS[0],
        np.roll(STARTS, -1, axis=1),
        "x",
        None,
    ],
    ids=["nan", "zero", "below 0", "sum 2", "too few", "a vector", "at a goal", "text", "none of one"],
)
@pytest.mark.parametrize("kind", ["path", "path_infinite"])
def test_a_batch_refuses_starts_that_are_no_distributions(kind, starts):
    given: Any = [None] if starts is None else starts
    with pytest.raises(irl.InvalidModel) as refused:
        irl.infer_batch([WORLD], REWARD[None], inference=kind, starts=given)
    assert refused.value.field in {"starts", "start"}


NO_HORIZONS = [0, -1, 10.0, True, "10", 10**30, float("nan"), np.array([3])]


@pytest.mark.parametrize("horizon", NO_HORIZONS, ids=map(str, NO_HORIZONS))
@pytest.mark.parametrize(
    "take",
    [
        lambda n: irl.infer(WORLD, REWARD, horizon=n),
        lambda n: irl.soft_plan(WORLD, REWARD, horizon=n),
        lambda n: irl.hard_plan(WORLD, REWARD, horizon=n),
        lambda n: irl.expected_return(WORLD, UNIFORM, horizon=n),
        lambda n: irl.expected_visits(SPARSE, UNIFORM, horizon=n),
        lambda n: irl.rollouts(WORLD, UNIFORM, 2, np.random.default_rng(0), horizon=n),
    ],
    ids=["infer", "soft_plan", "hard_plan", "expected_return", "expected_visits", "rollouts"],
)
def test_what_is_no_number_of_steps_is_refused(take, horizon):
    with pytest.raises(irl.InvalidSettings, match="whole number from 1") as refused:
        take(horizon)
    assert refused.value.field == "horizon"


NO_MODELS = [None, "x", REWARD]


@pytest.mark.parametrize("model", NO_MODELS, ids=["none", "text", "array"])
@pytest.mark.parametrize(
    "take",
    [
        lambda given: irl.infer(given, REWARD),
        lambda given: irl.infer_batch([given], REWARD[None]),
        lambda given: irl.spectral_radius(given, REWARD),
        lambda given: irl.soft_plan(given, REWARD),
        lambda given: irl.hard_plan(given, REWARD),
        lambda given: irl.greedy_plan(given, REWARD),
        irl.optimum,
        irl.success_is_possible,
        lambda given: irl.simulate(given, [1]),
        lambda given: irl.expected_return(given, UNIFORM),
        lambda given: irl.expected_visits(given, UNIFORM),
        lambda given: irl.rollouts(given, UNIFORM, 2, np.random.default_rng(0)),
        lambda given: irl.demonstration_of(given, [0, 1], [1], id="d", outcome="success"),
        lambda given: irl.feature_counts(given, [WALKED], {"walked": 1.0}),
        lambda given: irl.LearningProblem.build(given, []),
        lambda given: irl.compare(given, [], [], seed=1),
        lambda given: irl.learn("meirl", given),
        lambda given: influence("meirl", given),
        lambda given: what_if(given, drop="walked"),
        TableSimulator,
    ],
)
def test_what_is_no_model_is_refused(take, model):
    with pytest.raises(irl.InvalidModel):
        take(model)


@pytest.mark.parametrize("take", [irl.optimum, lambda given: irl.expected_return(given, UNIFORM)])
def test_a_grid_without_rewards_earns_nothing_and_that_is_said(take):
    with pytest.raises(irl.InvalidModel, match="rewards of their own"):
        take(GRID)


@pytest.mark.parametrize("given", [None, ["walked"], WALKED, [None]])
@pytest.mark.parametrize(
    "take",
    [
        lambda given: irl.LearningProblem.build(WORLD, given),
        lambda given: irl.feature_counts(WORLD, given, {"walked": 1.0}),
        lambda given: irl.compare(WORLD, given, [], seed=1),
    ],
)
def test_what_is_no_list_of_demonstrations_is_refused(take, given):
    with pytest.raises(irl.ImpossibleDemonstration) as refused:
        take(given)
    assert refused.value.field == "demonstrations"


def changed(**fields):
    """The walk with some fields changed, which `simulate` would never have given."""
    given = {
        name: getattr(WALKED, name) for name in ("id", "states", "actions", "rewards", "total", "outcome", "ending")
    }
    return irl.Demonstration(**{**given, **fields})


@pytest.mark.parametrize(
    "forged",
    [
        {"states": WALKED.states.astype(float)},
        {"states": np.stack([WALKED.states] * 2)},
        {"states": np.where(np.arange(6) == 1, 9, WALKED.states)},
        {"states": -WALKED.states},
        {"actions": WALKED.actions + 9},
        {"actions": WALKED.actions - 9},
        {"rewards": WALKED.rewards * np.nan},
        {"total": float("nan")},
        {"total": 99.0},
        {"outcome": "glorious"},
        {"ending": "gave_up"},
    ],
    ids=lambda forged: next(iter(forged)),
)
@pytest.mark.parametrize("model", [WORLD, GRID, SPARSE], ids=["world", "grid", "sparse"])
def test_a_forged_demonstration_is_not_learned_from(model, forged):
    with pytest.raises(irl.ImpossibleDemonstration, match="walked"):
        irl.LearningProblem.build(model, [changed(**forged)])


@pytest.mark.parametrize(
    ("arguments", "refusal"),
    [
        ({"settings": {"iterations": 5}}, irl.InvalidSettings),
        ({"rankings": [["walked"]]}, irl.InvalidRanking),
        ({"rankings": None}, irl.InvalidRanking),
        ({"seed": "x"}, irl.InvalidSettings),
        ({"features": np.eye(S)}, irl.InvalidFeatures),
        ({"features": features.one_hot(3)}, irl.InvalidFeatures),
    ],
)
def test_a_problem_says_what_does_not_belong_to_it(arguments, refusal):
    with pytest.raises(refusal) as refused:
        irl.LearningProblem.build(WORLD, [WALKED], **arguments)
    assert refused.value.field == next(iter(arguments))


@pytest.mark.parametrize("weights", [None, {}, {"walked": float("nan")}, {"walked": "x"}])
def test_feature_counts_need_a_number_for_each_demonstration(weights):
    with pytest.raises(irl.InvalidRanking, match="walked") as refused:
        irl.feature_counts(WORLD, [WALKED], weights)
    assert refused.value.field == "weights"


def test_feature_counts_refuse_demonstrations_of_a_larger_world():
    far = irl.simulate(make_world(5, 5), [1] * 4 + [2] * 4, id="far")
    with pytest.raises(irl.ImpossibleDemonstration, match="state 24, and there are 12"):
        irl.feature_counts(WORLD, [far], {"far": 1.0})


@pytest.mark.parametrize("discount", [float("nan"), -1, 0, 2, "x", True])
@pytest.mark.parametrize(
    "take",
    [
        lambda given: irl.infer(WORLD, REWARD, inference="causal", discount=given),
        lambda given: irl.expected_visits(WORLD, UNIFORM, discount=given),
        lambda given: irl.feature_counts(WORLD, [WALKED], {"walked": 1.0}, discount=given),
    ],
)
def test_a_discount_lies_above_0_and_at_most_at_1(take, discount):
    with pytest.raises(irl.InvalidSettings) as refused:
        take(discount)
    assert refused.value.field == "discount"


@pytest.mark.parametrize("rng", [None, 3])
def test_randomness_comes_from_a_generator_that_is_given(rng):
    with pytest.raises(irl.InvalidSettings, match="default_rng"):
        irl.rollouts(WORLD, UNIFORM, 2, rng)
    with pytest.raises(irl.InvalidSettings, match="default_rng"):
        TableSimulator(GRID).play(UNIFORM, 2, rng)


@pytest.mark.parametrize("seed", [-1, 2.5, "x", None, True, float("nan")])
def test_worlds_are_drawn_from_whole_numbers(seed):
    with pytest.raises(irl.InvalidWorld) as refused:
        irl.draw_playable_world(seed)
    assert refused.value.field == "seed"


@pytest.mark.parametrize("learner", [None, "x", 3, ["meirl"]])
def test_learn_names_the_learners_there_are(learner):
    with pytest.raises(irl.InvalidSettings, match="meirl, irlr"):
        irl.learn(learner, PROBLEM)


@pytest.mark.parametrize("every", [0, 1.5, "x", True, float("nan")])
def test_frames_come_every_whole_number_of_iterations(every):
    with pytest.raises(irl.InvalidSettings) as refused:
        irl.learn("meirl", PROBLEM, frame_every=every)
    assert refused.value.field == "frame_every"


@pytest.mark.parametrize("swap", ["walked", ("a", "b", "c"), 5])
def test_what_if_swaps_a_pair(swap):
    with pytest.raises(irl.InvalidRanking) as refused:
        what_if(PROBLEM, swap=swap)
    assert refused.value.field == "swap"


def test_a_feature_map_of_ones_own_is_learned_with():
    matrix = np.c_[np.ones(S), np.arange(S) % 4, np.arange(S) // 4]
    settings = irl.Settings(optimiser="newton", l2=0.01)
    success = irl.demonstration_of(GRID, WALKED.states, WALKED.actions, id="walked", outcome="success")
    own = irl.LearningProblem.build(GRID, [success], settings=settings, features=features.from_matrix(matrix))
    learned = irl.learn("meirl", own)
    assert learned.outcome == "converged"
    assert learned.weights.shape == (3,)
    assert np.allclose(learned.reward, matrix @ learned.weights, rtol=0, atol=1e-12)
    gap = matrix.T @ (irl.infer(WORLD, learned.reward).visitation - np.bincount(WALKED.states, minlength=S))
    assert np.abs(gap + 0.01 * learned.weights).max() <= 1e-4


@pytest.mark.parametrize("given", [None, "x", [1.0], np.full(12, np.nan), np.full(12, 1j)])
@pytest.mark.parametrize("chosen", [features.one_hot(S), features.tiles(GRID), features.from_matrix(np.eye(S))])
def test_feature_maps_refuse_weights_and_visits_that_are_none(chosen, given):
    with pytest.raises(irl.InvalidFeatures, match="weights must be"):
        chosen.reward(given)
    with pytest.raises(irl.InvalidFeatures, match="visits must be"):
        chosen.counts(given)


@pytest.mark.parametrize(
    ("build", "given"),
    [
        (features.one_hot, 0),
        (features.one_hot, "x"),
        (features.position, SPARSE),
        (features.tiles, SPARSE),
        (lambda given: features.tiles(GRID, offsets=given), 5),
        (lambda given: features.tiles(GRID, offsets=given), (1, 2)),
        (features.colour_class, GRID),
        (features.from_matrix, np.eye(3) * 1j),
        (features.from_matrix, [[10**400]]),
    ],
)
def test_what_makes_no_features_is_refused(build, given):
    with pytest.raises(irl.InvalidFeatures):
        build(given)


@pytest.mark.parametrize("counts", [None, "x", [REWARD], [REWARD + 1j], [[10**400] * S], np.ones(S)])
def test_a_fit_refuses_what_counts_nothing(counts):
    with pytest.raises(irl.InvalidReward) as refused:
        fit_maxent([GRID], counts)
    assert refused.value.field == "counts"


@pytest.mark.parametrize("mdps", [None, [], [WORLD], [SPARSE], GRID])
def test_a_fit_refuses_what_is_no_list_of_grids(mdps):
    with pytest.raises(irl.InvalidModel) as refused:
        fit_maxent(mdps, np.ones((1, S)))
    assert refused.value.field == "mdps"


@pytest.mark.parametrize("horizon", [10**30, -1, 2.5, "x", True])
@pytest.mark.parametrize(
    "build",
    [
        lambda n: irl.GridMdp(3, 3, goals=(8,), horizon=n),
        lambda n: replace(SPARSE, horizon=n),
    ],
    ids=["grid", "sparse"],
)
def test_a_model_refuses_a_horizon_that_would_never_end(build, horizon):
    with pytest.raises(irl.InvalidModel) as refused:
        build(horizon)
    assert refused.value.field == "horizon"


@pytest.mark.parametrize(
    ("ask", "given"),
    [
        (lambda given: demonstrate(given, WORLD, np.random.default_rng(0)), ["wanderer"]),
        (lambda given: demonstrate("wanderer", given, np.random.default_rng(0)), GRID),
        (lambda given: demonstrate("wanderer", WORLD, given), 3),
        (lambda given: rank_by_total("success", given, np.random.default_rng(0)), None),
        (lambda given: rank_by_total("success", [WALKED], given), None),
        (lambda given: rank_by_total("success", [WALKED], np.random.default_rng(0), noise=given), float("nan")),
        (lambda given: rank_by_total("success", [WALKED], np.random.default_rng(0), ties_within=given), -1),
        (lambda given: irl.write_demonstration_file(given, []), None),
        (lambda given: irl.write_demonstration_file(WORLD, given), ["walked"]),
        (irl.read_demonstration_file, None),
        (irl.read_demonstration_file, 5),
        (irl.read_demonstration_file, [1]),
        (lambda given: irl.write_demonstration_file(WORLD, [WALKED], given), [3]),
        (lambda given: ExperimentSpec(learners=given), None),
        (lambda given: ExperimentSpec(learners=given), "meirl"),
        (lambda given: ExperimentSpec(settings=given), "x"),
        (lambda given: run_chunk(given, "wanderer", 0, 1), None),
        (lambda given: run_chunk(ExperimentSpec(), "wanderer", given, 1), "a"),
        (lambda given: run_chunk(ExperimentSpec(), "wanderer", 0, given), 1.5),
        (summarise, None),
        (summarise, ["x"]),
        (irl.LearningState.from_json, {"learner": "meirl", "iteration": "x", "values": {}, "outcome": None}),
    ],
)
def test_helpers_refuse_by_a_named_error_too(ask, given):
    with pytest.raises(irl.IrlError):
        ask(given)


@pytest.mark.parametrize("action", [9, -1, "x", 1.5, None])
def test_the_environment_knows_four_actions(action):
    environment = pytest.importorskip("irl_core.environment")
    with pytest.raises(irl.ImpossibleDemonstration, match="0 up, 1 right"):
        environment.GridworldEnv(WORLD).step(action)
