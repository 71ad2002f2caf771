"""Learning without a transition table: what is sampled, how it is weighed, how near it comes to the exact learner."""

import json
from dataclasses import replace

import numpy as np
import pytest

from irl_core import (
    GridMdp,
    InvalidModel,
    IrlError,
    LearningProblem,
    LearningResult,
    LearningState,
    MissingDemonstrations,
    Outcome,
    Settings,
    World,
    draw_playable_world,
    expected_return,
    expected_visits,
    infer,
    learn,
)
from irl_core.demonstrators import demonstrate
from irl_core.inference.sampled import infer_sampled
from irl_core.learners import descent, model_free
from irl_core.learners.model_free import ModelFree
from irl_core.simulators import StepSimulator, TableSimulator
from tests.core import naive_model_free as naive
from tests.core.examples import SMALL_WORLDS, make_problem, make_world

LEARNER = ModelFree()


def uniform(mdp):
    return np.full((mdp.n_states, mdp.n_actions), 1.0 / mdp.n_actions)


def rng_of(seed):
    return np.random.default_rng(seed)


def some_policy(mdp, seed):
    return rng_of(seed).dirichlet(np.ones(mdp.n_actions), mdp.n_states)


def sample_of(mdp, reward, policy, n_episodes, *, seed=0):
    return infer_sampled(TableSimulator(mdp).play(policy, n_episodes, rng_of(seed)), reward, policy, starts=mdp.starts)


def problem_of(kind, k, *, side=7, n_each=3, **settings):
    """A simulated person's successes and failures, ranked."""
    for attempt in range(50):
        rng = rng_of([k, attempt])
        world = draw_playable_world(rng, rows=side, cols=side)
        played = demonstrate(kind, world, rng, n_successes=n_each, n_failures=n_each)
        if played is not None:
            return LearningProblem.build(world, played.demonstrations, played.rankings, Settings(**settings))
    raise AssertionError


def small_problem(**settings):
    """A 5×5 world, so that runs are short."""
    return problem_of("perceptual", 0, side=5, n_each=2, **settings)


class TestSimulators:
    @pytest.mark.parametrize("name", ["3x3 slip", "3x3 walls", "3x3 two goals slip"])
    def test_episodes_visit_what_the_policy_visits_on_average(self, name):
        mdp = SMALL_WORLDS[name].mdp
        policy, n = some_policy(mdp, 1), 40_000
        episodes = TableSimulator(mdp).play(policy, n, rng_of(0))
        counts = np.zeros((n, mdp.n_states))
        for t in range(mdp.horizon + 1):
            going = np.flatnonzero(episodes.lengths >= t)
            np.add.at(counts, (going, episodes.states[going, t]), 1.0)
        error = np.abs(counts.mean(axis=0) - expected_visits(mdp, policy))
        assert (error <= 5 * counts.std(axis=0) / np.sqrt(n) + 1e-12).all()

    def test_an_episode_ends_at_a_goal_or_when_its_steps_are_over(self):
        mdp = make_world(3, 3, slip=0.2).mdp
        episodes = TableSimulator(mdp).play(uniform(mdp), 500, rng_of(0))
        for states, length, arrived in zip(episodes.states, episodes.lengths, episodes.arrived, strict=True):
            path = states[: length + 1]
            assert path[0] == 0
            assert (path[-1] == 8) == arrived
            assert 8 not in path[:-1]
            assert arrived or length == mdp.horizon
        assert 0 < episodes.arrived.sum() < 500
        assert episodes.n_steps == episodes.lengths.sum()

    def test_a_sparse_model_of_the_same_grid_plays_the_same_distribution(self):
        mdp = make_world(3, 3, slip=0.3).mdp
        policy = some_policy(mdp, 2)
        ours, theirs = (TableSimulator(one).play(policy, 20_000, rng_of(0)) for one in (mdp, mdp.to_sparse()))
        for first, second in ((ours.lengths, theirs.lengths), (ours.arrived, theirs.arrived)):
            assert abs(first.mean() - second.mean()) < 5 * np.sqrt(2) * first.std() / np.sqrt(20_000)

    def test_several_starts_are_drawn_as_often_as_they_shall(self):
        start = np.zeros(9)
        start[[0, 2]] = 0.25, 0.75
        mdp = GridMdp(3, 3, (8,), start=start)
        episodes = TableSimulator(mdp).play(uniform(mdp), 10_000, rng_of(0))
        assert np.bincount(episodes.states[:, 0], minlength=9)[[0, 2]].tolist() == pytest.approx([2500, 7500], abs=220)

    def test_an_environment_of_gymnasiums_shape_is_played_step_by_step(self):
        environment = Corridor()
        simulator = StepSimulator(environment, horizon=6)
        assert (simulator.n_states, simulator.n_actions) == (3, 2)
        episodes = simulator.play(np.tile([0.3, 0.7], (3, 1)), 200, rng_of(0))
        again = simulator.play(np.tile([0.3, 0.7], (3, 1)), 200, rng_of(0))
        np.testing.assert_array_equal(episodes.states, again.states)
        assert episodes.lengths.max() <= 6
        for states, actions, length in zip(episodes.states, episodes.actions, episodes.lengths, strict=True):
            for t in range(length):
                assert states[t + 1] == max(0, states[t] + (1 if actions[t] else -1))

    def test_what_cannot_be_simulated_is_refused(self):
        with pytest.raises(InvalidModel, match="horizon must be at least 1 step, not 0"):
            StepSimulator(Corridor(), horizon=0)
        with pytest.raises(InvalidModel, match="observation_space must be discrete"):
            StepSimulator(object(), horizon=5)


