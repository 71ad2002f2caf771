"""Inference: log partition, policy, state visitation and gradient of the path distribution that a reward implies."""

from irl_core.inference.base import INFERENCE_KINDS, BatchInferred, InferenceKind, Inferred

__all__ = ["INFERENCE_KINDS", "BatchInferred", "InferenceKind", "Inferred"]
