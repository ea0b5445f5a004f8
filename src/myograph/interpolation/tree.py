r"""The tree of grid points: children and parents, dimension by dimension.

A point is a tuple of pairs (level, index). In one dimension the children of (l, i) are (l + 1, 2 i ± 1), those of both
boundary points (0, 0) and (0, 1) is (1, 1), so that (1, 1) has two parents on grids with boundary points and none on
others.
"""

from collections.abc import Iterator
from typing import TypeAlias

import numpy as np

Pair: TypeAlias = tuple[int, int]
Point: TypeAlias = tuple[Pair, ...]


def keys(levels: np.ndarray, indices: np.ndarray) -> dict[Point, None]:
    """The points (points, dimension) as keys, in their order."""
    pairs = np.stack([levels, indices], axis=2).tolist()
    return {tuple((level, index) for level, index in point): None for point in pairs}


def children(point: Point) -> Iterator[Point]:
    """Children in every dimension."""
    for k, (level, index) in enumerate(point):
        below = ((1, 1),) if level == 0 else ((level + 1, 2 * index - 1), (level + 1, 2 * index + 1))
        yield from (_replaced(point, k, pair) for pair in below)


def parents(point: Point, boundary: bool) -> Iterator[Point]:
    """Parents in every dimension; `boundary` says whether level 1 has parents."""
    for k, (level, index) in enumerate(point):
        above: tuple[Pair, ...] = ()
        if level > 1:
            half = (index + 1) // 2
            above = ((level - 1, half if half % 2 else half - 1),)
        elif level == 1 and boundary:
            above = ((0, 0), (0, 1))
        yield from (_replaced(point, k, pair) for pair in above)


def add_with_ancestors(known: dict[Point, None], point: Point, boundary: bool) -> None:
    """Add a point, its parents, theirs and so on to the known ones, as far as they are missing; parents first."""
    if point in known:
        return
    for parent in parents(point, boundary):
        add_with_ancestors(known, parent, boundary)
    known[point] = None


def _replaced(point: Point, k: int, pair: Pair) -> Point:
    return (*point[:k], pair, *point[k + 1 :])
