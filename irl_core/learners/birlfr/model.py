"""The model of Bayesian IRLFR: what labels, ranks and choices say about the costs of squares.

**Costs.** Every square s that can be visited before a goal has a cost c(s) > 0, in units of what the (first) goal pays:

    log c(s) = m_k + σ_k z_s,   m_k = m̄_k − log L + s_m z_{m,k},   σ_k = σ e^{s_σ z_{σ,k}},   every z ~ N(0, 1),

where k is the colour that people see (red, blue), or one class for all where colours are ignored or there are none, and
L the fewest steps from a start to a goal: where attempts both succeed and fail, one of ordinary length costs about 1. A
further goal j pays v_j = e^{s_v z_j}. An attempt i that enters squares s_1, s_2, … before it ends totals

    g_i = v − C_i,   C_i = Σ_t c(s_t),   v the worth of the goal it reached, 0 if it reached none.

**Labels** (of attempts that reached a goal): success ⇔ g_i ≥ 0, with likelihood σ(±g_i / w_l). They fix the scale,
which choices alone cannot. A failure that reached no goal failed for that reason; its label says nothing about costs.

**Ranks**: each attempt against each of the next group, Bradley and Terry (1952) with a share ε of mistakes,
ε + (1 − 2ε) σ((g_better − g_worse) / w_r). A tie gives no term: people tie what they cannot or will not tell apart, and
an equality would be read as knowledge.

**Choices**: an attempt means to follow the distribution over paths of any length (Ziebart et al. 2008; slip cancels,
see `planning`),

    P(ζ) = exp(−β Σ_t c(s_t) + β (v − 1) − κ L_ζ) / z(s_0),   L_ζ the squares entered before the goal,

but at each step with probability η its hand slips, or the world does: it goes in any direction. With
v(s) = e^{−βc(s) − κ} z(s), of a goal e^{β (v_j − 1)}, a step from s in direction d has probability

    (1 − η) q(d | s) + η / 4,   q(d | s) = v(s′_d) / Σ_d′ v(s′_d′).

Successes and failures have β, κ and η of their own. An attempt that reached no goal is made of steps like any other.
κ = log 4 + e^{…} > log 4 makes z finite whatever the costs: K below is diagonally dominant, so positive definite. One
banded LDLᵀ gives v, a second solve with it the gradient,

    K v = b,  K = diag(e^{βc + κ}) − adjacency,  b(s) = Σ e^{β (v_j − 1)} over goals j beside s;
    ∂ (h·log v) / ∂ (βc(s) + κ) = −g(s) v(s) e^{βc(s) + κ},  K g = h / v.

**The power of choices.** Their log-likelihood is multiplied by ν < 1, as in the power posteriors of Miller and Dunson
(2019) for models that are known to be wrong: who believes something false acts on it at every step, so that steps are
not so many pieces of evidence. Simulated people who are blind to colour or act on noisy impressions of it are misread
at ν = 1; labels and ranks are facts of the game and keep their power.

**Why the posterior mean.** The return of a policy is linear in costs and worths (its expected visits do not depend on
them), so the plan that is best for the mean cost E[c | data] has the largest expected return under the posterior.

The constants (`PRIOR…`) were chosen on simulated attempts, in worlds that no reported figure is from. Red is taken to
cost several times as much as blue *a priori* (m̄: e^1.5 = 4.5, give or take a factor of e^{s_m √2} = 1.9): it is what
people are told. Scores are never used.
"""

from itertools import pairwise, product
from typing import Any, Final

import numpy as np

from irl_core import _kernels, grid
from irl_core.arrays import IntVector, Vector
from irl_core.errors import InvalidModel, IrlError
from irl_core.learners.problem import LearningProblem
from irl_core.mdp import GridMdp
from irl_core.types import RED_BELOW, Demonstration, World

