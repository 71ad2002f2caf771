"""The log posterior of Bayesian IRLFR as its formulas read, square by square; of irl_core only plain values."""

import math
from itertools import pairwise
from statistics import NormalDist

import numpy as np

from tests.naive import step


def log_logistic(x):
    return -np.logaddexp(0.0, -x)


def log_sums(problem, cost, worth, beta, kappa):
    """Log z(s) of every state from which a goal can be reached: the sum over paths of any length, by a dense solve."""
    mdp = problem.mdp
    n = mdp.rows * mdp.cols
    W, b = np.zeros((n, n)), np.zeros(n)
    for s in cost:
        for direction in range(4):
            ahead = step(mdp, s, direction)
            if ahead in worth:
                b[s] += math.exp(beta * (worth[ahead] - 1.0))
            else:
                W[s, ahead] += math.exp(-beta * cost[ahead] - kappa)
    with np.errstate(divide="ignore"):
        return np.log(np.linalg.solve(np.eye(n) - W, b))


def log_looks(problem, cost, worth, beta, per_step):
    """What somebody who sees three steps ahead makes of each open square: log u_2, path by path."""
    mdp = problem.mdp

    def distance(s):
        reached, n_steps = {s}, 0
        while not reached & set(mdp.goals):
            reached |= {step(mdp, one, direction) for one in reached for direction in range(4)}
            n_steps += 1
        return n_steps

    def u(s, k):
        if s in worth:
            return 1.0
        if k == 0:
            return math.exp(-per_step * distance(s))
        ahead = [step(mdp, s, direction) for direction in range(4)]
        return sum(math.exp(-beta * (1.0 - worth[to] if to in worth else cost[to])) * u(to, k - 1) for to in ahead)

    return {s: math.log(u(s, 2)) for s in cost}


def log_likelihood_of_steps(mdp, attempts, log_weight, lapse):
    """Of all steps, when a neighbour weighs e^{log_weight} and the hand slips now and then."""
    value = 0.0
    for one in attempts:
        for here, there in pairwise(int(s) for s in one.states):
            ahead = [step(mdp, here, direction) for direction in range(4)]
            weights = [math.exp(log_weight[to]) for to in ahead]
            meant = weights[ahead.index(there)] / sum(weights)
            value += math.log((1.0 - lapse) * meant + lapse / 4.0)
    return value


def log_posterior(problem, squares, prior, q):
    """With q in the layout of the kernel: squares, classes, β, κ (or h) and η twice, worths of more goals."""
    mdp, n, K = problem.mdp, len(squares), len(prior.class_means)
    seen = problem.model.reward if K > 1 else np.zeros(mdp.n_states)
    cost = {}
    for i, s in enumerate(squares):
        k = int(K > 1 and seen[s] < -1.0)
        mean = prior.class_means[k] + prior.class_spread * q[n + k]
        below = NormalDist().cdf(q[i])
        by_range = prior.lowest[k] + (prior.highest[k] - prior.lowest[k]) * below
        cost[int(s)] = math.exp(mean) * (by_range if K > 1 else math.exp(prior.square_spread * q[i]))
    worth = {goal: math.exp(prior.log_worth_spread * q[n + K + 5 + j]) for j, goal in enumerate(mdp.goals)}
    worth[mdp.goals[0]] = 1.0

    value, totals = -0.5 * float(q @ q), {}
    for kind, attempts in (("success", problem.successes), ("failure", problem.failures)):
        at = n + K + (3 if kind == "failure" else 0)
        beta = math.exp(prior.log_beta + prior.log_beta_spread * q[at])
        kappa = math.log(4.0) + math.exp(prior.log_kappa + prior.log_kappa_spread * q[at + 1])
        per_step = beta * math.exp(prior.log_ahead + prior.log_ahead_spread * q[at + 1])
        lapse = 1.0 / (1.0 + math.exp(-prior.lapse - prior.lapse_spread * q[at + 2]))
        at_goal = {goal: beta * (worth[goal] - 1.0) for goal in mdp.goals}
        log_z, log_u = log_sums(problem, cost, worth, beta, kappa), log_looks(problem, cost, worth, beta, per_step)
        by_path = at_goal | {s: log_z[s] - beta * c - kappa for s, c in cost.items()}
        by_look = at_goal | {s: log_u[s] - beta * c for s, c in cost.items()}
        whole = prior.choice_power * log_likelihood_of_steps(mdp, attempts, by_path, lapse)
        few = prior.choice_power * log_likelihood_of_steps(mdp, attempts, by_look, lapse)
        if attempts:
            p = prior.looks_ahead
            value += math.log((1.0 - p) * math.exp(whole) + p * math.exp(few))
        for one in attempts:
            entered = [int(s) for s in one.states[1:]]
            end = entered[-1]
            totals[one.id] = worth.get(end, 0.0) - sum(cost[s] for s in entered if s not in worth)
            if end in worth:
                value += log_logistic((1 if kind == "success" else -1) * totals[one.id] / prior.label_width)

    for outcome, groups in problem.orders.items():
        shown = [[id_ for id_ in group if id_ in totals] for group in groups]
        best_first = [group for group in (shown if outcome == "success" else shown[::-1]) if group]
        for better, worse in pairwise(best_first):
            for one in better:
                for other in worse:
                    chance = math.exp(log_logistic((totals[one] - totals[other]) / prior.rank_width))
                    value += math.log(prior.flip_rate + (1.0 - 2.0 * prior.flip_rate) * chance)
    return value
