"""Where the elbow rests."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES, Case
from myograph.errors import InputError
from myograph.limb.equilibrium import equilibria
from myograph.limb.moments import load_moment, stop_moment


def test_all_roots_of_a_cubic_are_found_with_their_stability():
    found = equilibria(lambda t: -(t - 0.5) * (t - 1.0) * (t - 1.7), 0.0, 2.0)
    assert [e.angle for e in found] == pytest.approx([0.5, 1.0, 1.7], abs=1e-8)
    assert [e.stable for e in found] == [True, False, True]


def test_a_root_on_a_scanned_angle_is_found_once():
    found = equilibria(lambda t: 1.0 - t, 0.0, 2.0)
    assert [(e.angle, e.stable) for e in found] == [(pytest.approx(1.0), True)]


def test_no_root_is_no_equilibrium():
    assert equilibria(lambda t: 1.0 + t, 0.0, 2.0) == ()


def test_all_moments_cancel_at_the_angle_of_the_solution(formula_arm):
    case = Case((0.3, 0.1, 0.6, 0.2, 0.5), hand_load=10.0)
    solution = formula_arm(case)
    arm = formula_arm.arm
    angle = np.array([solution.elbow_angle])
    rest = load_moment(arm.load, angle, 10.0, gravity=True) + stop_moment(arm.stops, angle)
    assert sum(solution.moments.values()) + rest[0] == pytest.approx(0, abs=1e-3)
    assert solution.origin == "table"


def test_a_weight_in_the_hand_extends_the_elbow(formula_arm):
    angles = [formula_arm(Case((0.0, 0.0, 0.5, 0.0, 0.4), load)).elbow_angle for load in (0.0, 10.0, 20.0)]
    assert np.all(np.diff(angles) < 0)


def test_the_triceps_extends_and_the_biceps_flexes(formula_arm):
    def angle(biceps, triceps):
        return formula_arm(Case((0.0, 0.0, biceps, 0.0, triceps))).elbow_angle

    assert angle(0.8, 0.5) > angle(0.4, 0.5) > angle(0.4, 0.9)


def test_a_prescribed_angle_is_kept(formula_arm):
    assert formula_arm(Case((0.0,) * 5, elbow_angle=1.0)).elbow_angle == 1.0


def test_a_load_that_nothing_holds_is_refused_with_the_moments_at_both_ends(formula_arm):
    with pytest.raises(InputError, match=r"got none \(net moment -.* N·m at 10 degrees.*change the load"):
        formula_arm(Case((0.0,) * 5, hand_load=5000.0))


def test_weights_pull_down_most_on_a_level_forearm():
    load = built_in_arm().load
    moments = load_moment(load, np.radians([0.0, 90.0]), 10.0, gravity=False)
    assert moments == pytest.approx([0.0, -10.0 * load.hand], abs=1e-9)


def test_stops_push_back_at_both_ends_and_let_the_middle_be():
    stops = built_in_arm().stops
    low, middle, high = stop_moment(stops, np.radians([15.0, 65.0, 125.0]))
    assert low > 1e4
    assert high < -1e4
    assert abs(middle) < 1.0


@pytest.mark.parametrize("bad", [-0.1, 1.1, float("nan")])
def test_an_activation_outside_zero_to_one_is_refused_by_name(bad):
    with pytest.raises(InputError, match=r"activation of biceps: expected a number in \[0, 1\]"):
        Case((0.0, 0.0, bad, 0.0, 0.0))


def test_the_number_of_activations_and_the_load_are_checked():
    with pytest.raises(InputError, match=f"expected {len(MUSCLES)} activations"):
        Case((0.0,) * 4)
    with pytest.raises(InputError, match="load at the hand"):
        Case((0.0,) * 5, hand_load=float("inf"))
