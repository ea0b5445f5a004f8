"""A potential that runs from 0 at the origin to 1 at the insertion: Laplace's equation, no flux through the skin."""

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import csr_array
from scipy.sparse.linalg import spsolve

from myograph.mesh.element import Element

Points = Float[np.ndarray, "nodes 3"]
Cells = Int[np.ndarray, "cells element_nodes"]
Rule = tuple[Float[np.ndarray, "quad 3"], Float[np.ndarray, " quad"]]


def potential(
    element: Element,
    points: Points,
    cells: Cells,
    ends: tuple[Int[np.ndarray, " origin"], Int[np.ndarray, " insertion"]],
) -> Float[np.ndarray, " nodes"]:
    """Nodal values of the potential; `ends` holds the nodes of the origin and of the insertion."""
    gradients, volumes = space_gradients(element, points, cells, (element.places, element.weights))
    blocks = np.einsum("cqna,cqma,cq->cnm", gradients, gradients, volumes)
    width = cells.shape[1]
    rows, columns = np.repeat(cells, width, axis=1).ravel(), np.tile(cells, width).ravel()
    matrix = csr_array((blocks.ravel(), (rows, columns)), shape=(len(points), len(points)))
    values = np.zeros(len(points))
    values[ends[1]] = 1.0
    free = np.setdiff1d(np.arange(len(points)), np.concatenate(ends))
    right = -(matrix @ values)[free]
    values[free] = np.asarray(spsolve(matrix[free][:, free].tocsc(), right))
    return values


def space_gradients(
    element: Element, points: Points, cells: Cells, rule: Rule
) -> tuple[Float[np.ndarray, "cells quad element_nodes 3"], Float[np.ndarray, "cells quad"]]:
    """Derivatives of the shape functions over space [1/mm] at the places of a rule, and the volumes these stand for."""
    places, weights = rule
    jacobians = element.jacobians(points, cells, places)
    gradients = np.einsum("qna,cqax->cqnx", element.gradients(places), np.linalg.inv(jacobians))
    return gradients, np.linalg.det(jacobians) * weights
