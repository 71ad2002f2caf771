"""Maximum causal entropy: the policy of N steps that is as random as its expected features allow.

Among all policies with given discounted feature counts, the one of largest causal entropy is the softened value
iteration (Ziebart 2010, eqs. 9.1–9.3), with n steps to go:

    Q_n(s, a) = R(s) + γ Σ_{s′} T(s′ | s, a) V_{n−1}(s′),      V_n(s) = log Σ_a exp Q_n(s, a),
    π_n(a | s) = exp(Q_n(s, a) − V_n(s)),      V_n(t) = R(t) at terminal t,      V_0 = 0 elsewhere.

γ in (0, 1] discounts. A state is paid when it is left, a terminal one on arrival: so the state after the last step is
not paid unless it is terminal. The log partition is Σ_s ρ_0(s) V_N(s); its gradient in R is the discounted visits

    μ^π(s) = Σ_{t < N} γ^t P(s_t = s),      at terminal ones Σ_{t ≤ N} γ^t P(s_t = s, arriving at t),

exact whatever the transitions. With certain transitions and γ = 1 it is a distribution over paths like `path`'s, with
one difference: *paths need not arrive*. N steps spent anywhere count as well as a way to the goal, so where rewards
make staying out cheap, it stays out. With uncertain transitions it differs in kind: an action is chosen for what it
leads to on average (Σ T V), never for lucky outcomes (log Σ T e^V).

The policy that is drawn and executed is π_N, with all steps to go; uniform at terminal states. Agrees with
`imitation` 1.0.1, which has no terminal states (tests/imitation_agreement shows how to map one onto the other).
"""

import numpy as np

from irl_core import _kernels
from irl_core.arrays import Matrix, Policy, Vector
from irl_core.errors import InvalidReward
from irl_core.inference.base import Inferred
from irl_core.mdp import Mdp, SparseMdp

StepPolicies = np.ndarray[tuple[int, int, int], np.dtype[np.float64]]


def infer_causal(mdp: Mdp, reward: Vector, *, horizon: int, discount: float, starts: Vector) -> Inferred:
    """Σ ρ_0 V_N, π_N and discounted visits; `reward` and `starts` have shape (S,), γ is in (0, 1].

    Raises InvalidReward where values grow beyond all numbers.
    """
    model = _written_out(mdp)
    values = _values(model, reward, horizon=horizon, discount=discount)
    here, visits = starts.copy(), np.zeros(model.n_states)
    _kernels.causal.forward(
        model.indptr, model.indices, model.probabilities, model.terminal, discount, values, here, visits
    )
    policy = _policy(model, values[-2], discount=discount)
    return Inferred("causal", float((starts * values[-1]).sum()), policy, visits)


def causal_step_policies(mdp: Mdp, reward: Vector, *, horizon: int, discount: float) -> StepPolicies:
    """π_n(a | s) for n = 1, …, N, shape (N, S, A): the policy itself, of which `Inferred.policy` is the last."""
    model = _written_out(mdp)
    values = _values(model, reward, horizon=horizon, discount=discount)
    return np.stack([_policy(model, before, discount=discount) for before in values[:-1]])


def _written_out(mdp: Mdp) -> SparseMdp:
    return mdp if isinstance(mdp, SparseMdp) else mdp.to_sparse()


def _values(model: SparseMdp, reward: Vector, *, horizon: int, discount: float) -> Matrix:
    """V_n for n = 0, …, N, shape (N + 1, S)."""
    values: Matrix = np.empty((horizon + 1, model.n_states))
    values[0] = np.where(model.terminal, reward, 0.0)
    _kernels.causal.backward(model.indptr, model.indices, model.probabilities, reward, model.terminal, discount, values)
    if not np.isfinite(values[-1]).all():
        raise InvalidReward(f"reward is too large: its sum over {horizon} steps is no number any more.", field="reward")
    return values


def _policy(model: SparseMdp, value: Vector, *, discount: float) -> Policy:
    """π_n from V_{n−1}: R(s) cancels, shape (S, A)."""
    expected = np.bincount(model.rows, model.probabilities * value[model.indices], model.n_states * model.n_actions)
    q = discount * expected.reshape(model.n_states, model.n_actions)
    weights = np.exp(q - q.max(axis=1, keepdims=True))
    policy: Policy = weights / weights.sum(axis=1, keepdims=True)
    return policy
