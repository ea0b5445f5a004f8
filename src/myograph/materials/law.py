r"""What every law is: named parameters, and an energy per reference volume summed from parts.

    W = matrix + passive_fibre + activation * active + p θ(J) - p² / (2 K)

`matrix`, `passive_fibre` and `active` are energies [MPa] of the invariants and decide themselves whether they look at
their isochoric parts; θ(J) is J - 1 or ln J, so that at equilibrium p = K θ(J) and the volume costs K θ² / 2.

Convention: the energy is linear in the activation, from 0 to 1.
Trap: the term in p² must stay, else the finite elements' matrix loses its quasi-definiteness.
"""

from abc import abstractmethod
from typing import Annotated

from pydantic import Field

from myograph.config import Model
from myograph.materials.functions import Functions, Scalar
from myograph.materials.invariants import Invariants

Positive = Annotated[float, Field(gt=0)]
NonNegative = Annotated[float, Field(ge=0)]

BULK_OVER_SHEAR = 100.0
"""Bulk over shear modulus from which on a strain of ten per cent changes the volume by less than a thousandth."""


class Law(Model):
    """A material law; subclasses name it by their field `law`, and their parameters by the names that users know."""

    @abstractmethod
    def matrix(self, at: Invariants, f: Functions) -> Scalar:
        """Energy of the ground substance without its volume part [MPa]."""

    def passive_fibre(self, at: Invariants, f: Functions) -> Scalar:
        """Energy of the fibres at rest [MPa]; zero unless a law has fibres."""
        return 0.0 * at.J

    def active(self, at: Invariants, f: Functions) -> Scalar:
        """Energy of full activation [MPa]; zero unless a law contracts."""
        return 0.0 * at.J

    def volume_strain(self, J: Scalar, f: Functions) -> Scalar:
        """θ(J) [-]."""
        return J - 1

    @property
    @abstractmethod
    def bulk_modulus(self) -> float:
        """K of the volume energy K θ² / 2 [MPa]."""

    @property
    @abstractmethod
    def shear_modulus(self) -> float:
        """Of the ground substance at small strain [MPa]."""

    def mixed_energy(self, at: Invariants, pressure: Scalar, activation: Scalar, f: Functions) -> Scalar:
        """The whole energy W [MPa] with the pressure p [MPa] as an unknown of its own."""
        tissue = self.matrix(at, f) + self.passive_fibre(at, f) + activation * self.active(at, f)
        return tissue + pressure * self.volume_strain(at.J, f) - pressure * pressure / (2 * self.bulk_modulus)

    def energy(self, at: Invariants, activation: Scalar, f: Functions) -> Scalar:
        """The energy W [MPa] with the pressure at its equilibrium, K θ(J)."""
        theta = self.volume_strain(at.J, f)
        tissue = self.matrix(at, f) + self.passive_fibre(at, f) + activation * self.active(at, f)
        return tissue + 0.5 * self.bulk_modulus * theta * theta


def require_bulk(name: str, bulk: float, shear: float) -> None:
    """Refuse a nearly incompressible law that would not keep its volume; for validators.

    A bar stretched by a small strain e presses its matrix sideways with the shear modulus times e, and the bulk
    modulus has to answer that with a change of volume under 1e-3 at e = 0.1.
    """
    if bulk < BULK_OVER_SHEAR * shear:
        raise ValueError(
            f"{name}: expected at least {BULK_OVER_SHEAR:g} times the shear modulus of {shear:g} MPa, so that a strain"
            f" of ten per cent changes the volume by less than 1e-3; got {bulk:g}, give"
            f" {BULK_OVER_SHEAR * shear:g} MPa or more"
        )
