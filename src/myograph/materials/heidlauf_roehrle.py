r"""The muscle of Heidlauf and Röhrle, as OpenDiHu uses it: power law at rest, a parabola when active.

    W = c1 (I1bar - 3) + c2 (I2bar - 3) + b/d (l^d - 1) - b ln l + activation ψ_active(l) + K/2 (J - 1)²,  l = sqrt(I4)
    S_active = (1 / l) p_max f(l / l_opt) a0 ⊗ a0,   f(x) = -25/4 x² + 25/2 x - 5.25 on [0.6, 1.4], 0 beyond

Convention: `nominal` in print, so that dψ_active/dl = p_max f; the two others may be chosen by name.
Traps: the passive fibre resists shortening, too (b (l^d - 1) / l < 0 for l < 1). The parabola ends with kinks.
Source: Heidlauf and Röhrle 2014 (Frontiers in Physiology 5); Heidlauf and others 2016 for the parameters.
"""

from typing import Literal

from pydantic import model_validator

from myograph.materials.conventions import POWER, Convention
from myograph.materials.functions import Functions, Scalar, clamped
from myograph.materials.invariants import Invariants
from myograph.materials.law import Law, NonNegative, Positive, require_bulk
from myograph.materials.mooney_rivlin import mooney_rivlin_energy

_PARABOLA = (-5.25, 12.5, -6.25)
_ENDS = (0.6, 1.4)


class HeidlaufRoehrle(Law):
    """Stresses c1, c2, b, p_max, bulk [MPa]; d, l_opt [-]."""

    law: Literal["heidlauf_roehrle"] = "heidlauf_roehrle"
    c1: NonNegative
    c2: NonNegative
    b: NonNegative
    d: Positive
    p_max: NonNegative
    l_opt: Positive = 1.2
    convention: Convention = "nominal"
    bulk: Positive

    @model_validator(mode="after")
    def _keeps_its_volume(self) -> "HeidlaufRoehrle":
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
        """b/d (l^d - 1) - b ln l [MPa]."""
        return self.b * ((at.I4 ** (self.d / 2) - 1) / self.d - 0.5 * f.log(at.I4))

    def active(self, at: Invariants, f: Functions) -> Scalar:
        """Antiderivative of p_max f(l / l_opt) times the convention's power of l [MPa]."""
        x = clamped(f.sqrt(at.I4) / self.l_opt, *_ENDS, f)
        power = POWER[self.convention]
        energy = sum((_monomial(x, k + power, f) * c for k, c in enumerate(_PARABOLA)), 0.0)
        return self.p_max * self.l_opt ** (power + 1) * energy


def _monomial(x: Scalar, power: int, f: Functions) -> Scalar:
    """Antiderivative of x^power."""
    return f.log(x) if power == -1 else x ** (power + 1) / (power + 1)
