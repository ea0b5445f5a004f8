r"""Antiderivatives of curves whose integral has no closed form, as polynomials on a few pieces.

    primitive(l) = ∫ curve dl from the first break to l,   the curve taken as zero beyond its ends

Every piece is interpolated by Chebyshev polynomials, as many as its smoothness needs, and integrated exactly; a piece
that needs too many is halved. The result is evaluated by Horner's scheme in + and * alone, so that NumPy and finite
elements see the very same polynomial and can differentiate it as often as they like.

Trap: a curve should be smooth between its breaks; put a break wherever it has a kink, else the pieces there are many.
Source: Trefethen, Approximation Theory and Approximation Practice, 2013.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from jaxtyping import Float
from numpy.polynomial import Chebyshev
from numpy.polynomial.chebyshev import cheb2poly

from myograph.materials.functions import Functions, Scalar, clamped

ACCURACY = 1e-10
"""Of a curve's interpolation, relative to the curve's largest value."""
_DEGREES = range(6, 35, 4)
_MOST_HALVINGS = 20
Curve = Callable[[Float[np.ndarray, " points"]], Float[np.ndarray, " points"]]


@dataclass(frozen=True)
class Piece:
    """Integral of one smooth piece of a curve from `low`, a polynomial in t = (2 l - low - high) / (high - low)."""

    low: float
    high: float
    coefficients: tuple[float, ...]

    def __call__(self, stretch: Scalar, f: Functions) -> Scalar:
        """Integral from `low` to the stretch, which is held inside the piece."""
        t = (2 * clamped(stretch, self.low, self.high, f) - (self.low + self.high)) / (self.high - self.low)
        value = self.coefficients[-1]
        for coefficient in self.coefficients[-2::-1]:
            value = value * t + coefficient
        return value


def primitive(curve: Curve, breaks: tuple[float, ...]) -> tuple[Piece, ...]:
    """Pieces whose sum is the antiderivative of `curve`, which is smooth between the growing `breaks`."""
    scale = float(np.abs(curve(np.linspace(breaks[0], breaks[-1], 301))).max())
    return tuple(piece for ends in pairwise(breaks) for piece in _integrated(curve, ends, ACCURACY * scale))


def evaluated(pieces: tuple[Piece, ...], stretch: Scalar, f: Functions) -> Scalar:
    """Sum of the pieces: the integral from the first break to the stretch."""
    return sum((piece(stretch, f) for piece in pieces[1:]), pieces[0](stretch, f))


def _integrated(
    curve: Curve, ends: tuple[float, float], tolerance: float, halvings: int = _MOST_HALVINGS
) -> tuple[Piece, ...]:
    """One piece of the lowest degree that interpolates the curve between its points, or those of both halves."""
    low, high = ends
    between = np.linspace(low, high, 301)
    exact = curve(between)
    for degree in _DEGREES:
        fitted = Chebyshev.interpolate(curve, degree, domain=[low, high])
        if np.abs(fitted(between) - exact).max() <= tolerance or not halvings:
            return (Piece(low, high, tuple(map(float, cheb2poly(fitted.integ(lbnd=low).coef)))),)
    middle = 0.5 * (low + high)
    halves = ((low, middle), (middle, high))
    return tuple(piece for half in halves for piece in _integrated(curve, half, tolerance, halvings - 1))
