"""The hexahedron of 27 nodes.

Its nodes are lexicographic: section's first direction fastest, along the muscle slowest; local coordinates run from
-1 to 1. Facets have 9 nodes in the same manner.
"""

from itertools import product

import numpy as np
from jaxtyping import Float

from myograph.mesh.element import Element


def lattice(values: tuple[float, ...]) -> Float[np.ndarray, "places 3"]:
    """All triples of the given values, the first coordinate fastest."""
    return np.array([triple[::-1] for triple in product(values, repeat=3)])


def _values(local: Float[np.ndarray, "places 3"]) -> Float[np.ndarray, "places 27"]:
    values = [np.stack([x * (x - 1) / 2, 1 - x**2, x * (x + 1) / 2], axis=1) for x in local.T]
    return np.einsum("pi,pj,pk->pkji", *values).reshape(-1, 27)


def _gradients(local: Float[np.ndarray, "places 3"]) -> Float[np.ndarray, "places 27 3"]:
    values = [np.stack([x * (x - 1) / 2, 1 - x**2, x * (x + 1) / 2], axis=1) for x in local.T]
    slopes = [np.stack([x - 0.5, -2 * x, x + 0.5], axis=1) for x in local.T]
    factors = [[slopes[a] if a == direction else values[a] for a in range(3)] for direction in range(3)]
    columns = [np.einsum("pi,pj,pk->pkji", *three).reshape(-1, 27) for three in factors]
    return np.stack(columns, axis=2)


_GAUSS, _WEIGHTS = np.polynomial.legendre.leggauss(3)

HEX27 = Element(
    kind="hex27",
    nodes=lattice((-1.0, 0.0, 1.0)),
    corners=(0, 2, 8, 6, 18, 20, 26, 24),
    facet_corners=(0, 2, 8, 6),
    facet_quads=((0, 1, 4, 3), (1, 2, 5, 4), (3, 4, 7, 6), (4, 5, 8, 7)),
    places=lattice(tuple(_GAUSS)),
    weights=lattice(tuple(_WEIGHTS)).prod(axis=1),
    values=_values,
    gradients=_gradients,
)
"""27-node hexahedron, integrated at 3 x 3 x 3 Gauss points; its corners are bottom counter-clockwise, then top."""
