"""Boxes in physical units."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.interpolation import Domain

DEGREES = Domain(np.array([10.0, 0.0]), np.array([150.0, 1.0]))


def test_units_go_to_the_cube_and_back():
    points = np.random.default_rng(0).uniform(DEGREES.lower, DEGREES.upper, size=(4, 5, 2))
    assert DEGREES.to_unit(np.array([45.0, 0.25])) == pytest.approx([0.25, 0.25])
    assert DEGREES.from_unit(DEGREES.to_unit(points)) == pytest.approx(points)
    assert Domain.unit(3).to_unit(np.array([0.0, 0.5, 1.0])) == pytest.approx([0, 0.5, 1])


def test_a_rounding_error_outside_is_the_edge():
    assert DEGREES.to_unit(np.array([[150 + 1e-8, -1e-12]])).tolist() == [[1.0, 0.0]]


def test_a_point_outside_is_refused_by_coordinate_and_bounds():
    with pytest.raises(InputError, match=r"expected coordinate 0 from 10 to 150, got 151 in point 1"):
        DEGREES.to_unit(np.array([[20.0, 0.5], [151.0, 0.5]]))
    with pytest.raises(InputError, match=r"expected coordinate 1 from 0 to 1, got -1e-06 in point 0"):
        DEGREES.to_unit(np.array([[20.0, -1e-6]]))
    with pytest.raises(InputError, match=r"coordinate 1 .* got nan"):
        DEGREES.to_unit(np.array([20.0, np.nan]))


@pytest.mark.parametrize("points", [np.zeros((4, 3)), np.zeros(1)])
def test_a_wrong_number_of_coordinates_is_refused(points):
    with pytest.raises(InputError, match=r"expected points of shape \(\.\.\., 2\), got "):
        DEGREES.to_unit(points)


def test_bounds_increase_and_are_finite():
    with pytest.raises(InputError, match="lower < upper, got 3 and 3 for coordinate 1"):
        Domain(np.array([0.0, 3.0]), np.array([1.0, 3.0]))
    with pytest.raises(InputError, match="got 0 and inf for coordinate 0"):
        Domain(np.array([0.0]), np.array([np.inf]))
    with pytest.raises(InputError, match=r"expected as many lower as upper bounds, got shapes \(1,\) and \(2,\)"):
        Domain(np.array([0.0]), np.array([1.0, 2.0]))
