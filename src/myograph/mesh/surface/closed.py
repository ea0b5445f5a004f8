"""Closed triangulated surfaces: the skin of a body that somebody else drew.

Corners that lie within a millionth of the surface's size of each other are one point. A surface that all its
triangles see from inside is turned; anything else that keeps it from bounding one body is refused by
`closed_surface`.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import KDTree

from myograph.mesh.muscle_mesh import MuscleMesh
from myograph.mesh.surface.checks import check_closed, check_shapes, check_uncut
from myograph.mesh.surface.stl import read_stl

MERGED = 1e-6
"""Distance of points that are one, as a share of the diagonal of the surface's bounding box."""


@dataclass(frozen=True)
class ClosedSurface:
    """The skin of one body.

    Parameters
    ----------
    points
        Vertices [mm].
    triangles
        Corners, counter-clockwise seen from outside.
    """

    points: Float[np.ndarray, "nodes 3"]
    triangles: Int[np.ndarray, "triangles 3"]

    @property
    def volume(self) -> float:
        """Volume inside [mm³]."""
        return _volume(self.points, self.triangles)


def closed_surface(
    points: Float[np.ndarray, "nodes 3"], triangles: Int[np.ndarray, "triangles 3"], name: str = "surface"
) -> ClosedSurface:
    """The surface with its double points merged; raise InputError with the place unless it bounds one body.

    Refused are open edges, edges of more than two triangles, triangles that disagree about the outside, points where
    two parts touch, several shells, triangles without area or with a tiny angle, and triangles that cut each other.
    """
    points, triangles = _merged(points, triangles)
    check_closed(points, triangles, name)
    check_shapes(points, triangles, name)
    check_uncut(points, triangles, name)
    if _volume(points, triangles) < 0:
        triangles = np.ascontiguousarray(triangles[:, ::-1])
    return ClosedSurface(points, triangles)


def read_surface(path: Path) -> ClosedSurface:
    """The closed surface in the STL file at `path`, its numbers taken as mm; mistakes name the file."""
    corners = read_stl(path)
    return closed_surface(corners.reshape(-1, 3), np.arange(corners[..., 0].size).reshape(-1, 3), path.name)


def skin_of(mesh: MuscleMesh) -> ClosedSurface:
    """The skin of a mesh, cut into triangles."""
    corners = np.concatenate([mesh.skin[:, [0, 1, 2]], mesh.skin[:, [0, 2, 3]]])
    return closed_surface(mesh.points, corners[corners[:, 1] != corners[:, 2]], "skin of the mesh")


def neighbours(triangles: Int[np.ndarray, "triangles 3"]) -> Int[np.ndarray, "triangles 3"]:
    """Triangle beyond each side (corners 01, 12, 20) of each triangle of a closed surface."""
    sides = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    order = np.lexsort(sides.T)
    beyond = np.empty(len(order), dtype=int)
    beyond[order[0::2]], beyond[order[1::2]] = order[1::2] // 3, order[0::2] // 3
    return beyond.reshape(-1, 3)


def _merged(
    points: Float[np.ndarray, "nodes 3"], triangles: Int[np.ndarray, "triangles 3"]
) -> tuple[Float[np.ndarray, "merged 3"], Int[np.ndarray, "triangles 3"]]:
    """One number for points that are one; points that no triangle uses are left out."""
    used, triangles = np.unique(triangles, return_inverse=True)
    points = points[used]
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    pairs = KDTree(points).query_pairs(MERGED * size, output_type="ndarray")
    near = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(points), len(points)))
    _, group = connected_components(near, directed=False)
    _, first = np.unique(group, return_index=True)
    return points[first], group[triangles.reshape(-1, 3)].astype(int)


def _volume(points: Float[np.ndarray, "nodes 3"], triangles: Int[np.ndarray, "triangles 3"]) -> float:
    a, b, c = np.moveaxis(points[triangles] - points.mean(axis=0), 1, 0)
    return float(np.einsum("ta,ta->", a, np.cross(b, c)) / 6)
