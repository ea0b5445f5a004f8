"""The calibration's parts: samples, parameters in files, the muscle on its line of action."""

from pathlib import Path

import numpy as np
import pytest

from calibrate import FITTED, read_samples
from myograph.anatomy.body import line_of_action
from myograph.anatomy.load import built_in_arm, load_arm
from myograph.errors import InputError
from one_dimension import fit_line, line_forces
from parameters import values_of, with_values, write_values

ARM_FILE = Path(__file__).parents[2] / "src" / "myograph" / "anatomy" / "left_arm.toml"


def test_samples_come_sorted_by_angle_and_activation(tmp_path):
    rows = [[30 - k % 5, k / 20, 100.0, -200.0] for k in range(12)]
    np.savetxt(tmp_path / "s.csv", rows)
    samples = read_samples(tmp_path / "s.csv")
    assert np.array_equal(samples, np.array(sorted(rows)))


@pytest.mark.parametrize("text", ["", "1 2 3\n" * 20, "1 2 3 nan\n" * 20, "a b c d\n" * 20])
def test_a_file_that_is_no_table_of_samples_is_refused(tmp_path, text):
    path = tmp_path / "s.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=r"s\.csv: expected"):
        read_samples(path)


def test_parameters_are_written_and_every_comment_stays(tmp_path):
    path = tmp_path / "arm.toml"
    path.write_bytes(ARM_FILE.read_bytes())
    record = built_in_arm().muscles["biceps"].calibration.model_dump()
    write_values(path, "biceps", {"belly.peak_stress": 0.123}, record | {"preset": "tiny"})
    arm = load_arm(path)
    assert arm.muscles["biceps"].belly.peak_stress == 0.123
    assert arm.muscles["biceps"].calibration.preset == "tiny"
    assert path.read_text().count("#") == ARM_FILE.read_text().count("#")


def test_belly_and_tendons_carry_the_same_force_on_the_line():
    """At the angle of the drawn pose the excursion is none; what the tendons give, the belly loses."""
    arm = built_in_arm()
    muscle = arm.muscles["biceps"]
    force, stretch = line_forces(arm, "biceps", np.zeros(3), np.array([0.0, 0.5, 1.0]))
    assert np.all(np.diff(force) > 100)
    assert np.all(np.diff(stretch) < 0)
    assert stretch[0] < muscle.tissue.prestretch


def test_the_fit_on_the_line_finds_the_parameters_that_made_the_forces():
    arm, name = built_in_arm(), "biceps"
    keys = FITTED[name]
    truth = values_of(arm, name, keys)
    angles, activation = (grid.ravel() for grid in np.meshgrid(np.linspace(15, 145, 9), [0.0, 0.4, 1.0]))
    line = line_of_action(arm.muscles[name], arm.hinge.frame())
    excursion = np.array([line.length(np.radians(a) - arm.reference_angle) for a in angles]) - line.length(0.0)
    published, _ = line_forces(arm, name, excursion, activation)
    start = {key: value * 1.05 for key, value in truth.items()}
    found = fit_line(arm, name, np.column_stack([angles, activation]), published, start)
    fitted, _ = line_forces(with_values(arm, name, dict(zip(keys, found, strict=True))), name, excursion, activation)
    assert np.linalg.norm(fitted - published) < 1e-2 * np.linalg.norm(published)
