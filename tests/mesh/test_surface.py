"""Closed surfaces: what bounds a body, and what is refused, with the place."""

import os
import re
from pathlib import Path

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.mesh.surface import closed_surface, read_surface
from tests.mesh.shapes import box, box_triangles, spindle

ROOT = Path(os.environ.get("MYOGRAPH_REFERENCE_DATA", Path(__file__).parents[3] / "shared" / "data")) / "opendihu"
reference = pytest.mark.skipif(not ROOT.exists(), reason="the reference data are not here; set MYOGRAPH_REFERENCE_DATA")


def test_a_box_of_loose_triangles_is_a_closed_surface():
    points, triangles = box_triangles((2.0, 3.0, 4.0), (2, 3, 4))
    surface = closed_surface(points[triangles].reshape(-1, 3), np.arange(triangles.size).reshape(-1, 3))
    assert len(surface.points) == 2 * (3 * 4 + 4 * 5 + 3 * 5) - 4 * (3 + 4 + 5) + 8
    assert surface.volume == pytest.approx(24.0)


def test_a_surface_seen_from_inside_is_turned():
    points, triangles = box_triangles()
    assert closed_surface(points, triangles[:, ::-1]).volume == pytest.approx(1.0)


def test_the_skin_of_a_mesh_is_a_closed_surface():
    """∫ π r² dz with r = 6 + 12 sin²: the mean of r² is 36 + 2 · 6 · 12 / 2 + 144 · 3/8 = 162."""
    assert spindle().volume == pytest.approx(np.pi * 162 * 100, rel=0.01)


def _changed(change):
    points, triangles = box_triangles((2.0, 2.0, 2.0), (2, 2, 2))
    surface = closed_surface(points, triangles)
    return change(surface.points.copy(), surface.triangles.copy())


def _hole(points, triangles):
    return points, triangles[1:]


def _wall_inside(points, triangles):
    def at(*place):
        return int(np.argmin(np.linalg.norm(points - place, axis=1)))

    wall = [[at(1, 0, 0), at(1, 2, 0), at(1, 2, 2)], [at(1, 0, 0), at(1, 2, 2), at(1, 0, 2)]]
    return points, np.vstack([triangles, wall])


def _one_wall_more(points, triangles):
    return points, np.vstack([triangles, triangles[:1, ::-1], triangles[:1]])


def _one_turned(points, triangles):
    triangles[5] = triangles[5][::-1]
    return points, triangles


def _two_shells(points, triangles):
    return np.vstack([points, 0.5 + points / 4]), np.vstack([triangles, triangles[:, ::-1] + len(points)])


def _pinch(points, triangles):
    low = int(np.argmin(np.linalg.norm(points - (1, 1, 0), axis=1)))
    high = int(np.argmin(np.linalg.norm(points - (1, 1, 2), axis=1)))
    return points, np.where(triangles == high, low, triangles)


def _double_point(points, triangles):
    a, b, _ = triangles[0]
    return points, np.vstack([triangles, [[a, b, b]]])


def _needle(points, triangles):
    a, b, c = triangles[0]
    middle = 0.5 * (points[a] + points[b]) + 1e-3 * (points[c] - points[a])
    new = len(points)
    fan = [[a, b, new], [b, c, new], [c, a, new]]
    return np.vstack([points, middle]), np.vstack([triangles[1:], fan])


def _through_itself(points, triangles):
    points[np.argmin(np.linalg.norm(points - (1, 1, 0), axis=1))] = (1.1, 0.9, 3.0)
    return points, triangles


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (_hole, "surface: open: 3 edges have a triangle on one side only, the first from (0.00, "),
        (_wall_inside, "surface: open: 4 edges"),
        (_one_wall_more, "surface: 3 edges belong to more than two triangles, the first from"),
        (_one_turned, "triangles 0 and 5 at their common edge from"),
        (_two_shells, "2 separate shells (of 48, 48 triangles), the smallest at"),
        (_pinch, "two parts touch in the single point (1.00, 1.00, 0.00)"),
        (_double_point, "1 triangles have no area because two corners are one point, the first is 48 at"),
        (_needle, "triangle 47 at"),
        (_through_itself, "cut each other near"),
    ],
)
def test_what_bounds_no_single_body_is_refused_with_the_place(change, message):
    with pytest.raises(InputError, match=re.escape(message)):
        closed_surface(*_changed(change))


def test_a_needle_is_named_with_its_angle():
    with pytest.raises(InputError, match=r"needle: its smallest angle is 0\.1\d* degrees, expected at least 0\.5"):
        closed_surface(*_changed(_needle))


def test_triangles_that_cut_each_other_are_named_with_the_place():
    """The spike at (1.1, 0.9, 3) leaves the box through its lid at z = 2."""
    with pytest.raises(InputError, match=r"triangles \d+ and \d+ cut each other near \(\d\.\d+, \d\.\d+, 2\.00\)"):
        closed_surface(*_changed(_through_itself))


@pytest.mark.reference
@reference
def test_the_reference_biceps_is_a_closed_surface_of_320_cm3():
    assert read_surface(ROOT / "biceps_full.stl").volume == pytest.approx(320e3, rel=0.002)


@pytest.mark.reference
@reference
def test_the_reference_triceps_is_refused_for_its_interior_faces():
    with pytest.raises(InputError, match=r"left_triceps_brachii\.stl: 968 edges belong to more than two triangles"):
        read_surface(ROOT / "left_triceps_brachii.stl")


def test_a_box_may_be_flat():
    assert box((20.0, 6.0, 0.5), (10, 3, 1)).volume == pytest.approx(60.0)
