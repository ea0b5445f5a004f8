r"""Muscle of Blemker and others, as FEBio's "muscle material" has it.

    W = G1 B1² + G2 B2² + F(l) + K/2 (ln J)²,    l = sqrt(I4bar),  x = l / L_ofl     (B1, B2: see along_and_cross)
    dF/dl = sigma_max (f_passive(x) + activation f_active(x)) / L_ofl
    f_passive = P1 (exp(P2 (x - 1)) - 1) for x > 1, linear with the same slope from l = l_star on
    f_active  = 9 (x - 0.4)² to 0.6,  1 - 4 (1 - x)² to 1.4,  9 (x - 1.6)² to 1.6, 0 beyond

Convention: nominal, and divided by L_ofl: the largest force per reference area is sigma_max / L_ofl. In print all is
isochoric, the fibre too; with isochoric_fibre = false l is sqrt(I4).
Traps: an isochoric fibre of stress σ presses on the volume by σ / 3, which changes it by σ / (3 K) and drowns a soft
matrix: Newton's method fails in a whole muscle, so that arms want isochoric_fibre = false. l_star is a stretch, not a
share of L_ofl. The slope of f_active jumps from 3.6 to 3.2 at x = 0.6, and that of f_passive from 0 to P1 P2 at x = 1.
Source: Blemker, Pinsky, Delp 2005 (Journal of Biomechanics 38); FEBio user manual; FEBio test problem mu03.
"""

from math import exp
from typing import Literal

from pydantic import model_validator

from myograph.materials.along_and_cross import shear_energy
from myograph.materials.functions import Functions, Scalar, clamped
from myograph.materials.invariants import Invariants, fibre_stretch
from myograph.materials.law import Law, NonNegative, Positive, require_bulk


class Blemker(Law):
    """Stresses G1, G2, sigma_max, K [MPa]; P1, P2, L_ofl, l_star [-]."""

    law: Literal["blemker"] = "blemker"
    G1: Positive
    G2: Positive
    P1: NonNegative
    P2: Positive
    L_ofl: Positive
    l_star: Positive
    sigma_max: NonNegative
    K: Positive
    isochoric_fibre: bool = True

    @model_validator(mode="after")
    def _fits_together(self) -> "Blemker":
        require_bulk("K", self.K, self.shear_modulus)
        if self.l_star <= self.L_ofl:
            raise ValueError(
                f"l_star: expected a stretch beyond L_ofl = {self.L_ofl:g}, where the passive force becomes linear;"
                f" got {self.l_star:g}"
            )
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
        """sigma_max times the antiderivative of f_passive over x [MPa]."""
        x, end = fibre_stretch(at, self.isochoric_fibre, f) / self.L_ofl, self.l_star / self.L_ofl
        curved, beyond = clamped(x, 1.0, end, f) - 1, f.where(x - end, x - end, 0.0)
        growth = exp(self.P2 * (end - 1))
        energy = self.P1 * ((f.exp(self.P2 * curved) - 1) / self.P2 - curved)
        linear = self.P1 * ((growth - 1) * beyond + 0.5 * self.P2 * growth * beyond * beyond)
        return self.sigma_max * (energy + linear)

    def active(self, at: Invariants, f: Functions) -> Scalar:
        """sigma_max times the antiderivative of f_active over x [MPa]."""
        x = fibre_stretch(at, self.isochoric_fibre, f) / self.L_ofl
        low, middle, high = (clamped(x, a, b, f) for a, b in ((0.4, 0.6), (0.6, 1.4), (1.4, 1.6)))
        energy = 3 * (low - 0.4) ** 3 + middle - 0.6 + 4 / 3 * ((1 - middle) ** 3 - 0.4**3)
        return self.sigma_max * (energy + 3 * (high - 1.6) ** 3 + 3 * 0.2**3)
