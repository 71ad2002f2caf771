"""What to do with what the posterior knows: the plan for the mean cost, and how sure it is.

The plan is a stochastic shortest path under the costs E[c | data] and worths E[v | data] (`model.py` says why the
mean):

    J(s) = min_a Σ_d T(d | a) (c(s′_d) + J(s′_d)),   J(goal) = 0,   c(goal j) = v_1 − v_j = 1 − v_j,

by value iteration from above. Without slip it is exact after at most S sweeps (Bellman and Ford); with slip it ends
when no J moves by 1e-10 any more. Ties go to the action with the lowest number. At goals and walls, and where no goal
can be reached, the policy is uniform, as everywhere.
"""

from typing import Final, TypeAlias

import numpy as np

from irl_core import grid
from irl_core.arrays import Matrix, Policy, Vector
from irl_core.evaluation import expected_visits
from irl_core.learners.base import Posterior
from irl_core.learners.birlfr.chain import Chain
from irl_core.learners.birlfr.model import Model

Choices: TypeAlias = np.ndarray[tuple[int, int], np.dtype[np.int64]]
LEVEL: Final = 0.9
_STILL: Final = 1e-10
_MOST_SWEEPS: Final = 20_000


def plan(model: Model, costs: Vector) -> Policy:
    """The policy that is best for these costs, shape (n + G,): shape (S, 4)."""
    policy: Policy = np.full((model.mdp.n_states, grid.N_ACTIONS), 1.0 / grid.N_ACTIONS)
    policy[model.squares] = np.eye(grid.N_ACTIONS)[best_actions(model, costs[None])[0]]
    return policy


def best_actions(model: Model, costs: Matrix) -> Choices:
    """The best action in each square for each of several costs, (draws, n + G) → (draws, n)."""
    n, slip = len(model.squares), model.mdp.slip
    ahead = model.evidence.neighbours
    to_go: Matrix = np.zeros_like(costs)
    to_go[:, :n] = 2.0 * (np.abs(costs).max() + 1.0) * costs.shape[1]
    for _ in range(_MOST_SWEEPS):
        worth = (costs + to_go)[:, ahead]
        if slip > 0.0:
            aside = slip / (grid.N_ACTIONS - 1)
            worth = (1.0 - slip - aside) * worth + aside * worth.sum(axis=2, keepdims=True)
        improved = worth.min(axis=2)
        moved = np.abs(improved - to_go[:, :n]).max()
        to_go[:, :n] = improved
        if moved < _STILL:
            break
    choices: Choices = worth.argmin(axis=2)
    return choices


def posterior_of(chain: Chain, policy: Policy, visits: Vector, starts: Vector) -> Posterior:
    """Intervals of reward and return, and how many draws agree with the policy, from every fifth draw.

    `visits`, shape (S,), are those of the executed policy from `starts`. What is not a square has agreement 1.
    """
    model, draws = chain.model, chain.draws
    rewards = np.array([model.reward(costs) for costs in draws])
    returns = rewards @ (visits - starts)
    low, high = (1.0 - LEVEL) / 2.0, (1.0 + LEVEL) / 2.0
    agreement: Vector = np.ones(model.mdp.n_states)
    agreement[model.squares] = (best_actions(model, draws) == policy[model.squares].argmax(axis=1)).mean(axis=0)
    return Posterior(
        level=LEVEL,
        reward_low=np.quantile(rewards, low, axis=0),
        reward_high=np.quantile(rewards, high, axis=0),
        policy_agreement=agreement,
        return_low=float(np.quantile(returns, low)),
        return_high=float(np.quantile(returns, high)),
        n_draws=chain.n_draws,
        acceptance=chain.acceptance,
    )


def executed_visits(model: Model, policy: Policy, starts: Vector) -> Vector:
    """How often executing the policy visits each state, shape (S,)."""
    return expected_visits(model.mdp, policy, starts=starts)
