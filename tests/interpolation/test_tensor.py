"""Tensor-product splines."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.interpolation.tensor import TensorSpline


def _grid(nx, ny):
    return np.linspace(0.3, 2.1, nx), np.linspace(0, 1, ny)


def _on_grid(function, x, y):
    return function(*np.meshgrid(x, y, indexing="ij"))


def test_bicubic_polynomials_are_reproduced_with_their_derivatives():
    x, y = _grid(7, 5)
    spline = TensorSpline(x, y, _on_grid(lambda x, y: x**3 * y**2 - 2 * y**3 + x, x, y))
    assert spline(1.234, 0.567) == pytest.approx(1.234**3 * 0.567**2 - 2 * 0.567**3 + 1.234, rel=1e-12)
    assert spline(1.234, 0.567, (1, 0)) == pytest.approx(3 * 1.234**2 * 0.567**2 + 1, rel=1e-11)
    assert spline(1.234, 0.567, (0, 1)) == pytest.approx(2 * 1.234**3 * 0.567 - 6 * 0.567**2, rel=1e-11)


def test_the_error_falls_with_the_fourth_power_of_the_spacing():
    points = np.linspace(0.35, 2.05, 33)
    errors = []
    for n in (9, 17, 33):
        x, y = _grid(n, n)
        spline = TensorSpline(x, y, _on_grid(lambda x, y: np.sin(2 * x) * np.exp(y), x, y))
        errors.append(np.abs(spline(points, 0.37) - np.sin(2 * points) * np.exp(0.37)).max())
    assert np.log2(np.array(errors[:-1]) / errors[1:]).min() > 3.5


def test_many_components_share_one_grid():
    x, y = _grid(6, 4)
    values = np.random.default_rng(0).normal(size=(6, 4, 5, 3))
    spline = TensorSpline(x, y, values)
    assert spline(x[2], y[1]) == pytest.approx(values[2, 1], abs=1e-12)
    assert spline(x, y[3]) == pytest.approx(values[:, 3], abs=1e-12)


def test_outside_the_grid_is_refused_and_a_rounding_error_is_not():
    x, y = _grid(6, 4)
    spline = TensorSpline(x, y, np.ones((6, 4)))
    with pytest.raises(InputError, match=r"expected a place from 0\.3 to 2\.1 inside the table, got 2\.2"):
        spline(2.2, 0.5)
    with pytest.raises(InputError, match="got nan"):
        spline(1.0, float("nan"))
    assert spline(2.1 + 1e-12, 1.0) == pytest.approx(1)


def test_holes_and_wrong_shapes_are_refused():
    x, y = _grid(6, 4)
    values = np.ones((6, 4))
    with pytest.raises(InputError, match="grid of 6 x 4, got 6 x 3"):
        TensorSpline(x, y, values[:, :3])
    values[2, 2] = np.nan
    with pytest.raises(InputError, match="complete the table"):
        TensorSpline(x, y, values)
