"""Muscles from samples of a force: on sparse grids that are found again, on full grids, times a lever arm."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from myograph.errors import InputError
from myograph.interpolation import SparseGrid
from myograph.limb.forces import clenshaw_curtis_grid, tabulated_force
from tests.limb.limbs import HIGH, LOW

LEVER = Polynomial([30.0, 0.2, -0.001])
RANGE = (LOW, HIGH)


def _force(angle, activation):
    return 100 * (0.3 + activation) * np.exp(-0.5 * (angle - 1.2) ** 2)


def _sparse(level=5, boundary=False):
    unit = SparseGrid.regular(2, level, boundary).coordinates("clenshaw_curtis")
    angles, activations = LOW + unit[:, 0] * (HIGH - LOW), unit[:, 1]
    samples = np.stack([angles, activations, _force(angles, activations)], axis=1)
    return np.random.default_rng(0).permutation(samples)


def _full(angles=12, activations=6):
    grid = np.meshgrid(np.linspace(LOW, HIGH, angles), np.linspace(0, 1, activations), indexing="ij")
    angles, activations = (axis.ravel() for axis in grid)
    return np.random.default_rng(0).permutation(np.stack([angles, activations, _force(angles, activations)], axis=1))


@pytest.mark.parametrize("samples", [_sparse(), _sparse(4, boundary=True), _full()], ids=["inner", "boundary", "full"])
def test_the_moment_is_force_times_lever_at_and_between_the_samples(samples):
    muscle = tabulated_force(samples, RANGE, LEVER)
    for angle, activation, force in samples[::5]:
        expected = force * LEVER(np.degrees(angle))
        assert muscle.moment(np.array([angle]), activation) == pytest.approx([expected], rel=1e-9)
    angles = np.linspace(LOW, HIGH, 31)
    for activation in (0.0, 0.123, 0.77, 1.0):
        expected = _force(angles, activation) * LEVER(np.degrees(angles))
        assert muscle.moment(angles, activation) == pytest.approx(expected, rel=0.02)
        curve = muscle.curve(activation)
        assert curve(angles) == pytest.approx(muscle.moment(angles, activation), rel=1e-12)
        assert [curve.at(a) for a in angles.tolist()] == pytest.approx(curve(angles), rel=1e-9)


@pytest.mark.parametrize("samples", [_sparse(), _full()], ids=["sparse", "full"])
def test_the_gradient_is_that_of_the_moment(samples):
    muscle = tabulated_force(samples, RANGE, -1 * LEVER)
    angle, activation, step = 1.3, 0.41, 1e-5
    moment, by_angle, by_activation = muscle.moment_gradient(angle, activation)
    ends = muscle.moment(np.array([angle - step, angle, angle + step]), activation)
    sides = [muscle.moment(np.array([angle]), activation + sign * step)[0] for sign in (-1, 1)]
    assert moment == pytest.approx(ends[1], rel=1e-12)
    assert moment < 0
    assert by_angle == pytest.approx((ends[2] - ends[0]) / (2 * step), rel=1e-6)
    assert by_activation == pytest.approx((sides[1] - sides[0]) / (2 * step), rel=1e-6)


@pytest.mark.parametrize(("level", "boundary"), [(1, False), (4, False), (6, False), (3, True)])
def test_levels_and_indices_are_found_from_printed_coordinates(level, boundary):
    grid = SparseGrid.regular(2, level, boundary)
    found = clenshaw_curtis_grid(np.round(grid.coordinates("clenshaw_curtis"), 8))
    assert np.array_equal(found.levels, grid.levels)
    assert np.array_equal(found.indices, grid.indices)


def test_an_adaptive_grid_is_found_too():
    grid = SparseGrid.regular(2, 2).refined(np.array([1])).refined(np.array([5]))
    found = clenshaw_curtis_grid(grid.coordinates("clenshaw_curtis"))
    assert np.array_equal(found.levels, grid.levels)


def _changed(samples, row, column, value):
    changed = samples.copy()
    changed[row, column] = value
    return changed


@pytest.mark.parametrize(
    ("samples", "words"),
    [
        (_changed(_sparse(), 3, 2, np.nan), "expected numbers, got .* in sample 4"),
        (_changed(_sparse(), 3, 0, 1.1), r"expected a full grid .* or Clenshaw–Curtis .* got sample 4 at shares"),
        (np.delete(_sparse(), np.argmin(np.abs(_sparse()[:, 1] - 0.5) + np.abs(_sparse()[:, 0] - 1.3963)), axis=0),
         "with the parents of all its points, got one without 1"),
        (np.concatenate([_sparse()[:-1], _sparse()[:1]]), "twice"),
        (_full(3, 6), "at least 4 angles and 4 activations"),
        (_full()[_full()[:, 0] < 2.0], r"expected samples from 10 to 150 degrees .* got 10 to 111"),
    ],
)  # fmt: skip
def test_samples_that_make_no_muscle_are_refused(samples, words):
    with pytest.raises(InputError, match=words):
        tabulated_force(samples, RANGE, LEVER)


@pytest.mark.parametrize("samples", [_sparse(), _full()], ids=["sparse", "full"])
@pytest.mark.parametrize(("angle", "activation"), [(LOW - 0.01, 0.5), (HIGH + 0.01, 0.5), (1.0, 1.01)])
def test_outside_the_samples_is_refused(samples, angle, activation):
    muscle = tabulated_force(samples, RANGE, LEVER)
    with pytest.raises(InputError, match="expected"):
        muscle.moment(np.array([angle]), activation)
    with pytest.raises(InputError, match="expected"):
        muscle.moment_gradient(angle, activation)
