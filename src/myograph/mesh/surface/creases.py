"""Where a drawn surface has creases and corners, so that drawing it anew does not plane them off.

The normals n of the triangles (area a) near a place x make two sums,  A = Σ a n nᵀ  and  b = Σ a n (n·(p - x)),  with
p a point of the triangle. On a smooth piece A has one large eigenvalue, on a crease two, at a corner three; their
directions are those in which a point may not be moved freely, and in them the step that solves A d = b leads to the
piece, the crease, or the corner (medial quadrics; Jiao 2007).
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import KDTree

SHARP = 0.12
"""Eigenvalue over the largest that makes a direction count: normals that turn by more than about 40 degrees."""


@dataclass(frozen=True)
class Creases:
    """What the surface is like near some places.

    Parameters
    ----------
    rank
        1 on smooth pieces, 2 on creases, 3 at corners.
    across
        Projector on the directions in which the place may not be moved freely.
    snap
        Step [mm] to the piece, crease, or corner.
    """

    rank: Int[np.ndarray, " places"]
    across: Float[np.ndarray, "places 3 3"]
    snap: Float[np.ndarray, "places 3"]


class CreaseFinder:
    """Looks up the normals of small triangles that make up a surface."""

    def __init__(self, corners: Float[np.ndarray, "triangles 3 3"]) -> None:
        self._middles = corners.mean(axis=1)
        doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self._areas = np.maximum(np.linalg.norm(doubled, axis=1), 1e-300)
        self._normals = doubled / self._areas[:, None]
        self._tree = KDTree(self._middles)

    def find(self, places: Float[np.ndarray, "places 3"], radii: Float[np.ndarray, " places"]) -> Creases:
        """Creases within the given distances [mm] of places on or near the surface."""
        distance, _ = self._tree.query(places)
        near = self._tree.query_ball_point(places, np.maximum(radii, distance * (1 + 1e-9)))
        count = np.array([len(some) for some in near])
        chosen = np.concatenate([np.asarray(some, dtype=int) for some in near])
        row = np.repeat(np.arange(len(places)), count)
        normal, starts = self._normals[chosen], np.concatenate([[0], np.cumsum(count)[:-1]])
        weighted = self._areas[chosen, None] * normal
        A = np.add.reduceat(weighted[:, :, None] * normal[:, None], starts)
        height = (normal * (self._middles[chosen] - places[row])).sum(axis=1)
        b = np.add.reduceat(weighted * height[:, None], starts)
        values, vectors = np.linalg.eigh(A)
        counts = values > SHARP * values[:, -1:]
        across = np.einsum("pik,pk,pjk->pij", vectors, counts.astype(float), vectors)
        inverse = np.where(counts, 1 / np.where(counts, values, 1.0), 0.0)
        snap = np.einsum("pik,pk,pjk,pj->pi", vectors, inverse, vectors, b)
        return Creases(counts.sum(axis=1), across, snap)
