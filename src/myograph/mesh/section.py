"""O-grid of the unit disc: a square core of quadrilaterals, wrapped by rings that follow the circle.

Q2 quadrilaterals of 9 nodes, lexicographic (first direction fastest). The nodes are scaled so that the curved
quadrilaterals enclose exactly the area pi. Without rings the core itself is rounded half-way to the circle: rounding
it fully would flatten its corners to 180 degrees, where the Jacobian vanishes.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int


@dataclass(frozen=True)
class Section:
    """Nodes of the unit disc, its Q2 quadrilaterals, and the closed loop of nodes on its rim (counter-clockwise)."""

    nodes: Float[np.ndarray, "nodes 2"]
    quads: Int[np.ndarray, "cells 9"]
    rim: Int[np.ndarray, " rim"]


def o_grid(core: int, rings: int) -> Section:
    """O-grid with `core` x `core` quadrilaterals in the middle and `rings` rings of 4 `core` around them."""
    side = 2 * core
    lattice = np.linspace(-1, 1, side + 1)
    square = np.stack(np.meshgrid(lattice, lattice, indexing="xy"), axis=-1).reshape(-1, 2)
    index = np.arange((side + 1) ** 2).reshape(side + 1, side + 1)
    quads = [index[2 * j : 2 * j + 3, 2 * i : 2 * i + 3].ravel() for j in range(core) for i in range(core)]
    rim = np.concatenate([index[0, :-1], index[:-1, -1], index[-1, :0:-1], index[:0:-1, 0]])
    nodes = _rounded(square, 0.5)
    if rings:
        nodes = _rounded(square, 0.35) * 0.55
        circle = _rounded(square[rim], 1.0)
        inner, corners = nodes[rim], rim
        for ring in range(rings):
            layers = []
            for half in (1, 2):
                share = (2 * ring + half) / (2 * rings)
                layers.append(len(nodes) + np.arange(len(rim)))
                nodes = np.vstack([nodes, (1 - share) * inner + share * circle])
            quads += _ring_quads(corners, layers[0], layers[1])
            corners = layers[1]
        rim = corners
    cells = np.array(quads)
    return Section(nodes * np.sqrt(np.pi / _area(nodes, cells)), cells, rim)


def _rounded(square: Float[np.ndarray, "nodes 2"], amount: float) -> Float[np.ndarray, "nodes 2"]:
    """Square [-1, 1]² bent towards the unit disc: amount 0 leaves it, 1 makes its rim the circle."""
    x, y = square[:, 0], square[:, 1]
    disc = np.stack([x * np.sqrt(1 - y**2 / 2), y * np.sqrt(1 - x**2 / 2)], axis=1)
    return (1 - amount) * square + amount * disc


def _ring_quads(inner: np.ndarray, middle: np.ndarray, outer: np.ndarray) -> list[np.ndarray]:
    count = len(inner)
    columns = [[start, (start + 1) % count, (start + 2) % count] for start in range(0, count, 2)]
    return [np.array([layer[i] for i in column for layer in (inner, middle, outer)]) for column in columns]


def _area(nodes: Float[np.ndarray, "nodes 2"], quads: Int[np.ndarray, "cells 9"]) -> float:
    """Area inside the curved quadrilaterals, by 3-point Gauss rules (exact for Q2)."""
    points, weights = np.polynomial.legendre.leggauss(3)
    shape = np.stack([points * (points - 1) / 2, 1 - points**2, points * (points + 1) / 2])
    slope = np.stack([points - 0.5, -2 * points, points + 0.5])
    local = nodes[quads].reshape(-1, 3, 3, 2)
    along_x = np.einsum("cjia,ip,jq->cpqa", local, slope, shape)
    along_y = np.einsum("cjia,ip,jq->cpqa", local, shape, slope)
    jacobian = along_x[..., 0] * along_y[..., 1] - along_x[..., 1] * along_y[..., 0]
    return float(np.einsum("cpq,p,q->", jacobian, weights, weights))
