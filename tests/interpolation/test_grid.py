"""Sparse grids, regular and refined."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.interpolation import SparseGrid, basis, interpolate
from myograph.interpolation.tree import keys


def _is_closed(grid):
    """Whether every point has its parent in every dimension: the one odd number among the halves of i ± 1."""
    known = keys(grid.levels, grid.indices)
    for point in known:
        for k, (level, index) in enumerate(point):
            pairs = [(level - 1, index // 2 | 1)] if level > 1 else []
            if level == 1 and grid.boundary:
                pairs = [(0, 0), (0, 1)]
            if not all((*point[:k], pair, *point[k + 1 :]) in known for pair in pairs):
                return False
    return True


@pytest.mark.parametrize(("level", "points"), [(1, 1), (2, 11), (3, 71), (4, 351), (5, 1471), (6, 5503)])
def test_regular_grids_have_the_published_sizes(level, points):
    assert len(SparseGrid.regular(5, level)) == points
    assert len(SparseGrid.regular(2, 4)) == 49


@pytest.mark.parametrize(("dimension", "level", "points"), [(1, 3, 9), (2, 1, 9), (2, 3, 49), (3, 1, 27)])
def test_regular_grids_with_boundary_points(dimension, level, points):
    assert len(SparseGrid.regular(dimension, level, boundary=True)) == points


def test_a_face_carries_the_regular_grid_of_the_same_level():
    grid = SparseGrid.regular(3, 3, boundary=True)
    face = (grid.levels[:, 0] == 0) & (grid.indices[:, 0] == 1)
    plane = SparseGrid.regular(2, 3, boundary=True)
    assert (grid.levels[face, 1:] == plane.levels).all()
    assert (grid.indices[face, 1:] == plane.indices).all()


@pytest.mark.parametrize("boundary", [False, True])
def test_a_coarse_grid_is_the_beginning_of_the_next(boundary):
    coarse, fine = (SparseGrid.regular(3, level, boundary) for level in (3, 4))
    assert (fine.levels[: len(coarse)] == coarse.levels).all()
    assert (fine.indices[: len(coarse)] == coarse.indices).all()
    assert _is_closed(fine)


def test_coordinates_for_both_spacings():
    grid = SparseGrid(np.array([[2], [1], [0]]), np.array([[3], [1], [1]]))
    assert grid.coordinates("uniform")[:, 0] == pytest.approx([0.75, 0.5, 1])
    assert grid.coordinates("clenshaw_curtis")[:, 0] == pytest.approx([(1 + np.sqrt(0.5)) / 2, 0.5, 1])
    assert (grid.coordinates(basis("clenshaw_curtis")) == grid.coordinates("clenshaw_curtis")).all()
    with pytest.raises(InputError, match="'uniform' or 'clenshaw_curtis', got 'chebyshev'"):
        grid.coordinates("chebyshev")


@pytest.mark.parametrize("boundary", [False, True])
def test_refinement_keeps_the_order_and_adds_children_and_all_ancestors(boundary):
    rng = np.random.default_rng(3)
    grid = SparseGrid.regular(3, 2, boundary)
    for _ in range(4):
        chosen = rng.integers(len(grid), size=3)
        finer = grid.refined(chosen)
        assert (finer.levels[: len(grid)] == grid.levels).all()
        assert (finer.indices[: len(grid)] == grid.indices).all()
        assert _is_closed(finer)
        known = keys(finer.levels, finer.indices)
        for point in keys(grid.levels[chosen], grid.indices[chosen]):
            for k, (level, index) in enumerate(point):
                below = [(level + 1, 2 * index - 1), (level + 1, 2 * index + 1)] if level else [(1, 1)]
                assert all((*point[:k], pair, *point[k + 1 :]) in known for pair in below)
        grid = finer


def test_one_refinement_by_hand():
    """The point (1/4, 1/2) needs (1/8, 1/2), (3/8, 1/2), (1/4, 1/4), (1/4, 3/4); the last two (1/2, 1/4 or 3/4)."""
    grid = SparseGrid(np.array([[1, 1], [2, 1]]), np.array([[1, 1], [1, 1]]))
    mask = np.array([False, True])
    new = {tuple(row) for row in grid.refined(mask).coordinates("uniform")[2:].tolist()}
    assert new == {(0.125, 0.5), (0.375, 0.5), (0.25, 0.25), (0.25, 0.75), (0.5, 0.25), (0.5, 0.75)}
    assert len(grid.refined(np.flatnonzero(~mask))) == 5


def test_the_largest_surpluses_are_refined():
    grid = SparseGrid.regular(1, 3)
    surpluses = np.zeros((7, 2))
    surpluses[0], surpluses[5] = [9, 9], [0.3, 0.4]
    surpluses[6, 1] = 0.6
    assert sorted(grid.surplus_refined(surpluses, count=1).coordinates("uniform")[7:, 0]) == [13 / 16, 15 / 16]
    assert len(grid.surplus_refined(surpluses, count=2)) == 11
    assert len(grid.surplus_refined(surpluses, tolerance=0.55)) == 9
    assert len(grid.surplus_refined(surpluses, tolerance=0.7)) == 7
    assert len(grid.surplus_refined(surpluses, tolerance=0.55 / 8, by_volume=True)) == 9


def test_volume_prefers_coarse_points():
    grid = SparseGrid(np.array([[1], [2], [2], [3]]), np.array([[1], [1], [3], [1]]))
    surpluses = np.array([0.0, 0.0, 0.7, 1.0])
    assert grid.surplus_refined(surpluses, count=1).levels[-1] == 4
    assert grid.surplus_refined(surpluses, count=1, by_volume=True).levels[-1] == 3


def test_adaptive_refinement_beats_the_regular_grid_at_a_steep_front():
    def front(x):
        return np.tanh(25 * (x[:, 0] - 0.3)) + x[:, 1]

    linear = basis("modified", 1)
    grid = SparseGrid.regular(2, 3)
    while len(grid) < 100:
        grid = grid.surplus_refined(interpolate(grid, linear, front(grid.coordinates("uniform"))).surpluses, count=3)
    regular = SparseGrid.regular(2, 5)
    points = np.random.default_rng(0).uniform(size=(2000, 2))
    error, error_regular = (
        np.abs(interpolate(one, linear, front(one.coordinates("uniform")))(points) - front(points)).mean()
        for one in (grid, regular)
    )
    assert len(grid) < len(regular)
    assert error < error_regular / 4


@pytest.mark.parametrize(
    ("levels", "indices", "message"),
    [
        ([[1, 2]], [[1, 2]], "got level 2, index 2 in point 0"),
        ([[1, 2]], [[1, 5]], "got level 2, index 5"),
        ([[1, 0]], [[1, 2]], "got level 0, index 2"),
        ([[1, -1]], [[1, 1]], "got level -1, index 1"),
        ([[1, 1]], [[1, -1]], "got level 1, index -1"),
        ([[1], [1]], [[1], [1]], "got a point twice among 2"),
    ],
)
def test_levels_and_indices_belong_together(levels, indices, message):
    with pytest.raises(InputError, match=message):
        SparseGrid(np.array(levels), np.array(indices))


def test_bad_requests_are_refused():
    grid = SparseGrid.regular(2, 2)
    with pytest.raises(InputError, match=r"one shape \(points, dimension\), got \(1, 2\) and \(1, 1\)"):
        SparseGrid(np.array([[1, 1]]), np.array([[1]]))
    with pytest.raises(InputError, match="at least 1, got 2 and 0"):
        SparseGrid.regular(2, 0)
    for chosen in (np.array([5]), np.array([-1]), np.array([True])):
        with pytest.raises(InputError, match="expected a mask of 5 points or numbers from 0 to 4"):
            grid.refined(chosen)
    for count, tolerance in ((None, None), (1, 0.1), (0, None)):
        with pytest.raises(InputError, match=f"or a tolerance, got count {count}, tolerance {tolerance}"):
            grid.surplus_refined(np.zeros(5), count, tolerance)
    with pytest.raises(InputError, match="surpluses of 5 points, got 4"):
        grid.surplus_refined(np.zeros(4), count=1)
