"""Bayesian IRLFR, our own learner: `model` has the mathematics, `chain` samples, `decision` plans, `learner` shows."""

from irl_core.learners.birlfr.learner import Birlfr

__all__ = ["Birlfr"]
