"""Forces of our muscles beside those of a published two-muscle model (J. Valentin, 2019: 49 finite-element samples)."""

import os
from pathlib import Path

import numpy as np
import pytest

from myograph.anatomy.body import line_of_action
from myograph.anatomy.load import built_in_arm
from myograph.limb.table import regular_grid
from myograph.limb.tabulate import tabulate_muscle

ROOT = Path(os.environ.get("MYOGRAPH_REFERENCE_DATA", Path(__file__).parents[3] / "shared" / "data"))
SAMPLES = ROOT / "stuttgart" / "sparse_grid_clenshaw_curtis.csv"


@pytest.mark.reference
@pytest.mark.skipif(not SAMPLES.exists(), reason="the reference data are not here; set MYOGRAPH_REFERENCE_DATA")
@pytest.mark.parametrize(("name", "column", "largest"), [("biceps", 3, 0.07), ("triceps", 2, 0.20)])
def test_forces_stay_near_the_published_ones(name, column, largest):
    """Relative L2 error over the samples inside our range of angles; force = moment / moment arm."""
    pytest.importorskip("ngsolve", reason="the mechanics need NGSolve")
    arm = built_in_arm()
    samples = np.loadtxt(SAMPLES)
    low, high = arm.hinge.range_deg
    samples = samples[(samples[:, 0] >= low) & (samples[:, 0] <= high)]
    table = tabulate_muscle(arm, name, "tiny", regular_grid(arm, 6, 3), lambda _: None)
    line = line_of_action(arm.muscles[name], arm.hinge.frame())
    angles = np.radians(samples[:, 0])
    moments = np.array([table.moment(angles[[k]], samples[k, 1])[0] for k in range(len(samples))])
    forces = moments / [line.moment_arm(angle - arm.reference_angle) for angle in angles]
    published = np.abs(samples[:, column])
    assert np.linalg.norm(forces - published) < largest * np.linalg.norm(published)
