"""The graph of a graph element network: nodes on a disturbed grid, edges by Delaunay triangulation.

    D^-1/2 (A + 1) D^-1/2,   D = degrees with the self loop

Trap: each simplex joins all its corners; a tetrahedron has six edges, and code written for triangles (three edges)
leaves nodes isolated in space. Sources: thesis section 5.3; Kipf & Welling 2017 for the normalised adjacency.
"""

from itertools import combinations

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import coo_array, csr_array, eye_array
from scipy.spatial import Delaunay, QhullError

from myograph.errors import InputError
from myograph.learning.gen.line import Line, line_through

Triangulation = Delaunay | Line
NOISE = 0.2
"""Standard deviation of a grid node's place over the grid spacing [-]."""


def grid_nodes(per_axis: int, sides: Float[np.ndarray, " axes"], seed: int) -> Float[np.ndarray, "nodes axes"]:
    """Grid of `per_axis` nodes along each axis of the box [0, sides], disturbed, clamped to the box [-]."""
    lines = [np.linspace(0, side, per_axis) for side in sides]
    grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, len(sides))
    noise = np.random.default_rng(seed).normal(size=grid.shape) * NOISE * sides / (per_axis - 1)
    return np.clip(grid + noise, 0, sides)


def triangulate(nodes: Float[np.ndarray, "nodes axes"]) -> Triangulation:
    """Delaunay triangulation, neighbours on a line; raises InputError where the nodes span no volume."""
    try:
        return line_through(nodes) if nodes.shape[1] == 1 else Delaunay(nodes)
    except (QhullError, ValueError) as problem:
        reason = str(problem).strip().splitlines()[0]
        raise InputError(f"graph of {len(nodes)} nodes: expected nodes that span a volume: {reason}") from None


def edges_of(triangulation: Triangulation, corners: int | None = None) -> Int[np.ndarray, "edges 2"]:
    """Edges (smaller index, larger index) between all corners of each simplex, each once.

    A node that falls together with another, which Qhull leaves out, is joined to its nearest corner.

    Parameters
    ----------
    corners
        Only so many corners of each simplex are looked at: 3 is the trap.
    """
    known = triangulation.simplices.shape[1]
    looked_at = range(known if corners is None else min(corners, known))
    pairs = [triangulation.simplices[:, two] for two in combinations(looked_at, 2)]
    left_out = triangulation.coplanar[:, [0, 2]]
    return np.unique(np.sort(np.concatenate([*pairs, left_out]), axis=1), axis=0).astype(np.int64)


def delaunay_edges(nodes: Float[np.ndarray, "nodes axes"]) -> Int[np.ndarray, "edges 2"]:
    """Edges between all corners of each simplex of the nodes' triangulation, each once."""
    return edges_of(triangulate(nodes))


def normalised_adjacency(edges: Int[np.ndarray, "edges 2"], nodes: int) -> csr_array:
    """Symmetric normalised adjacency with self loops, (nodes, nodes), sparse [-]."""
    one_way = coo_array((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(nodes, nodes))
    joined = (one_way + one_way.T + eye_array(nodes)).tocsr()
    scale = joined.sum(axis=1) ** -0.5
    return csr_array(joined.multiply(scale[:, None]).multiply(scale[None, :]))
