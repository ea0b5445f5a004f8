r"""Numbers that carry their first and second derivatives over a few variables: exact derivatives of a law's energy.

    f(x):  ∂_i f = f' x_i,   ∂_ij f = f' x_ij + f'' x_i x_j          (forward mode, second order)

Every entry is an array over points. Derivatives that vanish everywhere are not kept: the fibre's part of a law depends
on one invariant only, and so costs two arrays beside its value. JETS are the elementary functions that laws are written
in, for these numbers.

Source: Griewank and Walther, Evaluating Derivatives, 2008, chapter 13.
"""

from collections.abc import Hashable
from math import pi, sqrt
from typing import TypeVar

import numpy as np
from scipy.special import erf

from myograph.materials.functions import Functions, Scalar

First = dict[int, np.ndarray]
Second = dict[tuple[int, int], np.ndarray]
Key = TypeVar("Key", bound=Hashable)


class Jet:
    """A number at every point, with its derivatives.

    Parameters
    ----------
    value
        At every point.
    first, second
        Variable, or pair of variables in rising order -> derivative; what is missing is zero. `second` may be None:
        then only first derivatives are carried.
    """

    __slots__ = ("first", "second", "value")
    __array_ufunc__ = None

    def __init__(self, value: np.ndarray, first: First, second: Second | None) -> None:
        self.value, self.first, self.second = value, first, second

    @classmethod
    def variable(cls, number: int, value: np.ndarray, second: bool = True) -> "Jet":
        """The variable of this number itself."""
        return cls(value, {number: np.ones_like(value)}, {} if second else None)

    def chain(self, value: np.ndarray, slope: Scalar, bend: Scalar) -> "Jet":
        """A function of this number, from its value and its first and second derivative here."""
        first = {i: slope * d for i, d in self.first.items()}
        if self.second is None:
            return Jet(value, first, None)
        second = {key: slope * d for key, d in self.second.items()}
        for i, d in self.first.items():
            bent = bend * d
            for j, e in self.first.items():
                if i <= j:
                    _add(second, (i, j), bent * e)
        return Jet(value, first, second)

    def __add__(self, other: Scalar) -> "Jet":
        if not isinstance(other, Jet):
            return Jet(self.value + other, self.first, self.second)
        second = None if self.second is None or other.second is None else _sum(self.second, other.second)
        return Jet(self.value + other.value, _sum(self.first, other.first), second)

    __radd__ = __add__

    def __neg__(self) -> "Jet":
        return self * -1.0

    def __sub__(self, other: Scalar) -> "Jet":
        return self + -1.0 * other

    def __rsub__(self, other: Scalar) -> "Jet":
        return -1.0 * self + other

    def __mul__(self, other: Scalar) -> "Jet":
        if not isinstance(other, Jet):
            second = None if self.second is None else {key: d * other for key, d in self.second.items()}
            return Jet(self.value * other, {i: d * other for i, d in self.first.items()}, second)
        if other is self:
            return self.chain(self.value * self.value, 2 * self.value, 2.0)
        first = _sum(_times(self.first, other.value), _times(other.first, self.value))
        if self.second is None or other.second is None:
            return Jet(self.value * other.value, first, None)
        second = _sum(_times(self.second, other.value), _times(other.second, self.value))
        for i, d in self.first.items():
            for j, e in other.first.items():
                product = d * e
                _add(second, (i, j) if i <= j else (j, i), product + product if i == j else product)
        return Jet(self.value * other.value, first, second)

    __rmul__ = __mul__

    def __truediv__(self, other: Scalar) -> "Jet":
        return self * (other**-1 if isinstance(other, Jet) else 1 / other)

    def __rtruediv__(self, other: Scalar) -> "Jet":
        return self**-1 * other

    def __pow__(self, n: float) -> "Jet":
        if n in (1, 2):
            return self if n == 1 else self * self
        lower = self.value ** (n - 2)
        slope = lower * self.value
        return self.chain(slope * self.value, n * slope, n * (n - 1) * lower)


class JetFunctions:
    """Jets; what is none is taken as a constant."""

    def sqrt(self, x: Scalar) -> Scalar:
        """Square root."""
        if not isinstance(x, Jet):
            return np.sqrt(x)
        root = np.sqrt(x.value)
        return x.chain(root, 0.5 / root, -0.25 / (root * x.value))

    def exp(self, x: Scalar) -> Scalar:
        """Exponential."""
        if not isinstance(x, Jet):
            return np.exp(x)
        value = np.exp(x.value)
        return x.chain(value, value, value)

    def log(self, x: Scalar) -> Scalar:
        """Natural logarithm."""
        if not isinstance(x, Jet):
            return np.log(x)
        slope = 1 / x.value
        return x.chain(np.log(x.value), slope, -slope * slope)

    def erf(self, x: Scalar) -> Scalar:
        """Error function."""
        if not isinstance(x, Jet):
            return erf(x)
        slope = 2 / sqrt(pi) * np.exp(-x.value * x.value)
        return x.chain(erf(x.value), slope, -2 * x.value * slope)

    def where(self, positive: Scalar, then: Scalar, otherwise: Scalar) -> Scalar:
        """`then` where `positive` > 0, else `otherwise`."""
        chosen = np.asarray(positive.value if isinstance(positive, Jet) else positive) > 0
        if not isinstance(then, Jet) and not isinstance(otherwise, Jet):
            return np.where(chosen, then, otherwise)
        then, otherwise = _as_jet(then), _as_jet(otherwise)
        second = None
        if then.second is not None and otherwise.second is not None:
            second = _chosen(chosen, then.second, otherwise.second)
        return Jet(np.where(chosen, then.value, otherwise.value), _chosen(chosen, then.first, otherwise.first), second)


JETS: Functions = JetFunctions()


def _as_jet(x: Scalar) -> Jet:
    return x if isinstance(x, Jet) else Jet(np.asarray(x), {}, {})


def _chosen(chosen: np.ndarray, then: dict[Key, np.ndarray], otherwise: dict[Key, np.ndarray]) -> dict[Key, np.ndarray]:
    return {key: np.where(chosen, then.get(key, 0.0), otherwise.get(key, 0.0)) for key in {**then, **otherwise}}


def _times(derivatives: dict[Key, np.ndarray], factor: np.ndarray) -> dict[Key, np.ndarray]:
    return {key: d * factor for key, d in derivatives.items()}


def _sum(one: dict[Key, np.ndarray], other: dict[Key, np.ndarray]) -> dict[Key, np.ndarray]:
    total = dict(one)
    for key, derivative in other.items():
        _add(total, key, derivative)
    return total


def _add(total: dict[Key, np.ndarray], key: Key, derivative: np.ndarray) -> None:
    total[key] = total[key] + derivative if key in total else derivative