MAX_SQUARES: Final = 400
PRIOR_BLUE: Final = -0.7
PRIOR_RED: Final = 0.8
PRIOR_ONE_CLASS: Final = -0.2
"""The m̄_k: log cost over the cost of 1 / L."""
PRIOR_SPREAD: Final = 0.6
PRIOR_SPREAD_ONE_CLASS: Final = 1.1
"""The σ: within a colour, or over both."""
PRIOR: Final = {
    "class_spread": 0.45,  # s_m
    "spread_of_spread": 0.3,  # s_σ
    "label_width": 0.05,  # w_l
    "rank_width": 0.03,  # w_r
    "flip_rate": 0.03,  # ε
    "choice_power": 0.7,  # ν
    "log_beta": float(np.log(5.0)),
    "log_beta_spread": 1.5,
    "log_kappa": float(np.log(0.5)),
    "log_kappa_spread": 2.0,
    "lapse": -2.5,  # the log odds of η: 0.08, give or take a factor of e
    "lapse_spread": 1.0,
    "log_worth_spread": 0.5,  # s_v
}
_N_CHOICE: Final = 6


class Model:
    """The posterior of one problem: its evidence and prior as the kernels take them. Raises InvalidModel.

    `squares`, shape (n,), are the states with a cost, in the order of the band; `goals`, shape (G,), those that pay.
    `dimension` is how many numbers make a position. Draws have costs of shape (n + G,): of a goal j, 1 − v_j.
    """

    def __init__(self, problem: LearningProblem) -> None:
        self.mdp = grid_of(problem)
        self.squares = _squares(self.mdp)
        self.goals: IntVector = np.array(self.mdp.goals, dtype=np.int64)
        colours = _colours(problem, self.squares)
        self.n_classes = 2 if colours is not None else 1
        self.evidence = _evidence(problem, self.mdp, self.squares, self.goals, colours)
        self.prior = _prior(self.mdp, n_classes=self.n_classes)
        self.n_costs = len(self.squares) + len(self.goals)
        self.dimension = len(self.squares) + 2 * self.n_classes + _N_CHOICE + len(self.goals) - 1

    def log_posterior(self, position: Vector) -> tuple[float, Vector, Vector]:
        """Up to a constant; its gradient, shape (dimension,); and the costs, shape (n + G,)."""
        gradient, costs = np.empty(self.dimension), np.empty(self.n_costs)
        value = _kernels.birlfr.log_posterior(position, gradient, costs, self.evidence, self.prior)
        return float(value), gradient, costs

    def reward(self, costs: Vector) -> Vector:
        """What entering each state pays, shape (S,): −c, of goals v; 0 for walls and what cannot be reached."""
        reward: Vector = np.zeros(self.mdp.n_states)
        reward[self.squares] = -costs[: len(self.squares)]
        reward[self.goals] = 1.0 - costs[len(self.squares) :]
        return reward


def grid_of(problem: LearningProblem) -> GridMdp:
    """The grid of a problem. Raises InvalidModel for another model, or too large a one."""
    mdp = problem.mdp
    if not isinstance(mdp, GridMdp):
        raise InvalidModel("Bayesian IRLFR learns in grids; this model is not one.", field="model")
    n_squares = int((~mdp.terminal & ~mdp.blocked).sum())
    if n_squares > MAX_SQUARES:
        raise InvalidModel(
            f"Bayesian IRLFR learns in grids of up to {MAX_SQUARES} open squares; this one has {n_squares}.",
            field="model",
        )
    return mdp


def _squares(mdp: GridMdp) -> IntVector:
    """The open squares from which a goal can be reached, numbered along the shorter side: the band is as wide."""
    both_ways = grid.neighbours(mdp.rows, mdp.cols, goals=(), walls=mdp.walls)
    order = np.arange(mdp.n_states)
    if mdp.rows < mdp.cols:
        order = order.reshape(mdp.rows, mdp.cols).T.reshape(-1)
    can_arrive = grid.distances_from(both_ways, np.array(mdp.goals)) >= 0
    return order[(can_arrive & ~mdp.terminal & ~mdp.blocked)[order]]


