"""Meshes of Q2 hexahedra with 27 nodes each, and the places on a muscle that others need to find on them.

Nodes of a hexahedron are lexicographic: section's first direction fastest, along the muscle slowest. The along-muscle
coordinate runs from 0 at the origin to 1 at the insertion.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np
from jaxtyping import Float, Int

CORNERS = (0, 2, 8, 6, 18, 20, 26, 24)
"""Local nodes at the vertices of a hexahedron: bottom counter-clockwise, then top."""


@dataclass(frozen=True)
class HexMesh:
    """A muscle as curved hexahedra.

    Parameters
    ----------
    points
        Q2 nodes in the reference body [mm].
    cells
        27 nodes per hexahedron.
    along
        Coordinate of each node along the muscle, 0 at the origin, 1 at the insertion.
    area
        Area of the reference section through each node [mm²].
    skin
        Linear quadrilaterals of the surface (four per curved facet), outward normal.
    facets
        Curved facets as 4 vertices each: 'skin', 'origin', 'insertion'.
    """

    points: Float[np.ndarray, "nodes 3"]
    cells: Int[np.ndarray, "cells 27"]
    along: Float[np.ndarray, " nodes"]
    area: Float[np.ndarray, " nodes"]
    skin: Int[np.ndarray, "quads 4"]
    facets: dict[str, Int[np.ndarray, "_ 4"]]

    def end_nodes(self, end: str) -> Int[np.ndarray, " nodes"]:
        """Nodes of the face at the 'origin' or the 'insertion'."""
        return np.flatnonzero(np.isclose(self.along, 0.0 if end == "origin" else 1.0, atol=1e-12))


def shape_functions(local: Float[np.ndarray, "points 3"]) -> Float[np.ndarray, "points 27"]:
    """Values of the 27 Q2 shape functions at local coordinates in [-1, 1]³."""
    values = [np.stack([x * (x - 1) / 2, 1 - x**2, x * (x + 1) / 2], axis=1) for x in local.T]
    return np.einsum("pi,pj,pk->pkji", *values).reshape(-1, 27)


def shape_gradients(local: Float[np.ndarray, "points 3"]) -> Float[np.ndarray, "points 27 3"]:
    """Derivatives of the 27 Q2 shape functions over the local coordinates."""
    values = [np.stack([x * (x - 1) / 2, 1 - x**2, x * (x + 1) / 2], axis=1) for x in local.T]
    slopes = [np.stack([x - 0.5, -2 * x, x + 0.5], axis=1) for x in local.T]
    factors = [[slopes[a] if a == direction else values[a] for a in range(3)] for direction in range(3)]
    columns = [np.einsum("pi,pj,pk->pkji", *three).reshape(-1, 27) for three in factors]
    return np.stack(columns, axis=2)


def jacobian_determinants(
    points: Float[np.ndarray, "nodes 3"], cells: Int[np.ndarray, "cells 27"], local: Float[np.ndarray, "places 3"]
) -> Float[np.ndarray, "cells places"]:
    """Determinant of the map from local to space coordinates at the given local coordinates of each element [mm³]."""
    return np.linalg.det(np.einsum("pna,cnx->cpxa", shape_gradients(local), points[cells]))


def lattice(values: tuple[float, ...]) -> Float[np.ndarray, "places 3"]:
    """All triples of the given values, the first coordinate fastest."""
    return np.array([triple[::-1] for triple in product(values, repeat=3)])


def jacobian_weights(
    points: Float[np.ndarray, "nodes 3"], cells: Int[np.ndarray, "cells 27"]
) -> Float[np.ndarray, "cells 27"]:
    """Volume [mm³] that each of the 27 Gauss points of each element stands for."""
    places, weights = np.polynomial.legendre.leggauss(3)
    product_weights = lattice(tuple(weights)).prod(axis=1)
    return jacobian_determinants(points, cells, lattice(tuple(places))) * product_weights
