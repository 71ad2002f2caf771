"""The log posterior of Bayesian IRLFR with its gradient, and one transition of Hamiltonian Monte Carlo.

The mathematics and the letters are those of `irl_core.learners.birlfr.model`. Open squares are 0 … n − 1 in the order
of the band, goals n … n + G − 1. A position q, standard normal a priori, is laid out

    z (n) | z_m (K) | β, κ (or h), η of successes and of failures (6) | worths of goals 1 … G − 1.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit

LOG_FOUR = math.log(4.0)
LOWEST = 1e-250  # of a path sum that is kept: below, what β and κ say has long been said
HIGHEST = 600.0  # of an exponent
LOG_HIGHEST = math.log(HIGHEST)
ROOT_HALF = math.sqrt(0.5)
DENSITY_AT_0 = 1.0 / math.sqrt(2.0 * math.pi)
STEPS_SEEN = 3  # H


class Evidence(NamedTuple):
    """What the posterior is conditional on. B attempts, n open squares, G goals, P pairs."""

    neighbours: np.ndarray  # (n, 4) int32: the square or goal each direction leads to
    colours: np.ndarray  # (n,) int32: the class of each square
    entries: np.ndarray  # (B, n + G): how often each attempt entered each square and goal
    is_failure: np.ndarray  # (B,) int32
    goals: np.ndarray  # (B,) int32: the goal reached, n …, or −1
    moves: np.ndarray  # (2, n, 4): how often successes and failures went each way
    pairs: np.ndarray  # (P, 2) int32: the better and the worse of two attempts
    distances: np.ndarray  # (n,): the fewest steps from each square to a goal
    width: int  # of the band


class Prior(NamedTuple):
    """The constants of the model, in its letters."""

    class_means: np.ndarray  # (K,)
    class_spread: float
    lowest: np.ndarray  # (K,)
    highest: np.ndarray  # (K,)
    square_spread: float  # of one class; unused with two
    label_width: float
    rank_width: float
    flip_rate: float
    choice_power: float
    log_beta: float
    log_beta_spread: float
    log_kappa: float
    log_kappa_spread: float
    log_ahead: float
    log_ahead_spread: float
    looks_ahead: float
    lapse: float
    lapse_spread: float
    log_worth_spread: float


@njit(cache=True)
def transition(position, costs, momentum, inverse_metric, step_size, n_steps, log_uniform, evidence, prior):
    """Move `position` in place, or leave it, and fill `costs`, (n + G,), with its own.

    Gives the acceptance probability and the log posterior where the chain now is.
    """
    gradient, proposed = np.empty_like(position), np.empty_like(costs)
    value = log_posterior(position, gradient, costs, evidence, prior)
    q, p = position.copy(), momentum.copy()
    energy = value - _kinetic(p, inverse_metric)
    there = value
    for _ in range(n_steps):
        for i in range(len(q)):
            p[i] += 0.5 * step_size * gradient[i]
            q[i] += step_size * inverse_metric[i] * p[i]
        there = log_posterior(q, gradient, proposed, evidence, prior)
        if not there > -np.inf:
            return 0.0, value
        for i in range(len(q)):
            p[i] += 0.5 * step_size * gradient[i]
    gain = there - _kinetic(p, inverse_metric) - energy
    if not gain > -HIGHEST:
        return 0.0, value
    if log_uniform < gain:
        position[:], costs[:] = q, proposed
        value = there
    return math.exp(min(0.0, gain)), value


@njit(cache=True)
def _kinetic(momentum, inverse_metric):
    total = 0.0
    for i in range(len(momentum)):
        total += momentum[i] * momentum[i] * inverse_metric[i]
    return 0.5 * total


@njit(cache=True)
def log_posterior(q, gradient, costs, evidence, prior):
    """The log posterior up to a constant; fills its gradient and the costs. −∞ where it cannot be computed with."""
    n, n_goals = len(evidence.neighbours), evidence.entries.shape[1] - len(evidence.neighbours)
    value = 0.0
    for i in range(len(q)):
        value -= 0.5 * q[i] * q[i]
        gradient[i] = -q[i]
    if not _costs(q, costs, n, n_goals, evidence, prior):
        return -np.inf
    by_cost = np.zeros(n + n_goals)
    value += _labels_and_ranks(costs, by_cost, evidence, prior)
    first_choice = n + len(prior.class_means)
    for kind in range(2):
        value += _choices(q, gradient, costs, by_cost, kind, first_choice, evidence, prior)
    _through_costs(q, gradient, costs, by_cost, n, n_goals, evidence, prior)
    return value


@njit(cache=True)
def _costs(q, costs, n, n_goals, evidence, prior):
    """c(s) of squares; 1 − v of goals, v the worth in units of the first's."""
    n_classes = len(prior.class_means)
    for i in range(n):
        k = evidence.colours[i]
        exponent = prior.class_means[k] + prior.class_spread * q[n + k]
        if n_classes == 1:
            exponent += prior.square_spread * q[i]
        if not abs(exponent) < HIGHEST:
            return False
        costs[i] = math.exp(exponent)
        if n_classes > 1:
            below = 0.5 * math.erfc(-q[i] * ROOT_HALF)
            costs[i] *= prior.lowest[k] + (prior.highest[k] - prior.lowest[k]) * below
    costs[n] = 0.0
    for j in range(1, n_goals):
        exponent = prior.log_worth_spread * q[n + n_classes + 5 + j]
        if not abs(exponent) < HIGHEST:
            return False
        costs[n + j] = 1.0 - math.exp(exponent)
    return True


