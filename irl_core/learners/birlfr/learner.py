"""Bayesian IRLFR: learning from labels, ranks and choices together, and knowing what is not known.

One iteration is one transition of the Markov chain (`chain.py`); the mathematics is in `model.py`, the policy in
`decision.py`.

The chain ends *converged* after 150 + 250 iterations, or any 50 later ones, when four quarters of its draws agree
(split R̂ ≤ 1.1 for the log posterior and the mean log cost) and at least half of its proposals were accepted; otherwise
at the limit of iterations, which says so. Frames show the mean so far; before there are draws, where the chain is.

The reward shown is −E[c], the first goal's 1: in units of what that goal pays.
"""

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Final, final

import numpy as np

from irl_core.arrays import Vector
from irl_core.errors import InvalidModel
from irl_core.learners.base import Family, Frame, LearningResult, LearningState, Outcome
from irl_core.learners.birlfr.chain import N_DRAWS, Chain
from irl_core.learners.birlfr.decision import executed_visits, plan, posterior_of
from irl_core.learners.birlfr.model import Model, grid_of
from irl_core.learners.problem import LearningProblem
from irl_core.planning import spectral_radius
from irl_core.weights import feature_counts, start_counts

R_HAT: Final = 1.1
FEWEST_ACCEPTED: Final = 0.5
CHECK_EVERY: Final = 50


@final
@dataclass(frozen=True)
class Birlfr:
    """Labels, ranks and choices in one posterior; the plan is the best one on average over it."""

    name: str = field(default="birlfr", init=False)
    title: str = field(default="Bayesian IRLFR", init=False)
    summary: str = field(
        default="Weighs labels, order and choices together, and says how sure it is of each square.", init=False
    )
    family: Family = field(default="ours", init=False)
    uses_ranking: bool = field(default=True, init=False)
    uses_failures: bool = field(default=True, init=False)
    uses_scores: bool = field(default=False, init=False)
    takes_anything: bool = field(default=True, init=False)
    references: tuple[str, ...] = field(
        default=(
            "Ramachandran, Amir: Bayesian inverse reinforcement learning. IJCAI 2007.",
            "Ziebart, Maas, Bagnell, Dey: Maximum entropy inverse reinforcement learning. AAAI 2008.",
            "Bradley, Terry: Rank analysis of incomplete block designs. Biometrika 39, 1952.",
            "Miller, Dunson: Robust Bayesian inference via coarsening. JASA 114, 2019.",
            "Neal: MCMC using Hamiltonian dynamics. Handbook of Markov Chain Monte Carlo, 2011.",
        ),
        init=False,
    )

    def missing(self, problem: LearningProblem) -> str | None:
        """Why it cannot learn from this, in words for a person: it lacks attempts, or the grid is too large."""
        try:
            grid_of(problem)
        except InvalidModel as error:
            return error.message
        return problem.missing(self)

    def start(self, problem: LearningProblem) -> LearningState:
        """The chain at the prior's medians. Any success or failure will do; ranks and failures only add to it."""
        problem.require(self)
        chain = Chain.at_start(_model(problem), seed=problem.seed, iterations=problem.settings.iterations)
        return chain.to_state(self.name, None)

    def advance(self, problem: LearningProblem, state: LearningState, *, iterations: int) -> LearningState:
        """Transitions of the chain."""
        if state.is_finished:
            return state
        chain = self._chain(problem, state)
        for _ in range(iterations):
            chain.advance()
            outcome = _verdict(chain, problem.settings.iterations)
            if outcome is not None:
                return chain.to_state(self.name, outcome)
        return chain.to_state(self.name, None)

    def frame(self, problem: LearningProblem, state: LearningState) -> Frame:
        """The mean so far and its plan; `log_likelihood` is the log posterior where the chain is."""
        chain = self._chain(problem, state)
        costs, policy = chain.mean_costs, plan(chain.model, chain.mean_costs)
        visits = executed_visits(chain.model, policy, _starts(problem))
        return Frame(
            learner=self.name,
            iteration=state.iteration,
            iterations=problem.settings.iterations,
            gap=_gap(problem, visits),
            log_likelihood=chain.model.log_posterior(chain.position)[0],
            reward=chain.model.reward(costs),
            policy=policy,
            visitation=visits,
        )

    def result(self, problem: LearningProblem, state: LearningState) -> LearningResult:
        """The posterior mean, its plan, and what it does not know."""
        chain, outcome = self._chain(problem, state), state.outcome or Outcome.STOPPED
        shown, starts = self.frame(problem, state), _starts(problem)
        return LearningResult(
            learner=self.name,
            outcome=outcome,
            sentence=_sentence(chain, outcome),
            iterations=state.iteration,
            gap=shown.gap,
            log_likelihood=shown.log_likelihood,
            reward=shown.reward,
            policy=shown.policy,
            visitation=shown.visitation,
            n_left_out=problem.n_left_out,
            shape=problem.shape,
            spectral_radius=spectral_radius(problem.mdp, shown.reward),
            executed_gap=0.0,
            weights=shown.reward,
            posterior=posterior_of(chain, shown.policy, shown.visitation, starts),
        )

    def _chain(self, problem: LearningProblem, state: LearningState) -> Chain:
        return Chain.from_state(_model(problem), state, seed=problem.seed, iterations=problem.settings.iterations)


