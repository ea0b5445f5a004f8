"""What a curved finite element is: its nodes, its shape functions, its rule of integration.

Two kinds exist, both quadratic: `HEX27` (mesh/hexahedra.py) and `TET10` (mesh/tetrahedra.py). The map from local to
space coordinates is  x(ξ) = Σ N_i(ξ) x_i,  its determinant is the volume ratio that all sizes and qualities come from.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

ShapeValues = Callable[[Float[np.ndarray, "places 3"]], Float[np.ndarray, "places element_nodes"]]
ShapeGradients = Callable[[Float[np.ndarray, "places 3"]], Float[np.ndarray, "places element_nodes 3"]]


@dataclass(frozen=True)
class Element:
    """One kind of element.

    Parameters
    ----------
    kind
        Its name, 'hex27' or 'tet10'.
    nodes
        Local coordinates of its nodes.
    corners
        Which of them are vertices.
    facet_corners
        Which nodes of a facet are vertices, counter-clockwise seen from outside.
    facet_quads
        The linear quadrilaterals that a facet is drawn with, in the facet's nodes; a triangle repeats its last corner.
    places, weights
        Rule of integration over the local element.
    values, gradients
        Shape functions and their derivatives over the local coordinates.
    """

    kind: str
    nodes: Float[np.ndarray, "element_nodes 3"]
    corners: tuple[int, ...]
    facet_corners: tuple[int, ...]
    facet_quads: tuple[tuple[int, int, int, int], ...]
    places: Float[np.ndarray, "quad 3"]
    weights: Float[np.ndarray, " quad"]
    values: ShapeValues
    gradients: ShapeGradients

    def jacobians(
        self,
        points: Float[np.ndarray, "nodes 3"],
        cells: Int[np.ndarray, "cells element_nodes"],
        local: Float[np.ndarray, "places 3"],
    ) -> Float[np.ndarray, "cells places 3 3"]:
        """Derivative of space over local coordinates (first index: space) in each element [mm]."""
        return np.einsum("pna,cnx->cpxa", self.gradients(local), points[cells])

    def determinants(
        self,
        points: Float[np.ndarray, "nodes 3"],
        cells: Int[np.ndarray, "cells element_nodes"],
        local: Float[np.ndarray, "places 3"],
    ) -> Float[np.ndarray, "cells places"]:
        """Determinant of the map from local to space coordinates [mm³]."""
        return np.linalg.det(self.jacobians(points, cells, local))

    def volumes(
        self, points: Float[np.ndarray, "nodes 3"], cells: Int[np.ndarray, "cells element_nodes"]
    ) -> Float[np.ndarray, "cells quad"]:
        """Volume [mm³] that each integration point of each element stands for."""
        return self.determinants(points, cells, self.places) * self.weights
