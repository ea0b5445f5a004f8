"""The tetrahedron of 10 nodes.

Its nodes are the four corners, then the middles of the edges 01, 12, 20, 03, 13, 23 (the order of VTK); local
coordinates are the shares of corners 1, 2, 3. Facets have 6 nodes: corners 0, 1, 2, then the middles of 01, 12, 20.
"""

import numpy as np
from jaxtyping import Float

from myograph.mesh.element import Element

EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
"""Corners of each edge, in the order of the nodes at their middles."""
SMALL = (
    (0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3), (4, 5, 6, 8), (6, 8, 7, 4), (6, 5, 9, 8), (6, 9, 7, 8)
)  # fmt: skip
"""Nodes of the eight small tetrahedra that an element's nodes make."""
_CORNERS = np.vstack([np.zeros((1, 3)), np.eye(3)])
_SLOPES = np.array([[-1.0, -1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
"""Derivatives of the four shares of the corners."""


def _shares(local: Float[np.ndarray, "places 3"]) -> Float[np.ndarray, "places 4"]:
    return np.column_stack([1 - local.sum(axis=1), local])


def _values(local: Float[np.ndarray, "places 3"]) -> Float[np.ndarray, "places 10"]:
    shares = _shares(local)
    middles = [4 * shares[:, a] * shares[:, b] for a, b in EDGES]
    return np.column_stack([shares * (2 * shares - 1), *middles])


def _gradients(local: Float[np.ndarray, "places 3"]) -> Float[np.ndarray, "places 10 3"]:
    shares = _shares(local)[:, :, None]
    corners = (4 * shares - 1) * _SLOPES
    middles = [4 * (shares[:, a] * _SLOPES[b] + shares[:, b] * _SLOPES[a]) for a, b in EDGES]
    return np.concatenate([corners, np.stack(middles, axis=1)], axis=1)


def _rule() -> tuple[Float[np.ndarray, "14 3"], Float[np.ndarray, " 14"]]:
    """Symmetric rule of 14 points, exact to degree 5 (Walkington 2000)."""
    places, weights = [], []
    for share, weight in ((0.3108859192633006, 0.01878132095300264), (0.09273525031089123, 0.01224884051939366)):
        corner = np.full((4, 4), share) + (1 - 4 * share) * np.eye(4)
        places.append(corner)
        weights += [weight] * 4
    share = 0.4544962958743506
    middle = np.full((6, 4), 0.5 - share)
    for row, (a, b) in enumerate(EDGES):
        middle[row, [a, b]] = share
    return np.vstack([*places, middle])[:, 1:], np.array(weights + [0.007091003462846911] * 6)


TET10 = Element(
    kind="tet10",
    nodes=np.vstack([_CORNERS, *(0.5 * (_CORNERS[[a]] + _CORNERS[[b]]) for a, b in EDGES)]),
    corners=(0, 1, 2, 3),
    facet_corners=(0, 1, 2),
    facet_quads=((0, 3, 4, 5), (3, 1, 4, 4), (5, 4, 2, 2)),
    places=_rule()[0],
    weights=_rule()[1],
    values=_values,
    gradients=_gradients,
)
"""10-node tetrahedron, integrated at 14 points."""
