"""How large the triangles of a remeshed surface should be: as asked where the body is thick, finer where it is slim.

    h(x) = min(size, P(x) / 6),   P = (area of the surface within R of x) / (2 R),   R = 4 min(t, size)

with t the local thickness. Along a tube or a ribbon P is the perimeter of its section, so that at least six triangles
go around it; on a thick body P / 6 exceeds the size. From place to place h grows by no more than 0.3 a mm.
"""

from collections.abc import Callable

import numpy as np
from jaxtyping import Float
from scipy.spatial import KDTree

from myograph.mesh.surface.closed import ClosedSurface

Sizes = Callable[[Float[np.ndarray, "places 3"]], Float[np.ndarray, " places"]]

AROUND = 6
GROWTH = 0.3
_REACH = 4.0
_OPPOSITE, _UNDER = -0.5, 0.8
"""Cosines: of two normals that look away from each other, and of a direction that runs straight into the body."""
_MOST_SITES = 4000
_NEAR = 9


def element_sizes(surface: ClosedSurface, size: float) -> Sizes:
    """Function that tells the wanted length of edges [mm] near given places of the surface."""
    corners = surface.points[surface.triangles]
    middles = corners.mean(axis=1)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    sites = np.arange(0, len(middles), 1 + len(middles) // _MOST_SITES)
    reach = _REACH * np.minimum(_thickness(middles, normals / areas[:, None], sites), size)
    tree = KDTree(middles)
    around = np.array([0.5 * areas[near].sum() for near in tree.query_ball_point(middles[sites], reach)])
    wanted = np.minimum(size, around / (2 * reach) / AROUND)
    wanted = np.array([(wanted + GROWTH * np.linalg.norm(middles[sites] - x, axis=1)).min() for x in middles[sites]])
    near = KDTree(middles[sites])
    return lambda places: wanted[near.query(places)[1]]


def halved_near(sizes: Sizes, sites: Float[np.ndarray, "sites 3"]) -> Sizes:
    """The same lengths, but half as large at the given places, growing back with the distance from them."""
    half, near = 0.5 * sizes(sites), KDTree(sites)

    def limited(places: Float[np.ndarray, "places 3"]) -> Float[np.ndarray, " places"]:
        distance, nearest = near.query(places)
        return np.minimum(sizes(places), half[nearest] + GROWTH * distance)

    return limited


def _thickness(
    middles: Float[np.ndarray, "triangles 3"], normals: Float[np.ndarray, "triangles 3"], sites: np.ndarray
) -> Float[np.ndarray, " sites"]:
    """Distance [mm] from the sites straight through the body to the other side: the median over near sites."""
    found = np.empty(len(sites))
    for row, site in enumerate(sites):
        apart = middles - middles[site]
        distance = np.linalg.norm(apart, axis=1)
        beyond = (apart @ -normals[site] > _UNDER * distance) & (normals @ normals[site] < _OPPOSITE)
        found[row] = np.min(distance[beyond], initial=np.inf)
    near = KDTree(middles[sites]).query(middles[sites], min(_NEAR, len(sites)))[1]
    return np.median(found[near], axis=1)
