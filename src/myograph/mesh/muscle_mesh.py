"""The mesh of a muscle, whatever its elements: what the mechanics, the pictures and the tables need to know of it.

The along-muscle coordinate runs from 0 at the origin to 1 at the insertion, in equal steps of the centre line's
length.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from myograph.mesh.element import Element

FACETS = ("origin", "insertion", "skin")
"""The parts of a muscle's surface: two faces that bones hold, and the rest."""


@dataclass(frozen=True)
class MuscleMesh:
    """A muscle as curved elements of one kind.

    Parameters
    ----------
    element
        The kind of its elements.
    points
        Nodes in the reference body [mm].
    cells
        Nodes of each element.
    facets
        Nodes of the elements' facets on each part of the surface, counter-clockwise seen from outside.
    along
        Coordinate of each node along the muscle, 0 at the origin, 1 at the insertion.
    area
        Area of the reference section through each node [mm²].
    length
        Length of the centre line [mm].
    """

    element: Element
    points: Float[np.ndarray, "nodes 3"]
    cells: Int[np.ndarray, "cells element_nodes"]
    facets: dict[str, Int[np.ndarray, "_ _"]]
    along: Float[np.ndarray, " nodes"]
    area: Float[np.ndarray, " nodes"]
    length: float

    def end_nodes(self, end: str) -> Int[np.ndarray, " face"]:
        """Nodes of the face at the 'origin' or the 'insertion', in increasing order."""
        return np.unique(self.facets[end])

    def end_centre(self, end: str) -> Float[np.ndarray, " 3"]:
        """Centre of area [mm] of the face at the 'origin' or the 'insertion'."""
        quads = self.points[self.facets[end][:, self.element.facet_quads].reshape(-1, 4)]
        halves = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
        areas = np.linalg.norm(np.cross(halves[:, 1] - halves[:, 0], halves[:, 2] - halves[:, 0]), axis=1)
        return areas @ halves.mean(axis=1) / areas.sum()

    @cached_property
    def skin(self) -> Int[np.ndarray, "quads 4"]:
        """The whole surface as linear quadrilaterals, outward normal; a triangle repeats its last corner."""
        facets = np.vstack([self.facets[name] for name in FACETS])
        return facets[:, self.element.facet_quads].reshape(-1, 4)

    def volume(self, positions: Float[np.ndarray, "nodes 3"] | None = None) -> float:
        """Volume [mm³] of the reference body, or with its nodes at other positions."""
        return float(self.element.volumes(self.points if positions is None else positions, self.cells).sum())

    def volume_ratios(self, positions: Float[np.ndarray, "nodes 3"]) -> Float[np.ndarray, "cells quad"]:
        """J, present over reference volume, at the integration points, with the nodes at the given positions."""
        return self.element.determinants(positions, self.cells, self.element.places) / self._determinants

    @cached_property
    def _determinants(self) -> Float[np.ndarray, "cells quad"]:
        """Of the map from local coordinates to the reference body, at the integration points [mm³]."""
        return self.element.determinants(self.points, self.cells, self.element.places)