@lru_cache(maxsize=8)
def _model(problem: LearningProblem) -> Model:
    """The model of a problem, which is one by identity: a run asks for it at every frame."""
    return Model(problem)


def _verdict(chain: Chain, limit: int) -> Outcome | None:
    """How it ended, if it did."""
    n_more = chain.n_draws - N_DRAWS
    is_due = (n_more >= 0 and n_more % CHECK_EVERY == 0) or chain.iteration >= limit
    if is_due and chain.split_r_hat() <= R_HAT and chain.acceptance >= FEWEST_ACCEPTED:
        return Outcome.CONVERGED
    return Outcome.ITERATION_LIMIT if chain.iteration >= limit else None


def _sentence(chain: Chain, outcome: Outcome) -> str:
    if chain.n_draws == 0:
        return f"Stopped after {chain.iteration} iterations, before the first draw; shown is where the chain was."
    r_hat = chain.split_r_hat()
    agree = f"R̂ = {r_hat:.2f}, {chain.acceptance:.0%} of the proposals accepted"
    if outcome is Outcome.CONVERGED:
        return f"Converged: {chain.n_draws} draws whose quarters agree ({agree})."
    if outcome is Outcome.STOPPED:
        return f"Stopped after {chain.iteration} iterations, {chain.n_draws} of them draws ({agree})."
    if not np.isfinite(r_hat):
        return f"The limit of {chain.iteration} iterations came first: {chain.n_draws} draws are too few to judge by."
    return (
        f"The limit of {chain.iteration} iterations came first: the quarters of {chain.n_draws} draws do not agree yet"
        f" ({agree}). Allow more iterations."
    )


def _starts(problem: LearningProblem) -> Vector:
    """Where successes (or, without any, failures) start, shape (S,)."""
    given = problem.successes or problem.failures
    return start_counts(problem.mdp, given, {one.id: 1.0 / len(given) for one in given})


def _gap(problem: LearningProblem, visits: Vector) -> float:
    """‖μ^π − μ̃ᴰ‖∞ of the executed policy; successes weigh by their ranks if all have one. Without successes, 0."""
    if not problem.successes:
        return 0.0
    placed = {id_ for group in problem.orders.get("success", ()) for id_ in group}
    weights = problem.success_weights(ranked=all(one.id in placed for one in problem.successes))
    return float(np.abs(visits - feature_counts(problem.mdp, problem.successes, weights)).max())
