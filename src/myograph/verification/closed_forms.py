r"""Homogeneous states and inflated shells of an incompressible Mooney–Rivlin body, which have closed forms.

    W = c1 (I1 - 3) + c2 (I2 - 3)
    uniaxial       σ = 2 (l² - 1/l) (c1 + c2/l)
    equibiaxial    σ = 2 (l² - 1/l⁴) (c1 + c2 l²)
    pure shear     σ = 2 (l² - 1/l²) (c1 + c2)
    active block   μ (l - 1/l²) + T l = 0  with  S_active = T a0 ⊗ a0 and neo-Hooke, μ = 2 c1
    sphere         r³ = R³ + a³ - A³,  π = ∫ Ŵ'(λ) / (λ³ - 1) dλ,  λ = r/R from the outer to the inner face
    cylinder       r² = R² + a² - A²,  π = ∫ Ŵ'(λ) / (λ² - 1) dλ,  plane strain

Finite elements need a finite bulk modulus: at 1e7 times c1 its share of the stress is 1e-6 of the result or less.
Source: Ogden, Non-linear Elastic Deformations (1984), chapters 4 and 5.
"""

from math import sqrt

from myograph.materials.mooney_rivlin import MooneyRivlin
from myograph.mechanics.specimen import Box, Load, Specimen, ThickCylinder, ThickSphere, solve
from myograph.verification.check import Check

RUBBER = MooneyRivlin(c1=1.0, c2=0.5, K=1e8)
"""Incompressible for every purpose of the homogeneous states; [MPa]."""
SHELL = MooneyRivlin(c1=1.0, c2=0.5, K=1e7)
MUSCLE = MooneyRivlin(c1=0.5, K=1e8, contraction="fibre", active_stress=0.5)
STRETCH = 1.3

_SPHERE_PRESSURE, _CYLINDER_PRESSURE = 2.7262675505, 1.2846852273
_INNER, _OUTER, _INFLATED = 1.0, 2.0, 1.5
_SOURCE = "closed form, incompressible"


def uniaxial(law: MooneyRivlin = RUBBER) -> float:
    """Cauchy stress [MPa] along a bar that is stretched."""
    return _stress(law, {"x_max": (STRETCH - 1, None, None)})


def equibiaxial(law: MooneyRivlin = RUBBER) -> float:
    """Cauchy stress [MPa] in a sheet stretched along both edges."""
    return _stress(law, {"x_max": (STRETCH - 1, None, None), "y_max": (None, STRETCH - 1, None)})


def pure_shear(law: MooneyRivlin = RUBBER) -> float:
    """Cauchy stress [MPa] along a sheet that is stretched and keeps its width."""
    return _stress(law, {"x_max": (STRETCH - 1, None, None), "y_max": (None, 0.0, None)})


def active_block(law: MooneyRivlin = MUSCLE) -> float:
    """Stretch along the fibres [-] of a free block at full activation."""
    return float(solve(Specimen(Box(), law), Load(activation=1.0)).mean_stretches[0])


def thick_sphere(law: MooneyRivlin = SHELL) -> float:
    """Inner radius [mm] of a hollow sphere under the closed form's pressure, which takes it from 1 to 1.5."""
    sphere = Specimen(ThickSphere(_INNER, _OUTER, cells=(3, 3)), law)
    state = solve(sphere, Load(pressure={"inner": _SPHERE_PRESSURE}), steps=2)
    corner = _INNER / sqrt(3)
    return sqrt(3) * (corner + float(state.displacement_at((corner, corner, corner)).mean()))


def thick_cylinder(law: MooneyRivlin = SHELL) -> float:
    """Inner radius [mm] of a tube in plane strain under the closed form's pressure, which takes it from 1 to 1.5."""
    symmetry = ("x_min", "y_min", "z_min", "z_max")
    tube = Specimen(ThickCylinder(_INNER, _OUTER, cells=(4, 4, 1)), law, symmetry=symmetry)
    state = solve(tube, Load(pressure={"inner": _CYLINDER_PRESSURE}), steps=2)
    return _INNER + float(state.displacement_at((_INNER, 0.0, 0.0))[0])


def _stress(law: MooneyRivlin, displacement: dict[str, tuple[float | None, float | None, float | None]]) -> float:
    state = solve(Specimen(Box(), law), Load(displacement=displacement))
    return float(state.mean_stress[0, 0])


CHECKS = (
    Check("closed_form.uniaxial", "Cauchy stress [MPa]", uniaxial, 2.5498224852, _SOURCE, 1e-6),
    Check("closed_form.equibiaxial", "Cauchy stress [MPa]", equibiaxial, 4.9441284304, _SOURCE, 1e-6),
    Check("closed_form.pure_shear", "Cauchy stress [MPa]", pure_shear, 3.2948520710, _SOURCE, 1e-6),
    Check("closed_form.active_block", "fibre stretch [-]", active_block, (1.0 / 1.5) ** (1 / 3), _SOURCE, 1e-6),
    Check("closed_form.thick_sphere", "inner radius [mm]", thick_sphere, _INFLATED, _SOURCE, 5e-4),
    Check("closed_form.thick_cylinder", "inner radius [mm]", thick_cylinder, _INFLATED, _SOURCE, 1e-4),
)
