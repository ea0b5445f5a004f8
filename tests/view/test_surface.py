"""Surfaces: capsules are closed and round, normals point out, mistakes are named."""

from collections import Counter

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.view import Surface, capsule
from myograph.view.surface import node_normals

START, END, RADIUS = np.array([10.0, -4.0, 2.0]), np.array([40.0, 30.0, -90.0]), 11.0


@pytest.fixture
def bone() -> Surface:
    return capsule(START, END, RADIUS, "bone", "#e8d9b8")


def half_edges(quads: np.ndarray) -> Counter:
    edges = ((int(a), int(b)) for quad in quads for a, b in zip(quad, np.roll(quad, -1), strict=True))
    return Counter((a, b) for a, b in edges if a != b)


def volume(points: np.ndarray, quads: np.ndarray) -> float:
    """Divergence theorem over both triangles of each quadrilateral."""
    a, b, c, d = np.moveaxis(points[quads], 1, 0)
    return float(np.sum(a * np.cross(b, c) + a * np.cross(c, d)) / 6)


def test_a_capsule_is_closed(bone):
    """Every edge is passed once in each direction."""
    edges = half_edges(bone.quads)
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)


def test_every_node_of_a_capsule_is_a_radius_away_from_its_axis(bone):
    axis = END - START
    share = np.clip((bone.points - START) @ axis / (axis @ axis), 0, 1)
    distance = np.linalg.norm(bone.points - START - share[:, None] * axis, axis=1)
    np.testing.assert_allclose(distance, RADIUS, rtol=1e-12)


def test_a_capsule_encloses_its_volume(bone):
    """Cylinder and ball, less the few per mille that chords cut off."""
    exact = np.pi * RADIUS**2 * np.linalg.norm(END - START) + 4 / 3 * np.pi * RADIUS**3
    assert volume(bone.points, bone.quads) == pytest.approx(exact, rel=0.01)


def test_normals_of_a_capsule_point_away_from_its_axis(bone):
    axis = END - START
    share = np.clip((bone.points - START) @ axis / (axis @ axis), 0, 1)
    outward = (bone.points - START - share[:, None] * axis) / RADIUS
    assert np.sum(node_normals(bone.points, bone.quads) * outward, axis=1).min() > 0.99


def test_a_node_without_quadrilaterals_has_no_normal():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [5, 5, 5]])
    np.testing.assert_array_equal(node_normals(points, np.array([[0, 1, 2, 3]])), [[0, 0, 1]] * 4 + [[0, 0, 0]])


@pytest.mark.parametrize(("end", "radius"), [(START, 3.0), (END, 0.0), (END, -1.0), (END, np.nan)])
def test_a_capsule_without_length_or_radius_is_refused(end, radius):
    with pytest.raises(InputError, match="capsule 'ulna': expected a radius and a length above 0"):
        capsule(START, end, radius, "ulna", "#e8d9b8")


@pytest.mark.parametrize("quads", [np.array([[0, 1, 2, 4]]), np.array([[0, -1, 2, 3]]), np.zeros((0, 4), dtype=int)])
def test_quadrilaterals_must_have_corners_among_the_points(quads):
    with pytest.raises(InputError, match="surface 'biceps': expected quadrilaterals with corners among the 4 points"):
        Surface(np.zeros((4, 3)), quads, "biceps", "#d55e00")


def test_coordinates_must_be_numbers():
    points = np.zeros((4, 3))
    points[2, 1] = np.nan
    with pytest.raises(InputError, match="surface 'biceps': expected finite coordinates"):
        Surface(points, np.array([[0, 1, 2, 3]]), "biceps", "#d55e00")
