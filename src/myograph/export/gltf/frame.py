"""From the arm's frame, mm with z up, to that of glTF, metres with Y up: (x, y, z) -> (x, z, -y) / 1000.

It is a rotation and a scale, so that outside stays outside.
"""

import numpy as np
from jaxtyping import Float, Int

METRES = 1e-3
TURN = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])


def turned(vectors: Float[np.ndarray, "*batch 3"]) -> Float[np.ndarray, "*batch 3"]:
    """Directions with Y up."""
    return vectors @ TURN.T


def placed(points: Float[np.ndarray, "*batch 3"], centre: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "*batch 3"]:
    """Points [m] about a centre [mm], with Y up."""
    return METRES * turned(points - centre)


def triangles_of(quads: Int[np.ndarray, "facets 4"]) -> Int[np.ndarray, "triangles 3"]:
    """Two triangles for each quadrilateral; one where it repeats a corner."""
    halves = np.stack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
    a, b, c = halves.T
    return halves[(a != b) & (b != c) & (c != a)]


def normals_of(
    points: Float[np.ndarray, "nodes 3"], triangles: Int[np.ndarray, "triangles 3"]
) -> Float[np.ndarray, "nodes 3"]:
    """Outward unit normals: means over the triangles around each node, weighted by area."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    total = np.zeros_like(points)
    for corner in range(3):
        np.add.at(total, triangles[:, corner], across)
    length = np.linalg.norm(total, axis=1, keepdims=True)
    return np.where(length > 0, total / np.where(length > 0, length, 1.0), [0.0, 1.0, 0.0])
