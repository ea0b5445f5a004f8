"""Does a triangulated surface bound one body, and are its triangles fit to be meshed?

Every mistake is an InputError that names the place and says what to do about it.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from myograph.errors import InputError
from myograph.mesh.surface.intersections import cutting_pairs, meeting_place

SMALLEST_ANGLE = np.radians(0.5)
"""Of a triangle; thinner ones are needles whose normal is a matter of rounding."""

Points = Float[np.ndarray, "nodes 3"]
Triangles = Int[np.ndarray, "triangles 3"]


def check_closed(points: Points, triangles: Triangles, name: str) -> None:
    """Raise InputError unless every edge has one triangle on either side and all triangles form one shell."""
    _check_corners(points, triangles, name)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    ends, which, count = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    if (count == 1).any():
        raise InputError(
            f"{name}: open: {int((count == 1).sum())} edges have a triangle on one side only, the first"
            f" {_edge(points, ends[count == 1][0])}; expected a closed surface: fill its holes in a mesh editor"
        )
    if (count > 2).any():
        raise InputError(
            f"{name}: {int((count > 2).sum())} edges belong to more than two triangles, the first"
            f" {_edge(points, ends[count > 2][0])}; expected two: delete the faces inside the body, or separate bodies"
            " that touch"
        )
    directed, times = np.unique(edges, axis=0, return_counts=True)
    if (times > 1).any():
        first, second = np.flatnonzero((edges == directed[times > 1][0]).all(axis=1)) % len(triangles)
        raise InputError(
            f"{name}: triangles {first} and {second} at their common edge {_edge(points, directed[times > 1][0])}"
            " disagree about which side is outside; expected one orientation: make the normals consistent"
        )
    _check_shells(points, triangles, np.argsort(which, kind="stable").reshape(-1, 2), name)


def check_shapes(points: Points, triangles: Triangles, name: str) -> None:
    """Raise InputError where a triangle has no area or a tiny angle; name the worst."""
    angles = smallest_angles(points, triangles)
    worst = int(np.argmin(angles))
    if angles[worst] < SMALLEST_ANGLE:
        raise InputError(
            f"{name}: triangle {worst} at {_place(points[triangles[worst]])} mm is a needle: its smallest angle is"
            f" {np.degrees(angles[worst]):.2g} degrees, expected at least {np.degrees(SMALLEST_ANGLE):g}; remesh the"
            " surface, or merge the points of its short edge"
        )


def check_uncut(points: Points, triangles: Triangles, name: str) -> None:
    """Raise InputError where two triangles cut each other; name both."""
    pairs = cutting_pairs(points, triangles)
    if len(pairs):
        pair = pairs[0].tolist()
        shared = meeting_place(*points[triangles[pair]])
        raise InputError(
            f"{name}: triangles {pair[0]} and {pair[1]} cut each other near {_place(shared[None])} mm; expected a"
            " surface that does not meet itself: pull the two parts apart or unite them in a mesh editor"
        )


def smallest_angles(points: Points, triangles: Triangles) -> Float[np.ndarray, " triangles"]:
    """Smallest angle of each triangle [rad]; 0 where it has no area."""
    corners = points[triangles]
    angles = []
    for k in range(3):
        one, other = corners[:, k - 1] - corners[:, k], corners[:, k - 2] - corners[:, k]
        angles.append(np.arctan2(np.linalg.norm(np.cross(one, other), axis=1), (one * other).sum(axis=1)))
    return np.min(angles, axis=0)


def _check_corners(points: Points, triangles: Triangles, name: str) -> None:
    doubled = (triangles == np.roll(triangles, 1, axis=1)).any(axis=1)
    if doubled.any():
        first = int(np.flatnonzero(doubled)[0])
        raise InputError(
            f"{name}: {int(doubled.sum())} triangles have no area because two corners are one point, the first is"
            f" {first} at {_place(points[triangles[first]])} mm; remove them: merge double points in a mesh editor"
        )


def _check_shells(points: Points, triangles: Triangles, twins: Int[np.ndarray, "edges 2"], name: str) -> None:
    """`twins` holds, for each edge, its two places in the list of all triangles' first, second, third edges."""
    number = len(triangles)
    one, other = twins.T % number
    shells, shell = connected_components(_graph(one, other, number), directed=False)
    if shells > 1:
        sizes = np.sort(np.bincount(shell))[::-1][:5].tolist()
        loose = int(np.flatnonzero(shell == np.argmin(np.bincount(shell)))[0])
        raise InputError(
            f"{name}: {shells} separate shells (of {', '.join(map(str, sizes))} triangles), the smallest at"
            f" {_place(points[triangles[loose]])} mm; expected one: delete what lies inside or apart"
        )
    corner = np.arange(3 * number).reshape(3, number)
    start, end = corner.ravel(), np.roll(corner, -1, axis=0).ravel()
    forward, back = twins.T
    same = _graph(np.concatenate([start[forward], end[forward]]), np.concatenate([end[back], start[back]]), 3 * number)
    fans, fan = connected_components(same, directed=False)
    if fans > len(np.unique(triangles)):
        vertices = triangles.T.ravel()[np.unique(fan, return_index=True)[1]]
        pinched = int(np.flatnonzero(np.bincount(vertices) > 1)[0])
        raise InputError(
            f"{name}: two parts touch in the single point {_place(points[[pinched]])} mm; expected a surface without"
            " pinches: pull the two parts apart or unite them in a mesh editor"
        )


def _graph(one: np.ndarray, other: np.ndarray, size: int) -> coo_array:
    return coo_array((np.ones(len(one)), (one, other)), shape=(size, size))


def _edge(points: Points, ends: np.ndarray) -> str:
    return f"from {_place(points[ends[:1]])} to {_place(points[ends[1:]])} mm"


def _place(corners: Float[np.ndarray, "corners 3"]) -> str:
    return "(" + ", ".join(f"{x:.2f}" for x in corners.mean(axis=0)) + ")"
