"""The built-in arm, and arms from files."""

import re

import numpy as np
import pytest

from myograph.anatomy.load import arm_checksum, built_in_arm, load_arm
from myograph.anatomy.model import Arm
from myograph.config import parse
from myograph.errors import InputError


def _data(**changes):
    data = built_in_arm().model_dump(mode="json")
    for key, value in changes.items():
        node = data
        *path, last = key.split("__")
        for part in path:
            node = node[part]
        node[last] = value
    return data


def _refused(data, message):
    with pytest.raises(InputError, match=re.escape(message)):
        parse(data, Arm, "arm.toml")


def test_flexion_turns_the_forearm_forwards_and_up():
    hinge = built_in_arm().hinge.frame()
    forward = hinge.point + hinge.forward
    assert hinge.flex(forward, np.pi / 2) == pytest.approx(hinge.point + hinge.up)


def test_plane_coordinates_lead_there_and_back():
    hinge = built_in_arm().hinge.frame()
    points = np.random.default_rng(0).normal(size=(7, 3)) * 100
    assert hinge.from_plane(hinge.to_plane(points)) == pytest.approx(points)


def test_the_reference_pose_is_the_angle_between_upper_arm_and_forearm():
    """Landmarks of the Visible Human: shoulder, elbow, wrist."""
    shoulder, elbow, wrist = np.array([[102.8, 174.1, -301.3], [37.7, 106.6, -586.3], [109.1, 277.1, -781.3]])
    upper, lower = elbow - shoulder, wrist - elbow
    flexion = np.degrees(np.arccos(upper @ lower / np.linalg.norm(upper) / np.linalg.norm(lower)))
    assert flexion == pytest.approx(built_in_arm().hinge.reference_angle_deg, abs=0.1)


def test_an_unknown_key_names_the_near_one():
    _refused(_data(muscles__biceps__boww=1.0), "unknown key 'muscles.biceps.boww'; did you mean 'bow'?")


def test_a_negative_stiffness_is_refused_by_name():
    _refused(_data(muscles__biceps__belly__c1=-1.0), "muscles.biceps.belly.gauss.c1")


def test_a_bulk_modulus_too_low_for_the_matrix_is_refused_with_what_is_needed_and_why():
    message = r"muscles\.biceps\.belly\.gauss: .*at least 100 times the shear modulus of 0\.016 MPa.*1\.6 MPa or more"
    with pytest.raises(InputError, match=message):
        parse(_data(muscles__biceps__belly__bulk=1.0), Arm, "arm.toml")


def test_a_bulk_modulus_too_low_for_the_tendon_is_refused_with_what_is_needed():
    message = r"holds in the tendon, too; expected at least 20 times .* 2 MPa.* got 30, give 40 MPa or more"
    with pytest.raises(InputError, match=message):
        parse(_data(muscles__biceps__belly__bulk=30.0), Arm, "arm.toml")


@pytest.mark.parametrize("prestretch", [0.9, 2.5])
def test_a_pre_stretch_of_no_living_muscle_is_refused(prestretch):
    _refused(_data(muscles__biceps__tissue__prestretch=prestretch), "expected 1 (none) to 2, the fibre's length")


def test_an_unknown_law_is_refused_with_the_known_ones():
    _refused(_data(muscles__biceps__belly__law="gaus"), "'gauss', ")


def test_a_parameter_of_another_law_names_the_near_one():
    _refused(_data(muscles__biceps__tendon__moduls=3.0), "did you mean 'modulus'?")


def test_muscles_are_as_strong_per_cross_section_as_in_print():
    """0.2 to 0.35 MPa: peak forces differ by the physiological cross-section, or nearly."""
    assert all(0.2 <= muscle.belly.peak_stress <= 0.35 for muscle in built_in_arm().muscles.values())


def test_a_missing_muscle_is_named():
    data = _data()
    data["muscles"].pop("anconeus")
    _refused(data, "expected exactly brachioradialis, brachialis, biceps, anconeus, triceps")


def test_a_contact_with_an_unknown_bone_is_refused():
    _refused(_data(muscles__biceps__contact__bones=["femur"]), "unknown bone 'femur'")


def test_areas_must_cover_the_length():
    _refused(_data(muscles__biceps__areas=[[0.1, 40.0], [1.0, 40.0]]), "fractions that grow from 0 to 1")


def test_fibres_without_length_are_refused():
    _refused(_data(muscles__biceps__insertion=_data()["muscles"]["biceps"]["origin"]), "no length")


def test_a_missing_file_and_a_broken_file_are_named(tmp_path):
    with pytest.raises(InputError, match="found none there"):
        load_arm(tmp_path / "no.toml")
    (tmp_path / "broken.toml").write_text("name = [")
    with pytest.raises(InputError, match="not TOML"):
        load_arm(tmp_path / "broken.toml")
    with pytest.raises(InputError, match="cannot be read"):
        load_arm(tmp_path)


def test_the_checksum_follows_the_content():
    arm = built_in_arm()
    assert arm_checksum(arm) == arm_checksum(built_in_arm())
    other = parse(_data(muscles__biceps__bow=21.0), Arm, "arm.toml")
    assert arm_checksum(other) != arm_checksum(arm)
