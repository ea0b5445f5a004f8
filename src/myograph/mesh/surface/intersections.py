"""Do triangles of a surface cut each other?

Two convex bodies are apart where their shadows on some line are apart. For two triangles it is enough to look along
the two normals, the nine products of their edges, and, in a common plane, the normals of the edges in that plane
(separating axes; Gottschalk, Lin, Manocha 1996). Triangles that only touch, as neighbours do, are apart.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

TOUCHING = 1e-6
"""Depth of a cut that still counts as touching, as a share of the diagonal of the surface's bounding box."""
_AT_ONCE = 200_000


def cutting_pairs(
    points: Float[np.ndarray, "nodes 3"], triangles: Int[np.ndarray, "triangles 3"]
) -> Int[np.ndarray, "pairs 2"]:
    """All pairs of triangles that cut each other."""
    corners = points[triangles]
    depth = TOUCHING * float(np.linalg.norm(np.ptp(points, axis=0)))
    near = _near_pairs(corners.min(axis=1), corners.max(axis=1))
    cut = [np.zeros((0, 2), dtype=int)]
    for start in range(0, len(near), _AT_ONCE):
        some = near[start : start + _AT_ONCE]
        cut.append(some[~_apart(corners[some[:, 0]], corners[some[:, 1]], depth)])
    return np.vstack(cut)


def meeting_place(one: Float[np.ndarray, "3 3"], other: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, " 3"]:
    """About where two triangles cut each other: the mean of where the sides of either pass the other."""
    found = []
    for sides, (a, b, c) in ((one, other), (other, one)):
        normal = np.cross(b - a, c - a)
        heights = (sides - a) @ normal
        for k in range(3):
            if heights[k] * heights[k - 1] < 0:
                place = sides[k] + (sides[k - 1] - sides[k]) * heights[k] / (heights[k] - heights[k - 1])
                shares = [np.cross(q - p, place - p) @ normal for p, q in ((a, b), (b, c), (c, a))]
                found += [place] if min(shares) >= 0 else []
    return np.mean(found or [one.mean(axis=0), other.mean(axis=0)], axis=0)


def _near_pairs(low: Float[np.ndarray, "triangles 3"], high: Float[np.ndarray, "triangles 3"]) -> np.ndarray:
    """Pairs of boxes that overlap: swept along the longest direction."""
    axis = int(np.argmax(np.ptp(low, axis=0)))
    order = np.argsort(low[:, axis])
    last = np.searchsorted(low[order, axis], high[order, axis], side="right")
    pairs = []
    for place, one in enumerate(order):
        others = order[place + 1 : last[place]]
        meets = ((low[others] <= high[one]) & (high[others] >= low[one])).all(axis=1)
        pairs.append(np.column_stack([np.full(meets.sum(), one), others[meets]]))
    return np.vstack(pairs)


def _apart(
    one: Float[np.ndarray, "pairs 3 3"], other: Float[np.ndarray, "pairs 3 3"], depth: float
) -> Bool[np.ndarray, " pairs"]:
    """True where some line separates the two triangles."""
    sides, other_sides = one - np.roll(one, 1, axis=1), other - np.roll(other, 1, axis=1)
    normal, other_normal = (_unit(np.cross(s[:, 0], s[:, 1])) for s in (sides, other_sides))
    heights = np.einsum("pa,pka->pk", normal, other - one[:, :1])
    flat = np.abs(heights).max(axis=1) <= depth
    crossed = np.cross(sides[:, :, None], other_sides[:, None]).reshape(-1, 9, 3)
    across = [np.cross(s, n[:, None]) for s, n in ((sides, normal), (other_sides, other_normal))]
    apart = _separated(one, other, np.concatenate(across, axis=1), depth)
    solid = _separated(one, other, np.concatenate([normal[:, None], other_normal[:, None], crossed], axis=1), depth)
    return apart | (solid & ~flat)


def _separated(
    one: Float[np.ndarray, "pairs 3 3"], other: Float[np.ndarray, "pairs 3 3"], lines: np.ndarray, depth: float
) -> Bool[np.ndarray, " pairs"]:
    """True where the shadows on one of the lines overlap by at most `depth`; lines without direction say nothing."""
    lengths = np.linalg.norm(lines, axis=-1)
    lines = _unit(lines)
    shadow, other_shadow = (np.einsum("pla,pka->plk", lines, t) for t in (one, other))
    overlap = np.minimum(shadow.max(axis=2) - other_shadow.min(axis=2), other_shadow.max(axis=2) - shadow.min(axis=2))
    return ((overlap <= depth) & (lengths > 1e-9 * lengths.max())).any(axis=1)


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-300)
