"""Solved specimens: equilibrium, reactions, objectivity, symmetric answers, Newton's quadratic tail."""

import numpy as np
import pytest

pytest.importorskip("ngsolve", reason="the mechanics need NGSolve")

from myograph.errors import NotConvergedError
from myograph.materials.guccione import Guccione
from myograph.materials.mooney_rivlin import MooneyRivlin
from myograph.materials.neo_hooke import NeoHooke
from myograph.mechanics.specimen import Box, Load, Specimen, ThickCylinder, solve

RUBBER = MooneyRivlin(c1=1.0, c2=0.5, K=1000.0)
ACTIVE = MooneyRivlin(c1=0.5, K=1000.0, contraction="fibre", active_stress=0.5)
HEART = Guccione(C=2e-3, bf=8.0, bt=2.0, bfs=4.0, bulk=10.0)
FOAM = NeoHooke(E=1.0, nu=0.3)


@pytest.mark.parametrize("element", ["hexahedra", "tetrahedra"])
def test_stretch_stress_and_reaction_of_a_bar_agree(element):
    """The force on the end is the Cauchy stress times the deformed section; the other end holds against it."""
    bar = Specimen(Box((3.0, 2.0, 1.0), (2, 1, 1)), RUBBER, element=element)
    state = solve(bar, Load(displacement={"x_max": (0.9, None, None)}))
    stretches, stress = state.mean_stretches, state.mean_stress
    assert stretches[0] == pytest.approx(1.3)
    assert stretches[1] == pytest.approx(stretches[2])
    assert state.reactions["x_max"][0] == pytest.approx(stress[0, 0] * 2 * stretches[1] * stretches[2], rel=1e-9)
    assert state.reactions["x_min"][0] == pytest.approx(-state.reactions["x_max"][0], rel=1e-9)
    assert stress[1:, 1:] == pytest.approx(np.zeros((2, 2)), abs=1e-9)
    assert state.samples.weights.sum() == pytest.approx(6.0)


def test_a_dead_traction_gives_the_stretch_that_costs_it():
    bar = Specimen(Box((3.0, 2.0, 1.0), (2, 1, 1)), RUBBER)
    pulled = solve(bar, Load(displacement={"x_max": (0.9, None, None)}))
    nominal = float(pulled.reactions["x_max"][0]) / 2.0
    state = solve(bar, Load(traction={"x_max": (nominal, 0.0, 0.0)}))
    assert state.displacement_at((3.0, 2.0, 1.0)) == pytest.approx(pulled.displacement_at((3.0, 2.0, 1.0)), rel=1e-9)


def test_a_follower_pressure_all_around_is_a_hydrostatic_stress():
    """Pressure on every free face of a cube: σ = -π 1, however large the deformation."""
    faces = {"x_max": 0.4, "y_max": 0.4, "z_max": 0.4}
    state = solve(Specimen(Box(), FOAM), Load(pressure=faces))
    assert state.mean_stretches[0] < 0.9
    assert state.mean_stress == pytest.approx(-0.4 * np.eye(3), abs=1e-10)


def test_the_fibre_decides_where_a_free_block_shortens_not_the_sign_of_it():
    """The same block with its fibre along y, along -y, along z: the same stretches, permuted."""
    along = {fibre: solve(Specimen(Box(), ACTIVE, fibre), Load(activation=1.0)).mean_stretches for fibre in _FIBRES}
    for fibre, stretches in along.items():
        axis = int(np.abs(fibre).argmax())
        assert np.roll(stretches, -axis) == pytest.approx(along[1.0, 0.0, 0.0], rel=1e-9)


_FIBRES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0))


def test_half_the_activation_is_half_the_active_stress():
    half = MooneyRivlin(c1=0.5, K=1000.0, contraction="fibre", active_stress=0.25)
    at_half = solve(Specimen(Box(), ACTIVE), Load(activation=0.5))
    assert at_half.mean_stretches == pytest.approx(solve(Specimen(Box(), half), Load(activation=1.0)).mean_stretches)


def test_a_rotated_body_carries_the_rotated_stress():
    """P(QF) = Q P(F): the whole boundary turned by a third of a circle about the diagonal."""
    F = np.array([[1.2, 0.1, 0.0], [0.0, 0.9, 0.0], [0.0, 0.05, 1.0]])
    Q = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    cube = Specimen(Box(), ACTIVE, symmetry=())
    first, second = (
        solve(cube, Load(gradient=tuple(map(tuple, gradient.tolist())), activation=1.0), steps=4)
        for gradient in (F, Q @ F)
    )
    assert second.mean_stress == pytest.approx(Q @ first.mean_stress @ Q.T, abs=1e-9)


def test_the_load_steps_do_not_matter_and_newton_ends_quadratically():
    tube = Specimen(ThickCylinder(1.0, 2.0, cells=(2, 2, 1)), RUBBER, symmetry=("x_min", "y_min", "z_min", "z_max"))
    load = Load(pressure={"inner": 1.2})
    once, often = solve(tube, load), solve(tube, load, steps=3)
    assert often.displacement == pytest.approx(once.displacement, abs=1e-10)
    assert [step.share for step in often.history] == pytest.approx([1 / 3, 2 / 3, 1.0])
    before, after = once.history[-1].corrections[-3:-1]
    assert after < 10 * before**2
    assert once.history[-1].residuals[-1] < 1e-4 * max(once.history[-1].residuals)


def test_newton_stays_quadratic_under_a_pressure_that_has_no_energy():
    """A cantilever: the edges of the pressed face are free, so the tangent is not symmetric."""
    beam = Specimen(Box((4.0, 1.0, 1.0), (4, 2, 1)), HEART, symmetry=())
    state = solve(beam, Load(displacement={"x_min": (0.0, 0.0, 0.0)}, pressure={"z_min": 3e-5}))
    before, after = state.history[-1].corrections[-2:]
    assert before > 1e-8
    assert after < 100 * before**2


def test_a_step_that_fails_is_halved():
    """Between clamped ends, pressed to half its height: too much at once, but not in smaller steps."""
    cube = Specimen(Box(cells=(2, 2, 2)), RUBBER, symmetry=())
    state = solve(cube, Load(displacement={"x_min": (0.0, 0.0, 0.0), "x_max": (-0.5, 0.0, 0.0)}))
    assert len(state.history) > 1
    assert state.history[-1].share == 1.0
    assert state.mean_gradient[0, 0] == pytest.approx(0.5)
    assert np.linalg.det(state.samples.F).min() > 0


def test_a_body_that_is_turned_inside_out_is_no_solution():
    """A law whose volume part is smooth at J = 0 has equilibria there, which Newton's method finds."""
    with pytest.raises(NotConvergedError, match=r"an element turned inside out \(J = -"):
        solve(Specimen(Box(), HEART), Load(displacement={"x_max": (-1.5, None, None)}))


def test_a_load_that_nothing_can_bear_says_where_it_stopped():
    """A bar pressed to no length at all."""
    bar = Specimen(Box(), RUBBER)
    with pytest.raises(NotConvergedError, match=r"Box of MooneyRivlin at .*% of its load") as caught:
        solve(bar, Load(displacement={"x_max": (-1.0, None, None)}))
    assert caught.value.exit_code == 3
    assert len(caught.value.residuals) > 0
