"""Where bones hold a surface: the faces around a given point.

A face grows from the triangle nearest to the point over its neighbours, up to a sharp edge (as around a flat cut) and
to a given distance from the point.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Int

from myograph.errors import InputError
from myograph.mesh.muscle_mesh import FACETS
from myograph.mesh.surface.closed import ClosedSurface, neighbours
from myograph.mesh.surface.nearest import NearestOnSurface

SHARP = np.radians(40.0)
"""Turn of the normal over an edge that ends a face."""


@dataclass(frozen=True)
class Attachment:
    """A face of a surface: a point on or near it, and how far the middles of its triangles may be from it [mm]."""

    point: tuple[float, float, float]
    radius: float


@dataclass(frozen=True)
class Attachments:
    """All faces of a muscle that bones hold: a head more is an attachment more at its end."""

    origin: tuple[Attachment, ...]
    insertion: tuple[Attachment, ...]


def surface_parts(surface: ClosedSurface, attachments: Attachments) -> Int[np.ndarray, " triangles"]:
    """Which part of a muscle's surface each triangle belongs to: its index in `FACETS`.

    Raises InputError where a point is off the surface, and where origin and insertion meet or are the same.
    """
    origin = _faces(surface, attachments.origin, "origin")
    insertion = _faces(surface, attachments.insertion, "insertion")
    if np.intersect1d(surface.triangles[origin], surface.triangles[insertion]).size:
        raise InputError(
            f"origin {_words(attachments.origin)} and insertion {_words(attachments.insertion)} are faces that meet:"
            " the fibres between them would have no length; expected faces apart: move the points or make the radii"
            " smaller"
        )
    parts = np.full(len(surface.triangles), FACETS.index("skin"))
    parts[origin], parts[insertion] = FACETS.index("origin"), FACETS.index("insertion")
    return parts


def _words(some: tuple[Attachment, ...]) -> str:
    return " and ".join(f"at {each.point} mm within {each.radius:g} mm" for each in some)


def _faces(surface: ClosedSurface, some: tuple[Attachment, ...], name: str) -> Int[np.ndarray, " face"]:
    if not some:
        raise InputError(f"{name}: expected at least one attachment, got none")
    return np.unique(np.concatenate([_face(surface, each, name) for each in some]))


def _face(surface: ClosedSurface, attachment: Attachment, name: str) -> Int[np.ndarray, " face"]:
    point = np.array(attachment.point)
    nearest, seed = NearestOnSurface(surface.points, surface.triangles).find(point[None])
    distance = float(np.linalg.norm(nearest[0] - point))
    if not distance <= attachment.radius:
        raise InputError(
            f"{name} at {attachment.point} mm: expected a point within its radius of {attachment.radius:g} mm of the"
            f" surface, got one {distance:.1f} mm away; the nearest surface point is {nearest[0].round(1).tolist()}"
        )
    corners = surface.points[surface.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    near = np.linalg.norm(corners.mean(axis=1) - point, axis=1) <= attachment.radius
    beside = neighbours(surface.triangles)
    face, front = {int(seed[0])}, [int(seed[0])]
    while front:
        here = front.pop()
        for other in map(int, beside[here]):
            if other not in face and near[other] and normals[here] @ normals[other] > np.cos(SHARP):
                face.add(other)
                front.append(other)
    return np.array(sorted(face))