@njit(cache=True)
def _through_costs(q, gradient, costs, by_cost, n, n_goals, evidence, prior):
    """The chain rule from costs to what they are made of."""
    n_classes = len(prior.class_means)
    for i in range(n):
        k = evidence.colours[i]
        by_log = by_cost[i] * costs[i]
        gradient[n + k] += by_log * prior.class_spread
        if n_classes == 1:
            gradient[i] += by_log * prior.square_spread
        else:
            unit = math.exp(prior.class_means[k] + prior.class_spread * q[n + k])
            density = DENSITY_AT_0 * math.exp(-0.5 * q[i] * q[i])
            gradient[i] += by_cost[i] * unit * (prior.highest[k] - prior.lowest[k]) * density
    for j in range(1, n_goals):
        gradient[n + n_classes + 5 + j] += by_cost[n + j] * (costs[n + j] - 1.0) * prior.log_worth_spread


@njit(cache=True)
def _labels_and_ranks(costs, by_cost, evidence, prior):
    n_attempts, n_all = evidence.entries.shape
    totals, by_total, value = np.zeros(n_attempts), np.zeros(n_attempts), 0.0
    for b in range(n_attempts):
        if evidence.goals[b] >= 0:
            totals[b] = 1.0
        for i in range(n_all):
            totals[b] -= evidence.entries[b, i] * costs[i]
        if evidence.goals[b] >= 0:
            sign = -1.0 if evidence.is_failure[b] else 1.0
            x = sign * totals[b] / prior.label_width
            value += _log_logistic(x)
            by_total[b] += sign * _logistic(-x) / prior.label_width
    for r in range(len(evidence.pairs)):
        better, worse = evidence.pairs[r, 0], evidence.pairs[r, 1]
        chance = _logistic((totals[better] - totals[worse]) / prior.rank_width)
        with_flips = prior.flip_rate + (1.0 - 2.0 * prior.flip_rate) * chance
        value += math.log(with_flips)
        slope = (1.0 - 2.0 * prior.flip_rate) * chance * (1.0 - chance) / (with_flips * prior.rank_width)
        by_total[better] += slope
        by_total[worse] -= slope
    for b in range(n_attempts):
        for i in range(n_all):
            by_cost[i] -= by_total[b] * evidence.entries[b, i]
    return value


