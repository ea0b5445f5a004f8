"""The triangulation of nodes on a line: neighbours joined; to be used like SciPy's, which begins with the plane."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int


@dataclass(frozen=True)
class Line:
    """Nodes on a line and the pieces between neighbours, with the names that `scipy.spatial.Delaunay` has for them.

    Parameters
    ----------
    points
        The nodes.
    simplices
        Both ends of each piece, from the least place to the largest.
    coplanar
        A node that falls together with another, a piece there, and that other node.
    """

    points: Float[np.ndarray, "nodes 1"]
    simplices: Int[np.ndarray, "pieces 2"]
    coplanar: Int[np.ndarray, "doubled 3"]

    def find_simplex(self, places: Float[np.ndarray, "*batch 1"]) -> Int[np.ndarray, "*batch"]:
        """The piece around each place; -1 where there is none."""
        order = np.append(self.simplices[:, 0], self.simplices[-1, 1])
        along, ends = places[..., 0], self.points[order, 0]
        piece = np.searchsorted(ends, along, side="right") - 1
        return np.where(along == ends[-1], len(ends) - 2, np.where(along > ends[-1], -1, piece))


def line_through(nodes: Float[np.ndarray, "nodes 1"]) -> Line:
    """Joined neighbours; raises ValueError where all nodes fall together."""
    _, first, which = np.unique(nodes[:, 0], return_index=True, return_inverse=True)
    if len(first) < 2:
        raise ValueError("all nodes fall together")
    simplices = np.stack([first[:-1], first[1:]], axis=1)
    doubled = np.setdiff1d(np.arange(len(nodes)), first)
    pieces = which[doubled].clip(max=len(simplices) - 1)
    return Line(nodes, simplices, np.stack([doubled, pieces, first[which[doubled]]], axis=1))
