"""The elementary functions and the invariants of laws for NGSolve, the judge of our derivatives.

NGSolve differentiates what a law builds from them, twice where a tangent is wanted.
"""

import ngsolve as ngs

from myograph.materials.functions import Functions, Scalar
from myograph.materials.invariants import Invariants


class NgsolveFunctions:
    """CoefficientFunctions."""

    def sqrt(self, x: Scalar) -> Scalar:
        """Square root."""
        return ngs.sqrt(x)

    def exp(self, x: Scalar) -> Scalar:
        """Exponential."""
        return ngs.exp(x)

    def log(self, x: Scalar) -> Scalar:
        """Natural logarithm."""
        return ngs.log(x)

    def erf(self, x: Scalar) -> Scalar:
        """Error function."""
        return ngs.erf(x)

    def where(self, positive: Scalar, then: Scalar, otherwise: Scalar) -> Scalar:
        """`then` where `positive` > 0, else `otherwise`."""
        return ngs.IfPos(positive, then, otherwise)


NGSOLVE: Functions = NgsolveFunctions()


def field_invariants(F: ngs.CoefficientFunction, fibre: ngs.CoefficientFunction) -> Invariants:
    """Invariants of a deformation gradient and of the unit fibre direction in the reference body."""
    C = F.trans * F
    along = C * fibre
    I1 = ngs.Trace(C)
    I2 = 0.5 * (I1 * I1 - ngs.InnerProduct(C, C))
    return Invariants(I1, I2, ngs.InnerProduct(fibre, along), ngs.InnerProduct(along, along), ngs.Det(F))