@njit(cache=True)
def _choices(q, gradient, costs, by_cost, kind, first_choice, evidence, prior):
    """The tempered log-likelihood of the steps of successes (kind 0) or failures (kind 1); adds to the gradients.

    Of a mixture: its gradients are those of the two ways to choose, each with its share of the explanation.
    """
    n, n_all, at, moves = len(evidence.neighbours), len(costs), first_choice + 3 * kind, evidence.moves[kind]
    if not np.any(moves > 0.0):
        return 0.0
    log_beta = prior.log_beta + prior.log_beta_spread * q[at]
    log_excess = prior.log_kappa + prior.log_kappa_spread * q[at + 1]
    log_ahead = prior.log_ahead + prior.log_ahead_spread * q[at + 1]
    if not max(log_beta, log_excess, log_beta + log_ahead) < LOG_HIGHEST:
        return -np.inf
    beta, excess, per_step = math.exp(log_beta), math.exp(log_excess), math.exp(log_beta + log_ahead)
    lapse = _logistic(prior.lapse + prior.lapse_spread * q[at + 2])
    meant, by_path, by_look = beta * costs, np.zeros(n_all), np.zeros(n_all)
    look, look_by_lapse, by_per_step = look_steps(
        meant, per_step, evidence.distances, evidence.neighbours, moves, lapse, by_look
    )
    meant[:n] += LOG_FOUR + excess
    path, path_by_lapse = log_steps(meant, evidence.neighbours, moves, lapse, evidence.width, by_path)
    if not path > -np.inf:
        return -np.inf
    path = prior.choice_power * path + math.log(1.0 - prior.looks_ahead)
    look = prior.choice_power * look + math.log(prior.looks_ahead)
    value = max(path, look) + math.log1p(math.exp(-abs(path - look)))
    by_path_value = prior.choice_power * math.exp(path - value)
    by_look_value = prior.choice_power * math.exp(look - value)
    by_log_beta, by_kappa, by_ahead = (
        by_look_value * by_per_step * per_step,
        0.0,
        by_look_value * by_per_step * per_step,
    )
    for i in range(n_all):
        by_meant = by_path_value * by_path[i] + by_look_value * by_look[i]
        by_cost[i] += by_meant * beta
        by_log_beta += by_meant * beta * costs[i]
        if i < n:
            by_kappa += by_path_value * by_path[i]
    gradient[at] += by_log_beta * prior.log_beta_spread
    gradient[at + 1] += by_kappa * excess * prior.log_kappa_spread + by_ahead * prior.log_ahead_spread
    by_lapse = by_path_value * path_by_lapse + by_look_value * look_by_lapse
    gradient[at + 2] += by_lapse * lapse * (1.0 - lapse) * prior.lapse_spread
    return value


@njit(cache=True)
def log_steps(action, neighbours, moves, lapse, width, by_action):
    """Σ moves · log((1 − η) q + η / 4) and its slope in η; adds its gradient in the action, (n + G,). −∞: underflow."""
    n = len(neighbours)
    band, v = np.zeros((n, width + 1)), np.zeros(n)
    if not path_sums(action, neighbours, band, v):
        return -np.inf, 0.0
    value, by_lapse, g, share, by_log = 0.0, 0.0, np.zeros(n), np.empty(4), np.empty(4)
    for i in range(n):
        if not np.any(moves[i] > 0.0):
            continue
        for d in range(4):
            j = neighbours[i, d]
            share[d] = math.exp(-action[j]) if j >= n else v[j]
        explained, slope = _steps_from(share, moves[i], lapse, by_log)
        value += explained
        by_lapse += slope
        for d in range(4):
            j = neighbours[i, d]
            if j >= n:
                by_action[j] -= by_log[d]
            else:
                g[j] += by_log[d] / v[j]
    _solve(band, g)
    for i in range(n):
        by_action[i] -= g[i] * v[i] * math.exp(action[i])
        for d in range(4):
            if neighbours[i, d] >= n:
                by_action[neighbours[i, d]] -= g[i] * math.exp(-action[neighbours[i, d]])
    return value, by_lapse


