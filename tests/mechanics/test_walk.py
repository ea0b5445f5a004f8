"""From state to state: the guess, the walk over the box, and what becomes of failures."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError, NotConvergedError
from myograph.mechanics import muscle as muscle_module
from myograph.mechanics.continuation import Controls, at_rest, reach, set_controls
from myograph.mechanics.muscle import FailedState, FiniteElementMuscle, MuscleState
from myograph.mechanics.predictor import extrapolated, flexion_rate
from myograph.mechanics.walk import Walk
from tests.mechanics.conftest import problem_of


def test_the_rate_is_the_derivative_of_solved_states_over_the_flexion():
    """Of a muscle on which a bone and bands of the forearm push."""
    problem, here, step = problem_of("brachioradialis"), 0.8, 2e-4
    solved = reach(problem, at_rest(problem), Controls(1.0, 0.0, here))
    ends = [reach(problem, solved, Controls(1.0, 0.0, here + sign * step)).vector for sign in (-1, 1)]
    set_controls(problem, solved.controls)
    rate = flexion_rate(problem, solved.vector, here)
    difference = (ends[1] - ends[0]) / (2 * step)
    forces = 3 * problem.space.scalar.ndof
    assert np.linalg.norm((rate - difference)[:forces]) < 1e-3 * np.linalg.norm(rate[:forces])


def test_the_extrapolation_is_exact_on_parabolas():
    """u = t²: rates 2t at 0.2 and 0.5; from there to 0.9."""
    change = extrapolated(np.array([1.0]), np.array([0.4]), 0.4, 0.3)
    assert change[0] == pytest.approx(0.9**2 - 0.5**2, rel=1e-12)


def test_a_turn_back_does_not_use_the_rate_of_the_turn_there():
    assert extrapolated(np.array([2.0]), np.array([5.0]), -0.1, 0.3)[0] == pytest.approx(-0.2)


@pytest.fixture(scope="module")
def anconeus():
    return FiniteElementMuscle(built_in_arm(), "anconeus", "tiny")


def points_of(angles_deg, activations):
    return np.array([(angle, a) for angle in np.radians(angles_deg) for a in activations])


def test_a_walk_yields_every_point_once_with_its_number(anconeus):
    points = points_of([75.0, 45.0], (1.0, 0.0))
    states = dict(Walk(anconeus).states(points))
    assert sorted(states) == [0, 1, 2, 3]
    for number, state in states.items():
        assert isinstance(state, MuscleState)
        assert (state.angle, state.activation) == pytest.approx(tuple(points[number]))
        assert abs(state.soundness.volume_change) < 1e-3


def test_the_angle_goes_outwards_from_the_reference_pose_and_the_activation_rises(anconeus):
    points = points_of([30.0, 45.0, 75.0, 90.0], (0.5, 0.2))
    order = [tuple(points[number].round(6)) for number, _ in Walk(anconeus).states(points)]
    expected = points_of([75.0, 90.0, 45.0, 30.0], (0.2, 0.5))
    assert order == [tuple(point) for point in expected.round(6)]


def test_further_points_start_from_what_is_solved(anconeus, monkeypatch):
    original, starts = muscle_module.reach, []

    def spy(problem, start, target, most=None):
        starts.append((start.controls.activation, start.controls.flexion, target.activation))
        return original(problem, start, target, most=most)

    monkeypatch.setattr(muscle_module, "reach", spy)
    walk = Walk(anconeus)
    first = dict(walk.states(points_of([75.0], (0.0, 0.5, 1.0))))
    starts.clear()
    again = dict(walk.states(points_of([75.0], (0.5,))))
    assert starts == []
    assert again[0].moment == first[1].moment
    between = next(walk.states(points_of([75.0], (0.75,))))[1]
    assert [(start, target) for start, _, target in starts] == [(0.5, 0.75)]
    fresh = anconeus.solve(0.75, np.radians(75.0))
    assert between.moment == pytest.approx(fresh.moment, rel=1e-5)
    starts.clear()
    dict(walk.states(points_of([80.0], (0.5,))))
    flexion = np.radians(75.0) - anconeus.arm.reference_angle
    assert starts[0] == (0.0, pytest.approx(flexion), 0.0)
    assert len(starts) == 2


def test_a_walk_goes_on_from_unknowns_of_an_earlier_one(anconeus, monkeypatch):
    walk = Walk(anconeus)
    points = points_of([75.0], (0.0, 0.5))
    solved = dict(walk.states(points))
    other = Walk(anconeus)
    for angle, activation in points.tolist():
        other.remember(angle, activation, walk.vector(angle, activation))
    monkeypatch.setattr(muscle_module, "reach", None)
    assert dict(other.states(points))[1].moment == pytest.approx(solved[1].moment, rel=1e-12)


def test_unknowns_are_those_of_solved_points_and_of_this_mesh(anconeus):
    walk = Walk(anconeus)
    with pytest.raises(InputError, match="expected a point that is solved, got angle 1 rad"):
        walk.vector(1.0, 0.5)
    with pytest.raises(InputError, match=r"anconeus: expected .* unknowns, got 7"):
        walk.remember(1.0, 0.5, np.zeros(7))


def test_a_point_outside_the_box_is_refused(anconeus):
    with pytest.raises(InputError, match="elbow angle: expected 10 to 150 degrees, got 170"):
        list(Walk(anconeus).states(points_of([170.0], (0.0,))))


def test_a_state_that_fails_is_yielded_with_its_reason_and_the_others_are_solved(anconeus, monkeypatch):
    original = muscle_module.reach

    def stubborn(problem, start, target, most=None):
        if target.activation == 1.0 and target.flexion > 0:
            raise NotConvergedError("no way there")
        return original(problem, start, target, most=most)

    monkeypatch.setattr(muscle_module, "reach", stubborn)
    states = dict(Walk(anconeus).states(points_of([55.0, 65.0], (0.0, 0.5, 1.0))))
    failed = [number for number, state in states.items() if isinstance(state, FailedState)]
    assert failed == [5]
    assert states[5].reason == "no way there"
    assert len(states) == 6


def test_an_active_state_is_reached_from_the_angle_before_where_rest_fails(anconeus, monkeypatch):
    original = muscle_module.reach

    def no_rest(problem, start, target, most=None):
        if target.activation == 0.0 and target.flexion > 0.3:
            raise NotConvergedError("slack")
        return original(problem, start, target, most=most)

    monkeypatch.setattr(muscle_module, "reach", no_rest)
    states = dict(Walk(anconeus).states(points_of([65.0, 80.0], (0.0, 1.0))))
    assert isinstance(states[2], FailedState)
    assert isinstance(states[3], MuscleState)


def test_a_muscle_that_folds_at_rest_is_turned_contracted_and_relaxed_there(anconeus, monkeypatch):
    original, way = muscle_module.reach, []

    def folding(problem, start, target, most=None):
        if most is not None:
            raise NotConvergedError(f"not reached with {most} tangents")
        way.append((start.controls.activation, target.activation))
        return original(problem, start, target)

    walk = Walk(anconeus)
    dict(walk.states(points_of([75.0], (0.0, 1.0))))
    monkeypatch.setattr(muscle_module, "reach", folding)
    state = dict(walk.states(points_of([85.0], (0.0,))))[0]
    assert isinstance(state, MuscleState)
    assert way == [(1.0, 1.0), (1.0, 0.0)]


@pytest.mark.parametrize("active", [(), (1.0,)])
def test_a_turn_at_rest_that_fails_from_the_nearest_state_is_tried_from_the_other_side(anconeus, monkeypatch, active):
    original, blocked = muscle_module.reach, np.radians(10.0)

    def one_sided(problem, start, target, most=None):
        if start.controls.flexion > blocked and target.flexion < start.controls.flexion:
            raise NotConvergedError("it folds the other way")
        return original(problem, start, target, most=most)

    walk = Walk(anconeus)
    dict(walk.states(points_of([65.0, 75.0], (0.0, *active))))
    reference = np.degrees(anconeus.arm.reference_angle)
    assert reference + np.degrees(blocked) < 72.0
    monkeypatch.setattr(muscle_module, "reach", one_sided)
    state = dict(walk.states(points_of([72.0], (0.0,))))[0]
    assert isinstance(state, MuscleState)


def test_a_way_ends_where_its_tangents_are_used_up(anconeus, monkeypatch):
    resting = anconeus.at_rest()
    monkeypatch.setattr("myograph.mechanics.newton.MOST_STEPS", 0)
    with pytest.raises(NotConvergedError, match="not reached with 0 tangents"):
        anconeus.reach(resting, 1.0, np.radians(100.0), most=0)
