"""The energy of muscle and tendon, point by point."""

import ngsolve as ngs
import numpy as np
import pytest
from ngsolve.meshes import MakeStructured3DMesh
from scipy.integrate import quad

from myograph.anatomy.load import built_in_arm
from myograph.mechanics.law import MuscleLaw, Site, belly_energy, matrix_energy, positive, tendon_energy

MESH = MakeStructured3DMesh(hexes=True, nx=1, ny=1, nz=1)
POINT = MESH(0.3, 0.4, 0.5)
MUSCLE = built_in_arm().muscles["biceps"]


def _value(function):
    return np.array(function(POINT))


def _number(value):
    return ngs.CoefficientFunction(float(value))


def _energy(F, activation=0.4, ramp=1.0, fraction=0.7, muscle=MUSCLE):
    law = MuscleLaw(muscle.fibre, muscle.tendons, muscle.matrix, _number(activation), _number(ramp))
    site = Site(ngs.CoefficientFunction((0.6, 0.0, 0.8)), _number(fraction), _number(900.0))
    matrix = ngs.CoefficientFunction(tuple(map(float, F.ravel())), dims=(3, 3))
    variable = matrix.MakeVariable()
    energy = law.energy(variable, _number(0.03), site)
    return float(_value(energy)), _value(energy.Diff(variable)).reshape(3, 3)


def _generic_deformation():
    return np.array([[1.06, 0.05, -0.02], [0.03, 0.93, 0.07], [-0.04, 0.02, 1.04]])


def test_the_stress_is_the_derivative_of_the_energy():
    F, step = _generic_deformation(), 1e-6
    _, P = _energy(F)
    for i, j in np.ndindex(3, 3):
        change = np.zeros((3, 3))
        change[i, j] = step
        difference = (_energy(F + change)[0] - _energy(F - change)[0]) / (2 * step)
        assert P[i, j] == pytest.approx(difference, rel=1e-5, abs=1e-8)


def test_a_rotation_of_the_body_only_rotates_the_stress():
    F = _generic_deformation()
    Q, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    Q *= np.linalg.det(Q)
    energy, P = _energy(F)
    rotated_energy, rotated_P = _energy(Q @ F)
    assert rotated_energy == pytest.approx(energy, rel=1e-12)
    assert rotated_P == pytest.approx(Q @ P, abs=1e-12)


def test_cauchy_stress_is_symmetric():
    F = _generic_deformation()
    sigma = _energy(F)[1] @ F.T / np.linalg.det(F)
    assert sigma == pytest.approx(sigma.T, abs=1e-12)


def test_the_sign_of_the_fibre_has_no_meaning():
    law = MuscleLaw(MUSCLE.fibre, MUSCLE.tendons, MUSCLE.matrix, _number(1.0), _number(1.0))
    F = ngs.CoefficientFunction(tuple(_generic_deformation().ravel()), dims=(3, 3))
    energies = [
        float(_value(law.energy(F, _number(0.0), Site(ngs.CoefficientFunction(a), _number(0.5), _number(500.0)))))
        for a in ((0.0, 0.6, 0.8), (0.0, -0.6, -0.8))
    ]
    assert energies[0] == pytest.approx(energies[1], rel=1e-14)


def test_the_volume_term_pulls_with_the_pressure():
    """Without fibres' share in it, dW/dp = J - 1 - p/κ."""
    F = _generic_deformation()
    law = MuscleLaw(MUSCLE.fibre, MUSCLE.tendons, MUSCLE.matrix, _number(0.0), _number(0.0))
    site = Site(ngs.CoefficientFunction((1.0, 0.0, 0.0)), _number(0.5), _number(500.0))
    pressure = _number(0.4).MakeVariable()
    energy = law.energy(ngs.CoefficientFunction(tuple(F.ravel()), dims=(3, 3)), pressure, site)
    slope = float(_value(energy.Diff(pressure)))
    assert slope == pytest.approx(np.linalg.det(F) - 1 - 0.4 / MUSCLE.matrix.bulk, rel=1e-10)


def test_the_matrix_does_not_feel_a_change_of_volume():
    """I1bar and I2bar are isochoric: the energy of s F is that of F."""
    site = Site(ngs.CoefficientFunction((1.0, 0.0, 0.0)), _number(0.5), _number(500.0))

    def energy(factor):
        F = factor * _generic_deformation()
        elastic = ngs.CoefficientFunction(tuple(map(float, F.ravel())), dims=(3, 3))
        return float(_value(matrix_energy(elastic, _number(np.linalg.det(F)), MUSCLE.matrix, site)))

    assert energy(1.2) == pytest.approx(energy(1.0), rel=1e-12)


@pytest.mark.parametrize("exponent", [1.0, 1.273, 1.9])
@pytest.mark.parametrize("activation", [0.0, 1.0])
def test_the_energy_of_the_belly_is_the_integral_of_its_force(exponent, activation):
    fibre = MUSCLE.fibre.model_copy(update={"passive_exponent": exponent})

    def force(stretch):
        total = fibre.prestretch * stretch
        passive = fibre.passive_force * (0.5 * (total - 1 + np.hypot(total - 1, fibre.toe))) ** exponent
        x = total / fibre.optimal_stretch - 1
        width = fibre.width_descending if x > 0 else fibre.width_ascending
        return passive + activation * fibre.active_force * np.exp(-((x / width) ** 2))

    def energy(stretch):
        return float(_value(belly_energy(_number(stretch), _number(fibre.prestretch), fibre, _number(activation))))

    optimum = fibre.optimal_stretch / fibre.prestretch
    work, _ = quad(force, 0.7, 1.25, points=[optimum], epsabs=1e-10)
    assert energy(1.25) - energy(0.7) == pytest.approx(work, rel=1e-8)


def test_the_tendon_is_slack_then_quadratic_then_linear():
    tendons, step = MUSCLE.tendons, 1e-5

    def force(strain):
        low, high = (float(_value(tendon_energy(_number(1 + strain + d), tendons))) for d in (-step, step))
        return (high - low) / (2 * step)

    toe, stiffness = tendons.toe, tendons.stiffness
    assert force(-0.02) == pytest.approx(0, abs=1e-9)
    assert force(toe / 2) == pytest.approx(stiffness * toe / 8, rel=1e-5)
    assert force(2 * toe) == pytest.approx(stiffness * 1.5 * toe, rel=1e-6)


def test_the_positive_part_is_smooth_and_never_zero():
    assert float(_value(positive(_number(-3.0), 0.1))) > 0
    assert float(_value(positive(_number(3.0), 0.1))) == pytest.approx(3.0, abs=1e-3)