class Space:
    def __init__(self, n):
        self.n = n


class Corridor:
    """Three squares in a row, left 0 and right 1; the last ends the episode."""

    observation_space, action_space = Space(3), Space(2)

    def reset(self, *, seed):
        del seed
        self.state = 0
        return self.state, {}

    def step(self, action):
        self.state = max(0, self.state + (1 if action else -1))
        return self.state, 0.0, self.state == 2, False, {}


class TestSampledInference:
    @pytest.mark.parametrize("name", ["3x3", "3x3 two goals slip", "2x3 wall slip"])
    def test_weights_are_those_of_the_formulas(self, name):
        mdp = SMALL_WORLDS[name].mdp
        reward, policy = rng_of(3).normal(-1.5, 0.5, mdp.n_states), some_policy(mdp, 4)
        episodes = TableSimulator(mdp).play(policy, 300, rng_of(5))
        sample = infer_sampled(episodes, reward, policy, starts=mdp.starts)
        weights, visits, sums, tries = naive.weigh(episodes, reward, policy)
        np.testing.assert_allclose(sample.shares, weights / weights.sum(), rtol=1e-10)
        np.testing.assert_allclose(sample.visits(), visits, rtol=1e-10, atol=1e-14)
        assert sample.log_partition == pytest.approx(np.log(weights.mean()), abs=1e-10)
        assert sample.effective == pytest.approx(weights.sum() ** 2 / (weights**2).sum())
        np.testing.assert_array_equal(sample.tries, tries)
        np.testing.assert_allclose(np.exp(sample.log_sums), sums, rtol=1e-10)

    def test_curvature_and_effective_after_a_change_are_those_of_the_formulas(self):
        mdp = SMALL_WORLDS["3x3"].mdp
        reward, policy = rng_of(3).normal(-1.5, 0.5, 9), some_policy(mdp, 4)
        episodes = TableSimulator(mdp).play(policy, 400, rng_of(5))
        sample = infer_sampled(episodes, reward, policy, starts=mdp.starts)
        largest = np.linalg.eigvalsh(naive.covariance(episodes, sample.shares, 9))[-1]
        assert sample.curvature(rounds=200) == pytest.approx(largest, rel=1e-6)
        assert 0.5 * largest < sample.curvature() <= largest * (1 + 1e-12)
        change = rng_of(6).normal(0, 0.3, 9)
        after = infer_sampled(episodes, reward + change, policy, starts=mdp.starts)
        assert sample.effective_after(change) == pytest.approx(after.effective)
        assert sample.effective_after(np.zeros(9)) == pytest.approx(sample.effective)

    @pytest.mark.parametrize("name", ["3x3", "3x3 slip", "3x3 two goals slip", "3x3 walls"])
    def test_estimates_come_to_the_exact_ones_as_episodes_grow(self, name):
        """Neither slip nor walls nor goals are told; the error falls like 1/√n: by 10 from 400 to 40,000."""
        mdp = SMALL_WORLDS[name].mdp
        reward = rng_of(1).normal(-1.6, 0.4, mdp.n_states)
        exact = infer(mdp, reward)
        errors = []
        for n, repeats in ((400, 20), (40_000, 2)):
            samples = [sample_of(mdp, reward, uniform(mdp), n, seed=k) for k in range(repeats)]
            errors.append(np.mean([np.abs(one.visits() - exact.visitation).max() for one in samples]))
        assert errors[1] < errors[0] / 4
        assert errors[1] < 0.1
        assert samples[-1].log_partition == pytest.approx(exact.log_partition, abs=0.05)

    def test_each_start_is_normalised_for_itself(self):
        start = np.zeros(9)
        start[[0, 5]] = 0.5, 0.5
        mdp = GridMdp(3, 3, (8,), start=start)
        reward = rng_of(1).normal(-1.6, 0.4, 9)
        wanted = np.zeros(9)
        wanted[[0, 5]] = 0.9, 0.1
        episodes = TableSimulator(mdp).play(uniform(mdp), 60_000, rng_of(2))
        sample = infer_sampled(episodes, reward, uniform(mdp), starts=wanted)
        exact = infer(mdp, reward, starts=wanted)
        np.testing.assert_allclose(sample.visits(), exact.visitation, atol=0.05)
        assert sample.log_partition == pytest.approx(exact.log_partition, abs=0.05)
        np.testing.assert_allclose(sample.visits(start), infer(mdp, reward).visitation, atol=0.05)

    def test_the_soft_policy_itself_proposes_paths_of_one_weight(self):
        mdp = replace(SMALL_WORLDS["3x3"].mdp, horizon=200)
        reward = np.full(9, -2.5)
        sample = sample_of(mdp, reward, infer(mdp, reward).policy, 1000)
        assert sample.effective == pytest.approx(1000, rel=1e-6)

    def test_rewards_of_a_thousand_overflow_nothing(self):
        mdp = SMALL_WORLDS["3x3"].mdp
        for reward in (rng_of(0).uniform(-1000, 1000, 9), np.full(9, -1000.0), np.full(9, 1000.0)):
            sample = sample_of(mdp, reward, uniform(mdp), 200)
            assert np.isfinite(sample.visits()).all()
            assert np.isfinite(sample.log_partition)
            assert sample.visits()[8] == pytest.approx(1.0)

    def test_where_nothing_arrives_there_is_no_weight(self):
        mdp = GridMdp(7, 7, (48,), horizon=12)
        up = np.tile([0.97, 0.01, 0.01, 0.01], (49, 1))
        sample = sample_of(mdp, np.zeros(49), up, 50)
        assert (sample.arrived, sample.effective) == (False, 0.0)
        assert not sample.visits().any()


