"""Straight tetrahedra become quadratic ones whose skin follows the surface that was drawn.

The middle of every edge on the skin moves to the nearest point of its part of that surface, the middle of an edge of
a rim to the nearest point of the rim. Two facets of one element that meet in an edge of the skin become tangent there
and spoil it; the middles of such elements go back, a tenth at a time, until it is well-shaped or straight.
"""

import numpy as np
from jaxtyping import Float, Int

from myograph.mesh.muscle_mesh import FACETS
from myograph.mesh.surface.closed import neighbours
from myograph.mesh.surface.drawn import Drawn
from myograph.mesh.surface.remesh import Remeshed
from myograph.mesh.tetrahedra import EDGES, TET10

_SPOILT = 0.05
"""Scaled Jacobian below which an element's middles go back."""
_BACK, _ROUNDS = 0.9, 25

Facets = dict[str, Int[np.ndarray, "_ 6"]]


def curved(
    points: Float[np.ndarray, "vertices 3"],
    tetrahedra: Int[np.ndarray, "cells 4"],
    skin: Remeshed,
    drawn: Drawn,
) -> tuple[Float[np.ndarray, "nodes 3"], Int[np.ndarray, "cells 10"], Facets]:
    """Nodes, 10-node cells and 6-node facets by part, of tetrahedra whose boundary is the given skin."""
    edges = np.sort(tetrahedra[:, EDGES], axis=2).reshape(-1, 2)
    ends, which = np.unique(edges, axis=0, return_inverse=True)
    cells = np.column_stack([tetrahedra, len(points) + which.reshape(-1, 6)])
    straight = np.vstack([points, points[ends].mean(axis=1)])
    numbers = {(a, b): len(points) + k for k, (a, b) in enumerate(ends.tolist())}
    sides = np.sort(np.stack([skin.triangles, np.roll(skin.triangles, -1, axis=1)], axis=2), axis=2)
    middles = np.array([[numbers[a, b] for a, b in triangle] for triangle in sides.tolist()])
    facets = np.column_stack([skin.triangles, middles])
    target = _on_the_surface(straight, middles, skin, drawn)
    named = {name: facets[skin.parts == part] for part, name in enumerate(FACETS)}
    return _unspoilt(straight, target, cells), cells, named


def _on_the_surface(
    straight: Float[np.ndarray, "nodes 3"], middles: Int[np.ndarray, "triangles 3"], skin: Remeshed, drawn: Drawn
) -> Float[np.ndarray, "nodes 3"]:
    """The nodes with the skin's middles on their part of the drawn surface."""
    target = straight.copy()
    beyond = skin.parts[neighbours(skin.triangles)]
    own = np.broadcast_to(skin.parts[:, None], beyond.shape)
    first = own <= beyond
    numbers, chosen = np.unique(middles[first], return_index=True)
    settled = drawn.settled(straight[numbers], own[first][chosen], (own != beyond)[first][chosen])
    target[numbers] = settled.places
    return target


def _unspoilt(
    straight: Float[np.ndarray, "nodes 3"], target: Float[np.ndarray, "nodes 3"], cells: Int[np.ndarray, "cells 10"]
) -> Float[np.ndarray, "nodes 3"]:
    share, points = np.ones((len(straight), 1)), target
    for left in range(_ROUNDS, -1, -1):
        determinants = TET10.determinants(points, cells, TET10.nodes)
        spoilt = determinants.min(axis=1) < _SPOILT * np.abs(determinants).mean(axis=1)
        if not spoilt.any():
            break
        share[np.unique(cells[spoilt])] *= _BACK if left > 1 else 0.0
        points = straight + share * (target - straight)
    return points
