"""Our Q2 hexahedra as NGSolve's mesh and spaces, and the way between nodal values and its hierarchical unknowns.

NGSolve's second-order functions are not nodal, but on every hexahedron they span the same 27 functions. The square
matrix of their values at the 27 nodes is the same for all elements (edge, face and cell functions of order 2 have no
direction), so nodal values and unknowns are two bases of one space and either follows from the other exactly. The
curved geometry of the reference body is itself such a Q2 field, applied as a deformation of the straight mesh.
"""

from dataclasses import dataclass
from typing import Any

import netgen.meshing
import ngsolve as ngs
import numpy as np
import scipy.sparse as sparse
from jaxtyping import Float

from myograph.mesh.hexahedra import CORNERS, HexMesh, lattice

_NETGEN: Any = netgen.meshing
"""Its names come from a compiled module that no checker of types sees."""
_FACETS = ("origin", "insertion", "skin")


@dataclass(frozen=True)
class NodalSpace:
    """Scalar Q2 space on a muscle with its nodal basis.

    Parameters
    ----------
    mesh
        The reference body, curved.
    scalar
        H1 space of order 2.
    to_nodes
        Sparse matrix from unknowns to values at our nodes.
    to_unknowns
        Its inverse.
    geometry
        The deformation that curves the straight mesh (kept alive with the mesh).
    """

    hexahedra: HexMesh
    mesh: ngs.Mesh
    scalar: ngs.H1
    to_nodes: sparse.csr_array
    to_unknowns: sparse.csr_array
    geometry: ngs.GridFunction

    def field(self, nodal: Float[np.ndarray, " nodes"]) -> ngs.GridFunction:
        """Q2 function with the given values at the nodes."""
        function = ngs.GridFunction(self.scalar)
        function.vec.FV().NumPy()[:] = self.to_unknowns @ nodal
        return function

    def at_nodes(self, function: ngs.CoefficientFunction) -> Float[np.ndarray, "nodes components"]:
        """Values at the nodes of anything that NGSolve can evaluate, recovered from inside the elements.

        Derivatives are most exact at the 2 x 2 x 2 Gauss points and worst at the nodes themselves; so they are taken
        there, extrapolated linearly to each element's nodes, and averaged over the elements around a node.
        """
        local, to_nodes = _recovery()
        rule = ngs.IntegrationRule(local.tolist(), [1.0] * len(local))
        values = np.asarray(function(self.mesh.MapToAllElements(rule, ngs.VOL)), dtype=float)
        values = values.reshape(len(self.hexahedra.cells), len(local), -1)
        values = np.einsum("ng,cgk->cnk", to_nodes, values).reshape(self.hexahedra.cells.size, -1)
        nodes = self.hexahedra.cells.ravel()
        count = np.bincount(nodes, minlength=len(self.hexahedra.points))
        sums = [np.bincount(nodes, weights=column, minlength=len(count)) for column in values.T]
        return np.stack(sums, axis=1) / count[:, None]


def nodal_space(hexahedra: HexMesh) -> NodalSpace:
    """Spaces on the given mesh."""
    mesh = _straight_mesh(hexahedra)
    scalar = ngs.H1(mesh, order=2)
    to_nodes = _nodal_matrix(hexahedra, scalar)
    to_unknowns = _inverse_by_elements(hexahedra, scalar)
    vector = ngs.VectorH1(mesh, order=2)
    geometry = ngs.GridFunction(vector)
    straight = to_nodes @ _linear_unknowns(hexahedra, scalar)
    geometry.vec.FV().NumPy()[:] = (to_unknowns @ (hexahedra.points - straight)).T.ravel()
    mesh.SetDeformation(geometry)
    return NodalSpace(hexahedra, mesh, scalar, to_nodes, to_unknowns, geometry)