class TestLearner:
    def test_a_run_in_pieces_and_through_json_is_the_uninterrupted_one_bit_for_bit(self):
        problem = small_problem(iterations=40, episodes=100)
        whole = LEARNER.advance(problem, LEARNER.start(problem), iterations=40)
        state = LEARNER.start(problem)
        while not state.is_finished:
            state = LEARNER.advance(problem, state, iterations=7)
            state = LearningState.from_json(json.loads(json.dumps(state.to_json(), allow_nan=False)))
        assert state.to_json() == whole.to_json()
        first, second = (LEARNER.result(problem, one).to_json() for one in (whole, state))
        assert first == second
        assert LearningResult.from_json(json.loads(json.dumps(first, allow_nan=False))).to_json() == first
        assert LEARNER.frame(problem, whole).to_json() == LEARNER.frame(problem, state).to_json()

    def test_the_order_in_which_demonstrations_are_given_changes_no_bit_and_the_seed_does(self):
        problem = small_problem(iterations=20, episodes=100)
        shuffled = replace(
            problem,
            demonstrations=problem.demonstrations[::-1],
            successes=problem.successes[::-1],
            failures=problem.failures[::-1],
        )
        assert learn(LEARNER, problem).to_json() == learn(LEARNER, shuffled).to_json()
        assert learn(LEARNER, problem).to_json() != learn(LEARNER, replace(problem, seed=1)).to_json()

    def test_its_distance_to_the_exact_descent_shrinks_with_the_episodes(self):
        few, many = (small_problem(episodes=n, iterations=300) for n in (30, 3000))
        exact = exact_descent(many)
        distances = [visits_apart(problem, learn(LEARNER, problem), exact) for problem in (few, many)]
        assert distances[1] < 0.05
        assert distances[1] < distances[0] / 2
        np.testing.assert_allclose(learn(LEARNER, many).visitation, exact.visitation, atol=0.05)

    def test_on_typical_worlds_it_keeps_nine_tenths_of_what_irlfr_earns(self):
        problems = [problem_of("mixture", k) for k in range(4)]
        ours, theirs = (
            np.mean([expected_return(p.world, learn(one, p, frame_every=500).policy) for p in problems])
            for one in (LEARNER, "irlfr")
        )
        assert theirs > 0
        assert ours > 0.9 * theirs

    def test_wanderers_whose_irlfr_oscillates_leave_it_where_samples_can_speak(self):
        """Attempts of up to 44 steps: λ = 5 is below the curvature. Without a bound on λ, ρ reached 10⁴⁷."""
        for k in range(2):
            result = learn(LEARNER, problem_of("boltzmann", k, episodes=300, iterations=300))
            assert np.isfinite(result.reward).all()
            assert result.spectral_radius < 1.2
            assert result.executed_gap < 2.0

    def test_it_learns_from_any_simulator(self):
        problem = small_problem(episodes=60, iterations=60)
        through_steps = ModelFree(StepSimulator(Steps(problem.world), horizon=problem.mdp.horizon))
        ours, theirs = (expected_return(problem.world, learn(one, problem).policy) for one in (LEARNER, through_steps))
        assert theirs == pytest.approx(ours, abs=1.0)

    def test_features_that_squares_share_are_learned_too(self):
        result = learn(LEARNER, small_problem(features="colour_position", iterations=50, episodes=200))
        assert result.weights.shape == (5,)
        assert np.isfinite(result.reward).all()

    def test_slip_and_walls_need_not_be_known(self):
        rewards = np.full((4, 4), -0.3)
        rewards[3, 3] = 8.0
        world = World(4, 4, rewards, 0, (15,), (5,), 0.1)
        played = demonstrate("wanderer", world, rng_of(0), n_successes=3, n_failures=0)
        assert played is not None
        failed = replace(played.demonstrations[0], id="failed", outcome="failure")
        problem = LearningProblem.build(world, played.demonstrations, played.rankings, Settings(iterations=150))
        problem = replace(problem, failures=(failed,))
        result = learn(LEARNER, problem)
        exact = infer(world, result.reward)
        np.testing.assert_allclose(result.visitation, exact.visitation, atol=0.15)

    def test_first_proposals_are_random_and_later_unknown_ones_lean_to_the_demonstrators(self):
        problem = small_problem()
        state = LEARNER.start(problem)
        np.testing.assert_array_equal(model_free.proposal(problem, state), uniform(problem.mdp))
        later = model_free.proposal(problem, replace(state, iteration=3))
        first = problem.successes[0]
        assert later[0, first.actions[0]] > 0.25
        assert later.min() >= 0.125
        np.testing.assert_allclose(later.sum(axis=1), 1.0)

    def test_an_iteration_in_which_nothing_arrives_changes_no_weight(self):
        problem = small_problem()
        lost = ModelFree(Nowhere(problem.mdp))
        state = lost.start(problem)
        later = lost.advance(problem, state, iterations=2)
        np.testing.assert_array_equal(later.vector("w_success"), state.vector("w_success"))
        assert later.iteration == 2
        result = lost.result(problem, later)
        assert "Only 0 of the last 5,000 episodes" in result.sentence
        json.dumps(result.to_json(), allow_nan=False)

    def test_it_says_how_it_ended(self):
        problem = small_problem(iterations=5, episodes=50)
        limit = learn(LEARNER, problem)
        assert limit.outcome is Outcome.ITERATION_LIMIT
        assert limit.sentence.startswith("The limit of 5 iterations of 50 episodes each came first")
        stopped = LEARNER.result(problem, LEARNER.start(problem))
        assert stopped.sentence.startswith("Stopped after 0 of 5 iterations")
        loose = learn(LEARNER, small_problem(tolerance=1.0, episodes=2000))
        assert loose.outcome is Outcome.CONVERGED
        assert loose.gap < 1.1

    def test_what_it_lacks_and_states_of_others_are_refused(self):
        problem = small_problem()
        alone = LearningProblem.build(problem.world, problem.successes[:1])
        with pytest.raises(MissingDemonstrations, match="Model-free IRLFR needs at least one failure"):
            LEARNER.start(alone)
        with pytest.raises(IrlError, match="25 weights; this problem has 49"):
            LEARNER.advance(make_problem(), LEARNER.start(problem), iterations=1)
        with pytest.raises(IrlError, match="no vector"):
            LEARNER.advance(problem, LearningState("irlfr", 0, {}), iterations=1)


