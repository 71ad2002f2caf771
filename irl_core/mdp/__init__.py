"""Models: Markov decision processes whose transitions are known. A grid, or any discrete one."""

from irl_core.mdp.grid import GridMdp

__all__ = ["GridMdp"]