def _straight_mesh(hexahedra: HexMesh) -> ngs.Mesh:
    """The mesh of the vertices alone, with named boundaries."""
    mesh = _NETGEN.Mesh(dim=3)
    vertices = np.unique(hexahedra.cells[:, CORNERS])
    points = {int(v): mesh.Add(_NETGEN.MeshPoint(_NETGEN.Pnt(*hexahedra.points[v]))) for v in vertices}
    mesh.Add(_NETGEN.FaceDescriptor(surfnr=1, domin=1, bc=1))
    mesh.Add(_NETGEN.FaceDescriptor(surfnr=2, domin=1, bc=2))
    mesh.Add(_NETGEN.FaceDescriptor(surfnr=3, domin=1, bc=3))
    mesh.SetMaterial(1, "muscle")
    for cell in hexahedra.cells:
        mesh.Add(_NETGEN.Element3D(1, [points[int(cell[c])] for c in CORNERS]))
    for number, name in enumerate(_FACETS, start=1):
        mesh.SetBCName(number - 1, name)
        for facet in hexahedra.facets[name]:
            mesh.Add(_NETGEN.Element2D(number, [points[int(v)] for v in facet]))
    return ngs.Mesh(mesh)


def _local_nodes() -> Float[np.ndarray, "27 3"]:
    """Our 27 nodes in NGSolve's unit hexahedron."""
    return lattice((0.0, 0.5, 1.0))


def _recovery() -> tuple[Float[np.ndarray, "8 3"], Float[np.ndarray, "27 8"]]:
    """Gauss points in NGSolve's unit hexahedron, and the linear extrapolation from them to the nodes."""
    gauss = 1 / np.sqrt(3)
    signs, nodes = lattice((-1.0, 1.0)), lattice((-1.0, 0.0, 1.0))
    weights = (0.5 * (1 + signs[None] * nodes[:, None] / gauss)).prod(axis=2)
    return 0.5 * (1 + gauss * signs), weights


def _element_matrix(scalar: ngs.H1) -> Float[np.ndarray, "27 27"]:
    """Values of an element's functions (columns) at its nodes (rows)."""
    element = scalar.GetFE(ngs.ElementId(ngs.VOL, 0))
    return np.array([np.asarray(element.CalcShape(*map(float, place))) for place in _local_nodes()])


def _element_unknowns(scalar: ngs.H1, cells: int) -> np.ndarray:
    return np.array([scalar.GetDofNrs(ngs.ElementId(ngs.VOL, k)) for k in range(cells)])


def _nodal_matrix(hexahedra: HexMesh, scalar: ngs.H1) -> sparse.csr_array:
    return _scatter(
        hexahedra.cells, _element_unknowns(scalar, len(hexahedra.cells)), _element_matrix(scalar), scalar.ndof
    )


def _inverse_by_elements(hexahedra: HexMesh, scalar: ngs.H1) -> sparse.csr_array:
    inverse = np.linalg.inv(_element_matrix(scalar))
    inverse[np.abs(inverse) < 1e-12] = 0.0
    return _scatter(_element_unknowns(scalar, len(hexahedra.cells)), hexahedra.cells, inverse, scalar.ndof)


def _scatter(rows: np.ndarray, columns: np.ndarray, block: np.ndarray, size: int) -> sparse.csr_array:
    """Global matrix from one element's block; entries that elements share are written once, not summed."""
    local_rows, local_columns = np.nonzero(block)
    row, column = rows[:, local_rows].ravel(), columns[:, local_columns].ravel()
    _, first = np.unique(row * size + column, return_index=True)
    values = np.tile(block[local_rows, local_columns], len(rows))[first]
    return sparse.csr_array((values, (row[first], column[first])), shape=(size, size))


def _linear_unknowns(hexahedra: HexMesh, scalar: ngs.H1) -> Float[np.ndarray, "unknowns 3"]:
    """Unknowns of the coordinates of the straight mesh: values at vertices, no bubbles."""
    unknowns = np.zeros((scalar.ndof, 3))
    numbers = _element_unknowns(scalar, len(hexahedra.cells))
    unknowns[numbers[:, :8]] = hexahedra.points[hexahedra.cells[:, CORNERS]]
    return unknowns
