"""Is a mesh fit for computing? Positive Jacobians everywhere; the worst element is named."""

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError
from myograph.mesh.hexahedra import HexMesh, jacobian_determinants, lattice

SMALLEST_SCALED_JACOBIAN = 0.02


def scaled_jacobians(mesh: HexMesh) -> Float[np.ndarray, " cells"]:
    """Smallest Jacobian determinant of each element at its 27 nodes over the element's mean."""
    determinants = jacobian_determinants(mesh.points, mesh.cells, lattice((-1.0, 0.0, 1.0)))
    return determinants.min(axis=1) / np.abs(determinants).mean(axis=1)


def check_mesh(mesh: HexMesh, name: str) -> None:
    """Raise InputError unless all nodes are finite and every element is well-shaped; name the worst element."""
    if not np.isfinite(mesh.points).all():
        node = int(np.flatnonzero(~np.isfinite(mesh.points).all(axis=1))[0])
        raise InputError(f"mesh of {name}: node {node} has no finite position; check the muscle's path and areas")
    quality = scaled_jacobians(mesh)
    worst = int(np.argmin(quality))
    if quality[worst] < SMALLEST_SCALED_JACOBIAN:
        centre = mesh.points[mesh.cells[worst]].mean(axis=0).round(1).tolist()
        raise InputError(
            f"mesh of {name}: element {worst} at {centre} mm has a scaled Jacobian of {quality[worst]:.3f}, expected at"
            f" least {SMALLEST_SCALED_JACOBIAN}; bend the path less or make the sections there smaller"
        )
