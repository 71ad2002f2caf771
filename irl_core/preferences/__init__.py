"""What a person says of attempts, in other ways than an order of their own, and the order it comes to."""

from irl_core.preferences.comparisons import Answer, order_from_comparisons

__all__ = ["Answer", "order_from_comparisons"]
