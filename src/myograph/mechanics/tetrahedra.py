"""The mesh of a muscle from its closed surface: remeshed to a target size, filled with tetrahedra by Netgen, curved.

Netgen keeps the triangles that it is given; what it would make of a drawn surface itself is ten times finer where the
surface has needles, or fails. The mesh keeps the surface's volume to a hundredth, or is refused.
"""

from typing import Any

import netgen.meshing
import ngsolve as ngs
import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError
from myograph.mesh.muscle_mesh import MuscleMesh
from myograph.mesh.quality import check_mesh
from myograph.mesh.stations import stations
from myograph.mesh.surface.attachments import Attachments, surface_parts
from myograph.mesh.surface.closed import ClosedSurface
from myograph.mesh.surface.curving import curved
from myograph.mesh.surface.drawn import Drawn
from myograph.mesh.surface.remesh import remesh
from myograph.mesh.surface.sizes import element_sizes
from myograph.mesh.tetrahedra import TET10

_NETGEN: Any = netgen.meshing
"""Its names come from a compiled module that no checker of types sees."""
GRADING = 0.3
LARGEST_LOSS = 0.01
"""Of volume, as a share."""


def surface_mesh(surface: ClosedSurface, attachments: Attachments, size: float, name: str = "muscle") -> MuscleMesh:
    """Checked mesh of quadratic tetrahedra with edges of about `size` [mm], shorter where the body is slim.

    Raises InputError where the attachments do not fit the surface, a part of it leads from no origin to no insertion,
    or no mesh of good elements comes out; `name` is for messages.
    """
    if not 0 < size < np.inf:
        raise InputError(f"mesh of {name}: expected an element size above 0 mm, got {size}")
    sizes = element_sizes(surface, size)
    drawn = Drawn(surface, surface_parts(surface, attachments), sizes)
    skin = remesh(drawn, sizes)
    points, cells, facets = curved(*filled(skin.points, skin.triangles, size, name), skin, drawn)
    ends = (np.unique(facets["origin"]), np.unique(facets["insertion"]))
    places = stations(points, cells, ends, name)
    mesh = MuscleMesh(TET10, points, cells, facets, places.along, places.area, places.length)
    check_mesh(mesh, name)
    loss = 1 - mesh.volume() / surface.volume
    if abs(loss) > LARGEST_LOSS:
        raise InputError(
            f"mesh of {name}: elements of {size:g} mm change the volume from {surface.volume / 1000:.2f} to"
            f" {mesh.volume() / 1000:.2f} cm³, expected the same to {LARGEST_LOSS:.0%}; choose smaller ones"
        )
    return mesh


def filled(
    points: Float[np.ndarray, "nodes 3"], triangles: Int[np.ndarray, "triangles 3"], size: float, name: str
) -> tuple[Float[np.ndarray, "all_nodes 3"], Int[np.ndarray, "tetrahedra 4"]]:
    """Points (the surface's first, in their order) and positively oriented tetrahedra with edges up to `size` [mm].

    Raises InputError where Netgen finds no way to fill the surface.
    """
    ngs.ngsglobals.msg_level = 0
    mesh = _NETGEN.Mesh(dim=3)
    numbers = [mesh.Add(_NETGEN.MeshPoint(_NETGEN.Pnt(*map(float, point)))) for point in points]
    mesh.Add(_NETGEN.FaceDescriptor(surfnr=1, domin=1, bc=1))
    for triangle in triangles:
        mesh.Add(_NETGEN.Element2D(1, [numbers[corner] for corner in triangle]))
    try:
        mesh.GenerateVolumeMesh(maxh=size, grading=GRADING, parallel_meshing=False)
    except Exception as problem:
        raise _failure(name, str(problem)) from None
    tetrahedra = np.array([[vertex.nr - 1 for vertex in element.vertices] for element in mesh.Elements3D()], dtype=int)
    if len(tetrahedra) == 0:
        raise _failure(name, "no tetrahedra came out")
    everywhere = np.array(mesh.Coordinates(), dtype=float)
    return everywhere, tetrahedra[:, [0, 2, 1, 3]]


def _failure(name: str, reason: str) -> InputError:
    return InputError(
        f"mesh of {name}: Netgen cannot fill the surface with tetrahedra ({reason}); choose another element size, or"
        " smooth the surface"
    )
