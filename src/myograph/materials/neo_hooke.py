r"""Compressible neo-Hooke, as FEBio writes it, with FEBio's active contraction.

    W = μ/2 (I1 - 3) - μ ln J + λ/2 (ln J)² + activation * contraction
    σ = (μ (B - 1) + λ ln J 1) / J + active part,   μ = E / (2 (1 + ν)),  λ = E ν / ((1 + ν) (1 - 2 ν))

Convention: `active_stress` T is a second Piola–Kirchhoff stress (see `contraction`).
Trap: λ and ln J make up the volume part, so the pressure of the mixed form is λ ln J, not the mean stress.
Source: FEBio user manual, neo-Hookean and active contraction materials; test problems ma20 and ma24.
"""

from typing import Annotated, Literal

from pydantic import Field

from myograph.materials.contraction import Contraction, contraction_energy
from myograph.materials.functions import Functions, Scalar
from myograph.materials.invariants import Invariants
from myograph.materials.law import Law, NonNegative, Positive


class NeoHooke(Law):
    """Young's modulus E [MPa], Poisson's ratio nu [-]; contraction of the named kind by `active_stress` [MPa]."""

    law: Literal["neo_hooke"] = "neo_hooke"
    E: Positive
    nu: Annotated[float, Field(gt=0, lt=0.5)]
    contraction: Contraction = "none"
    active_stress: NonNegative = 0.0

    @property
    def shear_modulus(self) -> float:
        """μ [MPa]."""
        return self.E / (2 * (1 + self.nu))

    @property
    def bulk_modulus(self) -> float:
        """λ, which multiplies (ln J)² / 2 [MPa]."""
        return self.E * self.nu / ((1 + self.nu) * (1 - 2 * self.nu))

    def matrix(self, at: Invariants, f: Functions) -> Scalar:
        """μ/2 (I1 - 3) - μ ln J [MPa]."""
        return self.shear_modulus * (0.5 * (at.I1 - 3) - f.log(at.J))

    def active(self, at: Invariants, f: Functions) -> Scalar:
        """Prescribed contraction [MPa]."""
        return contraction_energy(self.contraction, self.active_stress, at)

    def volume_strain(self, J: Scalar, f: Functions) -> Scalar:
        """ln J [-]."""
        return f.log(J)
