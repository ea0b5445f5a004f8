"""Is a mesh fit for computing? Positive Jacobians everywhere, no needles; the worst element is named.

Two measures of an element. Scaled Jacobian: its smallest Jacobian determinant at its nodes over the mean one; 1 for
a parallelepiped or a straight tetrahedron, negative where it is turned inside out. Mean ratio: 12 (3 V)^(2/3) / Σ l²
over the six edges of a tetrahedron; 1 where it is regular, 0 where it is flat or a needle. A hexahedron may be long:
its mean ratio counts as 1.
"""

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError
from myograph.mesh.muscle_mesh import MuscleMesh
from myograph.mesh.tetrahedra import EDGES, TET10

SMALLEST_SCALED_JACOBIAN = 0.02
SMALLEST_MEAN_RATIO = 0.02


def scaled_jacobians(mesh: MuscleMesh) -> Float[np.ndarray, " cells"]:
    """Smallest Jacobian determinant of each element at its nodes over the element's mean."""
    determinants = mesh.element.determinants(mesh.points, mesh.cells, mesh.element.nodes)
    return determinants.min(axis=1) / np.abs(determinants).mean(axis=1)


def mean_ratios(mesh: MuscleMesh) -> Float[np.ndarray, " cells"]:
    """Shape of each tetrahedron's corners, from 0 (flat) to 1 (regular); 1 for hexahedra."""
    if mesh.element.kind != TET10.kind:
        return np.ones(len(mesh.cells))
    corners = mesh.points[mesh.cells[:, :4]]
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
    squares = sum(((corners[:, a] - corners[:, b]) ** 2).sum(axis=1) for a, b in EDGES)
    return 12 * (3 * volumes) ** (2 / 3) / squares


def check_mesh(mesh: MuscleMesh, name: str) -> None:
    """Raise InputError unless all nodes are finite and every element is well-shaped; name the worst element."""
    if not np.isfinite(mesh.points).all():
        node = int(np.flatnonzero(~np.isfinite(mesh.points).all(axis=1))[0])
        raise InputError(f"mesh of {name}: node {node} has no finite position; check the muscle's path and areas")
    if mesh.element.kind == TET10.kind:
        advice = "choose another element size, or smooth the surface there"
    else:
        advice = "bend the path less or make the sections there smaller"
    _require(mesh, name, ("a scaled Jacobian", scaled_jacobians(mesh), SMALLEST_SCALED_JACOBIAN), advice)
    _require(mesh, name, ("a mean ratio", mean_ratios(mesh), SMALLEST_MEAN_RATIO), advice)


def _require(mesh: MuscleMesh, name: str, measure: tuple[str, Float[np.ndarray, " cells"], float], advice: str) -> None:
    """Raise InputError where a measure (its name, its values, the smallest that is allowed) falls short."""
    words, quality, smallest = measure
    worst = int(np.argmin(np.nan_to_num(quality, nan=-np.inf)))
    if not quality[worst] >= smallest:
        centre = mesh.points[mesh.cells[worst]].mean(axis=0).round(1).tolist()
        raise InputError(
            f"mesh of {name}: element {worst} at {centre} mm has {words} of {quality[worst]:.3f}, expected at"
            f" least {smallest}; {advice}"
        )
