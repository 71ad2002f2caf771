"""What a policy earns in a world, exactly and by playing it.

The return is the sum of the rewards of the squares reached within N steps, the goal once, the start's own not paid:

    V_n(s) = Σ_a π(a | s) Σ_d T(d | a) (r(s′_d) + V_{n−1}(s′_d)),   V_0 = 0,   V(goal) = 0.

A policy is a matrix (S, 4), the same at every step, or a HardPlan, which looks at the steps to go. In a SparseMdp the
returns are what the model itself pays, and `sparse_evaluation.py` does the work.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from irl_core import grid, sparse_evaluation
from irl_core.array_checks import check_discount, check_generator, check_reward, check_whole
from irl_core.arrays import BoolVector, IntVector, Matrix, Policy, Vector
from irl_core.checks import shown
from irl_core.errors import InvalidModel
from irl_core.mdp import GridMdp, Mdp, SparseMdp, as_mdp, start_distribution
from irl_core.planning import HardPlan, check_executable, direction_law, hard_plan
from irl_core.types import World


@dataclass(frozen=True)
class Rollout:
    """One episode: the states it went through, what it earned, whether it arrived."""

    states: tuple[int, ...]
    total: float
    reached_goal: bool

    def to_json(self) -> dict[str, Any]:
        """The rollout as the API has it."""
        return {"states": list(self.states), "total": self.total, "reached_goal": self.reached_goal}


def expected_return(world: World | SparseMdp, policy: Policy | HardPlan, *, horizon: int | None = None) -> float:
    """V_N(start), exact; N is the world's horizon unless said otherwise (and a plan's own horizon at most).

    Raises InvalidPolicy, InvalidModel, InvalidSettings.
    """
    _check_pays(world)
    policy = check_executable(policy, world)
    if isinstance(world, SparseMdp):
        return sparse_evaluation.expected_return(world, policy, horizon=_n_steps(world, policy, horizon))
    return float(_values(world, policy, _n_steps(world, policy, horizon))[world.start])


def state_values(world: World, policy: Policy | HardPlan, *, horizon: int | None = None) -> Vector:
    """V_N of every state of a grid, shape (S,): what is earned from there on average with N steps to go.

    Raises InvalidPolicy, InvalidModel, InvalidSettings.
    """
    _check_pays(world)
    policy = check_executable(policy, world)
    return _values(world, policy, _n_steps(world, policy, horizon))


def expected_visits(
    world: World | GridMdp | SparseMdp,
    policy: Policy | HardPlan,
    *,
    horizon: int | None = None,
    starts: Vector | None = None,
    discount: float = 1.0,
) -> Vector:
    """How often each state is visited on average when the policy is executed, start and goal included, shape (S,).

    `starts`, shape (S,), is the model's own unless given; a visit at step t counts γ^t with a discount γ in (0, 1].
    Raises InvalidPolicy, InvalidModel, InvalidSettings.
    """
    mdp = as_mdp(world)
    policy, discount = check_executable(policy, mdp), check_discount(discount)
    begun = mdp.starts if starts is None else _starts(mdp, starts)
    n_steps = _n_steps(world, policy, horizon)
    if isinstance(world, SparseMdp):
        return sparse_evaluation.expected_visits(world, policy, horizon=n_steps, starts=begun, discount=discount)
    ahead = world.next_states.reshape(-1)
    not_goal = ~grid.mask(world.n_states, world.goals)
    here: Vector = begun.copy()
    visits: Vector = here.copy()
    for law in _laws_first_step_first(world, policy, n_steps):
        moved = law * (here * not_goal * discount)[:, None]
        here = np.bincount(ahead, moved.reshape(-1), world.n_states).astype(np.float64, copy=False)
        visits += here
    return visits


def rollouts(
    world: World | SparseMdp,
    policy: Policy | HardPlan,
    n_episodes: int,
    rng: np.random.Generator,
    *,
    horizon: int | None = None,
) -> list[Rollout]:
    """Play the policy from the start, all episodes side by side. Each step draws one number for each episode.

    Raises InvalidPolicy, InvalidModel, InvalidSettings.
    """
    _check_pays(world)
    policy, rng = check_executable(policy, world), check_generator(rng)
    n_episodes = check_whole("n_episodes", n_episodes, minimum=1)
    n_steps = _n_steps(world, policy, horizon)
    if isinstance(world, SparseMdp):
        return _sparse_rollouts(world, policy, n_episodes, rng, horizon=n_steps)
    is_goal = grid.mask(world.n_states, world.goals)
    states = np.full((n_steps + 1, n_episodes), world.start, dtype=np.int64)
    for step, law_at in enumerate(_laws_where(world, policy, n_steps), start=1):
        here = states[step - 1]
        thresholds = law_at(here)[:, :-1].cumsum(axis=1)
        direction = (rng.random(n_episodes)[:, None] >= thresholds).sum(axis=1)
        states[step] = world.next_states[here, direction]
        if is_goal[states[step]].all():
            states = states[: step + 1]
            break
    return [_rollout(world, path, is_goal[path]) for path in states.T]


def optimum(world: World | SparseMdp) -> float:
    """The largest expected return within the world's horizon, V_N(start) of the best plan."""
    values = optimal_plan(world).values[-1]
    if isinstance(world, SparseMdp):
        return float((world.starts * values).sum())
    return float(values[world.start])


