"""Limbs of any number of muscles: equilibria, their stability, and how they move with the activations."""

import subprocess
import sys

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError
from myograph.limb.limb import Limb, arm_limb
from myograph.limb.moment import MuscleMoment, PlainCurve, curve_of
from myograph.limb.moments import WeightsAndStops
from tests.limb.limbs import HIGH, LOAD, LOW, Constant, Formula, five_muscles, spline_muscle, two_muscles

FIVE = (0.3, 0.1, 0.6, 0.2, 0.5)


def test_splines_and_formulas_are_muscles():
    assert isinstance(spline_muscle(1.0, level=2), MuscleMoment)
    assert isinstance(two_muscles().muscles["flexor"], MuscleMoment)


@pytest.mark.parametrize(("limb", "activations"), [(five_muscles(), FIVE), (two_muscles(), (0.4, 0.7))])
def test_all_moments_cancel_at_rest(limb, activations):
    rest = limb.rest(activations, 10.0, near=1.0)
    moments = limb.muscle_moments(activations, np.array([rest.angle]))
    assert moments.shape == (1, len(limb.muscles))
    assert moments.sum() + limb.outside(np.array([rest.angle]), 10.0)[0] == pytest.approx(0, abs=1e-4)
    assert limb.moment_gradient(activations, 10.0, rest.angle)[1] < 0
    assert rest.stable


def test_the_closed_form_of_a_linear_balance_comes_out():
    """1000 (a1 + 0.2) - 500 (a2 + 0.2) - 800 θ - weight = 0."""
    pull = Formula(1000.0, lambda t: 1.0, lambda t: 0.0), Formula(-500.0, lambda t: 1.0, lambda t: 0.0)
    limb = Limb(dict(zip("ab", pull, strict=True)), Constant(0.0, -800.0), -1.0, 2.0)
    angle = (1000 * 0.9 - 500 * 0.5 - 30) / 800
    (rest,) = limb.equilibria((0.7, 0.3), 30.0)
    assert rest.angle == pytest.approx(angle, abs=1e-11)
    assert limb.sensitivity((0.7, 0.3), 30.0, angle) == pytest.approx([1000 / 800, -500 / 800])


@pytest.mark.parametrize(("limb", "activations"), [(five_muscles(), FIVE), (two_muscles(), (0.4, 0.7))])
def test_the_sensitivity_is_the_derivative_of_the_angle(limb, activations):
    angle = limb.rest(activations, 10.0, near=1.0).angle
    exact = limb.sensitivity(activations, 10.0, angle)
    step = 1e-4
    for k in range(len(activations)):
        ends = [
            limb.rest(tuple(a + sign * step * (j == k) for j, a in enumerate(activations)), 10.0, angle).angle
            for sign in (-1, 1)
        ]
        assert exact[k] == pytest.approx((ends[1] - ends[0]) / (2 * step), abs=1e-6)


def test_a_muscle_without_a_curve_gives_the_same_equilibria_as_with_one():
    limb = five_muscles()

    class Bare:
        def __init__(self, muscle):
            self.moment, self.moment_gradient = muscle.moment, muscle.moment_gradient

    bare = Limb({name: Bare(muscle) for name, muscle in limb.muscles.items()}, limb.outside, LOW, HIGH)
    assert isinstance(curve_of(bare.muscles["biceps"], 0.5), PlainCurve)
    assert bare.rest(FIVE, 10.0, 1.0).angle == pytest.approx(limb.rest(FIVE, 10.0, 1.0).angle, abs=1e-10)


def test_the_nearest_stable_equilibrium_is_chosen():
    """sin(3 θ) - 0.2 falls through zero at (π - asin 0.2)/3 and 2π/3 further."""
    limb = Limb({"a": Formula(0.0, lambda t: t, lambda t: 1.0)}, _Waves(), 0.1, 3.1)
    first = (np.pi - np.arcsin(0.2)) / 3
    assert [e.stable for e in limb.equilibria((0.0,))] == [True, False, True]
    assert limb.rest((0.0,), 0.0, near=0.2).angle == pytest.approx(first, abs=1e-9)
    assert limb.rest((0.0,), 0.0, near=3.1).angle == pytest.approx(first + 2 * np.pi / 3, abs=1e-9)


