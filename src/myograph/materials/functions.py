"""The elementary functions that laws are written in, so that one text serves numbers and finite elements.

A law's energy is built with these and with + - * / ** alone. NUMPY evaluates it for plots, fits and tests; the
mechanics bring the same names for NGSolve, which then differentiates the very same expression.

Trap: `where` evaluates both branches; the branch that is not taken must still be finite, and so should its derivatives
be, because not every way to evaluate throws them away.
"""

from typing import Any, Protocol, runtime_checkable

import numpy as np
from scipy.special import erf

Scalar = Any
"""A float, a NumPy array, or a CoefficientFunction of NGSolve."""


@runtime_checkable
class Functions(Protocol):
    """Elementary functions of one way to evaluate."""

    def sqrt(self, x: Scalar) -> Scalar:
        """Square root."""
        ...

    def exp(self, x: Scalar) -> Scalar:
        """Exponential."""
        ...

    def log(self, x: Scalar) -> Scalar:
        """Natural logarithm."""
        ...

    def erf(self, x: Scalar) -> Scalar:
        """Error function."""
        ...

    def where(self, positive: Scalar, then: Scalar, otherwise: Scalar) -> Scalar:
        """`then` where `positive` > 0, else `otherwise`."""
        ...


class NumpyFunctions:
    """Numbers and arrays."""

    def sqrt(self, x: Scalar) -> Scalar:
        """Square root."""
        return np.sqrt(x)

    def exp(self, x: Scalar) -> Scalar:
        """Exponential."""
        return np.exp(x)

    def log(self, x: Scalar) -> Scalar:
        """Natural logarithm."""
        return np.log(x)

    def erf(self, x: Scalar) -> Scalar:
        """Error function."""
        return erf(x)

    def where(self, positive: Scalar, then: Scalar, otherwise: Scalar) -> Scalar:
        """`then` where `positive` > 0, else `otherwise`."""
        return np.where(np.asarray(positive) > 0, then, otherwise)


NUMPY: Functions = NumpyFunctions()


def positive(value: Scalar, width: float, f: Functions) -> Scalar:
    """Smooth positive part (v + sqrt(v² + width²)) / 2: never zero, slope 1/2 at zero."""
    return 0.5 * (value + f.sqrt(value * value + width**2))


def clamped(value: Scalar, low: float, high: float, f: Functions) -> Scalar:
    """The value, held at `low` and `high`."""
    return f.where(value - low, f.where(high - value, value, high), low)
