"""The six kinds of simulated people, each as the law of its attempts, shape (B, S, 4): B attempts, S states, 4 actions.

With r the true reward of a square, c = max(−r, 0.01) its cost, d(s) the fewest steps from s to a goal, and s′_a where
action a leads from s:

    boltzmann      π(a | s) ∝ exp(β Q(s, a)), Q(s, a) = Σ_d T(d | a) (r(s′_d) + V_N(s′_d)) of the best plan; log β
                   uniform on [log 0.2, log 3], anew for each attempt.
    myopic         looks three steps ahead and believes that each step left after that costs 3: G_0 = −3 d, G_k(s) =
                   max_a r(s′_a) + G_{k−1}(s′_a); takes the best a of G_3. One step in ten is a slip of the hand.
    shortest_path  takes one of the shortest paths, each as likely as the others, blind to colour.
    wanderer       sees the shades of the squares roughly: takes a best path where a square costs the geometric mean of
                   c and its colour's mean (4 for red, 0.5 for blue). A share of its steps, uniform on [0, 0.5] and anew
                   for each attempt, is a slip of the hand.
    perceptual     takes a best path under its impression of the squares: c e^{1.6 z}, z standard normal, anew for each
                   square and attempt.
    mixture        each attempt is one of the five above, as likely as the others.

A *slip of the hand* is a step in any of the four directions alike (the world's own slips come on top of it). Where
several actions are equally good, each is as likely. All but `boltzmann` plan as if no step would slip.

The kinds, β's range and the three steps are those of an earlier prototype of this experiment; the rest was chosen so
that players do about as well. Total of all attempts and of the best one over the optimum, prototype (100 worlds) and
here (500 worlds of seed 0):

                     prototype    here                           prototype    here
    mixture         −0.09, 0.87   −0.07, 0.88    shortest_path   −0.15, 0.63  −0.16, 0.58
    boltzmann       −0.27, 0.73   −0.32, 0.74    wanderer        −0.13, 0.90  −0.14, 0.94
    myopic           0.25, 0.90    0.17, 0.91    perceptual       0.09, 0.87   0.15, 0.85
"""

from typing import Final, TypeAlias

import numpy as np

from irl_core import grid
from irl_core.arrays import Matrix, Vector
from irl_core.demonstrators.play import Laws
from irl_core.planning import direction_law, hard_plan
from irl_core.types import RED_BELOW, World

Batch: TypeAlias = np.ndarray[tuple[int, int], np.dtype[np.float64]]
"""One number for each square of each attempt, shape (B, S)."""

RED_COST: Final = 4.0
BLUE_COST: Final = 0.5
LEAST_COST: Final = 0.01
BETA_RANGE: Final = (0.2, 3.0)
LOOK_AHEAD: Final = 3
STEP_COST_BEYOND: Final = 3.0
MYOPIC_SLIPS: Final = 0.1
MOST_WANDERING: Final = 0.5
IMPRESSION_SPREAD: Final = 1.6
_SAME: Final = 1e-9


def boltzmann(world: World, n_attempts: int, rng: np.random.Generator) -> Laws:
    """On the true values, more or less sharply."""
    value = hard_plan(world, world.reward).values[-1]
    worth = direction_law(world, (world.reward + value)[world.next_states])
    lowest, highest = BETA_RANGE
    beta = np.exp(rng.uniform(np.log(lowest), np.log(highest), n_attempts))
    law: Laws = np.exp(beta[:, None, None] * (worth - worth.max(axis=1, keepdims=True)))
    law /= law.sum(axis=2, keepdims=True)
    return law


def myopic(world: World, n_attempts: int, rng: np.random.Generator) -> Laws:
    """Three steps of look-ahead."""
    del rng
    goals = list(world.goals)
    value = -STEP_COST_BEYOND * _distances_to_goal(world)
    for _ in range(LOOK_AHEAD - 1):
        value = (world.reward + value)[world.next_states].max(axis=1)
        value[goals] = 0.0
    law = _best((world.reward + value)[None, world.next_states])
    return _slipping(np.repeat(law, n_attempts, axis=0), np.full(n_attempts, MYOPIC_SLIPS))


