"""From state to state: the guess, the walk over the box, and what becomes of failures."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import NotConvergedError
from myograph.mechanics import muscle as muscle_module
from myograph.mechanics.continuation import Controls, at_rest, reach, set_controls
from myograph.mechanics.muscle import FailedState, FiniteElementMuscle, MuscleState
from myograph.mechanics.predictor import extrapolated, flexion_rate
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


def test_a_walk_yields_every_state_of_the_grid_once(anconeus):
    angles, activations = np.radians([45.0, 75.0]), (0.0, 1.0)
    states = list(anconeus.walk(angles.tolist(), activations))
    assert sorted((k, j) for k, j, _ in states) == [(0, 0), (0, 1), (1, 0), (1, 1)]
    assert all(isinstance(state, MuscleState) for _, _, state in states)
    assert all(abs(state.soundness.volume_change) < 1e-3 for _, _, state in states)


def test_a_state_that_fails_is_yielded_with_its_reason_and_the_others_are_solved(anconeus, monkeypatch):
    original = muscle_module.reach

    def stubborn(problem, start, target):
        if target.activation == 1.0 and target.flexion > 0:
            raise NotConvergedError("no way there")
        return original(problem, start, target)

    monkeypatch.setattr(muscle_module, "reach", stubborn)
    states = {(k, j): state for k, j, state in anconeus.walk(np.radians([55.0, 65.0]).tolist(), (0.0, 0.5, 1.0))}
    failed = [key for key, state in states.items() if isinstance(state, FailedState)]
    assert failed == [(1, 2)]
    assert states[1, 2].reason == "no way there"
    assert len(states) == 6


def test_an_active_state_is_reached_from_the_angle_before_where_rest_fails(anconeus, monkeypatch):
    original = muscle_module.reach

    def no_rest(problem, start, target):
        if target.activation == 0.0 and target.flexion > 0.3:
            raise NotConvergedError("slack")
        return original(problem, start, target)

    monkeypatch.setattr(muscle_module, "reach", no_rest)
    states = {(k, j): state for k, j, state in anconeus.walk(np.radians([65.0, 80.0]).tolist(), (0.0, 1.0))}
    assert isinstance(states[1, 0], FailedState)
    assert isinstance(states[1, 1], MuscleState)
