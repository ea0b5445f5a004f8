"""Interpolants: values, derivatives, units, mistakes."""

import numpy as np
import pytest
from scipy.interpolate import BSpline

from myograph.errors import InputError, NotConvergedError
from myograph.interpolation import BASES, Basis, Domain, Hierarchizer, SparseGrid, basis, interpolate

BOX = Domain(np.array([10.0, 0.0]), np.array([150.0, 2.0]))


def _wavy(points):
    """Two components in physical units, with and without a bend at the boundary."""
    angle, share = points[..., 0] / 50, points[..., 1]
    return np.stack([np.sin(angle) * np.exp(share / 2), angle * share], axis=-1)


def _made(name, degree=3, level=3):
    one = basis(name, degree)
    hierarchizer = Hierarchizer(SparseGrid.regular(2, level, one.boundary), one, BOX)
    return hierarchizer.interpolant(_wavy(hierarchizer.points))


@pytest.mark.parametrize("name", BASES)
@pytest.mark.parametrize("degree", [1, 3, 5])
def test_values_at_the_grid_points_come_back(name, degree):
    one = basis(name, degree)
    hierarchizer = Hierarchizer(SparseGrid.regular(3, 3, one.boundary), one)
    values = np.random.default_rng(0).uniform(-1, 1, size=(len(hierarchizer.grid), 2, 3))
    assert hierarchizer.interpolant(values)(hierarchizer.points) == pytest.approx(values, abs=1e-12)


def test_a_refined_grid_and_a_sparse_factorisation_give_the_values_back():
    grid = SparseGrid.regular(2, 6).refined(np.arange(200, 300, 7))
    hierarchizer = Hierarchizer(grid, basis("modified", 1))
    values = np.random.default_rng(0).normal(size=len(grid))
    assert not isinstance(hierarchizer._matrix, np.ndarray)
    assert hierarchizer.interpolant(values)(hierarchizer.points) == pytest.approx(values, abs=1e-12)


@pytest.mark.parametrize(("degree", "level"), [(1, 1), (3, 3), (5, 5)])
def test_not_a_knot_reproduces_polynomials_up_to_its_degree(degree, level):
    """Each power needs the coarsest level that holds it, and the product the sum of these levels."""
    one = basis("not_a_knot", degree)
    grid = SparseGrid.regular(2, level, boundary=True)
    points = np.random.default_rng(1).uniform(size=(100, 2))
    powers = [(a, b) for a in range(degree + 1) for b in range(degree + 1)]

    def monomials(x):
        return np.stack([x[:, 0] ** a * (x[:, 1] - 0.3) ** b for a, b in powers], axis=1)

    spline = interpolate(grid, one, monomials(grid.coordinates(one)))
    assert spline(points) == pytest.approx(monomials(points), abs=1e-10)


def test_modified_bases_reproduce_constants():
    for name in ("modified", "modified_clenshaw_curtis", "modified_not_a_knot"):
        grid = SparseGrid.regular(3, 3)
        spline = interpolate(grid, basis(name), np.full(len(grid), 7.0))
        assert spline(np.random.default_rng(0).uniform(size=(50, 3))) == pytest.approx(7)


@pytest.mark.parametrize("name", BASES)
@pytest.mark.parametrize("degree", [3, 5])
def test_gradient_and_hessian_are_those_of_the_values(name, degree):
    spline = _made(name, degree)
    points = BOX.from_unit(np.random.default_rng(5).uniform(0.01, 0.99, size=(20, 2)))
    steps = 1e-5 * np.diag(BOX.widths)
    slopes = [(spline(points + step) - spline(points - step)) / (2 * step.sum()) for step in steps]
    assert spline.gradient(points) == pytest.approx(np.stack(slopes, axis=-1), abs=1e-6)
    bends = [(spline.gradient(points + step) - spline.gradient(points - step)) / (2 * step.sum()) for step in steps]
    assert spline.hessian(points) == pytest.approx(np.stack(bends, axis=-1), abs=1e-6, rel=1e-6)


