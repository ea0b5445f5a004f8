"""Surfaces drawn anew: sizes, shapes, creases, and the body they bound."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.mesh.muscle_mesh import FACETS
from myograph.mesh.surface import Attachment, Attachments, closed_surface
from myograph.mesh.surface.attachments import surface_parts
from myograph.mesh.surface.checks import smallest_angles
from myograph.mesh.surface.creases import CreaseFinder
from myograph.mesh.surface.drawn import Drawn
from myograph.mesh.surface.nearest import NearestOnSurface
from myograph.mesh.surface.remesh import remesh
from myograph.mesh.surface.sizes import element_sizes, halved_near
from tests.mesh.shapes import box, spindle

ENDS = Attachments((Attachment((0.0, 0.0, 0.0), 6.3),), (Attachment((0.0, 0.0, 100.0), 6.3),))


def _edges(points, triangles):
    ends = points[triangles[:, [[0, 1], [1, 2], [2, 0]]]].reshape(-1, 2, 3)
    return np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1), ends.mean(axis=1)


@pytest.fixture(scope="module")
def drawn():
    surface = spindle()
    sizes = element_sizes(surface, 9.0)
    return Drawn(surface, surface_parts(surface, ENDS), sizes), sizes


@pytest.fixture(scope="module")
def skin(drawn):
    return remesh(*drawn)


def test_sizes_are_as_asked_where_the_body_is_thick_and_finer_where_it_is_slim():
    """Six around the ends of radius 6, of perimeter 12 π; no step of more than 0.3 a mm."""
    sizes = element_sizes(spindle(), 9.0)
    place = np.array([[18.0, 0.0, 50.0], [6.0, 0.0, 3.0], [6.0, 0.0, 97.0]])
    assert sizes(place)[0] == 9.0
    assert sizes(place)[1:] == pytest.approx(2 * np.pi, rel=0.15)
    near = halved_near(sizes, place[:1])
    assert near(place[:1])[0] == 4.5
    assert near(place[:1] + np.array([0, 0, 5.0]))[0] == pytest.approx(6.0)


def test_a_remeshed_spindle_has_edges_as_wanted_and_no_needles(drawn, skin):
    """The chords of a twelve-gon alone lose 4.5 per cent of the circle; curving gives it back later."""
    lengths, middles = _edges(skin.points, skin.triangles)
    relative = lengths / drawn[1](middles)
    assert np.percentile(relative, [1, 99]) == pytest.approx([0.95, 0.95], abs=0.55)
    assert np.median(relative) == pytest.approx(1.0, abs=0.15)
    assert np.degrees(smallest_angles(skin.points, skin.triangles).min()) > 20
    assert closed_surface(skin.points, skin.triangles).volume == pytest.approx(drawn[0].surface.volume, rel=0.06)


def test_its_points_lie_on_the_drawn_surface_and_its_rims_on_the_drawn_rims(drawn, skin):
    part = np.full(len(skin.points), 2)
    np.minimum.at(part, skin.triangles.ravel(), np.repeat(skin.parts, 3))
    settled = drawn[0].settled(skin.points, part, np.zeros(len(part), dtype=bool)).places
    assert np.linalg.norm(settled - skin.points, axis=1).max() < 0.4
    for name, height in (("origin", 0.0), ("insertion", 100.0)):
        points = skin.points[np.unique(skin.triangles[skin.parts == FACETS.index(name)])]
        assert points[:, 2] == pytest.approx(height, abs=1e-9)
        assert np.linalg.norm(points[:, :2], axis=1).max() == pytest.approx(6.0, abs=0.2)


def _drawn_box(size, cells, edge):
    surface = box(size, cells)
    sizes = element_sizes(surface, edge)
    return Drawn(surface, np.full(len(surface.triangles), 2), sizes), sizes


def test_a_box_keeps_its_corners_and_edges():
    """Its volume is exact only if nothing of its twelve edges is planed off."""
    skin = remesh(*_drawn_box((30.0, 20.0, 20.0), (12, 8, 8), 6.0))
    volume = closed_surface(skin.points, skin.triangles).volume
    assert volume == pytest.approx(12000.0, rel=2e-3)
    assert len(skin.triangles) < 300


def test_a_thin_plate_is_remeshed_without_jumping_through_it():
    """A plate of 0.4 mm with edges of some millimetres: a nearest point may lie on its other side.

    Its sides may become single edges, half its thickness away from where it was drawn, but no more.
    """
    drawn, sizes = _drawn_box((30.0, 20.0, 0.4), (20, 14, 1), 5.0)
    skin = remesh(drawn, sizes)
    closed_surface(skin.points, skin.triangles)
    nearest, _ = NearestOnSurface(skin.points, skin.triangles).find(drawn.surface.points)
    assert np.linalg.norm(nearest - drawn.surface.points, axis=1).max() < 0.21
    assert len(skin.triangles) < 400


def test_faces_edges_and_corners_of_a_box_are_told_apart():
    surface = box((10.0, 10.0, 10.0), (20, 20, 20))
    finder = CreaseFinder(surface.points[surface.triangles])
    places = np.array([[5.0, 5.0, 9.9], [5.0, 9.8, 9.9], [9.9, 9.8, 9.9]])
    creases = finder.find(places, np.full(3, 1.5))
    assert creases.rank.tolist() == [1, 2, 3]
    assert places + creases.snap == pytest.approx(np.array([[5.0, 5, 10], [5, 10, 10], [10, 10, 10]]), abs=1e-9)
    assert np.trace(creases.across, axis1=1, axis2=2) == pytest.approx([1, 2, 3])


def test_attachments_grow_to_the_sharp_edge_around_them():
    surface = spindle()
    parts = surface_parts(surface, ENDS)
    for name, height in (("origin", 0.0), ("insertion", 100.0)):
        face = surface.triangles[parts == FACETS.index(name)]
        corners = surface.points[face]
        assert corners[..., 2] == pytest.approx(height)
        areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
        assert areas.sum() == pytest.approx(np.pi * 36, rel=0.02)


@pytest.mark.parametrize(
    ("attachments", "message"),
    [
        (
            Attachments((Attachment((0.0, 0.0, -9.0), 5.0),), ENDS.insertion),
            r"within its radius of 5 mm .* got one 9\.0 mm",
        ),
        (Attachments((), ENDS.insertion), "origin: expected at least one attachment"),
        (Attachments(ENDS.origin, ENDS.origin), "are faces that meet: the fibres between them would have no length"),
        (
            Attachments((Attachment((18.0, 0.0, 50.0), 9.0),), (Attachment((18.0, 0.0, 55.0), 9.0),)),
            r"origin at \(18\.0, 0\.0, 50\.0\) mm within 9 mm and insertion .* are faces that meet",
        ),
    ],
)
def test_attachments_that_do_not_fit_are_refused(attachments, message):
    with pytest.raises(InputError, match=message):
        surface_parts(spindle(), attachments)
