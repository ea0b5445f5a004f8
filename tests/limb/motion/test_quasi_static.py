"""Slow movements: an equilibrium at every time, along one branch as long as it lasts."""

import numpy as np
import pytest

from myograph.case import MUSCLES
from myograph.errors import InputError
from myograph.limb.limb import Limb
from myograph.limb.moments import WeightsAndStops
from myograph.limb.motion.activation_file import Activations
from myograph.limb.motion.movement import save_movement
from myograph.limb.motion.quasi_static import follow_equilibria
from tests.limb.limbs import LOAD, Formula, five_muscles, two_muscles


def _ramp(muscles, start, end, rows=21):
    times = np.linspace(0.0, 2.0, rows)
    share = times[:, None] / 2.0
    return Activations(tuple(muscles), times, (1 - share) * np.array(start) + share * np.array(end))


def test_every_time_is_an_equilibrium():
    limb = two_muscles()
    given = _ramp(limb.names, (0.1, 0.6), (0.9, 0.2))
    movement = follow_equilibria(limb, given, 10.0, 1.0)
    expected = [limb.rest(tuple(a), 10.0, 1.0).angle for a in given.values.tolist()]
    assert movement.kind == "quasi-static"
    assert movement.angles == pytest.approx(expected, abs=1e-9)
    assert movement.muscle_moments.sum(axis=1) + movement.outside_moments == pytest.approx(0, abs=1e-4)
    assert np.array_equal(movement.activations, given.values)
    assert movement.velocities == pytest.approx(np.gradient(movement.angles, given.times))
    assert movement.notes == ()


class _Fold:
    """Outside moment 500 + θ - θ³ for θ in units of 1 rad about 1 rad, times 1000: an S-shaped branch."""

    def __call__(self, angles, hand_load):
        t = 2 * (angles - 1.0)
        return 1000 * (t - t**3) - hand_load

    def gradient(self, angle, hand_load):
        t = 2 * (angle - 1.0)
        return 1000 * (t - t**3) - hand_load, 2000 * (1 - 3 * t**2)


def _folded():
    """M = 1000 (a - 0.5 + t - t³): stable branches end at t = ∓ 1/√3, where a - 0.5 = ± 0.385."""
    pull = Formula(1000.0, lambda t: 1.0, lambda t: 0.0, rest=-0.5)
    return Limb({"a": pull}, _Fold(), 0.0, 2.0)


@pytest.mark.parametrize("rows", [2, 11, 101])
def test_a_branch_is_followed_to_its_end_and_the_jump_is_noted(rows):
    """Up to the fold the lower branch, though the upper one is there from a = 0.115 on."""
    given = _ramp(("a",), (0.0,), (1.0,), rows)
    movement = follow_equilibria(_folded(), given, 0.0, 0.3)
    t = 2 * (movement.angles - 1.0)
    before = given.values[:, 0] < 0.5 + 2 / np.sqrt(27) - 1e-3
    assert np.all(t[before] < -1 / np.sqrt(3) + 0.05)
    assert np.all(t[~before] > 1.0)
    assert given.values[:, 0] - 0.5 + t - t**3 == pytest.approx(0, abs=1e-8)
    assert len(movement.notes) == 1
    assert movement.notes[0].startswith("jumps from ")
    time = given.times[np.flatnonzero(~before)[0]]
    assert movement.notes[0].endswith(f"degrees before {time:g} s")


def test_where_nothing_holds_the_limb_the_time_is_named():
    limb = Limb(two_muscles().muscles, WeightsAndStops(LOAD, None, False), *(np.radians([10.0, 90.0]).tolist()))
    with pytest.raises(InputError, match=r"at 0.4 s: activations .* expected an angle at rest"):
        follow_equilibria(limb, _ramp(limb.names, (0.3, 0.3), (1.0, 0.0)), 10.0, 1.0)


def test_a_file_has_a_row_per_time_and_says_its_units(tmp_path):
    limb = two_muscles()
    movement = follow_equilibria(limb, _ramp(limb.names, (0.1, 0.6), (0.9, 0.2), 5), 10.0, 1.0)
    save_movement(movement, tmp_path / "movement.csv")
    lines = (tmp_path / "movement.csv").read_text().splitlines()
    assert lines[0] == (
        "time_s,angle_deg,velocity_deg_s,excitation_flexor,excitation_extensor,activation_flexor,activation_extensor,"
        "moment_nm_flexor,moment_nm_extensor,outside_moment_nm"
    )
    numbers = np.array([line.split(",") for line in lines[1:]], dtype=float)
    assert numbers[:, 0] == pytest.approx(movement.times)
    assert np.radians(numbers[:, 1]) == pytest.approx(movement.angles, rel=1e-8)
    assert numbers[:, 7:].sum(axis=1) == pytest.approx(0, abs=1e-6)


def test_a_movement_of_the_arms_muscles_gives_the_case_of_a_time_and_others_do_not():
    limb = five_muscles()
    given = _ramp(MUSCLES, (0.1,) * 5, (0.9, 0.1, 0.5, 0.0, 0.2), 3)
    movement = follow_equilibria(limb, given, 10.0, 1.0)
    case = movement.case(2)
    assert case.activations == pytest.approx(tuple(given.values[2]))
    assert case.elbow_angle == movement.angles[2]
    assert case.hand_load == 10.0
    two = two_muscles()
    other = follow_equilibria(two, _ramp(two.names, (0.1, 0.6), (0.9, 0.2), 3), 10.0, 1.0)
    with pytest.raises(InputError, match=r"expected the muscles brachioradialis, .* got flexor, extensor"):
        other.case(0)
