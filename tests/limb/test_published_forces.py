"""Forces of our muscles beside those of a published two-muscle model (J. Valentin, 2019: 49 finite-element samples)."""

import os
from pathlib import Path

import numpy as np
import pytest

from myograph.anatomy.body import line_of_action
from myograph.anatomy.load import built_in_arm
from myograph.limb.tables.solve import FiniteElementStates

ROOT = Path(os.environ.get("MYOGRAPH_REFERENCE_DATA", Path(__file__).parents[3] / "shared" / "data"))
SAMPLES = ROOT / "stuttgart" / "sparse_grid_clenshaw_curtis.csv"


@pytest.mark.reference
@pytest.mark.skipif(not SAMPLES.exists(), reason="the reference data are not here; set MYOGRAPH_REFERENCE_DATA")
@pytest.mark.parametrize(("name", "column"), [("biceps", 3), ("triceps", 2)])
def test_forces_on_samples_that_the_fit_did_not_see_are_within_five_per_cent(name, column):
    """Relative L2 error from 10 to 150 degrees; force = moment / moment arm; every other sample was fitted."""
    pytest.importorskip("ngsolve", reason="the mechanics need NGSolve")
    arm = built_in_arm()
    samples = np.loadtxt(SAMPLES)
    samples = samples[np.lexsort((samples[:, 1], samples[:, 0]))][1::2]
    line = line_of_action(arm.muscles[name], arm.hinge.frame())
    angles = np.radians(samples[:, 0])
    points = np.column_stack([angles, samples[:, 1]])
    moments = np.array([state.moment for state in FiniteElementStates(arm, name, "tiny", lambda _: None)(points)])
    forces = moments / [line.moment_arm(angle - arm.reference_angle) for angle in angles]
    published = np.abs(samples[:, column])
    error = np.linalg.norm(forces - published) / np.linalg.norm(published)
    assert error < 0.05
    assert error == pytest.approx(arm.muscles[name].calibration.error_unseen, abs=0.01)
