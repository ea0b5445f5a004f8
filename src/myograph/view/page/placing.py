r"""Pieces of tissue in a mesh: of each, the nodes of the element around it and how much of each of them it is.

    X = sum_i N_i(ξ) X_i,   hence wherever the nodes are,   x = sum_i N_i(ξ) x_i

ξ by Newton's method in the elements whose middles are nearest; the one that contains the place best is taken. So two
meshes of one body can be told of each other. A little outside is extrapolated: curved skins differ between meshes.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import KDTree

from myograph.errors import InputError
from myograph.mesh.element import Element
from myograph.mesh.hexahedra import HEX27
from myograph.mesh.tetrahedra import TET10

NEAREST, STEPS, CLOSE = 12, 25, 1e-9
FARTHEST = 0.05
"""How far outside of its element a place may be, in local coordinates [-]."""
_ELEMENTS = {len(element.nodes): element for element in (HEX27, TET10)}


def place_tissue(
    places: Float[np.ndarray, "places 3"], nodes: Float[np.ndarray, "nodes 3"], cells: Int[np.ndarray, "cells n"]
) -> Float[np.ndarray, "places nodes"]:
    """Weights of the nodes for each place; raises InputError for one outside the body, and for unknown elements."""
    element = _ELEMENTS.get(cells.shape[1])
    if element is None:
        known = " or ".join(str(count) for count in _ELEMENTS)
        raise InputError(f"expected elements of {known} nodes, got {cells.shape[1]}: places in them are not known")
    tree = KDTree(nodes[cells].mean(axis=1))
    several = min(NEAREST, len(cells))
    candidates = tree.query(places, k=several)[1].reshape(len(places), several)
    weights = np.zeros((len(places), len(nodes)))
    for place, near, row in zip(places, candidates, weights, strict=True):
        cell, local, outside = _around(element, nodes, cells[near], place)
        if not outside <= FARTHEST:
            raise InputError(f"expected places in the body, got {np.round(place, 2).tolist()} mm: it is outside")
        row[cell] = element.values(local[None])[0]
    return weights


def _around(
    element: Element, nodes: Float[np.ndarray, "nodes 3"], near: Int[np.ndarray, "cells n"], place: np.ndarray
) -> tuple[Int[np.ndarray, " n"], Float[np.ndarray, " 3"], float]:
    """The element that contains a place best, its local coordinates there, and how far these are outside."""
    best = (near[0], element.nodes.mean(axis=0), np.inf)
    for cell in near:
        local, outside = _local(element, nodes[cell], place)
        if outside < best[2]:
            best = (cell, local, outside)
        if outside == 0:
            break
    return best


def _local(
    element: Element, corners: Float[np.ndarray, "element_nodes 3"], place: Float[np.ndarray, " 3"]
) -> tuple[Float[np.ndarray, " 3"], float]:
    """Local coordinates of a place, and how far these are outside of the element; infinity where there are none."""
    local = element.nodes.mean(axis=0)
    size = float(np.ptp(corners, axis=0).max())
    for _ in range(STEPS):
        missed = place - element.values(local[None])[0] @ corners
        if np.linalg.norm(missed) < CLOSE * size:
            return local, _outside(element, local)
        slope = corners.T @ element.gradients(local[None])[0]
        local = local + np.clip(np.linalg.lstsq(slope, missed, rcond=None)[0], -1, 1)
    return local, np.inf


def _outside(element: Element, local: Float[np.ndarray, " 3"]) -> float:
    if element is TET10:
        return float(max(-local.min(), local.sum() - 1, 0.0))
    return float(max(np.abs(local).max() - 1, 0.0))
