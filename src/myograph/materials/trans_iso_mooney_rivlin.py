r"""Transversely isotropic Mooney–Rivlin, as FEBio has it: fibres that stiffen exponentially, then are straight.

    W = C1 (I1bar - 3) + C2 (I2bar - 3) + F(l) + K/2 (ln J)² + activation active_stress (I4 - 1) / 2,   l = sqrt(I4bar)
    l dF/dl = C3 (exp(C4 (l - 1)) - 1) for 1 < l < l_m,   C5 l + C6 beyond,   0 for l < 1

C6 follows: the stress is continuous at l_m.

Convention: l dF/dl is the stress of the fibres per present area; `active_stress` is a second Piola–Kirchhoff stress
(see `contraction`), without a force–length curve. In print everything is isochoric; with isochoric_fibre = false l is
sqrt(I4).
Traps: an isochoric fibre of stress σ presses on the volume by σ / 3, which changes it by σ / (3 K) and drowns a soft
matrix: Newton's method fails in a whole muscle, so that arms want isochoric_fibre = false. The stress
sets in at l = 1 with the slope C3 C4 at once.
Source: Weiss, Maker, Govindjee 1996 (Computer Methods in Applied Mechanics and Engineering 135); FEBio user manual.
"""

from typing import Annotated, Literal

from pydantic import Field, model_validator

from myograph.materials.contraction import contraction_energy
from myograph.materials.functions import Functions, Scalar
from myograph.materials.invariants import Invariants, fibre_stretch
from myograph.materials.law import Law, NonNegative, Positive, require_bulk
from myograph.materials.mooney_rivlin import mooney_rivlin_energy
from myograph.materials.toe import ExponentialToe


class TransIsoMooneyRivlin(Law):
    """Stresses C1, C2, C3, C5, K, active_stress [MPa]; C4, l_m [-]."""

    law: Literal["trans_iso_mooney_rivlin"] = "trans_iso_mooney_rivlin"
    C1: Positive
    C2: NonNegative
    C3: NonNegative
    C4: Positive
    C5: NonNegative
    l_m: Annotated[float, Field(gt=1)]
    K: Positive
    active_stress: NonNegative = 0.0
    isochoric_fibre: bool = True

    @model_validator(mode="after")
    def _keeps_its_volume(self) -> "TransIsoMooneyRivlin":
        require_bulk("K", self.K, self.shear_modulus)
        return self

    @property
    def shear_modulus(self) -> float:
        """2 (C1 + C2) of the matrix [MPa]."""
        return 2 * (self.C1 + self.C2)

    @property
    def bulk_modulus(self) -> float:
        """K [MPa]."""
        return self.K

    def volume_strain(self, J: Scalar, f: Functions) -> Scalar:
        """ln J [-]."""
        return f.log(J)

    def matrix(self, at: Invariants, f: Functions) -> Scalar:
        """Isochoric Mooney–Rivlin [MPa]."""
        return mooney_rivlin_energy(self.C1, self.C2, at.isochoric())

    def passive_fibre(self, at: Invariants, f: Functions) -> Scalar:
        """Antiderivative of the stress over l [MPa]."""
        toe = ExponentialToe(self.C3, self.C4, self.l_m, self.C5)
        return toe.energy(fibre_stretch(at, self.isochoric_fibre, f), f)

    def active(self, at: Invariants, f: Functions) -> Scalar:
        """Prescribed contraction along the fibre [MPa]."""
        return contraction_energy("fibre", self.active_stress, at)
