r"""Transversely isotropic exponential law of Guccione and others, as the cardiac benchmarks use it.

    W = C/2 (exp(Q) - 1) + activation ψ_active(l) + K/2 (J - 1)²,    E = (Fᵀ F - 1) / 2,  l = sqrt(I4)
    Q = bf Eff² + bt (Ess² + Enn² + 2 Esn²) + bfs (2 Efs² + 2 Efn²)

written in invariants: Eff = (I4 - 1) / 2,  |E f|² = (I5 - 2 I4 + 1) / 4,  tr E² = (I1² - 2 I2 - 2 I1 + 3) / 4, hence
2 Efs² + 2 Efn² = 2 (|E f|² - Eff²) and Ess² + Enn² + 2 Esn² = tr E² - 2 |E f|² + Eff².

Convention: `second_piola` in print, S_active = T_a a0 ⊗ a0, so that dψ_active/dl = T_a l; the two others by name.
Traps: fibre and matrix share one exponential, so that all of it is `matrix`. The strain is not isochoric. The
exponential overflows where a step of Newton's method goes astray: load in steps.
Source: Guccione, McCulloch, Waldman 1991; Land and others 2015 (Proceedings of the Royal Society A 471).
"""

from typing import Literal

from pydantic import model_validator

from myograph.materials.conventions import Convention
from myograph.materials.functions import Functions, Scalar
from myograph.materials.invariants import Invariants
from myograph.materials.law import Law, NonNegative, Positive, require_bulk


class Guccione(Law):
    """Stresses C, T_a, bulk [MPa]; bf, bt, bfs [-]."""

    law: Literal["guccione"] = "guccione"
    C: Positive
    bf: Positive
    bt: Positive
    bfs: Positive
    T_a: NonNegative = 0.0
    convention: Convention = "second_piola"
    bulk: Positive

    @model_validator(mode="after")
    def _keeps_its_volume(self) -> "Guccione":
        require_bulk("bulk", self.bulk, self.shear_modulus)
        return self

    @property
    def shear_modulus(self) -> float:
        """C/2 times the largest exponent [MPa]."""
        return 0.5 * self.C * max(self.bf, self.bt, self.bfs)

    @property
    def bulk_modulus(self) -> float:
        """`bulk` [MPa]."""
        return self.bulk

    def matrix(self, at: Invariants, f: Functions) -> Scalar:
        """C/2 (exp(Q) - 1) [MPa]."""
        along = 0.25 * (at.I4 - 1) * (at.I4 - 1)
        fibre = 0.25 * (at.I5 - 2 * at.I4 + 1)
        whole = 0.25 * (at.I1 * at.I1 - 2 * at.I2 - 2 * at.I1 + 3)
        Q = self.bf * along + self.bt * (whole - 2 * fibre + along) + 2 * self.bfs * (fibre - along)
        return 0.5 * self.C * (f.exp(Q) - 1)

    def active(self, at: Invariants, f: Functions) -> Scalar:
        """Antiderivative of T_a times the convention's power of l [MPa]."""
        if self.convention == "second_piola":
            return 0.5 * self.T_a * (at.I4 - 1)
        return self.T_a * (f.sqrt(at.I4) - 1 if self.convention == "nominal" else 0.5 * f.log(at.I4))
