"""Bones, pulley and bands: they push out what is inside, turn with the forearm, and are reported on."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.anatomy.model import Arm
from myograph.errors import InputError
from myograph.mechanics.continuation import Controls, at_rest, reach, set_controls
from myograph.mechanics.problem import MuscleProblem
from myograph.mechanics.soundness import check_clear, soundness
from myograph.mesh.presets import RESOLUTIONS, muscle_mesh


def _problem(name, **contact):
    data = built_in_arm().model_dump(mode="json")
    data["muscles"][name]["contact"].update(contact)
    arm = Arm.model_validate(data)
    return MuscleProblem(arm, name, muscle_mesh(arm, name, RESOLUTIONS["tiny"]))


def _depth(problem, flexion):
    state = reach(problem, at_rest(problem), Controls(1.0, 0.0, flexion))
    set_controls(problem, state.controls)
    return soundness(problem, state.vector, flexion)


def test_the_humerus_keeps_the_stretched_triceps_out():
    flexion = np.radians(120) - built_in_arm().reference_angle
    without = _depth(_problem("triceps", bones=[]), flexion)
    kept_out = _depth(_problem("triceps"), flexion)
    assert without.obstacle == kept_out.obstacle == "humerus"
    assert without.penetration > 2.0
    assert kept_out.penetration < 0.5


def test_a_stiffer_bone_is_entered_less():
    flexion = np.radians(120) - built_in_arm().reference_angle
    soft, stiff = (_depth(_problem("triceps", stiffness=k), flexion).penetration for k in (0.1, 1.0))
    assert stiff < soft - 0.3


def test_bones_of_the_forearm_turn_with_it():
    """Contact energy of a body that turns with the forearm as a whole does not change."""
    problem = _problem("brachioradialis")
    points, angle = problem.mesh.points, 0.4
    turned = problem.hinge.flex(points, angle)
    vector = problem._vector_unknowns(turned - points)
    problem.controls.ramp.Set(1.0)
    energies = []
    for displacement, flexion in ((np.zeros_like(vector), 0.0), (vector, angle)):
        problem.controls.turn.set(flexion)
        energies.append(float(problem._turning.form.Energy(problem._load(displacement))))
    assert energies[0] > 0
    assert energies[1] == pytest.approx(energies[0], rel=1e-8)


def test_a_body_that_starts_inside_a_bone_is_refused_with_bone_and_place():
    data = built_in_arm().model_dump(mode="json")
    data["muscles"]["triceps"]["bow"] = -15.0
    arm = Arm.model_validate(data)
    problem = MuscleProblem(arm, "triceps", muscle_mesh(arm, "triceps", RESOLUTIONS["tiny"]))
    with pytest.raises(InputError, match=r"triceps: its skin starts \d+\.\d+ mm inside the humerus, at \[.*raise bow"):
        check_clear(problem)


def test_the_built_in_arm_starts_clear():
    for name in built_in_arm().muscles:
        check_clear(_problem(name))


def test_a_band_to_an_unknown_bone_is_refused():
    band = {"bone": "femur", "place": 0.5, "width": 0.1, "reach": 20.0, "stiffness": 0.1, "softness": 1.0}
    with pytest.raises(ValueError, match="unknown bone 'femur', expected humerus, radius, ulna"):
        _problem("biceps", bands=[band])


def test_a_band_holds_a_slack_belly_nearer_to_its_bone(monkeypatch):
    """The distance of the banded piece from the radius, in full flexion."""
    flexion = np.radians(120) - built_in_arm().reference_angle

    def distance(problem):
        state = reach(problem, at_rest(problem), Controls(1.0, 0.0, flexion))
        radius = problem.arm.bones["radius"]
        start, end = problem.hinge.flex(np.array([radius.start, radius.end]), flexion)
        middle = problem.positions(state.vector)[np.abs(problem.mesh.along - 0.46) < 0.08].mean(axis=0)
        along = (end - start) / np.linalg.norm(end - start)
        return np.linalg.norm(np.cross(middle - start, along))

    assert distance(_problem("brachioradialis")) < distance(_problem("brachioradialis", bands=[])) - 3.0