@njit(cache=True)
def look_steps(action, per_step, distances, neighbours, moves, lapse, by_action):
    """As `log_steps`, of somebody who sees H steps ahead: value, its slopes in η and in βh."""
    n = len(neighbours)
    if not STEPS_SEEN * -action.min() < HIGHEST:
        return -np.inf, 0.0, 0.0
    entered, u, g = np.exp(-action), np.ones((STEPS_SEEN + 1, len(action))), np.zeros((STEPS_SEEN, len(action)))
    u[0, :n] = np.exp(-per_step * distances)
    for k in range(1, STEPS_SEEN + 1):
        for i in range(n):
            u[k, i] = 0.0
            for d in range(4):
                u[k, i] += entered[neighbours[i, d]] * u[k - 1, neighbours[i, d]]
    if not u.min() > LOWEST:
        return -np.inf, 0.0, 0.0
    value, by_lapse, share, by_log, last = 0.0, 0.0, np.empty(4), np.empty(4), STEPS_SEEN - 1
    for i in range(n):
        if not np.any(moves[i] > 0.0):
            continue
        for d in range(4):
            share[d] = entered[neighbours[i, d]] * u[last, neighbours[i, d]]
        explained, slope = _steps_from(share, moves[i], lapse, by_log)
        value += explained
        by_lapse += slope
        for d in range(4):
            by_action[neighbours[i, d]] -= by_log[d]
            g[last, neighbours[i, d]] += by_log[d] / u[last, neighbours[i, d]]
    for k in range(last, 0, -1):
        for i in range(n):
            for d in range(4):
                j = neighbours[i, d]
                by_action[j] -= g[k, i] * entered[j] * u[k - 1, j]
                g[k - 1, j] += g[k, i] * entered[j]
    return value, by_lapse, -np.sum(g[0, :n] * u[0, :n] * distances)


@njit(cache=True)
def _steps_from(share, moves, lapse, by_log):
    """The steps from one square to neighbours of weights `share`, (4,), which are made to sum to 1.

    Gives Σ moves · log((1 − η) share + η / 4) and its slope in η; fills its gradient in the logarithms of the weights.
    """
    share /= share.sum()
    value, by_lapse, explained = 0.0, 0.0, 0.0
    for d in range(4):
        chance = max((1.0 - lapse) * share[d] + 0.25 * lapse, LOWEST)
        value += moves[d] * math.log(chance)
        by_lapse += moves[d] * (0.25 - share[d]) / chance
        by_log[d] = moves[d] * (1.0 - lapse) * share[d] / chance
        explained += by_log[d]
    for d in range(4):
        by_log[d] -= share[d] * explained
    return value, by_lapse


@njit(cache=True)
def path_sums(action, neighbours, band, v):
    """Fill v, (n,), with K⁻¹ b and `band` with the factors of K. False where a number leaves the range of floats.

    z(s), the sum over paths from s to a goal of e^{−action of what is entered}, is e^{action(s)} v(s).
    """
    n = len(neighbours)
    for i in range(len(action)):
        if not abs(action[i]) < HIGHEST:
            return False
    for i in range(n):
        band[i, 0] = math.exp(action[i])
        for d in range(4):
            j = neighbours[i, d]
            if j >= n:
                v[i] += math.exp(-action[j])
            elif j == i:
                band[i, 0] -= 1.0
            elif j < i:
                band[i, i - j] = -1.0
    if not _factorise(band):
        return False
    _solve(band, v)
    return bool(v.min() > LOWEST)


@njit(cache=True)
def _factorise(band):
    """K = L D Lᵀ in place; `band[i, k]` is K(i, i − k) for k = 0 … width. False where a pivot is not above 0."""
    n, width = band.shape[0], band.shape[1] - 1
    for i in range(n):
        first = max(0, i - width)
        for j in range(first, i):
            total = band[i, i - j]
            for k in range(max(first, j - width), j):
                total -= band[i, i - k] * band[j, j - k]
            band[i, i - j] = total  # L(i, j) · D(j) until the row is done
        pivot = band[i, 0]
        for j in range(first, i):
            scaled = band[i, i - j] / band[j, 0]
            pivot -= scaled * band[i, i - j]
            band[i, i - j] = scaled
        if not pivot > 0.0:
            return False
        band[i, 0] = pivot
    return True


@njit(cache=True)
def _solve(band, x):
    """The solution of L D Lᵀ x = x, in place."""
    n, width = band.shape[0], band.shape[1] - 1
    for i in range(n):
        for j in range(max(0, i - width), i):
            x[i] -= band[i, i - j] * x[j]
    for i in range(n):
        x[i] /= band[i, 0]
    for i in range(n - 1, -1, -1):
        for j in range(max(0, i - width), i):
            x[j] -= band[i, i - j] * x[i]


@njit(cache=True)
def _logistic(x):
    if x >= 0.0:
        return 1.0 / (1.0 + math.exp(-x))
    return math.exp(x) / (1.0 + math.exp(x))


@njit(cache=True)
def _log_logistic(x):
    return -math.log1p(math.exp(-x)) if x >= 0.0 else x - math.log1p(math.exp(x))
