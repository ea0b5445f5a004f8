"""A surface as it was drawn, cut into parts: where the points of a new triangulation are put back to."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from myograph.mesh.surface.closed import ClosedSurface, neighbours
from myograph.mesh.surface.creases import CreaseFinder, Creases
from myograph.mesh.surface.nearest import NearestOnSurface, halved, nearest_on_line
from myograph.mesh.surface.sizes import Sizes

NEAR = 0.3
"""How far creases are felt, as a share of the wanted length of edges."""


@dataclass(frozen=True)
class Settled:
    """Places on the surface [mm], and its unit normals there; zero on rims."""

    places: Float[np.ndarray, "places 3"]
    normals: Float[np.ndarray, "places 3"]


class Drawn:
    """The old surface.

    Parameters
    ----------
    surface
        Its triangles.
    parts
        The part that each of them belongs to; where parts meet is a rim.
    sizes
        The wanted length of new edges [mm].
    """

    def __init__(self, surface: ClosedSurface, parts: Int[np.ndarray, " triangles"], sizes: Sizes) -> None:
        self.surface, self.parts, self._sizes = surface, parts, sizes
        self._pieces = {int(part): surface.triangles[parts == part] for part in np.unique(parts)}
        self._nearest = {part: NearestOnSurface(surface.points, some) for part, some in self._pieces.items()}
        self._normals = {part: _normals(surface.points[some]) for part, some in self._pieces.items()}
        finest = 0.5 * NEAR * float(sizes(surface.points).max())
        small = {part: halved(surface.points[some], finest)[0] for part, some in self._pieces.items()}
        self._creases = {part: CreaseFinder(corners) for part, corners in small.items()}
        beyond = parts[neighbours(surface.triangles)]
        sides = np.stack([surface.triangles, np.roll(surface.triangles, -1, axis=1)], axis=2)
        self._rims = {part: surface.points[sides[(parts != part)[:, None] & (beyond == part)]] for part in self._pieces}

    def creases(self, places: Float[np.ndarray, "places 3"], part: Int[np.ndarray, " places"]) -> Creases:
        """What each place's part of the surface is like near it."""
        found = Creases(np.ones(len(places), dtype=int), np.zeros((len(places), 3, 3)), np.zeros_like(places))
        for number, finder in self._creases.items():
            here = np.flatnonzero(part == number)
            if len(here):
                some = finder.find(places[here], NEAR * self._sizes(places[here]))
                found.rank[here], found.across[here], found.snap[here] = some.rank, some.across, some.snap
        return found

    def settled(
        self,
        places: Float[np.ndarray, "places 3"],
        part: Int[np.ndarray, " places"],
        on_rim: Bool[np.ndarray, " places"],
    ) -> Settled:
        """The places put on their part of the surface, on its creases and corners, or on its rim."""
        result = places + np.where(on_rim[:, None], 0.0, self.creases(places, part).snap)
        normals = np.zeros_like(places)
        for number, nearest in self._nearest.items():
            inside, rim = np.flatnonzero((part == number) & ~on_rim), (part == number) & on_rim
            result[inside], triangles = nearest.find(result[inside])
            normals[inside] = self._normals[number][triangles]
            if rim.any():
                ends = self._rims[number]
                result[rim] = nearest_on_line(result[rim], ends[:, 0], ends[:, 1])
        return Settled(result, normals)


def _normals(corners: Float[np.ndarray, "triangles 3 3"]) -> Float[np.ndarray, "triangles 3"]:
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
