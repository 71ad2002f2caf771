"""Newton's maximum-entropy fits against scipy's L-BFGS, differences and the fits' own conditions."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from irl_core import DivergentPartition, InvalidModel, InvalidReward, InvalidSettings
from irl_core.inference.path_infinite import infer_path_infinite
from irl_core.maxent import fit_maxent
from irl_core.mdp.grid import GridMdp

L2 = 0.01
TWO_STARTS = np.zeros(25)
TWO_STARTS[[0, 3]] = 0.25, 0.75
GRIDS = {
    "5x5": GridMdp(5, 5, (24,)),
    "5x5 walls and slip": GridMdp(5, 5, (24,), walls=(6, 12), slip=0.2),
    "5x5 two goals, two starts": GridMdp(5, 5, (24, 20), walls=(11,), start=TWO_STARTS),
}


def three_attempts(mdp, seed):
    """Mean feature counts of three wandering paths that arrive."""
    rng, counts = np.random.default_rng(seed), np.zeros(mdp.n_states)
    for _ in range(3):
        s = rng.choice(mdp.n_states, p=mdp.starts)
        counts[s] += 1 / 3
        while s not in mdp.goals:
            s = mdp.next_states[s, rng.choice(4, p=[0.1, 0.4, 0.4, 0.1])]
            counts[s] += 1 / 3
    return counts


def objective(w, mdp, counts):
    """(f, its gradient); a wall of 1e6 where the sum over paths is infinite."""
    try:
        found = infer_path_infinite(mdp, w, starts=mdp.starts)
    except DivergentPartition:
        return 1e6, np.zeros_like(w)
    return found.log_partition - w @ counts + L2 / 2 * w @ w, found.visitation - counts + L2 * w


@pytest.mark.parametrize("mdp", GRIDS.values(), ids=GRIDS)
def test_newton_finds_the_minimum_that_l_bfgs_finds(mdp):
    counts = three_attempts(mdp, 1)
    fit = fit_maxent([mdp], counts[None], l2=L2, tolerance=1e-9)
    theirs = minimize(
        objective,
        np.full(25, -2.0),
        args=(mdp, counts),
        jac=True,
        method="L-BFGS-B",
        options={"maxiter": 3000, "maxfun": 9000, "ftol": 1e-15, "gtol": 1e-8},
    )
    np.testing.assert_allclose(fit.rewards[0], theirs.x, atol=2e-4)
    assert objective(fit.rewards[0], mdp, counts)[0] <= theirs.fun + 1e-10
    assert fit.gap[0] <= 1e-9
    path = fit.rewards[0] @ counts - infer_path_infinite(mdp, fit.rewards[0], starts=mdp.starts).log_partition
    assert fit.log_likelihood[0] == pytest.approx(path, abs=1e-9)


@given(seeds=st.lists(st.integers(0, 2**32), min_size=1, max_size=40), l2=st.sampled_from([1e-3, 0.01, 1.0]))
@settings(max_examples=10, deadline=None)
def test_at_the_end_visits_match_counts_but_for_the_penalty(seeds, l2):
    kinds = list(GRIDS.values())
    mdps = [kinds[seed % 3] for seed in seeds]
    counts = np.array([three_attempts(mdp, seed) for mdp, seed in zip(mdps, seeds, strict=True)])
    fit = fit_maxent(mdps, counts, l2=l2, tolerance=1e-8)
    for mdp, w, observed in zip(mdps, fit.rewards, counts, strict=True):
        visits = infer_path_infinite(mdp, w, starts=mdp.starts).visitation
        np.testing.assert_allclose(visits + l2 * w, observed, atol=2e-8)


def test_a_fit_of_a_batch_is_the_fit_of_each():
    mdps = [GRIDS["5x5"]] * 70
    counts = np.array([three_attempts(mdps[0], seed) for seed in range(70)])
    together = fit_maxent(mdps, counts)
    assert (together.iterations <= 15).all()
    for k in (0, 31, 32, 69):
        np.testing.assert_array_equal(fit_maxent(mdps[k : k + 1], counts[k : k + 1]).rewards[0], together.rewards[k])


def test_too_few_iterations_show_in_the_gap():
    fit = fit_maxent([GRIDS["5x5"]], three_attempts(GRIDS["5x5"], 3)[None], max_iterations=2)
    assert fit.iterations[0] == 2
    assert fit.gap[0] > 1e-6


def test_squares_no_start_leads_to_keep_the_weight_zero():
    mdp = GridMdp(3, 4, (2, 6, 10))
    fit = fit_maxent([mdp], three_attempts(mdp, 2)[None])
    np.testing.assert_allclose(fit.rewards[0][[3, 7, 11]], 0.0, atol=1e-12)


@pytest.mark.parametrize(
    ("changes", "error", "said"),
    [
        ({"l2": 0.0}, InvalidSettings, "l2 must be"),
        ({"tolerance": -1.0}, InvalidSettings, "tolerance must be"),
        ({"max_iterations": 0}, InvalidSettings, "max_iterations must be"),
        ({"counts": np.ones((1, 24))}, InvalidReward, "shape"),
        ({"counts": np.full((1, 25), -1.0)}, InvalidReward, "at least 0"),
        ({"counts": [["a"] * 25]}, InvalidReward, "numbers"),
        ({"mdps": []}, InvalidModel, "at least one"),
        ({"mdps": [GRIDS["5x5"], GridMdp(4, 4, (15,))]}, InvalidModel, "one size"),
    ],
)
def test_bad_input_is_refused_by_name(changes, error, said):
    arguments = {"mdps": [GRIDS["5x5"]], "counts": np.ones((1, 25))} | changes
    with pytest.raises(error, match=said):
        fit_maxent(arguments.pop("mdps"), arguments.pop("counts"), **arguments)
