r"""Between the nodes: a field at any point of the reference body, by the shape functions of the element around it.

    find ξ with  sum_i N_i(ξ) X_i = X   (Newton),   field(X) = sum_i N_i(ξ) field_i

Exact at nodes, and wherever the field is what the finite elements say it is. A point outside of all elements takes the
nearest one's continuation up to `REACH` of its local size, and is refused beyond.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import KDTree

from myograph.errors import InputError
from myograph.mesh.element import Element
from myograph.mesh.kinds import element_of

NEWTON_STEPS, TRIED = 12, 12
REACH = 0.1
"""How far outside of its element a point may be, in local coordinates."""


@dataclass(frozen=True)
class Between:
    """Weights of the nodes of the element around each point."""

    nodes: Int[np.ndarray, "points element_nodes"]
    weights: Float[np.ndarray, "points element_nodes"]

    def carry(self, values: Float[np.ndarray, "batch nodes ..."]) -> Float[np.ndarray, "batch points ..."]:
        """A field at the points, of its values at all nodes."""
        return np.einsum("pe,bpe...->bp...", self.weights, values[:, self.nodes])

    def matrix(self, nodes: int) -> Float[np.ndarray, "points nodes"]:
        """The weights of all so many nodes of the body."""
        whole = np.zeros((len(self.nodes), nodes))
        np.put_along_axis(whole, self.nodes, self.weights, axis=1)
        return whole


def between(
    reference: Float[np.ndarray, "nodes 3"],
    cells: Int[np.ndarray, "cells element_nodes"],
    points: Float[np.ndarray, "points 3"],
) -> Between:
    """The elements around these points [mm] of a body, whose nodes and elements are given.

    Raises InputError for a point outside of the body, and for elements that are not known.
    """
    element = element_of(cells)
    centres = reference[cells].mean(axis=1)
    tried = KDTree(centres).query(points, k=min(TRIED, len(centres)))[1].reshape(len(points), -1)
    best = np.full(len(points), np.inf)
    cell, local = np.zeros(len(points), dtype=np.int64), np.zeros((len(points), 3))
    for candidate in tried.T:
        found = _local(element, reference[cells[candidate]], points)
        outside = _outside(element, found)
        better = outside < best
        best[better], cell[better], local[better] = outside[better], candidate[better], found[better]
    if len(points) and not best.max() <= REACH:
        worst = int(best.argmax())
        raise InputError(f"points: expected places in the body, got {points[worst].tolist()} mm outside of it")
    return Between(cells[cell], element.values(local))


def _local(
    element: Element, corners: Float[np.ndarray, "points element_nodes 3"], points: Float[np.ndarray, "points 3"]
) -> Float[np.ndarray, "points 3"]:
    """Local coordinates of each point in its element, where Newton finds them."""
    local = np.tile(element.nodes.mean(axis=0), (len(points), 1))
    for _ in range(NEWTON_STEPS):
        missed = points - np.einsum("pe,pex->px", element.values(local), corners)
        jacobians = np.einsum("pea,pex->pxa", element.gradients(local), corners)
        regular = np.abs(np.linalg.det(jacobians)) > 0
        jacobians[~regular] = np.eye(3)
        step = np.linalg.solve(jacobians, missed[..., None])[..., 0]
        local = np.clip(local + step, -2, 2)
    return local


def _outside(element: Element, local: Float[np.ndarray, "points 3"]) -> Float[np.ndarray, " points"]:
    """How far outside of the local element; zero inside."""
    low, high = element.nodes.min(axis=0), element.nodes.max(axis=0)
    beyond = np.maximum(low - local, local - high).max(axis=1)
    if element.kind == "tet10":
        beyond = np.maximum(beyond, local.sum(axis=1) - 1)
    return np.maximum(beyond, 0)
