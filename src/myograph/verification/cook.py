r"""Cook's membrane in finite plane strain, nearly incompressible neo-Hooke.

A tapered panel, clamped on the left, pulled up by a dead shear traction of 6.25 MPa on its right edge; the quantity is
the upward displacement of its upper right corner (48, 60), extrapolated from three meshes.

Trap: the clamped corner (0, 44) is singular, so the displacement does not converge at the order of smooth problems;
the extrapolation takes the order from the three meshes themselves.
Source: a peer's study with F-bar quadrilaterals, G = 80.1938 MPa, K = 40.0942e4 MPa: 6.1414, 6.7463, 6.8242, 6.8589,
6.8731, 6.8914 mm for 4, 10, 15, 20, 25, 30 elements a side, which has not settled in its third digit.
"""

from functools import cache

from myograph.materials.mooney_rivlin import MooneyRivlin
from myograph.mechanics.specimen import Load, Panel, Specimen, solve
from myograph.verification.check import Check

SHEAR_MODULUS, BULK_MODULUS, TRACTION = 80.1938, 40.0942e4, 6.25
CORNERS = ((0.0, 0.0), (48.0, 44.0), (48.0, 60.0), (0.0, 44.0))
REFINEMENT = (4, 8, 16)


@cache
def corner_displacement(cells: int, traction: float = TRACTION) -> float:
    """Upward displacement of the corner (48, 60) [mm], with so many elements a side, under a traction [MPa]."""
    law = MooneyRivlin(c1=SHEAR_MODULUS / 2, K=BULK_MODULUS)
    membrane = Specimen(Panel(CORNERS, cells=(cells, cells)), law, symmetry=("z_min", "z_max"))
    load = Load(displacement={"x_min": (0.0, 0.0, None)}, traction={"x_max": (0.0, traction, 0.0)})
    return float(solve(membrane, load).displacement_at((48.0, 60.0, 0.0))[1])


def extrapolated(refinement: tuple[int, int, int] = REFINEMENT, traction: float = TRACTION) -> float:
    """Limit [mm] of a geometric sequence through three meshes, each of twice as many elements a side (Aitken)."""
    coarse, middle, fine = (corner_displacement(cells, traction) for cells in refinement)
    ratio = (fine - middle) / (middle - coarse)
    return fine + (fine - middle) * ratio / (1 - ratio)


CHECKS = (
    Check("cook.membrane", "displacement of the corner [mm], extrapolated", extrapolated, 6.9, "F-bar study", 0.01),
)