class Steps:
    """A world as an environment of Gymnasium's shape."""

    def __init__(self, world):
        self.world, self.state = world, world.start
        self.observation_space, self.action_space = Space(world.n_states), Space(4)

    def reset(self, *, seed):
        del seed
        self.state = self.world.start
        return self.state, {}

    def step(self, action):
        self.state = int(self.world.next_states[self.state, action])
        return self.state, 0.0, self.state in self.world.goals, False, {}


class Nowhere:
    """Episodes that stay at the start."""

    def __init__(self, mdp):
        self.n_states, self.n_actions, self.horizon = mdp.n_states, mdp.n_actions, mdp.horizon

    def play(self, policy, n_episodes, rng):
        del policy
        up = np.tile([1.0, 0.0, 0.0, 0.0], (self.n_states, 1))
        return TableSimulator(GridMdp(5, 5, (24,), horizon=self.horizon)).play(up, n_episodes, rng)


def exact_descent(problem):
    """IRLFR with exact visits, from where the model-free learner starts."""
    aims = descent.aims_of(problem, uses_ranking=True, uses_failures=True)
    state = descent.start(problem, learner="irlfr")
    state = replace(state, values={**state.values, "w_success": LEARNER.start(problem).vector("w_success")})
    return descent.result(problem, descent.advance(problem, state, aims, iterations=10**6), aims)


def visits_apart(problem, one, other):
    first, second = (expected_visits(problem.mdp, result.policy) for result in (one, other))
    return float(np.abs(first - second).max())
