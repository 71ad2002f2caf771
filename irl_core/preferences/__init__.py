"""What a person says of attempts, in other ways than an order of their own, and the order it comes to."""

from irl_core.preferences.comparisons import Answer, order_from_comparisons
from irl_core.preferences.gaps import Gap, positions_from_gaps, said_gaps
from irl_core.preferences.stretches import Stretch, order_from_stretches, score_of_stretches

__all__ = [
    "Answer",
    "Gap",
    "Stretch",
    "order_from_comparisons",
    "order_from_stretches",
    "positions_from_gaps",
    "said_gaps",
    "score_of_stretches",
]
