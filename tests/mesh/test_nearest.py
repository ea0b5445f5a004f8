"""Nearest points, beside looking everywhere."""

import numpy as np
import pytest

from myograph.mesh.surface.nearest import NearestOnSurface, halved, nearest_in_triangles, nearest_on_line
from tests.mesh.shapes import box, spindle


def test_the_nearest_point_of_a_triangle_is_the_nearest_of_very_many():
    rng = np.random.default_rng(0)
    shares = np.array([(a, b, 120 - a - b) for a in range(121) for b in range(121 - a)]) / 120
    for _ in range(30):
        corners, place = rng.uniform(-1, 1, (3, 3)), rng.uniform(-2, 2, 3)
        nearest = nearest_in_triangles(place[None], corners[None])[0]
        distance = np.linalg.norm(shares @ corners - place, axis=1).min()
        assert np.linalg.norm(nearest - place) == pytest.approx(distance, abs=2e-3)
        assert np.linalg.norm(nearest - place) <= distance + 1e-12


def test_a_surface_finds_what_looking_at_all_its_triangles_finds():
    """Long triangles beside short ones, places inside and outside."""
    surface = spindle()
    places = np.random.default_rng(1).uniform((-30, -30, -20), (30, 30, 120), (60, 3))
    nearest, triangles = NearestOnSurface(surface.points, surface.triangles).find(places)
    corners = surface.points[surface.triangles]
    for place, found, triangle in zip(places, nearest, triangles, strict=True):
        everywhere = nearest_in_triangles(np.broadcast_to(place, (len(corners), 3)), corners)
        distance = np.linalg.norm(everywhere - place, axis=1)
        assert np.linalg.norm(found - place) == pytest.approx(distance.min(), rel=1e-12)
        assert distance[triangle] == pytest.approx(distance.min(), rel=1e-12)


def test_halving_keeps_the_surface_and_its_owners():
    surface = box((8.0, 1.0, 2.0))
    pieces, owner = halved(surface.points[surface.triangles], 0.7)
    areas = 0.5 * np.linalg.norm(np.cross(pieces[:, 1] - pieces[:, 0], pieces[:, 2] - pieces[:, 0]), axis=1)
    whole = surface.points[surface.triangles]
    expected = 0.5 * np.linalg.norm(np.cross(whole[:, 1] - whole[:, 0], whole[:, 2] - whole[:, 0]), axis=1)
    assert np.bincount(owner, areas) == pytest.approx(expected)
    assert np.linalg.norm(pieces - np.roll(pieces, 1, axis=1), axis=2).max() <= 0.7


def test_the_nearest_point_of_a_line_is_an_end_or_a_foot():
    starts, ends = np.array([[0.0, 0, 0], [2, 0, 0]]), np.array([[2.0, 0, 0], [2, 2, 0]])
    places = np.array([[1.0, 1, 3], [5, 1, 0], [-1, -1, 0], [3, 3, 0]])
    assert nearest_on_line(places, starts, ends) == pytest.approx(
        np.array([[1.0, 0, 0], [2, 1, 0], [0, 0, 0], [2, 2, 0]])
    )
