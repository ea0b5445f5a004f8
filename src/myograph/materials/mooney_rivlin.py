r"""Nearly incompressible Mooney–Rivlin, with FEBio's active contraction.

    W = c1 (I1bar - 3) + c2 (I2bar - 3) + K/2 (ln J)² + activation * contraction

Convention: `active_stress` T is a second Piola–Kirchhoff stress, and the contraction is not made isochoric.
Trap: c1 of this law is half the shear modulus, not the shear modulus.
Source: FEBio user manual, Mooney-Rivlin; test problem ma25.
"""

from typing import Literal

from pydantic import model_validator

from myograph.materials.contraction import Contraction, contraction_energy
from myograph.materials.functions import Functions, Scalar
from myograph.materials.invariants import Invariants
from myograph.materials.law import Law, NonNegative, Positive, require_bulk


class MooneyRivlin(Law):
    """c1, c2, K [MPa]; contraction of the named kind by `active_stress` [MPa]."""

    law: Literal["mooney_rivlin"] = "mooney_rivlin"
    c1: Positive
    c2: NonNegative = 0.0
    K: Positive
    contraction: Contraction = "none"
    active_stress: NonNegative = 0.0

    @model_validator(mode="after")
    def _keeps_its_volume(self) -> "MooneyRivlin":
        require_bulk("K", self.K, self.shear_modulus)
        return self

    @property
    def shear_modulus(self) -> float:
        """2 (c1 + c2) [MPa]."""
        return 2 * (self.c1 + self.c2)

    @property
    def bulk_modulus(self) -> float:
        """K [MPa]."""
        return self.K

    def matrix(self, at: Invariants, f: Functions) -> Scalar:
        """c1 (I1bar - 3) + c2 (I2bar - 3) [MPa]."""
        return mooney_rivlin_energy(self.c1, self.c2, at.isochoric())

    def active(self, at: Invariants, f: Functions) -> Scalar:
        """Prescribed contraction [MPa]."""
        return contraction_energy(self.contraction, self.active_stress, at)

    def volume_strain(self, J: Scalar, f: Functions) -> Scalar:
        """ln J [-]."""
        return f.log(J)


def mooney_rivlin_energy(c1: float, c2: float, at: Invariants) -> Scalar:
    """c1 (I1 - 3) + c2 (I2 - 3) [MPa]."""
    first = c1 * (at.I1 - 3)
    return first + c2 * (at.I2 - 3) if c2 else first
