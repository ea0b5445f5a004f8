"""Hierarchical functions of one variable."""

import numpy as np
import pytest
from scipy.interpolate import BSpline

from myograph.errors import InputError
from myograph.interpolation import BASES, basis

PLACES = np.linspace(0.0, 1.0, 203)
DEGREES = (1, 3, 5)


def _all_of(level):
    """Level and index of all functions of one level."""
    indices = np.arange(1, 2**level, 2) if level else np.array([0, 1])
    return np.full_like(indices, level), indices


def _up_to(level, boundary):
    blocks = [_all_of(one) for one in range(0 if boundary else 1, level + 1)]
    return np.concatenate([block[0] for block in blocks]), np.concatenate([block[1] for block in blocks])


@pytest.mark.parametrize("degree", DEGREES)
def test_uniform_functions_are_cardinal_splines(degree):
    """b_{l,i}(x) = b^p(x / h + (p + 1)/2 - i)."""
    cardinal = BSpline.basis_element(np.arange(degree + 2), extrapolate=False)
    levels, indices = _up_to(4, boundary=True)
    expected = cardinal(PLACES[:, None] * 2.0**levels + (degree + 1) / 2 - indices)
    values = basis("uniform", degree).value(levels, indices, PLACES)
    assert values == pytest.approx(np.nan_to_num(expected), abs=1e-13)


@pytest.mark.parametrize("name", BASES)
@pytest.mark.parametrize("degree", DEGREES)
def test_every_family_is_symmetric(name, degree):
    one = basis(name, degree)
    levels, indices = _up_to(4, one.boundary)
    mirrored = np.where(levels == 0, 1 - indices, 2**levels - indices)
    here, there = one.value(levels, indices, PLACES), one.value(levels, mirrored, PLACES[::-1])
    assert here == pytest.approx(there, abs=1e-12)


@pytest.mark.parametrize("name", BASES)
@pytest.mark.parametrize("degree", DEGREES)
def test_derivatives_are_those_of_the_values(name, degree):
    one = basis(name, degree)
    levels, indices = _up_to(3, one.boundary)
    inside = np.array([0.0123, 0.0611, 0.217, 0.333, 0.481, 0.5321, 0.777, 0.9876])
    step = 1e-5
    ahead, behind = (one.value(levels, indices, inside + sign * step) for sign in (1, -1))
    assert one.first_derivative(levels, indices, inside) == pytest.approx((ahead - behind) / 2 / step, abs=1e-5)
    ahead, behind = (one.first_derivative(levels, indices, inside + sign * step) for sign in (1, -1))
    second = one.second_derivative(levels, indices, inside)
    assert second == pytest.approx((ahead - behind) / 2 / step, rel=1e-6, abs=2e-4)


def test_the_order_of_the_functions_is_the_callers():
    levels, indices = np.array([2, 0, 1, 2]), np.array([3, 1, 1, 1])
    singly = [basis("not_a_knot").value(levels[[k]], indices[[k]], PLACES) for k in range(4)]
    assert basis("not_a_knot").value(levels, indices, PLACES) == pytest.approx(np.concatenate(singly, axis=1))


@pytest.mark.parametrize("name", ["modified", "modified_clenshaw_curtis", "modified_not_a_knot"])
def test_level_one_of_modified_families_is_one(name):
    assert basis(name).value(np.array([1]), np.array([1]), PLACES) == pytest.approx(np.ones((203, 1)))


@pytest.mark.parametrize("degree", [1, 3])
def test_modified_functions_go_on_linearly_to_the_boundary(degree):
    """Up to the first point: 2 - x / h; for p = 5 only the second derivative at 0 vanishes."""
    cell = np.linspace(0, 0.125, 11)
    values = basis("modified", degree).value(np.array([3]), np.array([1]), cell)[:, 0]
    assert values == pytest.approx(2 - 8 * cell)


@pytest.mark.parametrize(("name", "degree"), [("modified", 5), ("modified_not_a_knot", 3), ("modified_not_a_knot", 5)])
def test_modified_functions_have_no_curvature_at_the_boundary(name, degree):
    levels, indices = _up_to(5, boundary=False)
    curvature = basis(name, degree).second_derivative(levels, indices, np.array([0.0, 1.0]))
    assert np.abs(curvature).max() < 1e-9 * 4**5


def test_modified_not_a_knot_functions_are_those_in_print():
    """Cubic, l >= 3, i = 1: (5/4, -3/4, 0, 1/24) in powers of x/h up to 2; quintic, l = 2: a quartic in x/h - 1."""
    x = np.linspace(0, 2, 9)
    cubic = basis("modified_not_a_knot", 3).value(np.array([3]), np.array([1]), x / 8)[:, 0]
    assert cubic == pytest.approx(5 / 4 - 3 / 4 * x + x**3 / 24)
    t = x - 1
    quintic = basis("modified_not_a_knot", 5).value(np.array([2]), np.array([1]), x / 4)[:, 0]
    assert quintic == pytest.approx((46 - 67 * t + 18 * t**2 + 4 * t**3 - t**4) / 46)


@pytest.mark.parametrize("degree", DEGREES)
def test_not_a_knot_functions_span_the_polynomials(degree):
    levels, indices = _up_to(4, boundary=True)
    values = basis("not_a_knot", degree).value(levels, indices, PLACES)
    for power in range(degree + 1):
        target = (PLACES - 0.4) ** power
        fit = values @ np.linalg.lstsq(values, target, rcond=None)[0]
        assert fit == pytest.approx(target, abs=1e-11)


@pytest.mark.parametrize("degree", DEGREES)
def test_clenshaw_curtis_functions_live_on_the_knots_of_their_level(degree):
    """Inside: the B-spline of knots x_{l, i - (p + 1)/2} to x_{l, i + (p + 1)/2}, here l = 4, i = 7."""
    around = 7 + np.arange(-(degree + 1) // 2, (degree + 1) // 2 + 1)
    expected = BSpline.basis_element((1 - np.cos(np.pi * around / 16)) / 2, extrapolate=False)(PLACES)
    for name in ("clenshaw_curtis", "modified_clenshaw_curtis"):
        values = basis(name, degree).value(np.array([4]), np.array([7]), PLACES)[:, 0]
        assert values == pytest.approx(np.nan_to_num(expected), abs=1e-13)


def test_names_and_degrees_are_listed_when_wrong():
    with pytest.raises(InputError, match=r"among uniform, modified, clenshaw_curtis, .*not_a_knot, got 'spline'"):
        basis("spline")
    with pytest.raises(InputError, match="degree of 1, 3 or 5, got 2"):
        basis("uniform", 2)


def test_levels_and_places_outside_are_refused():
    one = np.array([1])
    with pytest.raises(InputError, match="levels from 1 to 12 for the basis 'modified', got 0"):
        basis("modified").value(np.array([0]), one, PLACES)
    with pytest.raises(InputError, match="levels from 0 to 12 for the basis 'uniform', got 13"):
        basis("uniform").value(np.array([13]), one, PLACES)
    with pytest.raises(InputError, match=r"places from 0 to 1, got 1\.5"):
        basis("uniform").value(one, one, np.array([0.5, 1.5]))
