"""Models: Markov decision processes whose transitions are known. A grid, or any discrete one."""

from typing import Any, TypeAlias

from irl_core.checks import shown
from irl_core.errors import InvalidModel
from irl_core.mdp.grid import GridMdp, start_distribution
from irl_core.mdp.sparse import SparseMdp

Mdp: TypeAlias = GridMdp | SparseMdp


def as_mdp(model: Any) -> Mdp:  # noqa: ANN401 - a World would be a circle of imports
    """The model's transitions: a World's without its rewards, the model itself otherwise. Raises InvalidModel."""
    mdp = model if isinstance(model, GridMdp | SparseMdp) else getattr(model, "mdp", None)
    if not isinstance(mdp, GridMdp | SparseMdp):
        raise InvalidModel(f"model must be a World, a GridMdp or a SparseMdp, not {shown(model)}.", field="model")
    return mdp


__all__ = ["GridMdp", "Mdp", "SparseMdp", "as_mdp", "start_distribution"]
