"""What a policy earns in any discrete model (SparseMdp), exactly and by playing it; the best plan for it.

The twin of `evaluation.py`, which leads here. A step from s by action a pays p(s, a) on average, and

    V_n(s) = Σ_a π(a | s) (p(s, a) + Σ_{s′} T(s′ | s, a) V_{n−1}(s′)),   V_0 = 0,   V(terminal) = 0;

the best plan has max_a in place of Σ_a π. p is what the model itself pays, or for a learned reward R of the states that
are reached Σ_{s′} T(s′ | s, a) R(s′).

A policy is a matrix (S, A), the same at every step, or a HardPlan, which looks at the steps to go.
"""

from collections.abc import Iterator

import numpy as np

from irl_core.arrays import IntMatrix, IntVector, Matrix, Policy, Vector
from irl_core.mdp.sparse import SparseMdp
from irl_core.planning import HardPlan

_ARRIVAL_FIRST = 1000.0
"""As on grids: where moves are uncertain, a plan that must arrive gives up all for 0.1 % more chance of arriving."""


def expected_return(mdp: SparseMdp, policy: Policy | HardPlan, *, horizon: int) -> float:
    """Σ_s ρ_0(s) V_N(s), exact."""
    value: Vector = np.zeros(mdp.n_states)
    for chosen in _policies(mdp, policy, range(1, horizon + 1)):
        value = (chosen * _worth(mdp, mdp.pays, value)).sum(axis=1)
        value[mdp.terminal] = 0.0
    return float((mdp.starts * value).sum())


def expected_visits(
    mdp: SparseMdp, policy: Policy | HardPlan, *, horizon: int, starts: Vector, discount: float
) -> Vector:
    """How often each state is visited on average in `horizon` steps, a visit at step t counting γ^t, shape (S,)."""
    here, visits = starts.copy(), starts.copy()
    law = mdp.followed(policy).transpose() if not isinstance(policy, HardPlan) else None
    for chosen in _policies(mdp, policy, range(horizon, 0, -1)):
        moves = mdp.followed(chosen).transpose() if law is None else law
        here = np.asarray(discount * (moves @ here))
        visits += here
    return visits


def play(
    mdp: SparseMdp, policy: Policy | HardPlan, n_episodes: int, rng: np.random.Generator, *, horizon: int
) -> tuple[IntMatrix, Vector, IntVector]:
    """Episodes side by side: states (steps + 1, episodes), what each earned, and its number of steps.

    Each episode draws one number for its start and two for each step of all, whether or not it has ended. After its
    end its state is repeated.
    """
    running = _running_sums(mdp)
    begin = np.minimum(mdp.starts.cumsum().searchsorted(rng.random(n_episodes), side="right"), mdp.n_states - 1)
    states = [begin.astype(np.int64)]
    totals, n_steps = np.zeros(n_episodes), np.zeros(n_episodes, dtype=np.int64)
    for chosen in _policies(mdp, policy, range(horizon, 0, -1)):
        here, goes_on = states[-1], ~mdp.terminal[states[-1]]
        if not goes_on.any():
            break
        which, luck = rng.random((2, n_episodes))
        actions = (which[:, None] >= chosen[here, :-1].cumsum(axis=1)).sum(axis=1)
        rows = here * mdp.n_actions + actions
        entries = np.minimum(running.searchsorted(rows + luck, side="right"), len(running) - 1)
        states.append(np.where(goes_on, mdp.indices[entries], here))
        totals += np.where(goes_on, mdp.entry_pays[entries], 0.0)
        n_steps += goes_on
    return np.stack(states), totals, n_steps


def best_plan(mdp: SparseMdp, reward: Vector | None = None, *, must_arrive: bool = False) -> HardPlan:
    """The plan that earns most of what the model pays or, if given, of a reward (S,) of the states it reaches.

    With `must_arrive`, ending anywhere but in a terminal state costs more than any path can earn.
    """
    pays = mdp.pays if reward is None else _expected(mdp, reward)
    n_steps = mdp.horizon
    values: Matrix = np.zeros((n_steps + 1, mdp.n_states))
    actions = np.zeros((n_steps, mdp.n_states), dtype=np.int8 if mdp.n_actions <= 127 else np.int64)
    if must_arrive:
        entries = pays[~mdp.terminal]
        span = float(entries.max() - entries.min()) if reward is None else float(reward.max() - reward.min())
        certain = bool((mdp.probabilities[mdp.probabilities > 0.0] == 1.0).all())
        values[0] = np.where(mdp.terminal, 0.0, -(n_steps * span + 1.0) * (1.0 if certain else _ARRIVAL_FIRST))
    for n in range(1, n_steps + 1):
        worth = _worth(mdp, pays, values[n - 1])
        actions[n - 1] = worth.argmax(axis=1)
        values[n] = np.where(mdp.terminal, 0.0, worth.max(axis=1))
    return HardPlan(actions, values)


def _worth(mdp: SparseMdp, pays: Matrix, value: Vector) -> Matrix:
    """p(s, a) + Σ_{s′} T(s′ | s, a) V(s′), shape (S, A)."""
    worth: Matrix = pays + _expected(mdp, value)
    return worth


def _expected(mdp: SparseMdp, value: Vector) -> Matrix:
    """Σ_{s′} T(s′ | s, a) V(s′), shape (S, A)."""
    return np.asarray(mdp.transitions @ value).reshape(mdp.n_states, mdp.n_actions)


def _policies(mdp: SparseMdp, policy: Policy | HardPlan, steps_to_go: range) -> Iterator[Matrix]:
    """The policy, (S, A), with each number of steps to go."""
    if not isinstance(policy, HardPlan):
        return (policy for _ in steps_to_go)
    return (np.eye(mdp.n_actions)[policy.actions[n - 1]] for n in steps_to_go)


def _running_sums(mdp: SparseMdp) -> Vector:
    """Row number plus the running sum of the row's probabilities up to each entry: rising, so one search finds a move.

    Where a sum reaches 1 but for rounding it is 1 exactly, so that no draw falls behind the last possible entry.
    """
    cumulative = np.concatenate([[0.0], mdp.probabilities.cumsum()])
    within: Vector = cumulative[1:] - cumulative[mdp.indptr[:-1]][mdp.rows]
    return np.asarray(mdp.rows + np.where(within > 1.0 - 1e-9, 1.0, within), dtype=np.float64)
