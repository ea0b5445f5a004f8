"""Sections of an interpolant are the interpolant itself along a line, with its derivatives."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.interpolation import Domain, Hierarchizer, SparseGrid, basis, interpolate
from myograph.interpolation.section import Sections

DOMAIN = Domain(np.array([0.2, -1.0]), np.array([2.5, 3.0]))
X = np.linspace(0.2, 2.5, 57)


def _spline(name, degree, level=4):
    splines = Hierarchizer(SparseGrid.regular(2, level, name == "not_a_knot"), basis(name, degree), DOMAIN)
    x, y = splines.points.T
    return splines.interpolant((np.sin(2 * x) * np.exp(0.3 * y) + x * y**2)[:, None])


@pytest.fixture(
    scope="module", params=[("modified_clenshaw_curtis", 3), ("not_a_knot", 5), ("modified", 1)], ids=lambda one: one[0]
)
def spline(request):
    return _spline(*request.param)


@pytest.mark.parametrize("y", [-1.0, 0.37, 3.0])
def test_a_section_is_the_interpolant_along_a_line(spline, y):
    section = Sections(spline).held(y)
    points = np.stack([X, np.full(len(X), y)], axis=1)
    assert section(X) == pytest.approx(spline(points)[:, 0], abs=1e-11)
    assert [section.at(x) for x in X.tolist()] == pytest.approx(spline(points)[:, 0], abs=1e-11)


def test_derivatives_along_and_across_are_those_of_the_interpolant(spline):
    sections, y = Sections(spline), 0.37
    across, along = sections.held(y, derivative=1), sections.held(y)
    for x in (0.2, 0.913, 2.111, 2.5):
        gradient = spline.gradient(np.array([x, y]))[0]
        assert [along.slope(x), across.at(x)] == pytest.approx(gradient, abs=1e-10)


def test_sections_with_the_same_breaks_add():
    sections = Sections(_spline("modified_clenshaw_curtis", 3))
    a, b = sections.held(0.1), sections.held(1.9)
    assert (a + b)(X) == pytest.approx(a(X) + b(X), abs=1e-12)


@pytest.mark.parametrize("place", [0.19, 2.51])
def test_outside_the_range_is_refused(place):
    sections = Sections(_spline("modified_clenshaw_curtis", 3))
    section = sections.held(0.0)
    for ask in (lambda: section.at(place), lambda: section.slope(place), lambda: section(np.array([1.0, place]))):
        with pytest.raises(InputError, match=r"expected a place from 0.2 to 2.5, got"):
            ask()
    with pytest.raises(InputError, match=r"expected a place from -1 to 3, got 3.1"):
        sections.held(3.1)


def test_only_two_coordinates_with_one_component_have_sections():
    grid = SparseGrid.regular(2, 2)
    two = interpolate(grid, basis("modified"), np.zeros((len(grid), 2)))
    with pytest.raises(InputError, match="expected an interpolant of two coordinates with one component, got 2 and 2"):
        Sections(two)


def test_further_breaks_change_no_value(spline):
    more = np.array([0.111, 0.5, 0.73])
    plain, refined = Sections(spline), Sections(spline, more)
    assert set(np.round(refined.breaks, 12)) == set(np.round(np.concatenate([plain.breaks, more]), 12))
    assert refined.held(0.3)(X) == pytest.approx(plain.held(0.3)(X), rel=1e-12, abs=1e-13)
    assert refined.held(0.3).slope(1.2) == pytest.approx(plain.held(0.3).slope(1.2), rel=1e-11)


def test_sections_of_other_grids_add_on_common_breaks():
    fine, coarse = (_spline("modified_clenshaw_curtis", 3, level) for level in (4, 2))
    together = np.concatenate([Sections(fine).breaks, Sections(coarse).breaks])
    one, other = (Sections(function, together).held(0.3) for function in (fine, coarse))
    assert (one + other)(X) == pytest.approx(Sections(fine).held(0.3)(X) + Sections(coarse).held(0.3)(X), rel=1e-11)
