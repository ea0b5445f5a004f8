"""The line of action in the plane of flexion."""

import numpy as np
import pytest

from myograph.anatomy.body import end_turn, line_of_action, muscle_body
from myograph.anatomy.load import built_in_arm
from myograph.anatomy.path import LineOfAction
from myograph.case import MUSCLES

FLEXIONS = np.radians([-45.0, -20.0, 0.0, 30.0, 59.0])


@pytest.mark.parametrize("name", MUSCLES)
@pytest.mark.parametrize("flexion", FLEXIONS)
def test_the_moment_arm_is_minus_the_derivative_of_the_length(name, flexion):
    arm = built_in_arm()
    line = line_of_action(arm.muscles[name], arm.hinge.frame())
    step = 1e-5
    difference = -(line.length(flexion + step) - line.length(flexion - step)) / (2 * step)
    assert line.moment_arm(flexion) == pytest.approx(difference, rel=1e-6)


def test_a_wrapped_line_has_the_circle_as_its_moment_arm():
    line = LineOfAction(np.array([0.0, 200.0]), np.array([0.0, -60.0]), 25.0, 1)
    assert line.moment_arm(0.0) == pytest.approx(25.0, rel=1e-12)


def test_a_straight_line_is_as_long_as_its_ends_are_apart():
    line = LineOfAction(np.array([30.0, 200.0]), np.array([40.0, -60.0]), 5.0, 1)
    assert line.length(0.0) == pytest.approx(np.hypot(10, 260), rel=1e-12)


def test_a_quarter_turn_around_a_circle_adds_a_quarter_of_its_circumference():
    """Down along the front of the circle, around its bottom, and off backwards."""
    line = LineOfAction(np.array([20.0, 200.0]), np.array([-100.0, -20.0]), 20.0, 1)
    assert line.length(0.0) == pytest.approx(200 + 10 * np.pi + 100, rel=1e-9)


@pytest.mark.parametrize("name", MUSCLES)
def test_flexors_flex_and_extensors_extend_over_the_whole_range(name):
    arm = built_in_arm()
    line = line_of_action(arm.muscles[name], arm.hinge.frame())
    sign = 1 if arm.muscles[name].side == "front" else -1
    low, high = np.radians(arm.hinge.range_deg) - arm.reference_angle
    assert all(sign * line.moment_arm(flexion) > 0 for flexion in np.linspace(low, high, 41))


@pytest.mark.parametrize("name", MUSCLES)
def test_the_insertion_face_does_not_turn_in_the_reference_pose_and_turns_without_jumps(name):
    arm = built_in_arm()
    turns = [end_turn(arm.muscles[name], arm.hinge.frame(), f) for f in np.linspace(-0.7, 1.0, 341)]
    assert end_turn(arm.muscles[name], arm.hinge.frame(), 0.0) == pytest.approx(0, abs=1e-12)
    assert np.abs(np.diff(turns)).max() < 0.02


@pytest.mark.parametrize("name", MUSCLES)
def test_a_body_starts_at_the_origin_and_ends_at_the_insertion(name):
    arm = built_in_arm()
    body = muscle_body(arm, name, 41)
    assert body.centres[0] == pytest.approx(np.array(arm.muscles[name].origin), abs=0.1)
    assert body.centres[-1] == pytest.approx(np.array(arm.muscles[name].insertion), abs=0.1)
    spacing = np.linalg.norm(np.diff(body.centres, axis=0), axis=1)
    assert spacing == pytest.approx(spacing.mean(), rel=0.02)
