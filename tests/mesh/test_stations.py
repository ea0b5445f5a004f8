"""Along a body that was not swept: closed forms on boxes of tetrahedra."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.mesh.laplace import potential
from myograph.mesh.muscle_mesh import MuscleMesh
from myograph.mesh.quality import check_mesh, mean_ratios, scaled_jacobians
from myograph.mesh.stations import stations
from myograph.mesh.tetrahedra import TET10
from tests.mesh.shapes import box_of_tetrahedra

POINTS, CELLS = box_of_tetrahedra((40.0, 6.0, 5.0), (16, 3, 2))


def _at(points, column, value):
    return np.flatnonzero(np.isclose(points[:, column], value))


def _mesh(points):
    zero = np.zeros(len(points))
    return MuscleMesh(TET10, points, CELLS, {}, zero, zero, 1.0)


def test_the_potential_of_a_box_is_linear():
    values = potential(TET10, POINTS, CELLS, (_at(POINTS, 0, 0.0), _at(POINTS, 0, 40.0)))
    assert values == pytest.approx(POINTS[:, 0] / 40, abs=1e-12)


def test_a_box_has_its_length_its_section_and_its_coordinate():
    found = stations(POINTS, CELLS, (_at(POINTS, 0, 0.0), _at(POINTS, 0, 40.0)), "box")
    assert found.length == pytest.approx(40.0, rel=1e-3)
    assert found.along == pytest.approx(POINTS[:, 0] / 40, abs=2e-3)
    assert found.area == pytest.approx(30.0, rel=0.05)


def test_a_wedge_has_the_sections_of_a_wedge():
    """Its width grows from 6 to 18: A = 30 (1 + 2 s); level surfaces of the potential are arcs, nearly flat here."""
    points = POINTS.copy()
    points[:, 1] = (points[:, 1] - 3) * (1 + 2 * points[:, 0] / 40)
    found = stations(points, CELLS, (_at(points, 0, 0.0), _at(points, 0, 40.0)), "wedge")
    middle = (found.along > 0.1) & (found.along < 0.9)
    assert found.area[middle] == pytest.approx(30 * (1 + 2 * found.along[middle]), rel=0.05)
    assert found.along == pytest.approx(points[:, 0] / 40, abs=0.03)


def test_a_bent_bar_is_as_long_as_its_middle_line():
    """A quarter of a ring of radius 60: the current runs a little shorter, on the inner side."""
    angle, radius = POINTS[:, 0] / 40 * np.pi / 2, 60 + POINTS[:, 1] - 3
    points = np.column_stack([radius * np.sin(angle), radius * np.cos(angle), POINTS[:, 2]])
    ends = (_at(POINTS, 0, 0.0), _at(POINTS, 0, 40.0))
    assert stations(points, CELLS, ends, "arc").length == pytest.approx(60 * np.pi / 2, rel=5e-3)


def test_a_part_beside_the_way_is_refused_because_fibres_have_no_direction_there():
    """Attached at one end and in the middle of a side: the other half lies idle."""
    side = np.flatnonzero((POINTS[:, 1] == 0) & (POINTS[:, 0] > 14) & (POINTS[:, 0] < 19))
    with pytest.raises(
        InputError, match=r"bar: the fibres have no direction in 0\.\d+ cm³ around \[3\d\.\d, 3\.0, 2\.5\]"
    ):
        stations(POINTS, CELLS, (_at(POINTS, 0, 0.0), side), "bar")


def test_straight_tetrahedra_have_a_scaled_jacobian_of_one_and_the_mean_ratio_of_their_shape():
    """The corner tetrahedron of a cube: V = 1/6, Σ l² = 9:  12 (1/2)^(2/3) / 9."""
    corners = np.vstack([np.zeros((1, 3)), np.eye(3)])
    nodes = np.einsum("nc,cx->nx", np.column_stack([1 - TET10.nodes.sum(axis=1), TET10.nodes]), corners)
    zero = np.zeros(10)
    mesh = MuscleMesh(TET10, nodes, np.arange(10)[None], {}, zero, zero, 1.0)
    assert scaled_jacobians(mesh) == pytest.approx(1.0)
    assert mean_ratios(mesh) == pytest.approx(12 * 0.5 ** (2 / 3) / 9)


def test_inverted_and_needle_tetrahedra_are_refused_by_name():
    points = POINTS.copy()
    check_mesh(_mesh(points), "bar")
    points[CELLS[7, 0]] = points[CELLS[7, 1:4]].mean(axis=0) + (
        points[CELLS[7, 1:4]].mean(axis=0) - points[CELLS[7, 0]]
    )
    with pytest.raises(InputError, match=r"mesh of bar: element \d+ at .* mm has a scaled Jacobian of -.*element size"):
        check_mesh(_mesh(points), "bar")
    with pytest.raises(
        InputError, match=r"mesh of bar: element \d+ at .* has a mean ratio of 0\.0\d+, expected at least"
    ):
        check_mesh(_mesh(POINTS * (1.0, 1e-3, 1.0)), "bar")
