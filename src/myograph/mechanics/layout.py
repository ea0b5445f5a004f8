"""How NGSolve sees our elements: the order of their vertices, where our nodes lie, where derivatives are recovered.

NGSolve's hexahedron is the unit cube with our vertices in our order. Its tetrahedron has local coordinates that are
the shares of its first three vertices, and is positively oriented with two of our corners exchanged.
"""

from dataclasses import dataclass

import ngsolve as ngs
import numpy as np
from jaxtyping import Float

from myograph.mesh.hexahedra import HEX27, lattice
from myograph.mesh.tetrahedra import TET10


@dataclass(frozen=True)
class Layout:
    """One kind of element as NGSolve sees it.

    Parameters
    ----------
    corners
        Our nodes at NGSolve's vertices.
    nodes
        Our nodes in NGSolve's local coordinates.
    recovery
        The points inside, with no weights, where derivatives are most exact.
    to_nodes
        The linear extrapolation from them to our nodes.
    rule
        The points that the energy is integrated with: 27 in a hexahedron, 4 in a tetrahedron, exact for the squares of
        a quadratic displacement's gradient.
    """

    corners: tuple[int, ...]
    nodes: Float[np.ndarray, "element_nodes 3"]
    recovery: ngs.IntegrationRule
    to_nodes: Float[np.ndarray, "element_nodes inner"]
    rule: ngs.IntegrationRule


def _hexahedron() -> Layout:
    gauss = 1 / np.sqrt(3)
    signs = lattice((-1.0, 1.0))
    weights = (0.5 * (1 + signs[None] * HEX27.nodes[:, None] / gauss)).prod(axis=2)
    rule, inside = ngs.IntegrationRule(ngs.HEX, 5), _points(0.5 * (1 + gauss * signs))
    return Layout(HEX27.corners, lattice((0.0, 0.5, 1.0)), inside, weights, rule)


def _tetrahedron() -> Layout:
    corners = (0, 2, 1, 3)
    shares = np.column_stack([1 - TET10.nodes.sum(axis=1), TET10.nodes])[:, corners]
    inner = 0.25 + (np.eye(4) - 0.25) / np.sqrt(5)
    rule, weights = ngs.IntegrationRule(ngs.TET, 2), shares @ np.linalg.inv(inner)
    return Layout(corners, shares[:, :3], _points(inner[:, :3]), weights, rule)


def _points(places: Float[np.ndarray, "inner 3"]) -> ngs.IntegrationRule:
    return ngs.IntegrationRule(places.tolist(), [1.0] * len(places))


LAYOUTS = {HEX27.kind: _hexahedron(), TET10.kind: _tetrahedron()}
"""By the name of the kind."""
