"""Weights and stops, and the derivatives of their moments."""

import numpy as np
import pytest

from myograph.limb.moments import WeightsAndStops, load_moment, stop_moment
from tests.limb.limbs import LOAD, STOPS


@pytest.mark.parametrize("gravity", [True, False])
@pytest.mark.parametrize("stops", [STOPS, None])
@pytest.mark.parametrize("angle_deg", [10.0, 24.9, 25.0, 70.0, 112.5, 149.0])
def test_the_derivative_is_that_of_the_moment(gravity, stops, angle_deg):
    outside = WeightsAndStops(LOAD, stops, gravity)
    angle, step = float(np.radians(angle_deg)), 1e-5
    moment, slope = outside.gradient(angle, 17.0)
    behind, here, ahead = outside(np.array([angle - step, angle, angle + step]), 17.0)
    assert moment == pytest.approx(here, rel=1e-12)
    assert slope == pytest.approx((ahead - behind) / (2 * step), rel=1e-6)


def test_a_weight_of_a_newton_at_the_hand_pulls_with_its_lever():
    level = np.array([np.pi / 2])
    assert load_moment(LOAD, level, 10.0, gravity=False) == pytest.approx([-10.0 * LOAD.hand])
    forearm = 1.5 * 9.80665 * 180.0
    assert load_moment(LOAD, level, 0.0, gravity=True) == pytest.approx([-forearm])


def test_far_beyond_a_stop_its_moment_is_linear():
    low, high = stop_moment(STOPS, np.radians([5.0, 132.0]))
    assert low == pytest.approx(150e3 * np.radians(20.0), rel=1e-3)
    assert high == pytest.approx(-150e3 * np.radians(20.0), rel=1e-3)