class _Waves:
    def __call__(self, angles, hand_load):
        return np.sin(3 * angles) - 0.2

    def gradient(self, angle, hand_load):
        return float(np.sin(3 * angle) - 0.2), float(3 * np.cos(3 * angle))


def test_no_rest_is_refused_with_the_net_moments_at_both_ends():
    limb = Limb(two_muscles().muscles, WeightsAndStops(LOAD, None, False), LOW, HIGH)
    low, high = limb.net_moment((1.0, 0.0), -500.0, np.array([LOW, HIGH])) / 1000
    assert low > 0
    with pytest.raises(
        InputError,
        match=rf"-500 N in the hand: .* got none \(net moment {low:.2f} N·m at 10 .*{high:.2f} N·m at 150 degrees\)",
    ):
        limb.rest((1.0, 0.0), -500.0, 1.0)


def test_an_unstable_equilibrium_is_no_rest_and_is_named():
    limb = Limb({"a": Formula(0.0, lambda t: t, lambda t: 1.0)}, Constant(-1.0, 1.0), 0.1, 2.0)
    assert [(e.angle, e.stable) for e in limb.equilibria((0.5,))] == [(pytest.approx(1.0), False)]
    with pytest.raises(InputError, match=r"unstable at 57.3 degrees"):
        limb.rest((0.5,), 0.0, 1.0)


@pytest.mark.parametrize(
    ("activations", "load", "words"),
    [
        ((0.5,), 0.0, r"expected 2 activations \(flexor, extensor\), got 1"),
        ((0.5, 1.2), 0.0, r"activation of extensor: expected a number in \[0, 1\], got 1.2"),
        ((0.5, 0.5), float("nan"), "load at the hand: expected a number of newtons, got nan"),
    ],
)
def test_what_is_no_state_of_the_limb_is_refused(activations, load, words):
    with pytest.raises(InputError, match=words):
        two_muscles().equilibria(activations, load)


def test_an_arms_limb_has_its_range_load_stops_and_gravity():
    arm = built_in_arm()
    muscles = dict.fromkeys(("a", "b"), Formula(0.0, lambda t: t, lambda t: 1.0))
    heavy, light = arm_limb(arm, muscles), arm_limb(arm, muscles, gravity=False)
    assert heavy.names == ("a", "b")
    assert np.degrees([heavy.low, heavy.high]) == pytest.approx(arm.hinge.range_deg)
    level = np.array([np.pi / 2])
    weight = arm.load.forearm_mass * 9.80665 * arm.load.centre_of_mass
    assert light.outside(level, 0.0)[0] - heavy.outside(level, 0.0)[0] == pytest.approx(weight)
    assert heavy.outside(np.radians([12.0]), 0.0)[0] > 1e4


def test_an_equilibrium_of_five_splines_takes_less_time_than_half_a_plain_scan():
    """CPU time, best of several, without the checks of shapes that tests turn on; alone on a core some 0.2 ms."""
    script = """
import time
import numpy as np
from tests.limb.limbs import HIGH, LOW, five_muscles
limb = five_muscles()
points = np.stack([np.linspace(LOW, HIGH, 201), np.full(201, 0.3)], axis=1)
def seconds(action):
    times = []
    for _ in range(10):
        started = time.process_time()
        for _ in range(10):
            action()
        times.append(time.process_time() - started)
    return min(times)
fast = seconds(lambda: limb.equilibria((0.3, 0.1, 0.6, 0.2, 0.5), 10.0))
print(fast / seconds(lambda: [muscle.interpolant(points) for muscle in limb.muscles.values()]))
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert float(done.stdout) < 0.5
