"""Shaded surfaces by matplotlib alone: seen from far away, drawn from the farthest facet to the nearest.

Colour of a corner under one distant lamp: base (a + d max(n·l, 0)) + s max(n·h, 0)^k, interpolated over the facet
(Gouraud). Each quadrilateral is cut into smaller ones that follow the corners' normals, so that outlines look round and
facets of different bodies are sorted well by depth; where bodies cut through each other, they do so facet by facet.
Source: Boubekeur and Alexa 2008 (Phong tessellation) for the rounding.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Bool, Float, Int

from myograph.view.surface import node_normals

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LAMP = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])
"""Direction to the lamp, as (right, up, towards the viewer)."""
HALFWAY = (LAMP + np.eye(3)[2]) / np.linalg.norm(LAMP + np.eye(3)[2])
AMBIENT, DIFFUSE, GLOSS, SHININESS = 0.58, 0.50, 0.16, 24
FACET, MOST_PIECES = 2.0, 6
"""Size [mm] down to which quadrilaterals are cut, but into no more than 6 x 6."""
ROUNDING = 0.75
"""0 leaves the pieces in the flat quadrilateral, 1 rounds them fully."""
CONTOUR, CONTOUR_COLOUR = 0.7, np.array([0.20, 0.17, 0.15])
"""Width of the dark line around each surface [mm]: its far side, blown up, of which only the rim is seen."""


@dataclass(frozen=True)
class Camera:
    """A viewer far away; orthonormal directions in space, right and up as in the picture."""

    right: Float[np.ndarray, " 3"]
    up: Float[np.ndarray, " 3"]
    towards: Float[np.ndarray, " 3"]

    def project(self, vectors: Float[np.ndarray, "*batch 3"]) -> Float[np.ndarray, "*batch 3"]:
        """Points or directions as (right, up, towards the viewer)."""
        return vectors @ np.stack([self.right, self.up, self.towards], axis=1)


def side_camera(turn: float = 0.3, tilt: float = 0.12, forward: tuple[float, float, float] = (1.0, 1.5, 0.0)) -> Camera:
    """Viewer at the lateral side of a left arm: the hand to the left, z up.

    Parameters
    ----------
    turn
        Angle [rad] by which the viewer walks from the side to the front; pi looks from the medial side.
    tilt
        Height of the viewer above the horizon [rad].
    forward
        Horizontal direction in which the arm flexes.
    """
    ahead = np.array(forward) / np.linalg.norm(forward)
    upright = np.array([0.0, 0.0, 1.0])
    lateral = np.cross(upright, ahead)
    level = np.cos(turn) * lateral + np.sin(turn) * ahead
    towards = np.cos(tilt) * level + np.sin(tilt) * upright
    right = np.cross(upright, level)
    return Camera(right, np.cross(towards, right), towards)


@dataclass(frozen=True)
class PaintedSurface:
    """A surface with a colour (red, green, blue in [0, 1]) at each node; outward quadrilaterals."""

    points: Float[np.ndarray, "nodes 3"]
    quads: Int[np.ndarray, "facets 4"]
    colours: Float[np.ndarray, "nodes 3"]


def draw_surfaces(axes: "Axes", camera: Camera, surfaces: Sequence[PaintedSurface], relief: float = 1.0) -> None:
    """Draw closed surfaces, each with a thin dark contour, into axes whose unit is mm.

    Parameters
    ----------
    relief
        Strength of light and shade; less where the colours are to be read as values.
    """
    from matplotlib.collections import TriMesh
    from matplotlib.tri import Triangulation

    triangles, colours = [], []
    for surface in surfaces:
        corners, normals, paint = _facets(surface, camera)
        front = _counter_clockwise(corners)
        triangles.append(corners[front])
        colours.append(_lit(paint[front], normals[front], relief))
        triangles.append((corners + CONTOUR * normals)[~front])
        colours.append(np.broadcast_to(CONTOUR_COLOUR, corners[~front].shape))
    corners, paint = np.concatenate(triangles), np.concatenate(colours)
    order = np.argsort(corners[:, :, 2].mean(axis=1))
    flat = corners[order].reshape(-1, 3)
    mesh = TriMesh(Triangulation(flat[:, 0], flat[:, 1], np.arange(len(flat)).reshape(-1, 3)))
    mesh.update({"facecolor": np.column_stack([paint[order].reshape(-1, 3), np.ones(len(flat))])})
    axes.add_collection(mesh)


def _facets(surface: PaintedSurface, camera: Camera) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Corners, unit normals and colours (triangles, 3, 3) of the fine triangles, in the camera's directions."""
    used = camera.project(surface.points)[surface.quads]
    normals = camera.project(node_normals(surface.points, surface.quads))[surface.quads]
    diagonals = np.linalg.norm(used[:, :2] - used[:, 2:], axis=-1)
    pieces = int(np.clip(np.ceil(np.median(diagonals) / np.sqrt(2) / FACET), 1, MOST_PIECES))
    u, v = (grid.ravel() for grid in np.meshgrid(*[np.linspace(0, 1, pieces + 1)] * 2))
    weights = np.stack([(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v], axis=1)
    fine = np.einsum("pc,fca->fpa", weights, used)
    above = np.einsum("fpca,fca->fpc", fine[:, :, None] - used[:, None], normals)
    fine = fine - ROUNDING * np.einsum("pc,fpc,fca->fpa", weights, above, normals)
    turned = np.einsum("pc,fca->fpa", weights, normals)
    turned /= np.maximum(np.linalg.norm(turned, axis=-1, keepdims=True), 1e-12)
    paint = np.einsum("pc,fca->fpa", weights, surface.colours[surface.quads])
    node = np.arange(len(u)).reshape(pieces + 1, pieces + 1)
    a, b, c, d = node[:-1, :-1].ravel(), node[:-1, 1:].ravel(), node[1:, 1:].ravel(), node[1:, :-1].ravel()
    halves = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    soup = [values[:, halves].reshape(-1, 3, 3) for values in (fine, turned, paint)]
    return soup[0], soup[1], soup[2]


def _counter_clockwise(corners: Float[np.ndarray, "triangles 3 3"]) -> Bool[np.ndarray, " triangles"]:
    """Which triangles turn their outer side to the viewer."""
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return a[:, 0] * b[:, 1] > a[:, 1] * b[:, 0]


def _lit(
    paint: Float[np.ndarray, "*batch 3"], normals: Float[np.ndarray, "*batch 3"], relief: float
) -> Float[np.ndarray, "*batch 3"]:
    diffuse = np.maximum(normals @ LAMP, 0)[..., None]
    gloss = np.maximum(normals @ HALFWAY, 0)[..., None] ** SHININESS
    brightness = 1 + relief * (AMBIENT + DIFFUSE * diffuse - 1)
    return np.clip(paint * brightness + relief * GLOSS * gloss, 0, 1)