def shortest_path(world: World, n_attempts: int, rng: np.random.Generator) -> Laws:
    """Any of the shortest paths: each next square as often as shortest paths go on from it."""
    del rng
    steps = _distances_to_goal(world)
    leads_nearer = steps[world.next_states] < steps[:, None]
    n_paths = (steps == 0.0).astype(np.float64)
    for distance in range(1, int(steps.max()) + 1):
        here = np.flatnonzero(steps == distance)
        n_paths[here] = (leads_nearer[here] * n_paths[world.next_states[here]]).sum(axis=1)
    ways = leads_nearer * n_paths[world.next_states]
    n_ways = ways.sum(axis=1, keepdims=True)
    law = np.divide(ways, n_ways, out=np.full_like(ways, 1.0 / grid.N_ACTIONS), where=n_ways > 0.0)
    return np.repeat(law[None], n_attempts, axis=0)


def wanderer(world: World, n_attempts: int, rng: np.random.Generator) -> Laws:
    """A path by the shades of the squares, left again and again."""
    colour_cost = np.where(world.reward < RED_BELOW, RED_COST, BLUE_COST)
    law = _best_paths(world, np.sqrt(_costs(world) * colour_cost)[None])
    return _slipping(np.repeat(law, n_attempts, axis=0), rng.uniform(0.0, MOST_WANDERING, n_attempts))


def perceptual(world: World, n_attempts: int, rng: np.random.Generator) -> Laws:
    """The best path under noisy impressions of the squares."""
    noise = rng.standard_normal((n_attempts, world.n_states))
    return _best_paths(world, _costs(world) * np.exp(IMPRESSION_SPREAD * noise))


def mixture(world: World, n_attempts: int, rng: np.random.Generator) -> Laws:
    """Now like one of the five, now like another."""
    five = [kind(world, n_attempts, rng) for kind in (boltzmann, myopic, shortest_path, wanderer, perceptual)]
    drawn = rng.integers(len(five), size=n_attempts)
    return np.stack([five[kind][attempt] for attempt, kind in enumerate(drawn.tolist())])


def _costs(world: World) -> Vector:
    """What reaching a square costs, shape (S,); never nothing, so that the best paths end."""
    return np.maximum(-world.reward, LEAST_COST)


def _distances_to_goal(world: World) -> Vector:
    """Fewest steps to a goal, shape (S,); S, more than any, where there is no way."""
    both_ways = grid.neighbours(world.rows, world.cols, goals=(), walls=world.walls)
    steps = grid.distances_from(both_ways, np.array(world.goals))
    return np.where(steps < 0, world.n_states, steps).astype(np.float64)


def _best_paths(world: World, costs: Batch) -> Laws:
    """The first steps of the cheapest paths to a goal, shape (B, S, 4), by Bellman and Ford's recursion."""
    goals = list(world.goals)
    payment: Matrix = -costs
    payment[:, goals] = 0.0
    value: Matrix = np.full_like(costs, -costs.max() * world.n_states)  # worse than any path
    value[:, goals] = 0.0
    for _ in range(world.n_states):
        improved: Matrix = (payment + value)[:, world.next_states].max(axis=2)
        improved[:, goals] = 0.0
        if np.array_equal(improved, value):
            break
        value = improved
    return _best((payment + value)[:, world.next_states])


def _best(worth: Laws) -> Laws:
    """The actions that are worth most, equally likely."""
    is_best = worth >= worth.max(axis=2, keepdims=True) - _SAME
    law: Laws = is_best / is_best.sum(axis=2, keepdims=True)
    return law


def _slipping(law: Laws, share: Vector) -> Laws:
    """The law of a hand that slips in this share of the steps, shape (B,)."""
    by_attempt = share[:, None, None]
    slipping: Laws = (1.0 - by_attempt) * law + by_attempt / grid.N_ACTIONS
    return slipping
