r"""Vertices between the nodes of a surface of quadrilaterals, as weighted sums of nodes: rounder, and exact at nodes.

    on an edge ab that goes on straight from p to q:   (9 (a + b) - p - q) / 16
    where only q is there:                             (3 a + 6 b - q) / 8
    inside a quadrilateral:                            (sum of its four edges' vertices) / 2 - (sum of its corners) / 4

An edge goes on where four edges meet, as the one that shares no quadrilateral with it, unless the surface has a corner
there. Source: Dyn, Levin and Gregory 1987 for the first line.
"""

from collections import defaultdict
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

Weights = dict[int, float]
CORNER = 0.5
"""Cosine of the turn beyond which an edge does not go on."""


@dataclass(frozen=True)
class Refined:
    """Triangles of nodes and new vertices, and of each new vertex some nodes and their weights."""

    triangles: Int[np.ndarray, "triangles 3"]
    parents: Int[np.ndarray, "vertices most"]
    weights: Float[np.ndarray, "vertices most"]


def refine(points: Float[np.ndarray, "nodes 3"], quads: Int[np.ndarray, "facets 4"]) -> Refined:
    """Each quadrilateral cut into four, for a surface whose nodes are all used."""
    edges, of_quads = _edges(quads)
    onward = _Onward(points, edges, of_quads)
    sums = [onward.vertex(*map(int, edge)) for edge in edges]
    sums += [_inside(quad, [sums[edge] for edge in sides]) for quad, sides in zip(quads, of_quads, strict=True)]
    middle = len(points) + len(edges) + np.arange(len(quads))
    side = len(points) + of_quads
    corners = [np.stack([quads[:, k], side[:, k], middle, side[:, k - 1]], axis=1) for k in range(4)]
    return Refined(triangles_of(np.concatenate(corners)), *_padded(sums))


def triangles_of(quads: Int[np.ndarray, "facets 4"]) -> Int[np.ndarray, "triangles 3"]:
    """Two triangles of each quadrilateral; those without area, where corners coincide, are left out."""
    halves = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    a, b, c = halves.T
    return halves[(a != b) & (b != c) & (c != a)]


def _edges(quads: Int[np.ndarray, "facets 4"]) -> tuple[Int[np.ndarray, "edges 2"], Int[np.ndarray, "facets 4"]]:
    """All edges once, and the four of each quadrilateral: from each corner to the next."""
    each = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    edges, numbers = np.unique(each, axis=0, return_inverse=True)
    return edges, numbers.reshape(quads.shape)


class _Onward:
    """Where edges go on beyond their ends."""

    def __init__(self, points: np.ndarray, edges: np.ndarray, of_quads: np.ndarray) -> None:
        self.points = points
        self.beside: dict[frozenset[int], set[int]] = defaultdict(set)
        self.around: dict[int, list[int]] = defaultdict(list)
        for quad, sides in enumerate(of_quads.tolist()):
            for side in sides:
                self.beside[frozenset(edges[side].tolist())].add(quad)
        for a, b in edges.tolist():
            self.around[a].append(b)
            self.around[b].append(a)

    def vertex(self, a: int, b: int) -> Weights:
        """The new vertex on an edge."""
        before, after = self._beyond(b, a), self._beyond(a, b)
        if before is not None and after is not None:
            return {a: 9 / 16, b: 9 / 16, before: -1 / 16, after: -1 / 16}
        if after is not None:
            return {a: 3 / 8, b: 6 / 8, after: -1 / 8}
        if before is not None:
            return {b: 3 / 8, a: 6 / 8, before: -1 / 8}
        return {a: 1 / 2, b: 1 / 2}

    def _beyond(self, start: int, end: int) -> int | None:
        """The node after `end` on the line from `start`; None where there is none, or the line has a corner."""
        if len(self.around[end]) != 4:
            return None
        quads = self.beside[frozenset((start, end))]
        found = [node for node in self.around[end] if not quads & self.beside[frozenset((node, end))]]
        if len(found) != 1:
            return None
        here, there = self.points[end] - self.points[start], self.points[found[0]] - self.points[end]
        straight = here @ there / max(float(np.linalg.norm(here) * np.linalg.norm(there)), 1e-12)
        return found[0] if straight > CORNER else None


def _inside(quad: Int[np.ndarray, " 4"], sides: list[Weights]) -> Weights:
    total: Weights = defaultdict(float)
    for side in sides:
        for node, weight in side.items():
            total[node] += weight / 2
    for node in quad.tolist():
        total[node] -= 1 / 4
    return {node: weight for node, weight in total.items() if abs(weight) > 1e-12}


def _padded(sums: list[Weights]) -> tuple[np.ndarray, np.ndarray]:
    most = max(map(len, sums))
    parents, weights = np.zeros((len(sums), most), dtype=np.int64), np.zeros((len(sums), most))
    for row, each in enumerate(sums):
        parents[row, : len(each)], weights[row, : len(each)] = list(each), list(each.values())
    return parents, weights
