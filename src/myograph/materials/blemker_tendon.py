r"""Tendon of Blemker and others, as FEBio's "tendon material" has it.

    W = G1 B1² + G2 B2² + F(l) + K/2 (ln J)²,    l = sqrt(I4bar)     (B1, B2: see along_and_cross)
    l dF/dl = L1 (exp(L2 (l - 1)) - 1) for l > 1, linear with the same slope from l = l_star on, 0 for l < 1

Convention: cauchy, l dF/dl is the stress of the fibres per present area. In print everything is isochoric; with
isochoric_fibre = false l is sqrt(I4).
Traps: an isochoric fibre of stress σ presses on the volume by σ / 3, which changes it by σ / (3 K) and drowns a soft
matrix: Newton's method fails in a whole muscle, so that arms want isochoric_fibre = false. The stress
sets in at l = 1 with the slope L1 L2 at once (125 MPa for the published set).
Source: Blemker, Pinsky, Delp 2005 (Journal of Biomechanics 38); FEBio user manual.
"""

from math import exp
from typing import Annotated, Literal

from pydantic import Field, model_validator

from myograph.materials.along_and_cross import shear_energy
from myograph.materials.functions import Functions, Scalar
from myograph.materials.invariants import Invariants, fibre_stretch
from myograph.materials.law import Law, NonNegative, Positive, require_bulk
from myograph.materials.toe import ExponentialToe


class BlemkerTendon(Law):
    """Stresses G1, G2, L1, K [MPa]; L2, l_star [-]."""

    law: Literal["blemker_tendon"] = "blemker_tendon"
    G1: Positive
    G2: Positive
    L1: NonNegative
    L2: Positive
    l_star: Annotated[float, Field(gt=1)]
    K: Positive
    isochoric_fibre: bool = True

    @model_validator(mode="after")
    def _keeps_its_volume(self) -> "BlemkerTendon":
        require_bulk("K", self.K, self.shear_modulus)
        return self

    @property
    def shear_modulus(self) -> float:
        """The larger of 2 G1 (along the fibres) and 2 G2 (across them) [MPa]."""
        return 2 * max(self.G1, self.G2)

    @property
    def bulk_modulus(self) -> float:
        """K [MPa]."""
        return self.K

    def volume_strain(self, J: Scalar, f: Functions) -> Scalar:
        """ln J [-]."""
        return f.log(J)

    def matrix(self, at: Invariants, f: Functions) -> Scalar:
        """Shear along and across the fibres [MPa]."""
        return shear_energy(self.G1, self.G2, at, f)

    def passive_fibre(self, at: Invariants, f: Functions) -> Scalar:
        """Antiderivative of the stress over l [MPa]."""
        slope = self.L1 * self.L2 * exp(self.L2 * (self.l_star - 1))
        toe = ExponentialToe(self.L1, self.L2, self.l_star, slope)
        return toe.energy(fibre_stretch(at, self.isochoric_fibre, f), f)
