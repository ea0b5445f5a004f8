"""A surface drawn anew with triangles of wanted sizes, for meshing what somebody drew with needles or too finely.

In turns: edges longer than 4/3 of the wanted length are split, those shorter than 4/5 collapsed, diagonals flipped,
points moved within the surface towards the middle of their neighbours and put back on the old surface. Its creases
and the rims of its parts (origin, insertion) are kept as lines. Source: Botsch and Kobbelt 2004.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from jaxtyping import Float, Int

from myograph.mesh.surface.checks import check_uncut, smallest_angles
from myograph.mesh.surface.closed import neighbours
from myograph.mesh.surface.creases import Creases
from myograph.mesh.surface.drawn import Drawn
from myograph.mesh.surface.intersections import cutting_pairs
from myograph.mesh.surface.patchwork import CREASED, FIT, Patchwork
from myograph.mesh.surface.sizes import Sizes, halved_near

TURNS = 8
_LONG, _SHORT = 4 / 3, 4 / 5
_ATTEMPTS = 4
_OTHER_SIDE = -0.3
"""Cosine between the normals of a point and of where it would be put: it would jump through a thin fin."""


@dataclass(frozen=True)
class Remeshed:
    """New triangles of a surface, and the part that each of them belongs to."""

    points: Float[np.ndarray, "nodes 3"]
    triangles: Int[np.ndarray, "triangles 3"]
    parts: Int[np.ndarray, " triangles"]


def remesh(drawn: Drawn, sizes: Sizes) -> Remeshed:
    """The surface with edges of the wanted lengths [mm]; shorter ones where it would otherwise cut itself.

    Raises InputError where even edges of a sixteenth of the wanted length cut each other.
    """
    for _ in range(_ATTEMPTS):
        result = _attempt(drawn, sizes)
        cut = np.unique(cutting_pairs(result.points, result.triangles))
        if len(cut) == 0:
            return result
        sizes = halved_near(sizes, result.points[result.triangles[cut]].mean(axis=1))
    result = _attempt(drawn, sizes)
    check_uncut(result.points, result.triangles, "remeshed surface")
    return result


def _attempt(drawn: Drawn, sizes: Sizes) -> Remeshed:
    patchwork = Patchwork(drawn.surface.points, drawn.surface.triangles, drawn.parts)
    for _ in range(TURNS):
        _split_long(patchwork, sizes)
        creases = drawn.creases(np.array(patchwork.points), patchwork.part_of_points())
        _collapse_short(patchwork, sizes, creases)
        _flip(patchwork, creases)
        patchwork = _relaxed(patchwork, drawn)
    _tidy(patchwork)
    return Remeshed(*patchwork.arrays())


def _lengths(patchwork: Patchwork, edges: list[tuple[int, int]], sizes: Sizes) -> np.ndarray:
    """Length of each edge over the wanted one."""
    ends = np.array(patchwork.points)[np.array(edges)]
    return np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1) / sizes(ends.mean(axis=1))


def _split_long(patchwork: Patchwork, sizes: Sizes) -> None:
    """Split, the longest first, until no edge is too long; at most a few rounds."""
    for _ in range(TURNS):
        edges = patchwork.edges()
        length = _lengths(patchwork, edges, sizes)
        if length.max() <= _LONG:
            return
        for k in np.argsort(-length)[: int((length > _LONG).sum())]:
            patchwork.split(*edges[k])


def _collapse_short(patchwork: Patchwork, sizes: Sizes, creases: Creases) -> None:
    edges = patchwork.edges()
    length = _lengths(patchwork, edges, sizes)
    wanted = sizes(np.array(patchwork.points))
    for k in np.argsort(length)[: int((length < _SHORT).sum())]:
        for gone, kept in (edges[k], edges[k][::-1]):
            if len(patchwork.beside(gone, kept)) != 2 or patchwork.length(gone, kept) >= _SHORT * wanted[kept]:
                break
            free = creases.rank[gone] == 1 or (
                creases.rank[gone] <= creases.rank[kept] and _follows(patchwork, creases, gone, kept)
            )
            if free and patchwork.collapse(gone, kept, _LONG * float(wanted[kept])):
                break


def _flip(patchwork: Patchwork, creases: Creases) -> None:
    """Flip what is not an edge of a crease and would gain by it."""
    edges, opposite = patchwork.diagonals()
    points, (a, b), (c, d) = np.array(patchwork.points), edges.T, opposite.T
    before = _smallest(points, ((a, b, c), (b, a, d)))
    for k in np.flatnonzero(before < _smallest(points, ((a, d, c), (d, b, c)))):
        one, other = int(a[k]), int(b[k])
        creased = min(creases.rank[one], creases.rank[other]) > 1 and _follows(patchwork, creases, one, other)
        if not creased and len(patchwork.beside(one, other)) == 2:
            patchwork.flip(one, other)


def _smallest(points: np.ndarray, pair: tuple[tuple[np.ndarray, ...], ...]) -> Float[np.ndarray, " edges"]:
    """Smallest angle of each pair of triangles."""
    return np.minimum(*(smallest_angles(points, np.stack(corners, axis=1)) for corners in pair))


def _follows(patchwork: Patchwork, creases: Creases, a: int, b: int) -> bool:
    """True where the edge runs along the crease of its first end; every way leads along a corner."""
    edge = np.subtract(patchwork.points[b], patchwork.points[a])
    return bool(creases.rank[a] == 3 or edge @ creases.across[a] @ edge < 0.3 * (edge @ edge))


def _tidy(patchwork: Patchwork) -> None:
    """Needles drawn together at their shortest edge, or flipped over their longest, even across a crease."""
    for triangle in list(patchwork.triangles):
        corners = patchwork.triangles.get(triangle)
        if corners is None or patchwork.smallest_angle(corners) > FIT:
            continue
        edges = sorted(pairwise((*corners, corners[0])), key=lambda edge: patchwork.length(*edge))
        for a, b in (edges[0], edges[0][::-1], edges[1], edges[1][::-1]):
            if patchwork.absorb(a, b):
                break
        else:
            patchwork.flip(*edges[2], CREASED)


def _relaxed(patchwork: Patchwork, drawn: Drawn) -> Patchwork:
    """Points half-way to the middle of their neighbours along the surface and its creases, those on rims along them."""
    points, triangles, parts = patchwork.arrays()
    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    rim = (parts[:, None] != parts[neighbours(triangles)]).ravel()
    on_rim = np.isin(np.arange(len(points)), start[rim])
    pulls = rim | ~on_rim[start]
    count = np.bincount(start[pulls], minlength=len(points))
    sums = [np.bincount(start[pulls], weights=column, minlength=len(points)) for column in points[end[pulls]].T]
    step = 0.5 * (np.stack(sums, axis=1) / count[:, None] - points)
    part = np.full(len(points), parts.max())
    np.minimum.at(part, triangles.ravel(), np.repeat(parts, 3))
    held = np.where(on_rim[:, None, None], 0.0, drawn.creases(points, part).across)
    moved = points + step - np.einsum("pij,pj->pi", held, step)
    settled = drawn.settled(moved, part, on_rim)
    other_side = (settled.normals * _point_normals(points, triangles)).sum(axis=1) < _OTHER_SIDE
    return Patchwork(np.where(other_side[:, None], points, settled.places), triangles, parts)


def _point_normals(
    points: Float[np.ndarray, "nodes 3"], triangles: Int[np.ndarray, "triangles 3"]
) -> Float[np.ndarray, "nodes 3"]:
    """Outward unit normal at each point: the mean over its triangles, weighted by their areas."""
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    normals = np.zeros_like(points)
    for corner in triangles.T:
        np.add.at(normals, corner, np.cross(b - a, c - a))
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
