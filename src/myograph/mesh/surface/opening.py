"""No tetrahedron with two facets that meet smoothly: their common edge is given an inner face of its own.

Once the skin is curved, two facets of one element that meet in an edge are tangent to each other there: the element
opens by 180 degrees, and its Jacobian vanishes along the edge. Its opposite edge runs inside the body; with a point
on the middle of that, the element becomes two, and each opens by half as much.
"""

from itertools import combinations, count

import numpy as np
from jaxtyping import Float, Int

from myograph.mesh.surface.remesh import Remeshed

SMOOTH = float(np.cos(np.radians(75.0)))
"""Cosine between the normals of two facets that count as one smooth skin."""


def opened(
    points: Float[np.ndarray, "vertices 3"], tetrahedra: Int[np.ndarray, "cells 4"], skin: Remeshed
) -> tuple[Float[np.ndarray, "more_vertices 3"], Int[np.ndarray, "more_cells 4"]]:
    """Points, the new ones last, and tetrahedra of the same orientation."""
    cells: dict[int, list[int]] = dict(enumerate(tetrahedra.tolist()))
    numbers = count(len(cells))
    around: list[set[int]] = [set() for _ in points]
    for number, corners in cells.items():
        for corner in corners:
            around[corner].add(number)
    new = list(points)
    for one, other in _inner_edges(points, tetrahedra, skin):
        middle = len(new)
        new.append(0.5 * (new[one] + new[other]))
        around.append(set())
        for number in sorted(around[one] & around[other]):
            corners = cells.pop(number)
            for corner in corners:
                around[corner].discard(number)
            for gone in (one, other):
                added = next(numbers)
                cells[added] = [middle if corner == gone else corner for corner in corners]
                for corner in cells[added]:
                    around[corner].add(added)
    return np.array(new), np.array(list(cells.values()))


def _inner_edges(
    points: Float[np.ndarray, "vertices 3"], tetrahedra: Int[np.ndarray, "cells 4"], skin: Remeshed
) -> list[tuple[int, int]]:
    """Edges inside the body, opposite to the common edge of two smooth facets of one part."""
    corners = points[skin.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    facets = {frozenset(corners): k for k, corners in enumerate(skin.triangles.tolist())}
    sides = np.sort(np.stack([skin.triangles, np.roll(skin.triangles, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    outer = set(map(tuple, sides.tolist()))
    edges = set()
    for cell in tetrahedra.tolist():
        exposed = [(p, facets[f]) for p in sorted(cell) if (f := frozenset(cell) - {p}) in facets]
        for (one, first), (other, second) in combinations(exposed, 2):
            smooth = skin.parts[first] == skin.parts[second] and normals[first] @ normals[second] > SMOOTH
            if smooth and (one, other) not in outer:
                edges.add((one, other))
    return sorted(edges)