def optimal_plan(world: World | SparseMdp) -> HardPlan:
    """The plan that earns the optimum; it need not arrive where arriving does not pay."""
    _check_pays(world)
    if isinstance(world, SparseMdp):
        return sparse_evaluation.best_plan(world)
    return hard_plan(world, world.reward)


def greedy_plan(world: World | GridMdp | SparseMdp, reward: Vector) -> HardPlan:
    """The best path to a goal (a terminal state) under a learned reward, to be measured on the true one.

    Raises InvalidReward, InvalidModel.
    """
    if isinstance(world, SparseMdp):
        checked = check_reward(reward, n_states=world.n_states)
        return sparse_evaluation.best_plan(world, checked, must_arrive=True)
    return hard_plan(world, reward, must_reach_goal=True)


def _values(world: World, policy: Policy | HardPlan, n_steps: int) -> Vector:
    """V_N, shape (S,)."""
    back_up = _plan_backup(world, policy) if isinstance(policy, HardPlan) else _policy_backup(world, policy)
    value: Vector = np.zeros(world.n_states)
    goals = list(world.goals)
    for n in range(1, n_steps + 1):
        value = back_up((world.reward + value)[world.next_states], n)
        value[goals] = 0.0
    return value


def _policy_backup(world: World, policy: Policy) -> Callable[[Matrix, int], Vector]:
    """From what each direction is worth, shape (S, 4), to what the policy is; it looks at no clock."""
    law = direction_law(world, policy)
    return lambda ahead, _: np.einsum("sd,sd->s", law, ahead)


def _plan_backup(world: World, plan: HardPlan) -> Callable[[Matrix, int], Vector]:
    """The same of a plan with n steps to go. T is symmetric, so what mixes actions mixes what directions are worth."""
    everywhere = np.arange(world.n_states)
    return lambda ahead, n: direction_law(world, ahead)[everywhere, plan.actions[n - 1]]


def _sparse_rollouts(
    mdp: SparseMdp, policy: Policy | HardPlan, n_episodes: int, rng: np.random.Generator, *, horizon: int
) -> list[Rollout]:
    states, totals, n_steps = sparse_evaluation.play(mdp, policy, n_episodes, rng, horizon=horizon)
    return [
        Rollout(tuple(path[: last + 1].tolist()), float(total), bool(mdp.terminal[path[last]]))
        for path, total, last in zip(states.T, totals, n_steps, strict=True)
    ]


def _rollout(world: World, path: IntVector, arrived: BoolVector) -> Rollout:
    reached_goal = bool(arrived.any())
    n_steps = int(arrived.argmax()) if reached_goal else len(path) - 1
    states = path[: n_steps + 1]
    return Rollout(tuple(states.tolist()), float(world.reward[states[1:]].sum()), reached_goal)


def _check_pays(world: object) -> None:
    if not isinstance(world, World | SparseMdp):
        raise InvalidModel(
            f"world must be a World or a SparseMdp, which have rewards of their own, not {shown(world)}.", field="world"
        )


def _starts(mdp: Mdp, given: object) -> Vector:
    """A distribution over all states: whoever starts at an end is there and stays."""
    return start_distribution(given, n_states=mdp.n_states)


def _n_steps(world: World | GridMdp | SparseMdp, policy: Policy | HardPlan, horizon: int | None) -> int:
    n_steps = world.horizon if horizon is None else check_whole("horizon", horizon, minimum=1)
    return min(n_steps, policy.horizon) if isinstance(policy, HardPlan) else n_steps


def _laws_first_step_first(world: World | GridMdp, policy: Policy | HardPlan, n_steps: int) -> Iterator[Matrix]:
    if isinstance(policy, HardPlan):
        return (_plan_law(world, policy, n) for n in range(n_steps, 0, -1))
    law = direction_law(world, policy)
    return (law for _ in range(n_steps))


def _laws_where(world: World, policy: Policy | HardPlan, n_steps: int) -> Iterator[Callable[[IntVector], Matrix]]:
    """The direction law of each step, the first step first, asked for some states only: shape (n,) → (n, 4)."""
    if isinstance(policy, HardPlan):
        return (_plan_law_where(world, actions) for actions in policy.actions[n_steps - 1 :: -1])
    law = direction_law(world, policy)
    return (law.__getitem__ for _ in range(n_steps))


def _plan_law_where(world: World, actions: np.ndarray[tuple[int], np.dtype[np.int8]]) -> Callable[[IntVector], Matrix]:
    always: Matrix = np.eye(grid.N_ACTIONS)
    return lambda here: direction_law(world, always[actions[here]])


def _plan_law(world: World | GridMdp, plan: HardPlan, n: int) -> Matrix:
    """The direction law of a plan with n steps to go, shape (S, 4)."""
    chosen: Matrix = np.zeros((world.n_states, grid.N_ACTIONS))
    chosen[np.arange(world.n_states), plan.actions[n - 1]] = 1.0
    return direction_law(world, chosen)
