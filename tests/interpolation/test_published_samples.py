"""49 published finite-element samples of two muscle forces over elbow angle and activation (J. Valentin, 2019).

The published errors of the forces, 3.31 and 3.56 per mille, are measured on a full grid that is not at hand. What
can be checked: the coarser grid predicts the finer one's samples, and the equilibria of the limb are those in print.
"""

import os
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.spatial import KDTree

from myograph.interpolation import Domain, SparseGrid, basis, interpolate

ROOT = Path(os.environ.get("MYOGRAPH_REFERENCE_DATA", Path(__file__).parents[3] / "shared" / "data"))
SAMPLES = ROOT / "stuttgart" / "sparse_grid_clenshaw_curtis.csv"
DOMAIN = Domain(np.array([10.0, 0.0]), np.array([150.0, 1.0]))
CUBIC = basis("modified_clenshaw_curtis", 3)
LEVERS_MM = (
    lambda t: -0.0009399 * t**2 + 0.1126 * t + 22.21,
    lambda t: -0.001482 * t**2 + 0.1776 * t + 35.02,
    lambda t: 282.5 * np.sin(np.radians(t)),
)

pytestmark = [
    pytest.mark.reference,
    pytest.mark.skipif(not SAMPLES.exists(), reason="the reference data are not here; set MYOGRAPH_REFERENCE_DATA"),
]


def _forces(grid):
    """Angle [deg] and activation of the grid's points, and the samples [N] of triceps and biceps there."""
    samples = np.loadtxt(SAMPLES)
    points = DOMAIN.from_unit(grid.coordinates(CUBIC))
    distances, which = KDTree(samples[:, :2]).query(points)
    assert distances.max() < 1e-9
    return points, samples[which, 2:]


def test_the_samples_lie_on_our_regular_grid_and_come_back():
    grid = SparseGrid.regular(2, 4)
    points, forces = _forces(grid)
    assert len(np.loadtxt(SAMPLES)) == len(grid)
    assert interpolate(grid, CUBIC, forces, DOMAIN)(points) == pytest.approx(forces, abs=1e-9)


def test_the_17_samples_of_level_3_predict_the_other_32():
    """Relative L2 error of triceps and biceps forces, and the largest [N]."""
    points, forces = _forces(SparseGrid.regular(2, 4))
    coarse = interpolate(SparseGrid.regular(2, 3), CUBIC, forces[:17], DOMAIN)
    errors = coarse(points[17:]) - forces[17:]
    relative = np.linalg.norm(errors, axis=0) / np.linalg.norm(forces[17:], axis=0)
    assert relative == pytest.approx([4.67e-3, 15.4e-3], rel=0.01)
    assert np.abs(errors).max(axis=0) == pytest.approx([11.3, 13.5], abs=0.1)


@pytest.mark.parametrize(
    ("triceps", "biceps", "load", "published"),
    [
        (0, 0, 22, 48.5),
        (0, 1, 22, 83.9),
        (0.5, 0.5, 22, 49.5),
        (1, 0, 22, 21.9),
        (1, 1, 22, 52.7),
        (0, 0, 0, 63.9),
        (1, 1, 0, 64.2),
    ],
)
def test_the_angle_of_equilibrium_is_the_published_one(triceps, biceps, load, published):
    """Within half a degree; the published largest error of these angles is 0.886 degrees."""
    grid = SparseGrid.regular(2, 4)
    forces = interpolate(grid, CUBIC, _forces(grid)[1], DOMAIN)

    def moment(angle):
        pull = forces(np.array([angle, triceps]))[0], forces(np.array([angle, biceps]))[1], load
        return sum(force * lever(angle) for force, lever in zip(pull, LEVERS_MM, strict=True))

    assert brentq(moment, 10, 150) == pytest.approx(published, abs=0.5)
