"""An enormous surface with fewer nodes: of all nodes in a cell of a grid, the one next to their middle stands for them.

Nodes that are kept stay where they are, so that their values are those of the model.
"""

import numpy as np
from jaxtyping import Float, Int

STEPS = 40


def thin(
    points: Float[np.ndarray, "nodes 3"], triangles: Int[np.ndarray, "triangles 3"], most: int
) -> tuple[Int[np.ndarray, " kept"], Int[np.ndarray, "fewer 3"]]:
    """At most so many nodes of the surface, and its triangles among them (as indices into those kept)."""
    low, high = 0.0, float(np.ptp(points, axis=0).max())
    for _ in range(STEPS):
        middle = (low + high) / 2
        low, high = (low, middle) if _cells(points, middle).max() + 1 <= most else (middle, high)
    cells = _cells(points, high)
    kept = _representatives(points, cells)
    fewer = cells[triangles]
    a, b, c = fewer.T
    fewer = fewer[(a != b) & (b != c) & (c != a)]
    _, first = np.unique(np.sort(fewer, axis=1), axis=0, return_index=True)
    return kept, fewer[np.sort(first)]


def _cells(points: Float[np.ndarray, "nodes 3"], size: float) -> Int[np.ndarray, " nodes"]:
    """Number of the cell of each node."""
    grid = np.floor((points - points.min(axis=0)) / max(size, 1e-12)).astype(np.int64)
    return np.unique(grid, axis=0, return_inverse=True)[1].ravel()


def _representatives(
    points: Float[np.ndarray, "nodes 3"], cells: Int[np.ndarray, " nodes"]
) -> Int[np.ndarray, " cells"]:
    count = np.bincount(cells)
    middle = np.stack([np.bincount(cells, column) / count for column in points.T], axis=1)
    away = np.linalg.norm(points - middle[cells], axis=1)
    order = np.lexsort((away, cells))
    return order[np.concatenate([[0], np.cumsum(count)[:-1]])]
