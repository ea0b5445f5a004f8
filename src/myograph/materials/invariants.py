r"""Invariants of C = Fᵀ F and of a unit fibre direction a0, on which every law here is built.

    I1 = tr C,  I2 = (tr(C)² - tr(C²)) / 2,  I4 = a0 · C a0,  I5 = a0 · C² a0,  J = det F

Convention: I4 is the square of the fibre's stretch; `isochoric` are those of J^(-1/3) F.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from myograph.materials.functions import Functions, Scalar


@dataclass(frozen=True)
class Invariants:
    """All five; numbers, arrays or CoefficientFunctions."""

    I1: Scalar
    I2: Scalar
    I4: Scalar
    I5: Scalar
    J: Scalar

    def isochoric(self) -> "Invariants":
        """Of J^(-1/3) F, which keeps the volume."""
        first, second = self.J ** (-2 / 3), self.J ** (-4 / 3)
        return Invariants(first * self.I1, second * self.I2, first * self.I4, second * self.I5, 1.0)

    def prestretched(self, stretch: Scalar) -> "Invariants":
        """Of F G0 with G0 = l^(-1/2) 1 + (l - l^(-1/2)) a0 ⊗ a0, which stretches the fibre by l and keeps the volume.

        With G0² = k 1 + m a0 ⊗ a0, k = 1/l, m = l² - 1/l: no tensor needs to be formed again.
        """
        k = 1 / stretch
        m = stretch * stretch - k
        I1 = k * self.I1 + m * self.I4
        square = self.I1 * self.I1 - 2 * self.I2
        square = k * k * square + 2 * k * m * self.I5 + m * m * self.I4 * self.I4
        I5 = stretch * stretch * (k * self.I5 + m * self.I4 * self.I4)
        return Invariants(I1, 0.5 * (I1 * I1 - square), stretch * stretch * self.I4, I5, self.J)


def invariants(F: Float[np.ndarray, "*batch 3 3"], fibre: Float[np.ndarray, "*batch 3"]) -> Invariants:
    """Invariants of deformation gradients and of unit fibre directions, point by point."""
    C = np.swapaxes(F, -1, -2) @ F
    along = np.einsum("...ij,...j->...i", C, fibre)
    I1 = np.trace(C, axis1=-2, axis2=-1)
    square = np.einsum("...ij,...ij->...", C, C)
    I4 = np.einsum("...i,...i->...", fibre, along)
    return Invariants(I1, 0.5 * (I1 * I1 - square), I4, np.einsum("...i,...i->...", along, along), np.linalg.det(F))


def fibre_stretch(at: Invariants, isochoric: bool, f: Functions) -> Scalar:
    """Stretch of the fibre [-], its own or the one of J^(-1/3) F."""
    return f.sqrt(at.isochoric().I4 if isochoric else at.I4)
