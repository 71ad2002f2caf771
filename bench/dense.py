"""The dense reference: planning with the full tensor T[S, A, S], as a textbook writes it in NumPy."""

import numpy as np

from irl_core import World


def transitions(world: World) -> np.ndarray:
    """T[s, a, s'], the probability of reaching s' by action a from s. Shape (S, 4, S)."""
    tensor = np.zeros((world.n_states, 4, world.n_states))
    for state in range(world.n_states):
        for action in range(4):
            for direction in range(4):
                probability = 1 - world.slip if direction == action else world.slip / 3
                tensor[state, action, world.next_states[state, direction]] += probability
    return tensor


def gradient_visits(world: World, tensor: np.ndarray, reward: np.ndarray, *, horizon: int) -> np.ndarray:
    """Expected visits of the paths that end at the goal within the horizon, P(ζ) ∝ exp(Σ R). Shape (S,)."""
    goals = list(world.goals)
    ahead = np.zeros((horizon + 1, world.n_states))  # Z_n(s), rescaled at each step
    ahead[0, goals] = 1.0
    pay = np.exp(reward)[:, None]
    for n in range(1, horizon + 1):
        ahead[n] = (pay * (tensor @ ahead[n - 1])).sum(axis=1)
        ahead[n, goals] = ahead[n - 1, goals]
        ahead[n] /= ahead[n].max()
    here = np.zeros(world.n_states)
    here[world.start] = 1.0
    visits = here.copy()
    for n in range(horizon, 0, -1):
        moves = np.einsum("sat,t->st", tensor, ahead[n - 1])  # the path measure's own transition law, before scaling
        moves[goals] = 0.0
        total = moves.sum(axis=1, keepdims=True)
        here = here @ np.divide(moves, total, out=np.zeros_like(moves), where=total > 0)
        visits += here
    return visits
