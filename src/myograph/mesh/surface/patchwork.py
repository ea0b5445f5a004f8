"""A triangulated surface that can be changed edge by edge; only `remesh.py` uses it.

Splitting puts a point on an edge, collapsing draws one end into the other, flipping replaces an edge by the other
diagonal of its two triangles. Every triangle carries the number of its part; edges between parts are rims, which are
never flipped and only collapse along themselves.

Plain numbers instead of arrays: on three numbers at a time they are ten times faster.
"""

from collections.abc import Sequence
from itertools import pairwise
from math import dist, hypot

import numpy as np

Vector = tuple[float, float, float]

FLAT, CREASED = 0.3, -0.5
"""Smallest cosine between normals before and after a change; where a needle goes, whose normal means little."""
FIT = 0.17
"""Sine of the smallest angle that is no needle's (10 degrees)."""


class Patchwork:
    """The changing surface: points, triangles by number, and the triangles around each point."""

    def __init__(self, points: np.ndarray, triangles: np.ndarray, parts: np.ndarray) -> None:
        self.points: list[Vector] = [(x, y, z) for x, y, z in points.tolist()]
        self.triangles: dict[int, tuple[int, int, int]] = {}
        self.part: dict[int, int] = {}
        self.around: list[set[int]] = [set() for _ in points]
        self._next = 0
        for corners, part in zip(triangles.tolist(), parts.tolist(), strict=True):
            self._add(corners, part)

    def edges(self) -> list[tuple[int, int]]:
        """Both ends of every edge, the smaller number first."""
        return sorted({(min(p, q), max(p, q)) for t in self.triangles.values() for p, q in pairwise((*t, t[0]))})

    def diagonals(self) -> tuple[np.ndarray, np.ndarray]:
        """Both ends of every edge, and the other corners of its two triangles."""
        third = {}
        for a, b, c in self.triangles.values():
            third[a, b], third[b, c], third[c, a] = c, a, b
        edges = [(a, b) for a, b in third if a < b]
        return np.array(edges), np.array([(third[a, b], third[b, a]) for a, b in edges])

    def beside(self, a: int, b: int) -> list[int]:
        """The triangles on an edge: two, or none where there is no such edge."""
        return sorted(self.around[a] & self.around[b])

    def is_rim(self, a: int, b: int) -> bool:
        """True for an edge between two parts."""
        return len({self.part[t] for t in self.beside(a, b)}) > 1

    def on_rim(self, a: int) -> bool:
        """True for a point of more than one part."""
        return len({self.part[t] for t in self.around[a]}) > 1

    def neighbours(self, a: int) -> set[int]:
        """Points that share an edge with a point."""
        return {p for t in self.around[a] for p in self.triangles[t]} - {a}

    def length(self, a: int, b: int) -> float:
        """Length of an edge."""
        return dist(self.points[a], self.points[b])

    def smallest_angle(self, corners: Sequence[int]) -> float:
        """Sine of the smallest angle of a triangle, which lies between its two longer sides."""
        sides = sorted(self.length(corners[k], corners[k - 1]) for k in range(3))
        return hypot(*self._normal(corners)) / max(sides[1] * sides[2], 1e-300)

    def split(self, a: int, b: int) -> None:
        """Put a point on the middle of an edge."""
        middle = len(self.points)
        (ax, ay, az), (bx, by, bz) = self.points[a], self.points[b]
        self.points.append((0.5 * (ax + bx), 0.5 * (ay + by), 0.5 * (az + bz)))
        self.around.append(set())
        for triangle in self.beside(a, b):
            corners, part = self._remove(triangle)
            self._add([middle if p == a else p for p in corners], part)
            self._add([middle if p == b else p for p in corners], part)

    def collapse(self, gone: int, kept: int, longest: float) -> bool:
        """Draw one end of an edge into the other, unless that folds the surface or makes an edge too long."""
        if any(self.length(kept, p) > longest for p in self.neighbours(gone) - {kept}):
            return False
        return self._draw_in(gone, kept, FLAT)

    def absorb(self, gone: int, kept: int) -> bool:
        """The same to be rid of a needle: even over a crease, but not where it leaves another needle."""
        moved = [[kept if p == gone else p for p in self.triangles[t]] for t in self.around[gone] - self.around[kept]]
        if min(map(self.smallest_angle, moved), default=0.0) < FIT:
            return False
        return self._draw_in(gone, kept, CREASED)

    def flip(self, a: int, b: int, flat: float = FLAT) -> bool:
        """Exchange an edge for the other diagonal where that makes the smallest angle larger.

        `flat` is the smallest cosine between the normals of the two triangles before and after.
        """
        one, other = self.beside(a, b)
        corners = self.triangles[one]
        if corners[corners.index(a) - 2] != b:
            a, b = b, a
        c, d = (next(p for p in self.triangles[t] if p not in (a, b)) for t in (one, other))
        if self.is_rim(a, b) or self.beside(c, d) or min(len(self.around[a]), len(self.around[b])) < 4:
            return False
        old, new = (self.triangles[one], self.triangles[other]), ((a, d, c), (d, b, c))
        if min(map(self.smallest_angle, new)) <= min(map(self.smallest_angle, old)):
            return False
        normals = [self._normal(t) for t in (*old, *new)]
        if min(_cosine(normals[k], normals[2 + j]) for k in (0, 1) for j in (0, 1)) <= flat:
            return False
        _, part = self._remove(one)
        self._remove(other)
        for triangle in new:
            self._add(triangle, part)
        return True

    def arrays(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Points, triangles and their parts, without the points that are gone."""
        used, triangles = np.unique(np.array(list(self.triangles.values())), return_inverse=True)
        return np.array(self.points)[used], triangles.reshape(-1, 3), np.array([self.part[t] for t in self.triangles])

    def part_of_points(self) -> np.ndarray:
        """The smallest number of the parts around each point; 0 for points that are gone."""
        return np.array([min((self.part[t] for t in some), default=0) for some in self.around])

    def _draw_in(self, gone: int, kept: int, flat: float) -> bool:
        beside = self.beside(gone, kept)
        if len(self.neighbours(gone) & self.neighbours(kept)) != 2 or not self._may_go(gone, kept):
            return False
        moved = {t: [kept if p == gone else p for p in self.triangles[t]] for t in self.around[gone] - set(beside)}
        for triangle, corners in moved.items():
            if _cosine(self._normal(self.triangles[triangle]), self._normal(corners)) <= flat:
                return False
        for triangle in beside:
            self._remove(triangle)
        for triangle, corners in moved.items():
            _, part = self._remove(triangle)
            self._add(corners, part)
        return True

    def _may_go(self, gone: int, kept: int) -> bool:
        """A rim's point goes only along a rim of two parts that does not shrink to a triangle's width."""
        if min(len(self.around[p]) for p in self.neighbours(gone) & self.neighbours(kept)) < 4:
            return False
        if not self.on_rim(gone):
            return True
        rims = [p for p in self.neighbours(gone) if self.is_rim(gone, p)]
        return kept in rims and len(rims) == 2 and not self.beside(*rims)

    def _add(self, corners: Sequence[int], part: int) -> None:
        self.triangles[self._next], self.part[self._next] = (corners[0], corners[1], corners[2]), part
        for p in corners:
            self.around[p].add(self._next)
        self._next += 1

    def _remove(self, triangle: int) -> tuple[tuple[int, int, int], int]:
        corners = self.triangles.pop(triangle)
        for p in corners:
            self.around[p].discard(triangle)
        return corners, self.part.pop(triangle)

    def _normal(self, corners: Sequence[int]) -> Vector:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (self.points[p] for p in corners)
        bx, by, bz, cx, cy, cz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
        return by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx


def _cosine(one: Vector, other: Vector) -> float:
    product = one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
    return product / max(hypot(*one) * hypot(*other), 1e-300)
