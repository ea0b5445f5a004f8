"""Tensor-product cubic splines through vector-valued data on a rectangular grid of two variables.

Not-a-knot end conditions; fewer than four points in a direction lower the degree there to what they allow.
"""

import numpy as np
from jaxtyping import Float
from scipy.interpolate import BSpline, make_interp_spline

from myograph.errors import InputError


class TensorSpline:
    """Spline s(x, y) with s(x_i, y_j) = values[i, j], twice continuously differentiable.

    Parameters
    ----------
    x, y
        Increasing grid coordinates.
    values
        Any number of components at each grid point.
    """

    def __init__(
        self,
        x: Float[np.ndarray, " x"],
        y: Float[np.ndarray, " y"],
        values: Float[np.ndarray, "rows columns *components"],
    ) -> None:
        if values.shape[:2] != (len(x), len(y)):
            raise InputError(
                f"expected values on a grid of {len(x)} x {len(y)}, got {values.shape[0]} x {values.shape[1]}"
            )
        if not np.isfinite(values).all():
            raise InputError(
                "expected finite values on the whole grid, got some that are not; complete the table first"
            )
        self._x, along_x = _spline(x, values, 0)
        self._y, coefficients = _spline(y, along_x, 1)
        self._coefficients = coefficients

    def __call__(
        self, x: Float[np.ndarray, " points"] | float, y: float, derivative: tuple[int, int] = (0, 0)
    ) -> Float[np.ndarray, "*result"]:
        """Values (points, components), or partial derivatives, at many x and one y; one x without the first axis.

        Raises InputError outside the grid.
        """
        second = _weights(self._y, np.atleast_1d(y), derivative[1])[0]
        curve = np.tensordot(self._coefficients, second, axes=([1], [0]))
        first = _weights(self._x, np.atleast_1d(x), derivative[0])
        result = np.tensordot(first, curve, axes=1)
        return result if np.ndim(x) else np.asarray(result[0])


def _spline(places: np.ndarray, values: np.ndarray, axis: int) -> tuple[BSpline, np.ndarray]:
    """All basis functions of the interpolating spline along an axis, and its coefficients in place of the values."""
    degree = min(3, len(places) - 1)
    spline = make_interp_spline(places, np.moveaxis(values, axis, 0), k=degree)
    basis = BSpline(spline.t, np.eye(len(places)), degree)
    return basis, np.moveaxis(spline.c, 0, axis)


def _weights(basis: BSpline, places: np.ndarray, derivative: int) -> Float[np.ndarray, "points functions"]:
    """Values of all basis functions at the places; a place a rounding error outside is taken as the edge."""
    low, high = basis.t[0], basis.t[-1]
    slack = 1e-9 * (high - low)
    if not ((places >= low - slack) & (places <= high + slack)).all():
        outside = places[(places < low - slack) | (places > high + slack) | ~np.isfinite(places)][0]
        raise InputError(f"expected a place from {low:g} to {high:g} inside the table, got {outside:g}")
    return basis(np.clip(places, low, high), nu=derivative)