def test_derivatives_in_closed_form():
    """f = x² y³ + y on [10, 150] x [0, 2]: within the space of cubic not-a-knot splines."""
    one = basis("not_a_knot")
    hierarchizer = Hierarchizer(SparseGrid.regular(2, 3, boundary=True), one, BOX)
    spline = hierarchizer.interpolant((lambda x, y: x**2 * y**3 + y)(*hierarchizer.points.T))
    x, y = 42.0, 1.3
    assert spline.gradient(np.array([x, y])) == pytest.approx([2 * x * y**3, 3 * x**2 * y**2 + 1], rel=1e-10)
    hessian = [[2 * y**3, 6 * x * y**2], [6 * x * y**2, 6 * x**2 * y]]
    assert spline.hessian(np.array([x, y])) == pytest.approx(np.array(hessian), rel=1e-10)


@pytest.mark.parametrize("name", BASES)
def test_one_by_one_is_the_same_as_all_at_once(name):
    spline = _made(name)
    points = BOX.from_unit(np.random.default_rng(2).uniform(size=(3, 7, 2)))
    points[0, 0], points[0, 1] = BOX.lower, BOX.upper
    flat = points.reshape(-1, 2)
    assert np.stack([spline(one) for one in flat]).reshape(3, 7, 2) == pytest.approx(spline(points), abs=1e-13)
    assert np.stack([spline.gradient(one) for one in flat]).reshape(3, 7, 2, 2) == pytest.approx(
        spline.gradient(points), abs=1e-13
    )
    assert np.stack([spline.hessian(one[None])[0] for one in flat]).reshape(3, 7, 2, 2, 2) == pytest.approx(
        spline.hessian(points), abs=1e-13
    )


def test_many_points_are_taken_some_at_a_time():
    one = basis("modified_clenshaw_curtis")
    grid = SparseGrid.regular(2, 7)
    spline = interpolate(grid, one, grid.coordinates(one)[:, 0] ** 2)
    points = np.random.default_rng(0).uniform(size=(2500, 2))
    assert len(spline._blocks(points)) > 1
    assert spline(points) == pytest.approx(points[:, 0] ** 2, abs=1e-4)
    assert spline.gradient(points)[-1] == pytest.approx(spline.gradient(points[-1]))
    assert spline(np.empty((0, 2))).shape == (0,)


def test_points_outside_are_refused():
    spline = _made("modified")
    for ask in (spline, spline.gradient, spline.hessian):
        with pytest.raises(InputError, match=r"coordinate 1 from 0 to 2, got 2\.1 in point 0"):
            ask(np.array([20.0, 2.1]))
        with pytest.raises(InputError, match=r"points of shape \(\.\.\., 2\), got \(3,\)"):
            ask(np.zeros(3))
        ask(np.array([150 + 1e-8, 0.0]))


def test_wrong_values_are_refused():
    grid, one = SparseGrid.regular(2, 2), basis("modified")
    values = np.ones((5, 4))
    with pytest.raises(InputError, match=r"expected values of shape \(5, \.\.\.\), got \(4, 4\)"):
        interpolate(grid, one, values[:4])
    values[[2, 4], 3] = np.nan, np.inf
    with pytest.raises(InputError, match=r"got 2 points whose values are not, the first is point 2 at \(80, 1\.5\)"):
        interpolate(grid, one, values, BOX)


def test_grid_basis_and_domain_belong_together():
    with pytest.raises(InputError, match="without boundary points for the basis 'modified', got one with"):
        Hierarchizer(SparseGrid.regular(2, 2, boundary=True), basis("modified"))
    with pytest.raises(InputError, match="expected a domain of 3 dimensions, got 2"):
        Hierarchizer(SparseGrid.regular(3, 2), basis("modified"), BOX)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_functions_that_depend_on_each_other_are_an_error():
    """Every level the same straight line: two functions fewer than points."""
    line = BSpline(np.array([0.0, 0, 1, 1]), np.array([[0.0], [1.0]]), 1)
    twice = Basis(
        "line", 1, "uniform", False, lambda _, __, indices: BSpline(line.t, line.c.repeat(len(indices), 1), 1)
    )
    with pytest.raises(NotConvergedError, match="use a grid that holds the parents"):
        interpolate(SparseGrid.regular(1, 2), twice, np.array([1.0, 0.0, 3.0]))
