"""The nearest point of a surface or of a line to given points.

Long triangles are halved until all are of one size; then only those whose middle is near enough need to be looked at.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import KDTree

_LARGE = 4.0
"""Edges longer than this many times the surface's mean point distance are halved."""


class NearestOnSurface:
    """Nearest points of some triangles."""

    def __init__(self, points: Float[np.ndarray, "nodes 3"], triangles: Int[np.ndarray, "triangles 3"]) -> None:
        corners = points[triangles]
        area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
        self._corners, self._owner = halved(corners, _LARGE * np.sqrt(area / len(triangles)))
        middles = self._corners.mean(axis=1)
        self._reach = float(np.linalg.norm(self._corners - middles[:, None], axis=2).max())
        self._tree = KDTree(middles)

    def find(
        self, places: Float[np.ndarray, "places 3"]
    ) -> tuple[Float[np.ndarray, "places 3"], Int[np.ndarray, " places"]]:
        """Nearest points, and the triangles that they lie in."""
        if len(places) == 0:
            return places, np.zeros(0, dtype=int)
        bound, _ = self._tree.query(places)
        candidates = self._tree.query_ball_point(places, bound + self._reach)
        count = [len(some) for some in candidates]
        chosen = np.concatenate([np.asarray(some, dtype=int) for some in candidates])
        nearest = nearest_in_triangles(np.repeat(places, count, axis=0), self._corners[chosen])
        distance = np.linalg.norm(nearest - np.repeat(places, count, axis=0), axis=1)
        starts = np.concatenate([[0], np.cumsum(count)[:-1]])
        best = np.repeat(np.minimum.reduceat(distance, starts), count) == distance
        rows = np.repeat(np.arange(len(places)), count)[best]
        first = np.flatnonzero(best)[np.unique(rows, return_index=True)[1]]
        return nearest[first], self._owner[chosen[first]]


def nearest_in_triangles(
    places: Float[np.ndarray, "places 3"], corners: Float[np.ndarray, "places 3 3"]
) -> Float[np.ndarray, "places 3"]:
    """Nearest point of one triangle to each place: inside it, or on its nearest side."""
    a, b, c = np.moveaxis(corners, 1, 0)
    on_sides = np.stack([nearest_on_segments(places, *ends) for ends in ((a, b), (b, c), (c, a))], axis=1)
    best = np.argmin(np.linalg.norm(on_sides - places[:, None], axis=2), axis=1)
    result = on_sides[np.arange(len(places)), best]
    normal = np.cross(b - a, c - a)
    square = (normal**2).sum(axis=1)
    shares = [
        (np.cross(q - p, places - p) * normal).sum(axis=1) / np.maximum(square, 1e-300)
        for p, q in ((a, b), (b, c), (c, a))
    ]
    inside = np.min(shares, axis=0) >= 0
    height = ((places - a) * normal).sum(axis=1) / np.maximum(square, 1e-300)
    return np.where(inside[:, None], places - height[:, None] * normal, result)


def nearest_on_segments(
    places: Float[np.ndarray, "*batch 3"], start: Float[np.ndarray, "*batch 3"], end: Float[np.ndarray, "*batch 3"]
) -> Float[np.ndarray, "*batch 3"]:
    """Nearest point of a segment to each place."""
    along = end - start
    share = ((places - start) * along).sum(axis=-1) / np.maximum((along**2).sum(axis=-1), 1e-300)
    return start + np.clip(share, 0, 1)[..., None] * along


def nearest_on_line(
    places: Float[np.ndarray, "places 3"],
    starts: Float[np.ndarray, "segments 3"],
    ends: Float[np.ndarray, "segments 3"],
) -> Float[np.ndarray, "places 3"]:
    """Nearest point of a line of segments to each place."""
    shape = (len(places), len(starts), 3)
    each = nearest_on_segments(*(np.broadcast_to(x, shape) for x in (places[:, None], starts, ends)))
    best = np.argmin(np.linalg.norm(each - places[:, None], axis=2), axis=1)
    return each[np.arange(len(places)), best]


def halved(
    corners: Float[np.ndarray, "triangles 3 3"], longest: float
) -> tuple[Float[np.ndarray, "pieces 3 3"], Int[np.ndarray, " pieces"]]:
    """Triangles cut at the middle of their longest side until none is longer than `longest`, and whose they were."""
    owner = np.arange(len(corners))
    while True:
        sides = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
        long = sides.max(axis=1) > longest
        if not long.any():
            return corners, owner
        turn = (np.argmax(sides[long], axis=1)[:, None] + np.arange(3)) % 3
        a, b, c = np.moveaxis(np.take_along_axis(corners[long], turn[:, :, None], axis=1), 1, 0)
        middle = 0.5 * (a + b)
        halves = (np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1))
        corners = np.concatenate([corners[~long], *halves])
        owner = np.concatenate([owner[~long], owner[long], owner[long]])
