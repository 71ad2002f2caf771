"""Write down what `imitation` 1.0.1 finds in a few small models, for tests/core/test_causal.py to compare with.

Run it in an environment of its own (`pip install -r requirements.txt`, Python 3.11), from this folder:

    python agree.py

`imitation` knows no terminal states: its episodes have N steps, every state pays R(s) when it is left, and every action
counts towards the entropy. A model with terminal states is mapped onto one without in one of two ways. A is the number
of actions; a state in which all actions do the same adds log A to its value, which a reward of −log A takes back.

* *absorbing*: where R is 0 at the terminal states, each loops to itself and pays −log A. Its value is then 0 with any
  number of steps to go, as ours is.
* *layers*: a terminal state of any reward pays on arrival, with the last step as well, where other states pay nothing.
  That is a reward of the time: each state is copied for each t = 0 … N. The last copies pay −log A (so they are worth
  0), terminal ones R(s) − log A in every layer, and lead to an end that absorbs. `imitation` plans N + 1 steps.
"""

import json
from pathlib import Path

import numpy as np
from imitation.algorithms.mce_irl import mce_occupancy_measures, mce_partition_fh  # type: ignore[import-not-found]
from seals.base_envs import TabularModelMDP  # type: ignore[import-not-found]

HERE = Path(__file__).parent


def random_model(seed, *, n_states, n_actions, n_terminal):
    """T[s, a, s′], rewards, starts; the last states are terminal (their rows of T are 0)."""
    rng = np.random.default_rng(seed)
    T = rng.dirichlet(np.full(n_states, 0.5), size=(n_states, n_actions))
    T[n_states - n_terminal :] = 0.0
    reward = rng.normal(0.0, 1.0, n_states)
    starts = np.zeros(n_states)
    starts[: n_states - n_terminal] = rng.dirichlet(np.ones(n_states - n_terminal))
    return T.round(6), reward.round(6), starts.round(6)


def normalised(T, starts):
    """Sums of 1 again, after rounding."""
    sums = T.sum(axis=2, keepdims=True)
    return np.divide(T, sums, out=np.zeros_like(T), where=sums > 0), starts / starts.sum()


def ask(T, reward, starts, *, horizon, discount):
    """The soft value V[0], the first policy π[0], and how the states are occupied at t = 0 … N, shape (N + 1, S)."""
    env = TabularModelMDP(transition_matrix=T, reward_matrix=reward, horizon=horizon, initial_state_dist=starts)
    V, _, pi = mce_partition_fh(env, reward=reward, discount=discount)
    D, _ = mce_occupancy_measures(env, reward=reward, pi=pi, discount=discount)
    return V[0], pi[0], D


def plain(T, reward, starts, *, horizon, discount):
    """No terminal states: visits are Σ γ^t D_t without the state after the last step, which is not paid."""
    value, policy, D = ask(T, reward, starts, horizon=horizon, discount=discount)
    return value, policy, discount ** np.arange(horizon) @ D[:-1]


def absorbing(T, reward, starts, terminal, *, horizon, discount):
    """Terminal states of reward 0 loop to themselves and pay −log A; a visit there is the arrival alone."""
    mapped, paid = T.copy(), reward.copy()
    mapped[terminal, :, :] = 0.0
    mapped[terminal, :, terminal] = 1.0
    paid[terminal] = -np.log(T.shape[1])
    value, policy, D = ask(mapped, paid, starts, horizon=horizon, discount=discount)
    arrivals = np.diff(D, axis=0, prepend=np.zeros((1, len(reward))))
    weights = discount ** np.arange(horizon + 1)
    return value, policy, np.where(terminal, weights @ arrivals, weights[:-1] @ D[:-1])


def layers(T, reward, starts, terminal, *, horizon, discount):
    """A copy of every state for every t, and one end."""
    n, m, _ = T.shape
    end = n * (horizon + 1)
    mapped, paid, begun = np.zeros((end + 1, m, end + 1)), np.full(end + 1, -np.log(m)), np.zeros(end + 1)
    begun[:n] = starts
    mapped[end, :, end] = 1.0
    for t in range(horizon + 1):
        copies = np.arange(t * n, (t + 1) * n)
        ends = terminal | (t == horizon)
        mapped[copies[ends], :, end] = 1.0
        paid[copies] = np.where(terminal, reward - np.log(m), reward if t < horizon else -np.log(m))
        if t < horizon:
            mapped[np.ix_(copies[~terminal], np.arange(m), copies + n)] = T[~terminal]
    value, policy, D = ask(mapped, paid, begun, horizon=horizon + 1, discount=discount)
    visits = np.zeros(n)
    for t in range(horizon + 1):
        visits += discount**t * D[t, t * n : (t + 1) * n] * (terminal | (t < horizon))
    return value[:n], policy[:n], visits


def case(name, kind, *, seed, n_states, n_actions, n_terminal, horizon, discount):
    """One model with what `imitation` finds in it, in JSON."""
    T, reward, starts = random_model(seed, n_states=n_states, n_actions=n_actions, n_terminal=n_terminal)
    T, starts = normalised(T, starts)
    terminal = np.arange(n_states) >= n_states - n_terminal
    if kind is absorbing:
        reward[terminal] = 0.0
    settings = {"horizon": horizon, "discount": discount}
    given = (T, reward, starts) if kind is plain else (T, reward, starts, terminal)
    value, policy, visits = kind(*given, **settings)
    return {
        "name": name,
        "transitions": T.tolist(),
        "reward": reward.tolist(),
        "starts": starts.tolist(),
        "terminal": terminal.tolist(),
        **settings,
        "log_partition": float(starts @ value),
        "policy": policy.tolist(),
        "visitation": visits.tolist(),
    }


CASES = [
    case("plain", plain, seed=1, n_states=5, n_actions=3, n_terminal=0, horizon=12, discount=1.0),
    case("plain, discounted", plain, seed=2, n_states=5, n_actions=2, n_terminal=0, horizon=15, discount=0.9),
    case(
        "absorbing ends of reward 0", absorbing, seed=3, n_states=6, n_actions=2, n_terminal=2, horizon=10, discount=1.0
    ),
    case("absorbing, discounted", absorbing, seed=4, n_states=5, n_actions=3, n_terminal=1, horizon=10, discount=0.8),
    case(
        "ends of any reward, in layers", layers, seed=5, n_states=5, n_actions=3, n_terminal=2, horizon=6, discount=1.0
    ),
    case("in layers, discounted", layers, seed=6, n_states=6, n_actions=2, n_terminal=1, horizon=8, discount=0.95),
]

if __name__ == "__main__":
    (HERE / "imitation_1_0_1.json").write_text(json.dumps({"imitation": "1.0.1", "cases": CASES}, indent=1) + "\n")
