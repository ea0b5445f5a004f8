"""The bodies of one or more muscles as one VTK grid: points one after the other, elements in VTK's order.

A body without elements is drawn with its skin; one without skin with its points.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int, UInt8

from myograph.ensemble.spec import Body
from myograph.errors import InputError
from myograph.mesh.vtk import QUADRILATERAL, TRIANGLE, VERTEX, cell_kind, to_vtk


@dataclass(frozen=True)
class Grid:
    """Points and elements.

    Parameters
    ----------
    muscles
        Their names, in the order of their points.
    points
        Reference bodies [mm].
    connectivity
        Nodes of all elements, one after the other.
    offsets
        Where each element begins in it, and where the last one ends.
    types
        VTK's number of each element.
    muscle
        Of each element: its place in `muscles`.
    """

    muscles: tuple[str, ...]
    points: Float[np.ndarray, "nodes 3"]
    connectivity: Int[np.ndarray, " corners"]
    offsets: Int[np.ndarray, " ends"]
    types: UInt8[np.ndarray, " cells"]
    muscle: Int[np.ndarray, " cells"]


def grid_of(bodies: Mapping[str, Body]) -> Grid:
    """One grid of all bodies; raises InputError for none at all, and for elements that VTK does not know."""
    if not bodies:
        raise InputError("expected the body of at least one muscle, got none")
    elements: list[np.ndarray] = []
    types: list[int] = []
    muscle: list[int] = []
    first = 0
    for number, body in enumerate(bodies.values()):
        for kind, nodes in _elements(body):
            elements.append(nodes + first)
            types.append(kind)
            muscle.append(number)
        first += len(body.reference)
    return Grid(
        tuple(bodies),
        np.concatenate([body.reference for body in bodies.values()]),
        np.concatenate(elements),
        np.concatenate([[0], np.cumsum([len(nodes) for nodes in elements])]),
        np.array(types, dtype=np.uint8),
        np.array(muscle),
    )


def _elements(body: Body) -> list[tuple[int, Int[np.ndarray, " corners"]]]:
    """Kind and nodes of each element."""
    if len(body.cells):
        kind = cell_kind(body.cells.shape[1])
        return [(kind.vtk, nodes) for nodes in to_vtk(body.cells)]
    if len(body.skin):
        return [(TRIANGLE, quad[:3]) if quad[3] == quad[2] else (QUADRILATERAL, quad) for quad in body.skin]
    return [(VERTEX, np.array([node])) for node in range(len(body.reference))]
