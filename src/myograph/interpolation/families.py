r"""Hierarchical B-splines of one variable: which spline is function (level l, index i) of each family.

p is the odd degree, x_{l,j} = j 2^-l or (1 - cos(π j 2^-l)) / 2 the points of level l, b_{l,i} the B-spline whose p + 2
knots are x_{l,j}, |j - i| <= (p + 1)/2. As knots, the inner points go on equidistantly to both sides.

- uniform, Clenshaw–Curtis: b_{l,i}; for equal steps h that is b^p(x / h + (p + 1)/2 - i), b^p the cardinal B-spline.
- modified: 1 on level 1; on finer levels the first function is Σ_{i' <= 1} (2 - i') b_{l,i'}, the last its
  mirror image.
- not-a-knot: the knots of level l without the first and last (p - 1)/2 inner ones, counted by i = 0 ... 2^l; where
  2^l < p the Lagrange polynomials of the points of level l.
- modified not-a-knot: 1 on level 1; on finer levels b_{l,i} - α b_{l,0} - β b_{l,2^l} with the α and β that make the
  second derivatives at 0 and 1 vanish. For p = 1 there is no such derivative: the modified uniform functions.

The trap: x_{l,0} = 2 x_{l,1} - x_{l,2} is a knot of Clenshaw–Curtis functions, 0 is none. With knots at 0, and beyond
it in steps of x_{l,1}, the interpolant with boundary points is hundreds of times worse.
Source: Valentin 2019, B-Splines for Sparse Grids, chapters 3 and 4; the knots beyond the edges as in SG++.
"""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from jaxtyping import Int
from scipy.interpolate import BSpline, make_interp_spline

from myograph.interpolation.spacing import level_points

Family: TypeAlias = Callable[[int, int, np.ndarray], BSpline]
"""(degree, level, indices) -> a spline whose coefficients (basis functions, indices) hold one function per column."""


def uniform(degree: int, level: int, indices: Int[np.ndarray, " functions"]) -> BSpline:
    """B-splines on equidistant knots, with boundary functions 0 and 1 on level 0."""
    return BSpline(_knots(degree, level, "uniform"), _single(degree, level, indices), degree)


def clenshaw_curtis(degree: int, level: int, indices: Int[np.ndarray, " functions"]) -> BSpline:
    """B-splines on Clenshaw–Curtis knots, with boundary functions 0 and 1 on level 0."""
    return BSpline(_knots(degree, level, "clenshaw_curtis"), _single(degree, level, indices), degree)


def modified(degree: int, level: int, indices: Int[np.ndarray, " functions"]) -> BSpline:
    """Uniform functions whose first and last go on linearly to the boundary."""
    if level == 1:
        return _one(len(indices))
    return BSpline(_knots(degree, level, "uniform"), _extrapolating(degree, level, indices), degree)


def modified_clenshaw_curtis(degree: int, level: int, indices: Int[np.ndarray, " functions"]) -> BSpline:
    """Clenshaw–Curtis functions whose first and last go on almost linearly to the boundary."""
    if level == 1:
        return _one(len(indices))
    return BSpline(_knots(degree, level, "clenshaw_curtis"), _extrapolating(degree, level, indices), degree)


def not_a_knot(degree: int, level: int, indices: Int[np.ndarray, " functions"]) -> BSpline:
    """Functions whose span on a full grid holds all polynomials up to the degree."""
    points = level_points(level, "uniform")
    chosen = np.eye(len(points))[:, indices]
    if 2**level < degree:
        ends = np.repeat([0.0, 1.0], 2**level + 1)
        return make_interp_spline(points, chosen, k=2**level, t=ends)
    left_out = (degree + 1) // 2
    beyond = np.arange(degree + 1) * 2.0**-level
    knots = np.concatenate([-beyond[::-1], points[left_out : len(points) - left_out], 1 + beyond])
    return BSpline(knots, chosen, degree)


def modified_not_a_knot(degree: int, level: int, indices: Int[np.ndarray, " functions"]) -> BSpline:
    """Not-a-knot functions without curvature at the boundary."""
    if level == 1 or degree == 1:
        return modified(degree, level, indices)
    spline = not_a_knot(degree, level, np.concatenate([[0, 2**level], indices]))
    curvature = spline(np.array([0.0, 1.0]), nu=2)
    shares = np.linalg.solve(curvature[:, :2], curvature[:, 2:])
    return BSpline(spline.t, spline.c[:, 2:] - spline.c[:, :2] @ shares, spline.k)


def _knots(degree: int, level: int, spacing: str) -> np.ndarray:
    """Inner points of a level and p + 1 more on either side: knots of b_{l,i}, -(p - 1)/2 <= i <= 2^l + (p - 1)/2."""
    if level < 2:
        return np.arange(-degree, 2**level + degree + 1) * 2.0**-level
    inner = level_points(level, spacing)[1:-1]
    outer = (inner[1] - inner[0]) * np.arange(1, degree + 2)
    return np.concatenate([inner[0] - outer[::-1], inner, inner[-1] + outer])


def _single(degree: int, level: int, indices: np.ndarray) -> np.ndarray:
    """Coefficients of b_{l,i} alone."""
    return np.eye(2**level + degree)[:, indices + (degree - 1) // 2]


def _extrapolating(degree: int, level: int, indices: np.ndarray) -> np.ndarray:
    """Coefficients of b_{l,i}, with those outside the boundary added to the first and the last."""
    coefficients = _single(degree, level, indices)
    ramp = np.arange((degree + 3) // 2, 0, -1.0)
    coefficients[: len(ramp), indices == 1] = ramp[:, None]
    coefficients[-len(ramp) :, indices == 2**level - 1] = ramp[::-1, None]
    return coefficients


def _one(functions: int) -> BSpline:
    """The constant 1."""
    return BSpline(np.array([0.0, 1.0]), np.ones((1, functions)), 0)