def _colours(problem: LearningProblem, squares: IntVector) -> IntVector | None:
    """0 blue, 1 red: what people saw, and no more of the rewards than that."""
    if not isinstance(problem.model, World) or problem.settings.use_colours == "no":
        return None
    return (problem.model.reward[squares] < RED_BELOW).astype(np.int64)


def _prior(mdp: GridMdp, *, n_classes: int) -> Any:  # noqa: ANN401 - a NamedTuple of the kernel module, loaded late
    steps = grid.distances_from(mdp.next_states, mdp.start_states)[list(mdp.goals)]
    relative = (PRIOR_BLUE, PRIOR_RED) if n_classes > 1 else (PRIOR_ONE_CLASS,)
    return _kernels.birlfr.Prior(
        class_means=np.array(relative) - np.log(steps[steps > 0].min()),
        square_spread=PRIOR_SPREAD if n_classes > 1 else PRIOR_SPREAD_ONE_CLASS,
        **PRIOR,
    )


def _evidence(
    problem: LearningProblem, mdp: GridMdp, squares: IntVector, goals: IntVector, colours: IntVector | None
) -> Any:  # noqa: ANN401 - as above
    number = np.full(mdp.n_states, -1, dtype=np.int64)
    number[squares], number[goals] = np.arange(len(squares)), len(squares) + np.arange(len(goals))
    attempts = informative(problem, number)
    entries, moves = np.zeros((len(attempts), len(squares) + len(goals))), np.zeros((2, len(squares), grid.N_ACTIONS))
    for b, one in enumerate(attempts):
        np.add.at(entries[b], number[one.states[1:]], 1.0)
        here, there = one.states[:-1], one.states[1:]
        went = (mdp.next_states[here] == there[:, None]).argmax(axis=1)
        np.add.at(moves[int(one.outcome == "failure")].reshape(-1), number[here] * grid.N_ACTIONS + went, 1.0)
    neighbours = number[mdp.next_states[squares]]
    inside = neighbours < len(squares)
    return _kernels.birlfr.Evidence(
        neighbours=neighbours.astype(np.int32),
        colours=np.zeros(len(squares), dtype=np.int32) if colours is None else colours.astype(np.int32),
        entries=entries,
        is_failure=np.array([one.outcome == "failure" for one in attempts], dtype=np.int32),
        goals=np.array([number[one.states[-1]] if one.reached_goal else -1 for one in attempts], dtype=np.int32),
        moves=moves,
        pairs=_pairs(problem, {one.id: b for b, one in enumerate(attempts)}),
        width=int(np.where(inside, np.abs(neighbours - np.arange(len(squares))[:, None]), 0).max()),
    )


def informative(problem: LearningProblem, number: IntVector) -> list[Demonstration]:
    """Attempts in the order of their ids; without those that were walled in, who could choose nothing that pays."""
    given = sorted((*problem.successes, *problem.failures), key=lambda one: one.id)
    kept = [one for one in given if number[one.states[0]] >= 0]
    if not kept:
        raise IrlError("No attempt began where a goal can be reached.", field="demonstrations")
    return kept


def _pairs(problem: LearningProblem, number: dict[str, int]) -> np.ndarray[tuple[int, int], np.dtype[np.int32]]:
    """The better and the worse attempt of each pair of neighbours in an order, shape (P, 2)."""
    pairs: list[tuple[int, int]] = []
    for outcome, given in sorted(problem.orders.items()):
        shown = reversed(given) if outcome == "failure" else given  # failures are shown worst first
        groups = [kept for group in shown if (kept := [number[id_] for id_ in group if id_ in number])]
        for better, worse in pairwise(groups):
            pairs += product(better, worse)
    return np.array(pairs, dtype=np.int32).reshape(-1, 2)
