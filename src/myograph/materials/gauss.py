r"""The built-in muscle: a power law at rest, a Gauss bell when active, in an isochoric Mooney–Rivlin matrix.

    W = c1 (I1bar - 3) + c2 (I2bar - 3) + ψ_passive(l) + activation ψ_active(l) + K/2 (J - 1)²,   l = sqrt(I4)
    ψ_passive' = passive_stress (pos(l - 1)^n - knee_drop pos(l - 1 - knee_strain)),  pos(e) = (e + sqrt(e² + toe²)) / 2
    ψ_active'  = peak_stress exp(-(x / w)²),    x = l / optimal_stretch - 1,  w its own on either side of the optimum

Convention: nominal, P = ψ' F a0 ⊗ a0 / l: stresses are forces per area of the unstretched belly, and l is measured from
the unstretched fibre.
Trap: pos is never zero, so that a fibre is never quite slack and Newton's method never chatters; the price is a
passive stress of passive_stress (toe / 2)^n at l = 1. And a stretched muscle must not soften: where the bell falls
faster than the passive stress rises, Newton's method needs hundreds of steps.
Source: shape of the bell from Heidlauf and others; of the rest, fitted to the forces of Valentin 2019.
"""

from math import pi, sqrt
from typing import Annotated, Literal

from pydantic import Field, model_validator

from myograph.materials.functions import Functions, Scalar, positive
from myograph.materials.invariants import Invariants
from myograph.materials.law import Law, NonNegative, Positive, require_bulk
from myograph.materials.mooney_rivlin import mooney_rivlin_energy


class Gauss(Law):
    """Stresses c1, c2, bulk, passive_stress, peak_stress [MPa]; everything else is a stretch or a share of one [-]."""

    law: Literal["gauss"] = "gauss"
    c1: Positive
    c2: NonNegative
    bulk: Positive
    passive_stress: NonNegative
    passive_exponent: Annotated[float, Field(ge=1)]
    toe: Positive
    knee_strain: Positive = 1.0
    knee_drop: Annotated[float, Field(ge=0, le=1)] = 0.0
    peak_stress: NonNegative
    optimal_stretch: Positive
    width_ascending: Positive
    width_descending: Positive

    @model_validator(mode="after")
    def _keeps_its_volume(self) -> "Gauss":
        require_bulk("bulk", self.bulk, self.shear_modulus)
        return self

    @property
    def shear_modulus(self) -> float:
        """2 (c1 + c2) of the matrix [MPa]."""
        return 2 * (self.c1 + self.c2)

    @property
    def bulk_modulus(self) -> float:
        """`bulk` [MPa]."""
        return self.bulk

    def matrix(self, at: Invariants, f: Functions) -> Scalar:
        """Isochoric Mooney–Rivlin [MPa]."""
        return mooney_rivlin_energy(self.c1, self.c2, at.isochoric())

    def passive_fibre(self, at: Invariants, f: Functions) -> Scalar:
        """Antiderivative of passive_stress (pos(l - 1)^n - knee_drop pos(l - 1 - knee_strain)) [MPa]."""
        strain = f.sqrt(at.I4) - 1
        rising = self._power(strain, self.passive_exponent, f)
        if self.knee_drop:
            rising = rising - self.knee_drop * self._power(strain - self.knee_strain, 1.0, f)
        return self.passive_stress * rising

    def _power(self, strain: Scalar, n: float, f: Functions) -> Scalar:
        """Antiderivative of q^n with q = pos(strain): q^(n+1)/(n+1) + toe²/4 q^(n-1)/(n-1), a logarithm where n = 1."""
        q = positive(strain, self.toe, f)
        tail = f.log(q) if n == 1 else q ** (n - 1) / (n - 1)
        return q ** (n + 1) / (n + 1) + 0.25 * self.toe**2 * tail

    def active(self, at: Invariants, f: Functions) -> Scalar:
        """Antiderivative of the bell, which is the error function [MPa]."""
        x = f.sqrt(at.I4) / self.optimal_stretch - 1
        bell = f.where(x, _bell(x, self.width_descending, f), _bell(x, self.width_ascending, f))
        return self.peak_stress * self.optimal_stretch * bell


def _bell(x: Scalar, width: float, f: Functions) -> Scalar:
    return 0.5 * sqrt(pi) * width * f.erf(x / width)
