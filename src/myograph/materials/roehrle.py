r"""The muscle and tendon of Röhrle and others (Stuttgart): power law at rest, skewed bell when active.

    W = c1 (I1bar - 3) + c2 (I2bar - 3) + ψ_passive(l) + activation ψ_active(l) + K/2 (J - 1)²,   l = sqrt(I4)
    S_passive = (c3 / l²) (l^c4 - 1) a0 ⊗ a0 for l >= 1, else 0
    S_active  = (sigma_max / l²) f(l) a0 ⊗ a0,   f = exp(-|(l / l_opt - 1) / width|^power)

with a width and a power of its own on either side of l_opt. A tendon is the same law with sigma_max = 0.

Convention: `cauchy` in print, so that dψ_active/dl = sigma_max f / l; the two others may be chosen by name.
Trap: for a tendon c3 c4 is over 100 MPa and sets in at l = 1 at once: with coarse steps Newton chatters there.
Source: Röhrle, Sprenger, Schmitt 2017 (Biomechanics and Modeling in Mechanobiology 16).
"""

from functools import cache
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from myograph.materials.conventions import POWER, Convention
from myograph.materials.functions import Functions, Scalar
from myograph.materials.invariants import Invariants
from myograph.materials.law import Law, NonNegative, Positive, require_bulk
from myograph.materials.mooney_rivlin import mooney_rivlin_energy
from myograph.materials.primitive import Piece, evaluated, primitive

Side = tuple[float, float]
Exponent = Annotated[float, Field(ge=2)]

_VANISHED = 23.0
"""exp(-23) = 1e-10: the bell ends there."""
_SHORTEST = 0.2
"""Share of l_opt under which no fibre is active."""


class Roehrle(Law):
    """Stresses c1, c2, c3, sigma_max, bulk [MPa]; c4, l_opt, widths and powers of the bell [-]."""

    law: Literal["roehrle"] = "roehrle"
    c1: Positive
    c2: NonNegative
    c3: NonNegative
    c4: Positive
    sigma_max: NonNegative
    l_opt: Positive = 1.35
    width_ascending: Positive = 0.25
    power_ascending: Exponent = 3.0
    width_descending: Positive = 0.15
    power_descending: Exponent = 4.0
    convention: Convention = "cauchy"
    bulk: Positive

    @model_validator(mode="after")
    def _keeps_its_volume(self) -> "Roehrle":
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
        """c3 ((l^c4 - 1) / c4 - ln l) for l > 1 [MPa]."""
        energy = (at.I4 ** (self.c4 / 2) - 1) / self.c4 - 0.5 * f.log(at.I4)
        return self.c3 * f.where(at.I4 - 1, energy, 0.0 * at.I4)

    def active(self, at: Invariants, f: Functions) -> Scalar:
        """Antiderivative of sigma_max f(l) times the convention's power of l [MPa]."""
        ascending = self.width_ascending, self.power_ascending
        descending = self.width_descending, self.power_descending
        pieces = _pieces(self.l_opt, ascending, descending, POWER[self.convention])
        return self.sigma_max * evaluated(pieces, f.sqrt(at.I4), f)


@cache
def _pieces(l_opt: float, ascending: Side, descending: Side, power: int) -> tuple[Piece, ...]:
    """Antiderivative of the bell times a power of l; a side is its width and its power."""

    def slope(stretch: np.ndarray) -> np.ndarray:
        x = stretch / l_opt - 1
        below, above = (np.abs(x / width) ** exponent for width, exponent in (ascending, descending))
        return stretch**power * np.exp(-np.where(x > 0, above, below))

    low = max(_SHORTEST, 1 - ascending[0] * _VANISHED ** (1 / ascending[1]))
    high = 1 + descending[0] * _VANISHED ** (1 / descending[1])
    return primitive(slope, (low * l_opt, l_opt, high * l_opt))
