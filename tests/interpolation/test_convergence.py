"""Orders of convergence of the largest error, on average between two regular grids.

Not-a-knot splines have the full order p + 1 (up to logarithms) for every smooth function. The others have it only for
functions that suit their boundary; elsewhere the order that they do have is tested from both sides.
"""

import numpy as np
import pytest

from myograph.interpolation import SparseGrid, basis, interpolate


def _general(x):
    """Neither zero nor straight at the boundary."""
    return np.exp(1.5 * x.mean(axis=1)) * np.cos(x[:, 0] - 0.3 * x[:, -1])


def _sines(x):
    """Zero and without curvature at the boundary."""
    return np.sin(np.pi * x).prod(axis=1)


def _flat(x):
    """Zero with five derivatives at the boundary."""
    return (4 * x * (1 - x)).prod(axis=1) ** 6


def _order(function, name, degree, coarse, fine, dimension=2):
    """log2 of the ratio of the largest errors, per level; a quarter of the points lies close to the boundary."""
    one = basis(name, degree)
    points = np.random.default_rng(1).uniform(size=(800, dimension))
    points[:200, 0] **= 4
    errors = []
    for level in (coarse, fine):
        grid = SparseGrid.regular(dimension, level, one.boundary)
        spline = interpolate(grid, one, function(grid.coordinates(one)))
        errors.append(np.abs(spline(points) - function(points)).max())
    return np.log2(errors[0] / errors[1]) / (fine - coarse)


@pytest.mark.parametrize(("degree", "coarse", "fine"), [(1, 3, 7), (3, 3, 7), (5, 3, 6)])
def test_not_a_knot_has_full_order_for_any_smooth_function(degree, coarse, fine):
    assert _order(_general, "not_a_knot", degree, coarse, fine) > degree + 1 - 0.2


@pytest.mark.parametrize("degree", [1, 3, 5])
def test_not_a_knot_has_full_order_in_five_dimensions(degree):
    """On so coarse levels the logarithms take up to half an order away."""
    assert _order(_general, "not_a_knot", degree, 2, 3, dimension=5) > degree + 1 - 0.5


@pytest.mark.parametrize("degree", [1, 3, 5])
def test_modified_not_a_knot_has_full_order_without_curvature_at_the_boundary(degree):
    assert _order(_sines, "modified_not_a_knot", degree, 4, 8) > degree + 1 - 0.2


@pytest.mark.parametrize("name", ["modified", "modified_not_a_knot"])
@pytest.mark.parametrize("degree", [3, 5])
def test_straight_ends_limit_the_order_to_two_where_the_function_bends(name, degree):
    assert 1.7 < _order(_general, name, degree, 5, 7) < 2.5


@pytest.mark.parametrize("degree", [3, 5])
def test_modified_functions_are_straight_next_to_the_boundary(degree):
    """So a third derivative there limits their order to three, whatever the degree."""
    assert 2.2 < _order(_sines, "modified", degree, 5, 7) < 3.2


@pytest.mark.parametrize("degree", [3, 5])
def test_modified_functions_have_full_order_for_functions_flat_at_the_boundary(degree):
    assert _order(_flat, "modified", degree, 6, 8, dimension=1) > degree + 1 - 0.3


@pytest.mark.parametrize(("name", "finest"), [("clenshaw_curtis", 6), ("modified_clenshaw_curtis", 7)])
@pytest.mark.parametrize(("degree", "low", "high"), [(1, 1.8, 2.5), (3, 3.8, 5.5), (5, 4.2, 5.5)])
def test_clenshaw_curtis_is_hardly_limited_by_the_boundary(name, finest, degree, low, high):
    """The outermost cells are as wide as the squares of the others: full order for p = 3, about five for p = 5."""
    assert low < _order(_general, name, degree, 4, finest) < high


def test_modified_clenshaw_curtis_in_five_dimensions():
    assert _order(_general, "modified_clenshaw_curtis", 3, 4, 5, dimension=5) > 3.8


@pytest.mark.parametrize("degree", [3, 5])
def test_levels_that_are_not_nested_limit_the_order_of_uniform_functions(degree):
    """Splines of a coarse level are sums of those of a finer one only with some whose points lie outside."""
    assert 1.3 < _order(_general, "uniform", degree, 4, 7) < 2.1


def test_linear_functions_with_boundary_have_order_two():
    assert _order(_general, "uniform", 1, 3, 7) > 1.8


@pytest.mark.parametrize("degree", [3, 5])
def test_uniform_functions_need_their_boundary_points(degree):
    """Without them there is no convergence to speak of, even for a function that vanishes at the boundary."""
    one, places = basis("uniform", degree), np.linspace(0, 1, 401)[:, None]
    errors = []
    for level in (4, 8):
        grid = SparseGrid.regular(1, level)
        errors.append(np.abs(interpolate(grid, one, _flat(grid.coordinates(one)))(places) - _flat(places)).max())
    assert np.log2(errors[0] / errors[1]) / 4 < 0.5
