"""Slow, obvious twins of an experiment's figures."""

import numpy as np


def mean_places(returns):
    """Mean over worlds of 1 + how many earned more + half of the others who earned the same."""
    places = [[1 + sum(b > a for b in row) + (sum(b == a for b in row) - 1) / 2 for a in row] for row in returns]
    return np.mean(places, axis=0)


def wins(returns):
    """The share of worlds in which row earned more than column, half of the ties counted."""
    n = returns.shape[1]
    return np.array(
        [[np.mean([(w[i] > w[j]) + 0.5 * (w[i] == w[j]) for w in returns]) for j in range(n)] for i in range(n)]
    )


def bootstrap(optima, returns, rng, n_resamples=2000):
    """The 95 % percentile interval of Σ returns / Σ optima, world by world drawn with replacement."""
    shares = []
    for _ in range(n_resamples):
        drawn = rng.integers(len(optima), size=len(optima))
        shares.append(returns[drawn].sum() / optima[drawn].sum())
    return np.percentile(shares, [2.5, 97.5])
