"""A shape as NGSolve's mesh: straight elements with named faces, curved by a deformation of second order.

The deformation belongs to the mesh: integrals, gradients and normals are those of the curved reference body.
"""

from dataclasses import dataclass
from typing import Any

import netgen.meshing
import ngsolve as ngs
import numpy as np
from jaxtyping import Float

from myograph.mechanics.specimen.blocks import tetrahedra, triangles
from myograph.mechanics.specimen.shapes import Shape

_NETGEN: Any = netgen.meshing
"""Its names come from a compiled module that no checker of types sees."""


@dataclass(frozen=True)
class CurvedMesh:
    """The reference body.

    Parameters
    ----------
    mesh
        With the deformation that curves it already set.
    place
        Its coordinates as unknowns of a vector space of order 2 on the mesh, one component after the other [mm].
    vertices
        Coordinates of its vertices [mm].
    geometry
        The deformation (kept alive with the mesh).
    """

    mesh: ngs.Mesh
    place: Float[np.ndarray, "3 unknowns"]
    vertices: Float[np.ndarray, "vertices 3"]
    geometry: ngs.GridFunction | None


def curved_mesh(shape: Shape, element: str) -> CurvedMesh:
    """Mesh of the shape in elements of the kind."""
    mesh = _straight_mesh(shape, element)
    space = ngs.VectorH1(mesh, order=2)
    place = np.zeros((3, space.components[0].ndof))
    place[:, : mesh.nv] = np.array([vertex.point for vertex in mesh.vertices]).T
    coordinates = (ngs.x, ngs.y, ngs.z)
    curved = shape.curved(coordinates)
    geometry = None
    if curved is not None:
        geometry = ngs.GridFunction(space)
        for component, there, here in zip(geometry.components, curved, coordinates, strict=True):
            component.Interpolate(there - here)
        place += geometry.vec.FV().NumPy().reshape(3, -1)
        mesh.SetDeformation(geometry)
    return CurvedMesh(mesh, place, place[:, : mesh.nv].T.copy(), geometry)


def _straight_mesh(shape: Shape, element: str) -> ngs.Mesh:
    lattice = shape.lattice()
    whole = element == "hexahedra"
    cells = lattice.cells if whole else tetrahedra(lattice.cells)
    mesh = _NETGEN.Mesh(dim=3)
    points = [mesh.Add(_NETGEN.MeshPoint(_NETGEN.Pnt(*map(float, point)))) for point in lattice.points]
    for number in range(1, len(lattice.faces) + 1):
        mesh.Add(_NETGEN.FaceDescriptor(surfnr=number, domin=1, bc=number))
    mesh.SetMaterial(1, "specimen")
    for cell in cells:
        mesh.Add(_NETGEN.Element3D(1, [points[int(vertex)] for vertex in cell]))
    for number, (name, quads) in enumerate(lattice.faces.items(), start=1):
        mesh.SetBCName(number - 1, name)
        for facet in quads if whole else triangles(quads):
            mesh.Add(_NETGEN.Element2D(number, [points[int(vertex)] for vertex in facet]))
    return ngs.Mesh(mesh)
