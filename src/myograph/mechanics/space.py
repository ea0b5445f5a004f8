"""Our quadratic meshes as NGSolve's mesh and spaces, and the way between nodal values and its hierarchical unknowns.

NGSolve's second-order functions are not nodal, but on every element they span the same functions as ours. The square
matrix of their values at the element's nodes is the same for all elements (edge, face and cell functions of order 2
have no direction), so nodal values and unknowns are two bases of one space and either follows from the other exactly.
The curved geometry of the reference body is itself such a field, applied as a deformation of the straight mesh.
"""

from dataclasses import dataclass
from typing import Any

import netgen.meshing
import ngsolve as ngs
import numpy as np
import scipy.sparse as sparse
from jaxtyping import Float

from myograph.mechanics.layout import LAYOUTS, Layout
from myograph.mesh.muscle_mesh import FACETS, MuscleMesh

_NETGEN: Any = netgen.meshing
"""Its names come from a compiled module that no checker of types sees."""


@dataclass(frozen=True)
class NodalSpace:
    """Scalar quadratic space on a muscle with its nodal basis.

    Parameters
    ----------
    muscle
        Our mesh of the reference body.
    mesh
        NGSolve's, curved.
    scalar
        H1 space of order 2.
    to_nodes
        Sparse matrix from unknowns to values at our nodes.
    to_unknowns
        Its inverse.
    geometry
        The deformation that curves the straight mesh (kept alive with the mesh).
    """

    muscle: MuscleMesh
    mesh: ngs.Mesh
    scalar: ngs.H1
    to_nodes: sparse.csr_array
    to_unknowns: sparse.csr_array
    geometry: ngs.GridFunction

    def field(self, nodal: Float[np.ndarray, " nodes"]) -> ngs.GridFunction:
        """Quadratic function with the given values at the nodes."""
        function = ngs.GridFunction(self.scalar)
        function.vec.FV().NumPy()[:] = self.to_unknowns @ nodal
        return function

    def recovered(self, values: Float[np.ndarray, "points components"]) -> Float[np.ndarray, "nodes components"]:
        """At the nodes, from values at the points of `Layout.recovery` in every element, one after the other.

        Derivatives are most exact at the Gauss points of one order less and worst at the nodes themselves; so they
        are taken there, extrapolated linearly to each element's nodes, and averaged over the elements around a node.
        """
        cells, layout = self.muscle.cells, LAYOUTS[self.muscle.element.kind]
        inside = values.reshape(len(cells), len(layout.recovery.points), -1)
        outwards = np.einsum("ng,cgk->cnk", layout.to_nodes, inside).reshape(cells.size, -1)
        count = np.bincount(cells.ravel(), minlength=len(self.muscle.points))
        sums = [np.bincount(cells.ravel(), weights=column, minlength=len(count)) for column in outwards.T]
        return np.stack(sums, axis=1) / count[:, None]


def nodal_space(muscle: MuscleMesh) -> NodalSpace:
    """Spaces on the given mesh."""
    layout = LAYOUTS[muscle.element.kind]
    mesh = _straight_mesh(muscle, layout)
    scalar = ngs.H1(mesh, order=2)
    numbers = np.array([scalar.GetDofNrs(ngs.ElementId(ngs.VOL, k)) for k in range(len(muscle.cells))])
    block = _element_matrix(scalar, layout)
    inverse = np.linalg.inv(block)
    inverse[np.abs(inverse) < 1e-12] = 0.0
    to_nodes = _scatter(muscle.cells, numbers, block, scalar.ndof)
    to_unknowns = _scatter(numbers, muscle.cells, inverse, scalar.ndof)
    linear = np.zeros((scalar.ndof, 3))
    linear[numbers[:, : len(layout.corners)]] = muscle.points[muscle.cells[:, layout.corners]]
    geometry = ngs.GridFunction(ngs.VectorH1(mesh, order=2))
    geometry.vec.FV().NumPy()[:] = (to_unknowns @ (muscle.points - to_nodes @ linear)).T.ravel()
    mesh.SetDeformation(geometry)
    return NodalSpace(muscle, mesh, scalar, to_nodes, to_unknowns, geometry)


def _straight_mesh(muscle: MuscleMesh, layout: Layout) -> ngs.Mesh:
    """The mesh of the vertices alone, with named boundaries."""
    mesh = _NETGEN.Mesh(dim=3)
    vertices = np.unique(muscle.cells[:, layout.corners])
    points = {int(v): mesh.Add(_NETGEN.MeshPoint(_NETGEN.Pnt(*muscle.points[v]))) for v in vertices}
    for number in range(1, 1 + len(FACETS)):
        mesh.Add(_NETGEN.FaceDescriptor(surfnr=number, domin=1, bc=number))
    mesh.SetMaterial(1, "muscle")
    for cell in muscle.cells:
        mesh.Add(_NETGEN.Element3D(1, [points[int(cell[c])] for c in layout.corners]))
    for number, name in enumerate(FACETS, start=1):
        mesh.SetBCName(number - 1, name)
        for facet in muscle.facets[name][:, muscle.element.facet_corners]:
            mesh.Add(_NETGEN.Element2D(number, [points[int(v)] for v in facet]))
    return ngs.Mesh(mesh)


def _element_matrix(scalar: ngs.H1, layout: Layout) -> Float[np.ndarray, "element_nodes element_nodes"]:
    """Values of an element's functions (columns) at its nodes (rows)."""
    element = scalar.GetFE(ngs.ElementId(ngs.VOL, 0))
    return np.array([np.asarray(element.CalcShape(*map(float, place))) for place in layout.nodes])


def _scatter(rows: np.ndarray, columns: np.ndarray, block: np.ndarray, size: int) -> sparse.csr_array:
    """Global matrix from one element's block; entries that elements share are written once, not summed."""
    local_rows, local_columns = np.nonzero(block)
    row, column = rows[:, local_rows].ravel(), columns[:, local_columns].ravel()
    _, first = np.unique(row * size + column, return_index=True)
    values = np.tile(block[local_rows, local_columns], len(rows))[first]
    return sparse.csr_array((values, (row[first], column[first])), shape=(size, size))
