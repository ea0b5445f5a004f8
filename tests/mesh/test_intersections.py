"""Triangles that cut each other: beside a second way of finding them, and the doubtful cases."""

import numpy as np
import pytest

from myograph.mesh.surface.intersections import cutting_pairs, meeting_place


def _cut(one, other):
    points = np.vstack([one, other, [[-50.0, -50, -50], [50, 50, 50]]]).astype(float)
    return len(cutting_pairs(points, np.array([[0, 1, 2], [3, 4, 5]]))) == 1


def _side_passes(sides, triangle):
    """A side of one triangle passes through the other: the signs of five volumes."""

    def volume(a, b, c, d):
        return np.sign(np.linalg.det(np.array([b - a, c - a, d - a])))

    for k in range(3):
        p, q = sides[k], sides[k - 1]
        a, b, c = triangle
        if volume(p, a, b, c) != volume(q, a, b, c) and volume(p, q, a, b) == volume(p, q, b, c) == volume(p, q, c, a):
            return True
    return False


def test_random_triangles_cut_each_other_where_a_side_of_one_passes_the_other():
    rng, found = np.random.default_rng(0), []
    for _ in range(400):
        one, other = rng.uniform(-1, 1, (2, 3, 3))
        expected = _side_passes(one, other) or _side_passes(other, one)
        assert _cut(one, other) == expected
        found.append(expected)
    assert 50 < sum(found) < 350


FLAT = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0]])


@pytest.mark.parametrize(
    ("other", "cuts"),
    [
        ([[4, 0, 0], [0, 4, 0], [4, 4, 0]], False),
        ([[4, 0, 0], [0, 4, 0], [1, 1, 3]], False),
        ([[0, 0, 0], [1, 1, 3], [2, 1, 3]], False),
        ([[0, 0, 0], [-4, 0, 0], [0, -4, 0]], False),
        ([[1, 1, 0], [2, 1, 0], [1, 2, 0]], True),
        ([[4, 0, 0], [0, 4, 0], [1, 1, 0]], True),
        ([[0, 0, 0], [3, 3, 1], [3, 3, -1]], True),
        ([[1, 1, -1], [1, 1, 1], [9, 9, 1]], True),
        ([[1, 1, 0.5], [9, 9, 0.5], [9, 1, 0.5]], False),
    ],
    ids=[
        "flat neighbours",
        "folded neighbours",
        "a common corner, above",
        "a common corner, beside",
        "inside it, in its plane",
        "folded onto it",
        "through it from a common corner",
        "through it",
        "above it",
    ],
)
def test_neighbours_may_touch_and_nothing_may_pass(other, cuts):
    assert _cut(FLAT, np.array(other, dtype=float)) is cuts


def test_the_meeting_place_lies_on_both():
    other = np.array([[1.0, 1, -1], [1, 1, 1], [9, 9, 1]])
    assert meeting_place(FLAT, other) == pytest.approx([1.5, 1.5, 0.0])


def test_pairs_are_found_among_many():
    """Two sheets of triangles, and one spike through both."""
    x, y = np.meshgrid(np.arange(8.0), np.arange(8.0), indexing="ij")
    corners = [
        [[a, b, z], [a + 0.9, b, z], [a, b + 0.9, z]] for z in (0.0, 1.0) for a, b in zip(x.flat, y.flat, strict=True)
    ]
    corners.append([[3.2, 3.2, -1], [3.3, 3.2, 2], [3.2, 3.3, 2]])
    points = np.array(corners).reshape(-1, 3)
    pairs = cutting_pairs(points, np.arange(len(points)).reshape(-1, 3))
    assert sorted(map(sorted, pairs.tolist())) == [[27, 128], [91, 128]]
