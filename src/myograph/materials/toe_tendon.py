r"""The built-in tendon: no force when slack, quadratic up to the toe's end, linear beyond, in a neo-Hookean matrix.

    W = c1 (I1bar - 3) + ψ(l) + K/2 (J - 1)²,   l = sqrt(I4),  e = l - 1
    ψ' = modulus * { 0 for e <= 0;  e² / (2 toe) up to the toe's end;  e - toe / 2 beyond }

Convention: nominal, P = ψ' F a0 ⊗ a0 / l: force per area of the slack tendon.
Trap: the slope of the force jumps nowhere, but it is zero at e = 0: a tendon at rest resists only by its matrix.
Source: the shape is common in the field (Zajac 1989); a modulus of 300 MPa keeps strains near 3 per cent.
"""

from typing import Literal

from pydantic import model_validator

from myograph.materials.functions import Functions, Scalar
from myograph.materials.invariants import Invariants
from myograph.materials.law import Law, Positive, require_bulk


class ToeTendon(Law):
    """c1, modulus, bulk [MPa]; toe, the strain from which on the force is linear [-]."""

    law: Literal["toe_tendon"] = "toe_tendon"
    c1: Positive
    modulus: Positive
    toe: Positive
    bulk: Positive = 500.0

    @model_validator(mode="after")
    def _keeps_its_volume(self) -> "ToeTendon":
        require_bulk("bulk", self.bulk, self.shear_modulus)
        return self

    @property
    def shear_modulus(self) -> float:
        """2 c1 of the matrix [MPa]."""
        return 2 * self.c1

    @property
    def bulk_modulus(self) -> float:
        """`bulk` [MPa]."""
        return self.bulk

    def matrix(self, at: Invariants, f: Functions) -> Scalar:
        """Isochoric neo-Hooke [MPa]."""
        return self.c1 * (at.isochoric().I1 - 3)

    def passive_fibre(self, at: Invariants, f: Functions) -> Scalar:
        """Antiderivative of the force per area [MPa]."""
        strain = f.sqrt(at.I4) - 1
        quadratic = strain**3 / (6 * self.toe)
        linear = 0.5 * strain * strain - 0.5 * self.toe * strain + self.toe**2 / 6
        return self.modulus * f.where(strain - self.toe, linear, f.where(strain, quadratic, 0.0 * strain))
