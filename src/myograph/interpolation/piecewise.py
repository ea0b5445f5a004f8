r"""Many piecewise polynomials of one variable on common breaks, evaluated together.

In the cell with middle m and half width h:  f(x) = Σ_k c_k s^k,  s = (x - m) / h in [-1, 1],  c_k = f⁽ᵏ⁾(m) h^k / k!.
One search finds the cell, one small matrix product gives all the functions. At a break the cell to the right counts,
at the last one the cell to the left.
"""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import comb, factorial, perm

import numpy as np
from jaxtyping import Float
from scipy.interpolate import BSpline


@dataclass(frozen=True, eq=False)
class PiecewisePolynomials:
    """Functions on [0, 1].

    Parameters
    ----------
    inner_breaks
        Where cells meet, increasing; 0 and 1 are left out.
    middles, half_widths
        Of the cells.
    coefficients
        c_k of every function in every cell.
    """

    inner_breaks: Float[np.ndarray, " breaks"]
    middles: Float[np.ndarray, " cells"]
    half_widths: Float[np.ndarray, " cells"]
    coefficients: Float[np.ndarray, "cells powers functions"]

    @classmethod
    def from_splines(cls, splines: Sequence[BSpline]) -> "PiecewisePolynomials":
        """All the functions of the splines, whose coefficients have shape (basis functions, functions), in order."""
        breaks = _breaks(splines)
        middles, half_widths = (breaks[:-1] + breaks[1:]) / 2, np.diff(breaks) / 2
        highest = max(spline.k for spline in splines)
        columns = []
        for spline in splines:
            block = np.zeros((len(middles), highest + 1, spline.c.shape[1]))
            for k in range(spline.k + 1):
                block[:, k] = spline(middles, nu=k) * (half_widths**k / factorial(k))[:, None]
            columns.append(block)
        return cls(breaks[1:-1], middles, half_widths, np.concatenate(columns, axis=2))

    def reordered(self, order: np.ndarray) -> "PiecewisePolynomials":
        """The functions with these numbers, in this order."""
        return PiecewisePolynomials(
            self.inner_breaks, self.middles, self.half_widths, np.ascontiguousarray(self.coefficients[:, :, order])
        )

    def refined(self, breaks: Float[np.ndarray, " more"]) -> "PiecewisePolynomials":
        """The same functions with further breaks in (0, 1): every polynomial is moved to the middles of new cells."""
        old = np.concatenate([[0.0], self.inner_breaks, [1.0]])
        new = _distinct(np.concatenate([old, breaks]))
        middles, half_widths = (new[:-1] + new[1:]) / 2, np.diff(new) / 2
        cell = self.inner_breaks.searchsorted(middles, side="right")
        shift, share = (middles - self.middles[cell]) / self.half_widths[cell], half_widths / self.half_widths[cell]
        powers = self.coefficients.shape[1]
        moved = np.zeros((len(middles), powers, self.coefficients.shape[2]))
        for m in range(powers):
            for k in range(m, powers):
                weight = comb(k, m) * share**m * shift ** (k - m)
                moved[:, m] += weight[:, None] * self.coefficients[cell, k]
        return PiecewisePolynomials(new[1:-1], middles, half_widths, moved)

    def __call__(self, x: Float[np.ndarray, " points"], derivative: int = 0) -> Float[np.ndarray, "points functions"]:
        """Values, or derivatives of this order, of all functions at places in [0, 1]."""
        cell = self.inner_breaks.searchsorted(x, side="right")
        half = self.half_widths[cell]
        s = (x - self.middles[cell]) / half
        coefficients = self.coefficients[cell]
        powers = s[:, None, None] ** self._exponents[: len(self._exponents) - derivative]
        if derivative:
            factors = [perm(k, derivative) for k in range(derivative, len(self._exponents))]
            powers = powers * factors / half[:, None, None] ** derivative
            coefficients = coefficients[:, derivative:]
        return (powers @ coefficients)[:, 0]

    def at(self, x: float) -> Float[np.ndarray, " functions"]:
        """Values of all functions at one place in [0, 1], faster than a call."""
        cell = bisect_right(self._break_list, x)
        s = (x - self.middles[cell]) / self.half_widths[cell]
        return s**self._exponents @ self.coefficients[cell]

    @cached_property
    def _break_list(self) -> list[float]:
        return self.inner_breaks.tolist()

    @cached_property
    def _exponents(self) -> np.ndarray:
        return np.arange(self.coefficients.shape[1], dtype=float)


def _breaks(splines: Sequence[BSpline]) -> np.ndarray:
    """0, the knots between, and 1."""
    return _distinct(np.concatenate([spline.t for spline in splines]))


def _distinct(places: np.ndarray) -> np.ndarray:
    """0, the places between, and 1, in rising order; places that a rounding error parts are one."""
    ordered = np.unique(places)
    inner = ordered[(ordered > 1e-14) & (ordered < 1 - 1e-14)]
    apart = np.diff(inner, prepend=-1.0) > 1e-14
    return np.concatenate([[0.0], inner[apart], [1.0]])
