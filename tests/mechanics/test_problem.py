"""The whole muscle: derivatives, Newton, virtual work, rigid motion."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import NotConvergedError
from myograph.mechanics.continuation import Controls, at_rest, reach, set_controls
from myograph.mechanics.newton import newton, smallest_volume_ratio
from myograph.mechanics.problem import MuscleProblem
from myograph.mesh.presets import RESOLUTIONS, muscle_mesh
from tests.mechanics.conftest import problem_of


def _direction(problem):
    direction = np.random.default_rng(5).normal(size=problem.vector_size)
    direction[3 * problem.space.scalar.ndof :] *= 0.01
    return direction * 0.01


def test_the_residual_is_the_derivative_of_the_energy(biceps, solved):
    direction, step = _direction(biceps), 1e-4
    low, high = (biceps.energy(solved.vector + s * step * direction) for s in (-1, 1))
    assert biceps.residual(solved.vector) @ direction == pytest.approx((high - low) / (2 * step), rel=1e-5)


def test_the_tangent_is_the_derivative_of_the_residual(biceps, solved):
    direction, step = _direction(biceps), 1e-5
    low, high = (biceps.residual(solved.vector + s * step * direction) for s in (-1, 1))
    difference = (high - low) / (2 * step)
    product = biceps.tangent(solved.vector).times(direction)
    assert np.linalg.norm(product - difference) < 1e-5 * np.linalg.norm(difference)


def test_newton_ends_quadratically(biceps, solved):
    """The logarithm of the residual doubles in the last steps."""
    moved = biceps.boundary_values(0.35) - biceps.boundary_values(0.2)
    set_controls(biceps, Controls(1.0, 0.5, 0.35))
    result = newton(biceps, solved.vector, moved, contraction=0)
    set_controls(biceps, solved.controls)
    before, last, after = result.residuals[-3:]
    assert not result.failure
    assert np.log(after / last) / np.log(last / before) > 1.8


@pytest.mark.parametrize("name", ["biceps", "brachioradialis"])
def test_the_moment_is_minus_the_derivative_of_the_energy_over_the_angle(name):
    """Of equilibria, with bands that turn with the forearm and without."""
    problem = problem_of(name)
    middle = reach(problem, at_rest(problem), Controls(1.0, 0.5, 0.2))
    set_controls(problem, middle.controls)
    moment, step, energies = problem.moment(middle.vector, 0.2), 0.01, []
    for flexion in (0.2 - step, 0.2 + step):
        state = reach(problem, middle, Controls(1.0, 0.5, flexion))
        set_controls(problem, state.controls)
        energies.append(problem.energy(state.vector))
    assert moment == pytest.approx(-(energies[1] - energies[0]) / (2 * step), rel=1e-3)


def test_a_rigid_motion_of_the_arm_changes_no_moment(biceps, solved):
    """The whole arm shifted in space: same muscle, same moment."""
    data = built_in_arm().model_dump(mode="json")
    shift = np.array([120.0, -45.0, 300.0])
    data["hinge"]["point"] = list(shift + data["hinge"]["point"])
    for bone in data["bones"].values():
        bone["start"], bone["end"] = list(shift + bone["start"]), list(shift + bone["end"])
    for muscle in data["muscles"].values():
        for end in ("origin", "insertion", "via"):
            muscle[end] = None if muscle[end] is None else list(shift + muscle[end])
    arm = type(built_in_arm()).model_validate(data)
    moved = MuscleProblem(arm, "biceps", muscle_mesh(arm, "biceps", RESOLUTIONS["tiny"]))
    state = reach(moved, at_rest(moved), solved.controls)
    set_controls(moved, state.controls)
    expected = biceps.moment(solved.vector, solved.controls.flexion)
    assert moved.moment(state.vector, state.controls.flexion) == pytest.approx(expected, rel=1e-5)


def test_the_path_to_a_state_does_not_matter(biceps, solved):
    """Elastic muscle: there and back by another way, same positions."""
    elsewhere = reach(biceps, solved, Controls(1.0, 0.1, -0.4))
    back = reach(biceps, elsewhere, solved.controls)
    assert biceps.positions(back.vector) == pytest.approx(biceps.positions(solved.vector), abs=1e-4)


def test_the_volume_is_kept(biceps, solved):
    assert biceps.mesh.volume(biceps.positions(solved.vector)) == pytest.approx(biceps.mesh.volume(), rel=1e-3)
    assert smallest_volume_ratio(biceps, solved.vector) > 0.5


def test_the_ends_are_where_the_bones_hold_them(biceps, solved):
    mesh = biceps.mesh
    positions = biceps.positions(solved.vector)
    origin, insertion = mesh.end_nodes("origin"), mesh.end_nodes("insertion")
    assert positions[origin] == pytest.approx(mesh.points[origin], abs=1e-10)
    centre = biceps.hinge.flex(mesh.points[insertion].mean(axis=0), solved.controls.flexion)
    assert positions[insertion].mean(axis=0) == pytest.approx(centre, abs=1e-9)


def test_a_solve_that_fails_says_where_and_shows_its_residuals(biceps, solved, monkeypatch):
    monkeypatch.setattr("myograph.mechanics.newton.MOST_STEPS", 0)
    with pytest.raises(NotConvergedError, match=r"biceps at activation 0\.\d+, .* degrees") as caught:
        reach(biceps, solved, Controls(1.0, 1.0, -0.3))
    set_controls(biceps, solved.controls)
    assert caught.value.where is not None
    assert caught.value.where.muscle == "biceps"
    assert len(caught.value.residuals) == 1
