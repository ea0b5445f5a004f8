r"""Orders of convergence on an inflated tube, whose displacement has a closed form.

    u = (r - R) e_r,   r² = R² + a² - A²,   F = R/r e_r ⊗ e_r + r/R e_θ ⊗ e_θ + e_z ⊗ e_z
    π = ∫ 2 (c1 + c2) (λ² - 1/λ²) / r dr  over the deformed wall,  λ = r/R

With displacements of second order on curved elements the error of u falls as h³, that of F as h² (L2 norms).
"""

from functools import cache
from math import log, sqrt

import numpy as np
from jaxtyping import Float
from scipy.integrate import quad

from myograph.materials.mooney_rivlin import MooneyRivlin
from myograph.mechanics.specimen import Load, Samples, Specimen, ThickCylinder, solve
from myograph.verification.check import Check

LAW = MooneyRivlin(c1=1.0, c2=0.5, K=1e8)
_INNER, _OUTER, _INFLATED = 1.0, 1.5, 1.1
_GROWTH = _INFLATED**2 - _INNER**2
_CELLS = {"hexahedra": (4, 8), "tetrahedra": (4, 6)}


@cache
def errors(element: str, cells: int) -> tuple[float, float]:
    """L2 norms of the errors of displacement [mm] and of deformation gradient [-], over a tube one mm long."""
    length = 1 / cells
    shape = ThickCylinder(_INNER, _OUTER, length, (cells, 2 * cells, 1))
    symmetry = ("x_min", "y_min", "z_min", "z_max")
    tube = Specimen(shape, LAW, symmetry=symmetry, element="hexahedra" if element == "hexahedra" else "tetrahedra")
    samples = solve(tube, Load(pressure={"inner": inflation_pressure()})).samples
    displacement, F = exact(samples.points)
    return (
        _norm(samples, samples.displacement - displacement) / sqrt(length),
        _norm(samples, samples.F - F) / sqrt(length),
    )


def inflation_pressure() -> float:
    """Pressure [MPa] at which the inner radius grows as asked."""

    def integrand(r: float) -> float:
        square = r * r / (r * r - _GROWTH)
        return 2 * (LAW.c1 + LAW.c2) * (square - 1 / square) / r

    return float(quad(integrand, _INFLATED, sqrt(_OUTER**2 + _GROWTH))[0])


def exact(
    points: Float[np.ndarray, "points 3"],
) -> tuple[Float[np.ndarray, "points 3"], Float[np.ndarray, "points 3 3"]]:
    """Displacement [mm] and deformation gradient [-] of the closed form."""
    before = np.hypot(points[:, 0], points[:, 1])
    after = np.sqrt(before**2 + _GROWTH)
    outward = np.column_stack([points[:, 0] / before, points[:, 1] / before, np.zeros_like(before)])
    around = np.column_stack([-outward[:, 1], outward[:, 0], np.zeros_like(before)])
    stretch = (after / before)[:, None, None]
    F = outward[:, :, None] * outward[:, None, :] / stretch + around[:, :, None] * around[:, None, :] * stretch
    F[:, 2, 2] += 1
    return (after - before)[:, None] * outward, F


def order(element: str, quantity: int) -> float:
    """Observed order [-] of the displacement (0) or of the deformation gradient (1) between two meshes."""
    coarse, fine = _CELLS[element]
    return log(errors(element, coarse)[quantity] / errors(element, fine)[quantity]) / log(fine / coarse)


def _norm(samples: Samples, difference: Float[np.ndarray, "points ..."]) -> float:
    return sqrt(float(samples.weights @ (difference.reshape(len(difference), -1) ** 2).sum(axis=1)))


_THEORY = "theory of finite elements"
CHECKS = (
    Check("orders.hexahedra_u", "order of u, Q2–Q1 [-]", lambda: order("hexahedra", 0), 3.0, _THEORY, 0.05),
    Check("orders.hexahedra_F", "order of F, Q2–Q1 [-]", lambda: order("hexahedra", 1), 2.0, _THEORY, 0.05),
    Check("orders.tetrahedra_u", "order of u, P2–P1 [-]", lambda: order("tetrahedra", 0), 3.0, _THEORY, 0.05),
    Check("orders.tetrahedra_F", "order of F, P2–P1 [-]", lambda: order("tetrahedra", 1), 2.0, _THEORY, 0.05),
)
