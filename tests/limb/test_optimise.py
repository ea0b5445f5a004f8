"""Least activations and smallest changes that hold a target."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.limb.limb import Limb
from myograph.limb.moments import WeightsAndStops
from myograph.limb.optimise import Target, optimise
from myograph.limb.reach import moment_bounds, reachable_angles
from tests.limb.limbs import HIGH, LOAD, LOW, STOPS, Constant, Formula, five_muscles, two_muscles

ANGLE = float(np.radians(70.0))


def _brute_force(limb, target, count=801):
    """Least cost over a fine grid of one activation, either one; the other closes the balance."""
    outside = limb.outside(np.array([target.angle]), target.hand_load)[0]
    names = list(limb.muscles)
    levels = np.linspace(0, 1, count)
    moments = [
        np.array([limb.muscles[name].moment(np.array([target.angle]), a)[0] for a in levels.tolist()]) for name in names
    ]
    costs = []
    for one, other in ((0, 1), (1, 0)):
        order = np.argsort(moments[other])
        rest = np.interp(-outside - moments[one], moments[other][order], levels[order], left=np.nan, right=np.nan)
        if target.previous is None:
            costs.append(levels + rest)
        else:
            costs.append(np.hypot(levels - target.previous[one], rest - target.previous[other]))
    return float(np.nanmin(costs))


def _curved(strength, power):
    return Formula(
        strength,
        lambda t: np.cos(t / 3),
        lambda t: -np.sin(t / 3) / 3,
        lambda a: (a + 0.01) ** power,
        lambda a: power * (a + 0.01) ** (power - 1),
    )


def _two_flexors(first, second):
    """Two flexors of other strengths against a weight; powers above 1 make local minima."""
    muscles = {"a": _curved(2.0e4, first), "b": _curved(1.2e4, second)}
    return Limb(muscles, WeightsAndStops(LOAD, STOPS, False), LOW, HIGH)


@pytest.mark.parametrize("limb", [two_muscles(), _two_flexors(1, 1), _two_flexors(0.5, 0.7), _two_flexors(2, 2.5)])
@pytest.mark.parametrize("load", [35.0, 50.0])
@pytest.mark.parametrize("previous", [None, (0.9, 0.1), (0.2, 0.8)])
def test_nothing_on_a_fine_grid_is_better(limb, load, previous):
    target = Target(ANGLE, load, previous)
    found = optimise(limb, target)
    assert limb.net_moment(found.activations, load, np.array([ANGLE]))[0] == pytest.approx(0, abs=1e-3)
    assert found.cost == pytest.approx(_brute_force(limb, target), abs=2e-3)
    assert found.cost < _brute_force(limb, target) + 1e-5


@pytest.mark.parametrize("powers", [(2.5, 1), (3, 0.4)])
@pytest.mark.parametrize("previous", [None, (0.0, 0.0)])
def test_a_search_from_one_place_would_end_in_a_worse_local_minimum(powers, previous):
    limb, target = _two_flexors(*powers), Target(ANGLE, 60.0, previous)
    assert optimise(limb, target).cost == pytest.approx(_brute_force(limb, target), abs=2e-3)


def test_the_least_sum_uses_the_strongest_muscle_first():
    """Linear moments: by hand, all of a (2e4 a cos) before any of b."""
    limb = _two_flexors(1, 1)
    found = optimise(limb, Target(ANGLE, 40.0))
    needed = -limb.outside(np.array([ANGLE]), 40.0)[0] / np.cos(ANGLE / 3) - 0.21 * 3.2e4
    assert found.activations == pytest.approx((needed / 2e4, 0.0), abs=1e-9)


def test_the_smallest_change_of_linear_muscles_is_along_their_strengths():
    limb = _two_flexors(1, 1)
    found = optimise(limb, Target(ANGLE, 40.0, (0.3, 0.4)))
    change = np.array(found.activations) - (0.3, 0.4)
    assert change[0] / change[1] == pytest.approx(2.0 / 1.2, rel=1e-5)
    assert found.cost == pytest.approx(np.linalg.norm(change))


def test_what_holds_already_does_not_change():
    limb = two_muscles()
    rest = limb.rest((0.4, 0.3), 12.0, 1.0)
    assert optimise(limb, Target(rest.angle, 12.0, (0.4, 0.3))).activations == pytest.approx((0.4, 0.3), abs=1e-7)


def test_five_muscles_hold_a_target_stably_and_come_to_rest_there():
    limb = five_muscles()
    found = optimise(limb, Target(ANGLE, 20.0))
    assert found.stable
    assert limb.rest(found.activations, 20.0, ANGLE).angle == pytest.approx(ANGLE, abs=1e-6)
    assert found.sensitivity == pytest.approx(limb.sensitivity(found.activations, 20.0, ANGLE).tolist())
    assert found.activations[3:] == pytest.approx((0.0, 0.0), abs=1e-9)


def _steepened(slope):
    """A weak muscle whose balance rises with the angle and a strong one whose balance falls."""
    up = Formula(1000.0, lambda t: np.exp(t - 1), lambda t: np.exp(t - 1), rest=0.0)
    down = Formula(600.0, lambda t: np.exp(slope * (t - 1)), lambda t: slope * np.exp(slope * (t - 1)), rest=0.0)
    return Limb({"up": up, "down": down}, Constant(-500.0), 0.5, 1.5)


def test_a_stable_equilibrium_comes_before_a_cheaper_unstable_one():
    found = optimise(_steepened(-1.0), Target(1.0))
    assert found.stable
    assert found.activations == pytest.approx(((500 - 16) / 2000, (500 + 16) / 1200), abs=1e-6)
    assert found.notes == ("a cost of 0.5 would hold the target too, but not stably",)


def test_an_equilibrium_that_can_only_be_unstable_is_given_with_a_note():
    found = optimise(_steepened(0.5), Target(1.0))
    assert not found.stable
    assert found.notes == ("the equilibrium is unstable: the elbow leaves it when pushed",)


def test_reachable_angles_end_where_the_strongest_muscles_balance_the_load():
    limb = two_muscles()
    ((low, high),) = reachable_angles(limb, 20.0)
    assert low == pytest.approx(limb.rest((0.0, 1.0), 20.0, low).angle, abs=1e-3)
    assert high == pytest.approx(limb.rest((1.0, 0.0), 20.0, high).angle, abs=1e-3)


def test_bounds_of_the_moment_are_those_of_the_extreme_activations():
    limb = two_muscles()
    angles = np.array([0.5, 1.5])
    bounds = moment_bounds(limb, angles)
    assert bounds[:, 0] == pytest.approx(limb.muscle_moments((0.0, 1.0), angles).sum(axis=1))
    assert bounds[:, 1] == pytest.approx(limb.muscle_moments((1.0, 0.0), angles).sum(axis=1))


@pytest.mark.parametrize(
    ("target", "words"),
    [
        (Target(float(np.radians(125.0)), 20.0), r"125 degrees with 20 N in the hand is out of reach: it needs .* N·m"),
        (Target(float(np.radians(70.0)), 500.0), "reachable with this load: 11.2 to 17.4 degrees"),
        (Target(float(np.radians(5.0)), 0.0), "target: expected 10 to 150 degrees, got 5"),
        (Target(ANGLE, 0.0, (0.5,)), "expected 2 activations"),
        (Target(ANGLE, float("inf")), "expected a number of newtons"),
    ],
)
def test_a_target_out_of_reach_is_refused_with_what_can_be_reached(target, words):
    with pytest.raises(InputError, match=words):
        optimise(two_muscles(), target)
