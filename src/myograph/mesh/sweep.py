"""Structured hexahedra, swept along a centre line with an O-grid section.

Sections are ellipses of the given areas, square to the centre line; their first axis is the one nearest to the lateral
direction, so that the mesh does not twist.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from jaxtyping import Float, Int

from myograph.mesh.hexahedra import HexMesh
from myograph.mesh.section import Section, o_grid


@dataclass(frozen=True)
class Resolution:
    """Size of a swept mesh: core x core quadrilaterals, rings around them, hexahedra along the muscle."""

    core: int
    rings: int
    along: int


@dataclass(frozen=True)
class Tube:
    """What is swept: stations along a centre line.

    Parameters
    ----------
    centres
        Centre line [mm]; one point per station, two stations per hexahedron plus one.
    areas
        Section areas [mm²].
    flattening
        Lateral over other half-axis of the elliptic sections.
    lateral
        Direction that the sections' first axis follows.
    """

    centres: Float[np.ndarray, "stations 3"]
    areas: Float[np.ndarray, " stations"]
    flattening: Float[np.ndarray, " stations"]
    lateral: Float[np.ndarray, " 3"]


def sweep(tube: Tube, resolution: Resolution) -> HexMesh:
    """Hexahedra along the tube; the tube must have 2 x resolution.along + 1 stations."""
    section = o_grid(resolution.core, resolution.rings)
    stations, per_station = len(tube.centres), len(section.nodes)
    first, second = _frames(tube)
    radius = np.sqrt(tube.areas / np.pi)[:, None]
    stretch = np.sqrt(tube.flattening)[:, None]
    offsets = (
        np.einsum("n,sa->sna", section.nodes[:, 0], first * radius * stretch)
        + np.einsum("n,sa->sna", section.nodes[:, 1], second * radius / stretch)
    )  # fmt: skip
    layers = np.arange(stations) * per_station
    cells = [section.quads + layer for layer in layers]
    hexahedra = [np.hstack(cells[2 * k : 2 * k + 3]) for k in range(resolution.along)]
    return HexMesh(
        points=(tube.centres[:, None] + offsets).reshape(-1, 3),
        cells=np.vstack(hexahedra),
        along=np.repeat(np.linspace(0, 1, stations), per_station),
        area=np.repeat(tube.areas, per_station),
        skin=_skin(section, layers),
        facets=_facets(section, layers),
    )


def _frames(tube: Tube) -> tuple[np.ndarray, np.ndarray]:
    """Two unit vectors square to the centre line at each station; with the tangent they are right-handed."""
    tangent = np.gradient(tube.centres, axis=0, edge_order=2)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    first = tube.lateral - (tangent @ tube.lateral)[:, None] * tangent
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return first, np.cross(tangent, first)


def _skin(section: Section, layers: Int[np.ndarray, " stations"]) -> Int[np.ndarray, "quads 4"]:
    """Linear quadrilaterals of the whole surface."""
    rim, following = section.rim, np.roll(section.rim, -1)
    mantle = [
        np.stack([rim + low, following + low, following + high, rim + high], axis=1) for low, high in pairwise(layers)
    ]
    grids = section.quads.reshape(-1, 3, 3)
    caps = [
        np.stack([grids[:, j, i], grids[:, j, i + 1], grids[:, j + 1, i + 1], grids[:, j + 1, i]], axis=1)
        for j in (0, 1)
        for i in (0, 1)
    ]
    cap = np.vstack(caps)
    return np.vstack([*mantle, cap[:, ::-1] + layers[0], cap + layers[-1]])


def _facets(section: Section, layers: Int[np.ndarray, " stations"]) -> dict[str, np.ndarray]:
    """Vertices of the curved facets: the mantle, and the two end faces."""
    corners, following = section.rim[::2], np.roll(section.rim[::2], -1)
    mantle = [
        np.stack([corners + low, following + low, following + high, corners + high], axis=1)
        for low, high in zip(layers[:-1:2], layers[2::2], strict=True)
    ]
    face = section.quads[:, [0, 2, 8, 6]]
    return {"skin": np.vstack(mantle), "origin": face[:, ::-1] + layers[0], "insertion": face + layers[-1]}
