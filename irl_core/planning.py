"""Planning: the distribution over paths a reward implies, and the best plan for it.

**Soft.** Paths ζ = (s_0, a_0, s_1, …) start at the start, end at a goal within N steps, and have

    P(ζ) ∝ Π_t T(s_{t+1} | s_t, a_t) · exp(Σ_t R(s_t)),

the start's own reward and the goal's (once) included (Ziebart et al. 2008, Eq. 4; IRLFR paper, Algorithm 1). With
Z_n(s) the weight of all paths from s that arrive within n steps,

    Z_n(goal) = e^{R(goal)},   Z_0(s) = 0,   Z_n(s) = e^{R(s)} Σ_a Σ_d T(d | a) Z_{n−1}(s′_d)

where T(d | a) is the chance that action a moves in direction d. The paper has Z(goal) = 1: with one goal ours shifts
log Z by R(goal) and changes nothing else; with several it is what lets one be worth more than another.

*Slip cancels.* Here a slip goes each of the three other ways alike, so T is doubly stochastic: Σ_a T(d | a) = 1. Hence
Z_n(s) = e^{R(s)} Σ_d Z_{n−1}(s′_d) whatever the slip, and under P(ζ) the next *direction* with n steps to go has

    q_n(d | s) = Σ_a T(d | a) Z_{n−1}(s′_d) / Σ_{d′} Z_{n−1}(s′_{d′}) = Z_{n−1}(s′_d) / Σ_{d′} Z_{n−1}(s′_{d′}),

also without slip in it. Only the *action* behind it keeps it: P_n(a | s) = Σ_d T(d | a) q_n(d | s). Expected visits
run forward with q, the path measure's own transition law; running T with P_n(a | s) instead, as Ziebart's Algorithm 1
has it, is not the gradient of log Z (test_planning.py measures how far off it is).

The gradient of log Z_N(start) in R is the expected number of visits μ^π, so log P(ζ) has gradient (visits of ζ) − μ^π.
Everything is computed as log Z: rewards of ±1000 neither overflow nor underflow, and −∞ means "no way in n steps".
N is finite because the infinite sum rarely exists (`spectral_radius` tells): not even at R = 0.

**Hard.** V_n(s) = max_a Σ_d T(d | a) (r(s′_d) + V_{n−1}(s′_d)), V(goal) = 0: a step pays the square it reaches.

Shapes: S states, directions and actions 4, N steps. Ties go to the action with the lowest number.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, TypeAlias

import numpy as np

from irl_core import grid
from irl_core.array_checks import check_policy, check_reward, check_whole
from irl_core.arrays import BoolMatrix, BoolVector, Matrix, Policy, Reward, Vector, read_only
from irl_core.errors import InvalidModel, InvalidPolicy, InvalidWorld
from irl_core.mdp import GridMdp, Mdp, SparseMdp, as_mdp
from irl_core.mdp.radius import spectral_radius_of
from irl_core.types import World, check_world

StepActions: TypeAlias = np.ndarray[tuple[int, int], np.dtype[np.int8]]
StepPolicies: TypeAlias = np.ndarray[tuple[int, int, int], np.dtype[np.float64]]

_BLOCK: Final = 1 << 18
"""How many numbers the forward pass holds per array at once: 2 MB, some 1,300 steps of a 7×7 world."""

_SMALL: Final = 256
"""States up to which all eigenvalues are found at once."""

_ARRIVAL_FIRST: Final = 1000.0
"""With slip, a plan that must arrive gives up all it could earn for 0.1 % more chance of arriving."""

_AS_LIKELY: Final = 1e-9
"""Chances closer than this are the same, however their last digits came out."""


@dataclass(frozen=True, eq=False)
class SoftPlan:
    """What a reward implies. `policy` is stationary, P_N(a | s), shape (S, 4); `step_log_z` is log Z_n, (N + 1, S).

    Where no goal can be reached, at goals and at walls the policy is uniform.
    """

    log_partition: float
    policy: Policy
    step_log_z: Matrix


@dataclass(frozen=True, eq=False)
class HardPlan:
    """The best action with n steps to go is `actions[n − 1]`, (N, S); `values[n]` is what it earns, (N + 1, S)."""

    actions: StepActions
    values: Matrix

    @property
    def horizon(self) -> int:
        """N, the number of steps planned."""
        return len(self.actions)


def soft_plan(world: World, reward: Reward, *, horizon: int | None = None) -> SoftPlan:
    """Log partition and policy of the path distribution that `reward`, shape (S,), implies within the horizon."""
    check_world(world)
    reward, n_steps = _check(world, reward, horizon)
    goals = list(world.goals)
    ahead = np.ascontiguousarray(world.next_states.T)
    log_z: Matrix = np.empty((n_steps + 1, world.n_states))
    log_z[0] = -np.inf
    log_z[0, goals] = reward[goals]
    for n in range(1, n_steps + 1):
        log_z[n] = reward + _log_sum_exp(log_z[n - 1][ahead])
        log_z[n, goals] = reward[goals]
    if not np.isfinite(log_z[n_steps, world.start]):
        raise InvalidWorld(f"No goal can be reached within {n_steps} steps.", field="horizon")
    directions = next(_direction_laws(world, log_z[n_steps - 1 : n_steps]))[0].T
    # Contiguous, as it is when read back from JSON: sums over another layout differ in the last bit.
    policy = np.ascontiguousarray(_slip_mix(world, _uniform_where_nothing_is_ahead(directions)))
    read_only(log_z)
    read_only(policy)
    return SoftPlan(float(log_z[n_steps, world.start]), policy, log_z)


def visitation(world: World, plan: SoftPlan) -> Vector:
    """μ^π, how often each state is visited on average under P(ζ), shape (S,): the gradient of the log partition."""
    n_states = world.n_states
    ahead = world.next_states.T.reshape(-1)
    here: Vector = np.zeros(n_states)
    here[world.start] = 1.0
    visits: Vector = here.copy()
    steps_to_go = plan.step_log_z[-2::-1]  # log Z_{n−1} for n = N, …, 1
    for laws in _direction_laws(world, steps_to_go):
        for law in laws:
            here = np.bincount(ahead, (law * here).reshape(-1), n_states).astype(np.float64, copy=False)
            visits += here
    return visits


def hard_plan(
    world: World | GridMdp, reward: Reward, *, horizon: int | None = None, must_reach_goal: bool = False
) -> HardPlan:
    """The plan that earns most on average of `reward`, shape (S,), of the squares it reaches.

    With `must_reach_goal`, ending elsewhere costs more than any path can earn (without slip: it arrives whenever it
    can; with slip, 0.1 % more chance of arriving outweighs all rewards). It is the max-product twin of the soft plan.
    """
    reward, n_steps = _check(world, reward, horizon)
    goals = list(world.goals)
    values: Matrix = np.zeros((n_steps + 1, world.n_states))
    actions: StepActions = np.zeros((n_steps, world.n_states), dtype=np.int8)
    if must_reach_goal:
        span = float(reward.max() - reward.min())
        values[0] = -(n_steps * span + 1.0) * (_ARRIVAL_FIRST if world.slip > 0.0 else 1.0)
        values[0, goals] = 0.0
    for n in range(1, n_steps + 1):
        worth = _slip_mix(world, (reward + values[n - 1])[world.next_states])
        actions[n - 1] = worth.argmax(axis=1)
        values[n] = worth.max(axis=1)
        values[n, goals] = 0.0
    return HardPlan(actions, values)


def check_executable(policy: object, model: World | Mdp) -> Policy | HardPlan:
    """A policy (S, A), or a plan, that can be executed in the model. Raises InvalidPolicy."""
    mdp = as_mdp(model)
    if not isinstance(policy, HardPlan):
        return check_policy(policy, terminal=mdp.terminal, n_actions=mdp.n_actions)
    actions = policy.actions
    if actions.ndim != 2 or actions.shape[1] != mdp.n_states or len(actions) == 0:
        raise InvalidPolicy(
            f"The plan must have the shape (steps, {mdp.n_states}) of this model; its shape is {actions.shape}.",
            field="policy",
        )
    if actions.min() < 0 or actions.max() >= mdp.n_actions:
        raise InvalidPolicy(f"The plan's actions must lie from 0 to {mdp.n_actions - 1}.", field="policy")
    return policy


def direction_law(world: World | GridMdp, policy: Policy) -> Matrix:
    """The chance of each direction when `policy` (or a one-hot plan) is executed under slip, shape (S, 4)."""
    return _slip_mix(world, policy)


def likeliest(policy: Policy) -> BoolMatrix:
    """Which actions are the likeliest of their state, all of them where several are, shape (S, A)."""
    likely: BoolMatrix = policy >= policy.max(axis=1, keepdims=True) - _AS_LIKELY
    return likely


def spectral_radius(model: World | Mdp, reward: Reward) -> float:
    """ρ of the e^R-weighted moves between states on the way: the sum over paths of any length is finite iff ρ < 1.

    Only what can be reached from the starts before a terminal state counts. Small grids by the eigenvalues of the
    symmetric e^{R/2} W e^{R/2}, W the number of moves between two squares; others by power iteration in logs, between
    the Collatz–Wielandt bounds (`mdp/radius.py` for a SparseMdp). Where ρ exceeds e^700 it is given as that.
    """
    mdp = as_mdp(model)
    reward = check_reward(reward, n_states=mdp.n_states)
    if isinstance(mdp, SparseMdp):
        return spectral_radius_of(mdp, reward)
    if mdp.n_states <= _SMALL:
        return _largest_eigenvalue(mdp, reward)
    inside, ahead = _on_the_way(mdp), np.ascontiguousarray(mdp.next_states.T)
    log_v = np.where(inside, 0.0, -np.inf)
    low = high = 0.0
    for _ in range(2000):
        grown = np.where(inside, reward + _log_sum_exp(log_v[ahead]), -np.inf)
        growth = grown[inside] - log_v[inside]
        low, high = float(growth.min()), float(growth.max())
        if high - low < 1e-6:
            break
        log_v = grown - grown.max()
    return float(np.exp(min((low + high) / 2, 700.0)))


def _largest_eigenvalue(mdp: GridMdp, reward: Reward) -> float:
    inside = np.flatnonzero(_on_the_way(mdp))
    top = float(reward[inside].max())
    half = np.exp((reward[inside] - top) / 2)
    moves: Matrix = np.zeros((mdp.n_states, mdp.n_states))
    for ahead in mdp.next_states.T:
        moves[np.arange(mdp.n_states), ahead] += 1.0
    weighed = half[:, None] * moves[np.ix_(inside, inside)] * half
    largest = float(np.linalg.eigvalsh(weighed)[-1])
    return float(np.exp(min(np.log(max(largest, 1e-300)) + top, 700.0)))


def _on_the_way(mdp: GridMdp) -> BoolVector:
    reached: BoolVector = (grid.distances_from(mdp.next_states, mdp.start_states) >= 0) & ~mdp.terminal
    return reached


def _check(world: World | GridMdp, reward: Reward, horizon: int | None) -> tuple[Vector, int]:
    """Reward and horizon as they are computed with. Raises InvalidModel, InvalidReward, InvalidSettings."""
    if isinstance(as_mdp(world), SparseMdp):
        raise InvalidModel("world must be a grid, not a SparseMdp.", field="world")
    checked = check_reward(reward, n_states=world.n_states)
    return checked, world.horizon if horizon is None else check_whole("horizon", horizon, minimum=1)


def _log_sum_exp(values: Matrix) -> Vector:
    """Log Σ_d e^{x_d} down the columns, shape (4, S) → (S,); −∞ where every x is −∞."""
    top = values.max(axis=0)
    top[top == -np.inf] = 0.0
    total = np.exp(values - top).sum(axis=0)
    log_total: Vector = np.log(total, out=np.full(total.shape, -np.inf), where=total > 0.0)
    log_sum: Vector = top + log_total
    return log_sum


def _direction_laws(world: World, step_log_z: Matrix) -> Iterator[StepPolicies]:
    """q(d | s) from log Z of the step after, in blocks (steps, 4, S); 0 at goals and where nothing is ahead."""
    ahead = np.ascontiguousarray(world.next_states.T)
    goals = list(world.goals)
    n_rows = max(1, _BLOCK // ahead.size)
    for first in range(0, len(step_log_z), n_rows):
        log_ahead = np.take(step_log_z[first : first + n_rows], ahead, axis=1)
        top = log_ahead.max(axis=1, keepdims=True)
        top[top == -np.inf] = 0.0
        law = np.exp(np.subtract(log_ahead, top, out=log_ahead), out=log_ahead)
        total = law.sum(axis=1, keepdims=True)
        total[total == 0.0] = 1.0
        law /= total
        law[:, :, goals] = 0.0
        yield law


def _uniform_where_nothing_is_ahead(law: Matrix) -> Matrix:
    """Rows that are all 0 become 1/4 each, shape (S, 4)."""
    return np.where(law.any(axis=1, keepdims=True), law, 1.0 / grid.N_ACTIONS)


def _slip_mix(world: World | GridMdp, values: Matrix) -> Matrix:
    """Σ_d T(d | a) x_d (which is also Σ_a T(d | a) x_a: T is symmetric), shape (S, 4)."""
    if world.slip == 0.0:
        return values
    aside = world.slip / (grid.N_ACTIONS - 1)
    mixed: Matrix = (1.0 - world.slip - aside) * values + aside * values.sum(axis=1, keepdims=True)
    return mixed
