"""What baselines share: how a learned reward is acted upon, and how frames and results are made of a policy.

**Acting on a reward.** T-REX and score-based IRL are methods for learning a reward alone; whoever uses them trains a
policy to maximise it. Here that is done exactly: the policy executed is the optimal plan that must reach a goal. Two
things need settling. A learned reward may pay for squares, and a plan of N steps would then walk in circles to be paid
again. So it is first shifted until no square on the way pays: R(s) ← R(s) − max_s′ R(s′) − δ off the goals, with δ a
hundredth of the rewards' span (1 if all are alike). Between attempts of one length that changes no preference; between
attempts of several it says that time never pays, which is so in these worlds and which no learner could know. And the
policy is stationary, the plan's action with all N steps to go: with every step at a cost the way to the goal is the
same for any horizon that is long enough.

**Frames.** These learners have no distribution over paths: `visitation` is that of the executed policy, the gap is
‖φᵀμ^π − μ̃ᴰ‖∞ with the counts of successes weighed alike, `executed_gap` is 0.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from irl_core.arrays import Policy, Reward, Vector
from irl_core.evaluation import expected_visits, greedy_plan
from irl_core.learners.base import Frame, LearningResult, LearningState, Outcome
from irl_core.learners.problem import LearningProblem
from irl_core.planning import spectral_radius
from irl_core.weights import feature_counts, start_counts

_LEAST_COST: Final = 0.01
"""Of the span of rewards."""


@dataclass(frozen=True, eq=False)
class Learned:
    """What a baseline has come to at some iteration; `n_left_out` failures were of no use to it."""

    weights: Vector
    reward: Reward
    policy: Policy
    log_likelihood: float
    sentence: str
    n_left_out: int = 0


def frame(problem: LearningProblem, state: LearningState, learned: Learned, *, iterations: int) -> Frame:
    """What the state looks like."""
    visits, gap = _visits_and_gap(problem, learned.policy)
    return Frame(
        learner=state.learner,
        iteration=state.iteration,
        iterations=iterations,
        gap=gap,
        log_likelihood=learned.log_likelihood,
        reward=learned.reward,
        policy=learned.policy,
        visitation=visits,
    )


def result(problem: LearningProblem, state: LearningState, learned: Learned) -> LearningResult:
    """What it came to; a state that has not ended by itself was stopped."""
    visits, gap = _visits_and_gap(problem, learned.policy)
    return LearningResult(
        learner=state.learner,
        outcome=state.outcome or Outcome.STOPPED,
        sentence=learned.sentence,
        iterations=state.iteration,
        gap=gap,
        log_likelihood=learned.log_likelihood,
        reward=learned.reward,
        policy=learned.policy,
        visitation=visits,
        n_left_out=learned.n_left_out,
        shape=problem.shape,
        spectral_radius=spectral_radius(problem.mdp, learned.reward),
        executed_gap=0.0,
        weights=learned.weights,
    )


def as_costs(problem: LearningProblem, reward: Reward) -> Reward:
    """The reward shifted off the goals until every step costs something, shape (S,)."""
    on_the_way = ~problem.mdp.terminal
    span = float(reward.max() - reward.min())
    shifted: Reward = reward - np.where(on_the_way, reward[on_the_way].max() + (_LEAST_COST * span or 1.0), 0.0)
    return shifted


def planned_policy(problem: LearningProblem, costs: Reward) -> Policy:
    """The optimal plan that must reach a goal, as a stationary policy of shape (S, A)."""
    plan = greedy_plan(problem.model, costs)
    policy: Policy = np.zeros((problem.mdp.n_states, problem.mdp.n_actions))
    policy[np.arange(problem.mdp.n_states), plan.actions[-1]] = 1.0
    return policy


def uniform_policy(problem: LearningProblem) -> Policy:
    """Every action as likely as any other, shape (S, A)."""
    return np.full((problem.mdp.n_states, problem.mdp.n_actions), 1.0 / problem.mdp.n_actions)


def action_log_likelihood(problem: LearningProblem, policy: Policy) -> float:
    """Σ θ_i Σ_t log π(a_t | s_t) of the successes, weighed alike."""
    theta = problem.success_weights(ranked=False)
    ordered = sorted(problem.successes, key=lambda one: one.id)
    return float(sum(theta[one.id] * np.log(policy[one.states[:-1], one.actions]).sum() for one in ordered))


def _visits_and_gap(problem: LearningProblem, policy: Policy) -> tuple[Vector, float]:
    theta = problem.success_weights(ranked=False)
    starts = start_counts(problem.mdp, problem.successes, theta)
    aim = problem.features.counts(feature_counts(problem.mdp, problem.successes, theta))
    visits = expected_visits(problem.mdp, policy, starts=starts)
    return visits, float(np.abs(problem.features.counts(visits) - aim).max())
