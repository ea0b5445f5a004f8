"""Elements as VTK, and so most programs, name and number them; and the skin of a body of such elements.

A body's elements are told apart by their number of nodes: 4 and 10 (tetrahedra), 8, 20 and 27 (hexahedra). Nodes come
in VTK's order, but those of the 27-node hexahedron, which are lexicographic here (see `hexahedra`).
Source: VTK's vtkCellType.h and the parametric coordinates of its cells.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError
from myograph.mesh.hexahedra import HEX27
from myograph.mesh.tetrahedra import EDGES, TET10

TRIANGLE, QUADRILATERAL, VERTEX = 5, 9, 1
"""VTK's numbers of what a body without elements is drawn with."""


@dataclass(frozen=True)
class CellKind:
    """A kind of element.

    Parameters
    ----------
    name
        As meshio calls it.
    vtk
        VTK's number.
    order
        Our number of each of VTK's nodes.
    facets
        Our numbers of the nodes of each facet, counter-clockwise seen from outside.
    facet_quads
        The quadrilaterals that a facet is drawn with, in the facet's nodes; a triangle repeats its last corner.
    """

    name: str
    vtk: int
    order: tuple[int, ...]
    facets: tuple[tuple[int, ...], ...]
    facet_quads: tuple[tuple[int, int, int, int], ...]


def _lexicographic_facets() -> tuple[tuple[int, ...], ...]:
    """Of the 27-node hexahedron: 9 nodes each, the first direction fastest, first x second direction outwards."""
    found = []
    for axis, side in product(range(3), (0, 2)):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        if side == 0:
            first, second = second, first
        found.append(tuple(side * 3**axis + u * 3**first + v * 3**second for v, u in product(range(3), repeat=2)))
    return tuple(found)


_TRIANGLES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
_QUADS = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
_HEX_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
_VTK_HEX27 = (0, 2, 8, 6, 18, 20, 26, 24, 1, 5, 7, 3, 19, 23, 25, 21, 9, 11, 17, 15, 12, 14, 10, 16, 4, 22, 13)


def _with_middles(corners: tuple[int, ...], edges: tuple[tuple[int, int], ...], first: int) -> tuple[int, ...]:
    """A facet's corners, then the middles of its edges."""
    numbers = {frozenset(edge): first + k for k, edge in enumerate(edges)}
    pairs = zip(corners, corners[1:] + corners[:1], strict=True)
    return corners + tuple(numbers[frozenset(pair)] for pair in pairs)


KINDS = {
    4: CellKind("tetra", 10, tuple(range(4)), _TRIANGLES, ((0, 1, 2, 2),)),
    8: CellKind("hexahedron", 12, tuple(range(8)), _QUADS, ((0, 1, 2, 3),)),
    10: CellKind(
        "tetra10",
        24,
        tuple(range(10)),
        tuple(_with_middles(corners, EDGES, 4) for corners in _TRIANGLES),
        TET10.facet_quads,
    ),
    20: CellKind(
        "hexahedron20",
        25,
        tuple(range(20)),
        tuple(_with_middles(corners, _HEX_EDGES, 8) for corners in _QUADS),
        ((0, 4, 7, 7), (4, 1, 5, 5), (5, 2, 6, 6), (6, 3, 7, 7), (4, 5, 6, 7)),
    ),
    27: CellKind("hexahedron27", 29, _VTK_HEX27, _lexicographic_facets(), HEX27.facet_quads),
}
"""Number of nodes -> kind."""


def cell_kind(nodes: int) -> CellKind:
    """The kind of elements of so many nodes; raises InputError for a number that no kind has."""
    if nodes not in KINDS:
        raise InputError(f"elements: expected 4, 8, 10, 20 or 27 nodes each, got {nodes}")
    return KINDS[nodes]


def to_vtk(cells: Int[np.ndarray, "cells element_nodes"]) -> Int[np.ndarray, "cells element_nodes"]:
    """Elements with their nodes in VTK's order."""
    return cells[:, cell_kind(cells.shape[1]).order]


def from_vtk(cells: Int[np.ndarray, "cells element_nodes"]) -> Int[np.ndarray, "cells element_nodes"]:
    """Elements with their nodes in our order."""
    return cells[:, np.argsort(cell_kind(cells.shape[1]).order)]


def skin_of(
    points: Float[np.ndarray, "nodes 3"], cells: Int[np.ndarray, "cells element_nodes"]
) -> Int[np.ndarray, "facets 4"]:
    """The surface of a body: the facets that belong to one element only, as quadrilaterals with outward normals."""
    kind = cell_kind(cells.shape[1])
    facets = cells[:, kind.facets].reshape(-1, len(kind.facets[0]))
    _, first, count = np.unique(np.sort(facets, axis=1), axis=0, return_index=True, return_counts=True)
    quads = facets[np.sort(first[count == 1])][:, kind.facet_quads].reshape(-1, 4)
    return quads if _volume(points[quads]) >= 0 else quads[:, [1, 0, 3, 2]]


def _volume(quads: Float[np.ndarray, "facets 4 3"]) -> float:
    """Volume [mm³] inside closed facets; negative where their normals look inwards."""
    a, b, c, d = np.moveaxis(quads, 1, 0)
    return float(np.einsum("fx,fx->", a, np.cross(b, c)) + np.einsum("fx,fx->", a, np.cross(c, d))) / 6
