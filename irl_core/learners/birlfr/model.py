"""The model of Bayesian IRLFR: what labels, ranks and choices say about the costs of squares.

**Costs.** Every square s that can be visited before a goal has a cost c(s) > 0, in units of what the (first) goal pays:

    c(s) = u_k (a_k + (b_k − a_k) Φ(z_s)),   log u_k = m̄ − log L + s_m z_{m,k},   every z ~ N(0, 1),

where k is the colour that people see and [a_k, b_k] the range of rewards that they are told it stands for (blue up to
1, red 1 to 7, each equally likely), Φ the normal distribution function, and L the fewest steps from a start to a goal;
the goal pays about L. Where colours are ignored, or there are none, log c(s) = m̄ − log L + s_m z_m + σ z_s. A
further goal j pays v_j = e^{s_v z_j}. An attempt i that enters squares s_1, s_2, … before it ends totals

    g_i = v − C_i,   C_i = Σ_t c(s_t),   v the worth of the goal it reached, 0 if it reached none.

**Labels** (of attempts that reached a goal): success ⇔ g_i ≥ 0, with likelihood σ(±g_i / w_l). They fix the scale,
which choices alone cannot. A failure that reached no goal failed for that reason; its label says nothing about costs.

**Ranks**: each attempt against each of the next group, Bradley and Terry (1952) with a share ε of mistakes,
ε + (1 − 2ε) σ((g_better − g_worse) / w_r). A tie gives no term: people tie what they cannot or will not tell apart, and
an equality would be read as knowledge.

**Choices**: people see the whole way, or a few steps of it, and it is unknown which: successes have the likelihood
(1 − p) L_path^ν + p L_look^ν (ν: below), and so have failures. Who sees the whole way means to follow the distribution
over paths of any length (Ziebart et al. 2008; slip cancels, see `planning`),

    P(ζ) = exp(−β Σ_t c(s_t) + β (v − 1) − κ L_ζ) / z(s_0),   L_ζ the squares entered before the goal,

but at each step with probability η its hand slips, or the world does: it goes in any direction. With
v(s) = e^{−βc(s) − κ} z(s), of a goal e^{β (v_j − 1)}, a step from s in direction d has probability

    (1 − η) q(d | s) + η / 4,   q(d | s) = v(s′_d) / Σ_d′ v(s′_d′).

Successes and failures have β, κ and η of their own. An attempt that reached no goal is made of steps like any other.
κ = log 4 + e^{…} > log 4 makes z finite whatever the costs: K below is diagonally dominant, so positive definite. One
banded LDLᵀ gives v, a second solve with it the gradient,

    K v = b,  K = diag(e^{βc + κ}) − adjacency,  b(s) = Σ e^{β (v_j − 1)} over goals j beside s;
    ∂ (h·log v) / ∂ (βc(s) + κ) = −g(s) v(s) e^{βc(s) + κ},  K g = h / v.

Who *looks H = 3 steps ahead* believes that each step left after those costs h: with d(s) the fewest steps to a goal,

    u_0(s) = e^{−βh d(s)},   u_k(s) = Σ_d e^{−βc(s′_d)} u_{k−1}(s′_d),   u_k(goal) = 1,
    q(d | s) ∝ e^{−βc(s′_d)} u_{H−1}(s′_d),   log h = log(2 / L) + s_h z.

Such a person is drawn into costly squares that planning would have avoided, which the path distribution must take for
cheapness. h and κ are made of the same coordinate: within each way to choose it has its own meaning and N(0, 1).

**The power of choices.** Their log-likelihood is multiplied by ν < 1, as in the power posteriors of Miller and Dunson
(2019) for models that are known to be wrong: who believes something false acts on it at every step, so that steps are
not so many pieces of evidence. Simulated people who are blind to colour or act on noisy impressions of it are misread
at ν = 1; labels and ranks are facts of the game and keep their power.

**Why the posterior mean.** The return of a policy is linear in costs and worths (its expected visits do not depend on
them), so the plan that is best for the mean cost E[c | data] has the largest expected return under the posterior.

The constants (`PRIOR…`) were chosen on simulated attempts, in worlds that no reported figure is from. Scores
of squares and totals are never used.

**What helped**, in share of the optimum over 100 worlds of each kind of simulated person, against log-normal costs and
the path distribution alone: myopic +0.044 ± 0.026, perceptual +0.011 ± 0.018, shortest path +0.011 ± 0.016, mixture
+0.009 ± 0.011, wanderer +0.001 ± 0.002, Boltzmann 0.000 ± 0.003. On myopic people the ranges alone bring 0.004, the
look ahead alone 0.021. Both are knowledge of how things are here: drawn worlds have such rewards, and simulated myopic
people see three steps. H need not be right: 2 brings 0.040 there, 4 brings 0.030.
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
PRIOR_UNIT: Final = -0.15
"""The m̄: what 1 point costs, over 1 / L. A goal that pays L + 2 makes it log(12 / 14) where L = 12."""
BLUE: Final = (0.01, 1.0)
RED: Final = (1.0, 7.0)
"""The [a_k, b_k]. Blue begins above 0, so that logarithms exist."""
PRIOR_CLASS_SPREAD: Final = 0.2
"""The s_m."""
PRIOR_ONE_CLASS: Final = -0.2
PRIOR_CLASS_SPREAD_ONE_CLASS: Final = 0.45
PRIOR_SPREAD_ONE_CLASS: Final = 1.1
"""m̄, s_m and σ where colours are not used."""
PRIOR: Final = {
    "label_width": 0.05,  # w_l
    "rank_width": 0.03,  # w_r
    "flip_rate": 0.03,  # ε
    "choice_power": 0.7,  # ν
    "log_beta": float(np.log(5.0)),
    "log_beta_spread": 1.5,
    "log_kappa": float(np.log(0.5)),
    "log_kappa_spread": 2.0,
    "log_ahead_spread": 0.6,  # s_h
    "looks_ahead": 0.5,  # p
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
        self.dimension = len(self.squares) + self.n_classes + _N_CHOICE + len(self.goals) - 1

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
    order = np.arange(mdp.n_states)
    if mdp.rows < mdp.cols:
        order = order.reshape(mdp.rows, mdp.cols).T.reshape(-1)
    return order[((_distances(mdp) >= 0) & ~mdp.terminal & ~mdp.blocked)[order]]


def _distances(mdp: GridMdp) -> IntVector:
    """The fewest steps from each state to a goal, shape (S,); −1 where there is no way."""
    both_ways = grid.neighbours(mdp.rows, mdp.cols, goals=(), walls=mdp.walls)
    return grid.distances_from(both_ways, np.array(mdp.goals))


def _colours(problem: LearningProblem, squares: IntVector) -> IntVector | None:
    """0 blue, 1 red: what people saw, and no more of the rewards than that."""
    if not isinstance(problem.model, World) or problem.settings.use_colours == "no":
        return None
    return (problem.model.reward[squares] < RED_BELOW).astype(np.int64)


def _prior(mdp: GridMdp, *, n_classes: int) -> Any:  # noqa: ANN401 - a NamedTuple of the kernel module, loaded late
    steps = grid.distances_from(mdp.next_states, mdp.start_states)[list(mdp.goals)]
    log_length = np.log(steps[steps > 0].min())
    has_colours = n_classes > 1
    lowest, highest = np.array((BLUE, RED) if has_colours else ((0.0, 0.0),)).T.copy()
    return _kernels.birlfr.Prior(
        class_means=np.full(n_classes, PRIOR_UNIT if has_colours else PRIOR_ONE_CLASS) - log_length,
        class_spread=PRIOR_CLASS_SPREAD if has_colours else PRIOR_CLASS_SPREAD_ONE_CLASS,
        lowest=lowest,
        highest=highest,
        square_spread=PRIOR_SPREAD_ONE_CLASS,
        log_ahead=np.log(2.0) - log_length,
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
        distances=_distances(mdp)[squares].astype(np.float64),
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
