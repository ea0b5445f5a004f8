"""Structured hexahedra, swept along a centre line with an O-grid section.

Sections are ellipses of the given areas, square to the centre line; their first axis is the one nearest to the lateral
direction, so that the mesh does not twist.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.mesh.hexahedra import HEX27
from myograph.mesh.muscle_mesh import MuscleMesh
from myograph.mesh.section import Section, o_grid

_MIRRORED = (6, 7, 8, 3, 4, 5, 0, 1, 2)
"""Nodes of a 9-node facet seen from its other side."""


@dataclass(frozen=True)
class Resolution:
    """Size of a swept mesh: core x core quadrilaterals, rings around them, hexahedra along the muscle."""

    core: int
    rings: int
    along: int

    @property
    def cells(self) -> int:
        """Number of hexahedra."""
        return (self.core**2 + 4 * self.core * self.rings) * self.along


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
    length
        Length of the centre line [mm].
    """

    centres: Float[np.ndarray, "stations 3"]
    areas: Float[np.ndarray, " stations"]
    flattening: Float[np.ndarray, " stations"]
    lateral: Float[np.ndarray, " 3"]
    length: float


def sweep(tube: Tube, resolution: Resolution) -> MuscleMesh:
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
    return MuscleMesh(
        element=HEX27,
        points=(tube.centres[:, None] + offsets).reshape(-1, 3),
        cells=np.vstack(hexahedra),
        facets=_facets(section, layers),
        along=np.repeat(np.linspace(0, 1, stations), per_station),
        area=np.repeat(tube.areas, per_station),
        length=tube.length,
    )


def _frames(tube: Tube) -> tuple[np.ndarray, np.ndarray]:
    """Two unit vectors square to the centre line at each station; with the tangent they are right-handed."""
    tangent = np.gradient(tube.centres, axis=0, edge_order=2)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    first = tube.lateral - (tangent @ tube.lateral)[:, None] * tangent
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return first, np.cross(tangent, first)


def _facets(section: Section, layers: Int[np.ndarray, " stations"]) -> dict[str, np.ndarray]:
    """Nine nodes of each curved facet: of the mantle, and of the two end faces."""
    count = len(section.rim)
    around = section.rim[(np.arange(0, count, 2)[:, None] + np.arange(3)) % count]
    mantle = [np.hstack([around + layer for layer in layers[k : k + 3]]) for k in range(0, len(layers) - 2, 2)]
    face = section.quads
    return {"skin": np.vstack(mantle), "origin": face[:, _MIRRORED] + layers[0], "insertion": face + layers[-1]}
