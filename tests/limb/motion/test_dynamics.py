"""Forward dynamics beside closed forms."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError, NotConvergedError
from myograph.limb.limb import Limb
from myograph.limb.moments import WeightsAndStops
from myograph.limb.motion.activation_file import Activations
from myograph.limb.motion.dynamics import Mechanism, Start, mechanism, move, rest_at
from myograph.limb.motion.quasi_static import follow_equilibria
from tests.limb.limbs import LOAD, Constant, Formula, two_muscles

FREE = Mechanism(inertia=50.0, damping=0.0, activation_time=0.01, deactivation_time=0.04)


def _passive():
    """A muscle that does nothing."""
    return {"a": Formula(0.0, lambda t: 1.0, lambda t: 0.0)}


def _held(value, end=1.0, rows=101):
    times = np.linspace(0.0, end, rows)
    return Activations(("a",), times, np.full((rows, 1), value))


def test_a_constant_moment_accelerates_evenly():
    limb = Limb(_passive(), Constant(100.0), 0.0, 3.0)
    movement = move(limb, _held(0.0), 40.0, FREE, Start(0.5, 0.2, (0.0,)))
    t = movement.times
    assert movement.angles == pytest.approx(0.5 + 0.2 * t + 60.0 / 50.0 * t**2 / 2, abs=1e-7)
    assert movement.velocities == pytest.approx(0.2 + 60.0 / 50.0 * t, abs=1e-7)


def test_a_damped_spring_swings_as_its_closed_form():
    """I θ'' = k (1 - θ) - c θ', underdamped."""
    limb = Limb(_passive(), Constant(2000.0, -2000.0), 0.0, 3.0)
    damped = Mechanism(50.0, 300.0, 0.01, 0.04)
    movement = move(limb, _held(0.0), 0.0, damped, Start(1.5, 0.0, (0.0,)))
    rate, frequency = 3.0, np.sqrt(2000 / 50 - 9)
    t = movement.times
    swing = np.exp(-rate * t) * (np.cos(frequency * t) + rate / frequency * np.sin(frequency * t))
    assert movement.angles == pytest.approx(1 + 0.5 * swing, abs=1e-6)


def test_a_free_pendulum_keeps_its_energy():
    """Under a weight alone: I θ'² / 2 - W cos θ is constant."""
    limb = Limb(_passive(), WeightsAndStops(LOAD, None, False), -3.0, 3.0)
    movement = move(limb, _held(0.0, 3.0), 20.0, FREE, Start(1.4, 0.0, (0.0,)))
    weight = 20.0 * LOAD.hand
    energy = 50.0 * movement.velocities**2 / 2 - weight * np.cos(movement.angles)
    assert movement.angles.min() < -1.3
    assert energy == pytest.approx(energy[0], abs=1e-5 * weight)


@pytest.mark.parametrize(("start", "asked", "constant"), [(0.0, 0.8, 0.01), (0.9, 0.2, 0.04)])
def test_activation_follows_excitation_exponentially_faster_up_than_down(start, asked, constant):
    limb = Limb(_passive(), Constant(0.0, -1.0), -1.0, 1.0)
    movement = move(limb, _held(asked, 0.2), 0.0, FREE, Start(0.0, 0.0, (start,)))
    expected = asked + (start - asked) * np.exp(-movement.times / constant)
    assert movement.activations[:, 0] == pytest.approx(expected, abs=1e-6)
    assert np.all(movement.excitations == asked)


def test_a_slow_movement_passes_through_the_equilibria():
    """The slower, the nearer: the distance falls as one over the time taken."""
    limb = two_muscles()
    distances = []
    for slower in (1.0, 2.0):
        times = np.linspace(0.0, 4.0 * slower, 101)
        share = (1 - np.cos(np.pi * times / times[-1]))[:, None] / 2
        given = Activations(limb.names, times, (1 - share) * np.array([0.2, 0.5]) + share * np.array([0.6, 0.1]))
        still = follow_equilibria(limb, given, 10.0, 1.0)
        moving = move(limb, given, 10.0, Mechanism(70.0, 400.0, 0.01, 0.04), rest_at(limb, given, 10.0, 1.0))
        distances.append(np.abs(moving.angles - still.angles).max())
    assert distances[1] < 0.1
    assert distances[0] / distances[1] == pytest.approx(2.0, rel=0.1)


def test_a_limb_at_rest_stays_there():
    limb = two_muscles()
    given = Activations(limb.names, np.array([0.0, 0.5, 1.0]), np.tile([0.4, 0.3], (3, 1)))
    movement = move(limb, given, 10.0, FREE, rest_at(limb, given, 10.0, 1.0))
    assert movement.angles == pytest.approx(limb.rest((0.4, 0.3), 10.0, 1.0).angle, abs=1e-6)


def test_a_limb_that_leaves_its_range_is_an_error_with_time_and_angle():
    limb = Limb(_passive(), Constant(100.0), 0.0, 1.5)
    with pytest.raises(NotConvergedError, match=r"leaves its range at 1.000 s: 85.9 degrees, turning at 115 degrees/s"):
        move(limb, _held(0.0, 2.0), 0.0, FREE, Start(0.5, 0.0, (0.0,)))


def test_inertia_is_that_of_forearm_and_weight_about_the_hinge():
    """1.53 kg (181² + 112²) mm² and m 282.5² mm², in N mm s²."""
    arm = built_in_arm()
    assert arm.dynamics is not None
    free, loaded = (mechanism(arm.dynamics, arm.load, weight) for weight in (0.0, 9.80665))
    assert free.inertia == pytest.approx(1e-3 * 1.53 * (181.0**2 + 112.0**2))
    assert loaded.inertia - free.inertia == pytest.approx(1e-3 * 282.5**2)
    assert mechanism(arm.dynamics, arm.load, -60.0).inertia == free.inertia
    assert free.damping == pytest.approx(300.0)


@pytest.mark.parametrize("change", [{"inertia": 0.0}, {"damping": -1.0}, {"activation_time": float("nan")}])
def test_a_mechanism_that_cannot_move_is_refused(change):
    with pytest.raises(InputError, match="expected a positive inertia and times"):
        Mechanism(**{**vars(FREE), **change})
