"""Stress and elasticity of every law, against differences of its energy and of its stress."""

import numpy as np
import pytest

from myograph.materials.jets import JETS, Jet
from myograph.materials.stress import PRESSURE, Deformation
from tests.materials.cases import EXAMPLES, FIBRE, STATES, piola

PRESSED = 0.3
laws = pytest.mark.parametrize("law", EXAMPLES.values(), ids=EXAMPLES.keys())
states = pytest.mark.parametrize("F", STATES.values(), ids=STATES.keys())


def _evaluated(law, F, pressure=PRESSED, second=True):
    deformation = Deformation(F[:, :, None], FIBRE[:, None])
    unknown = Jet.variable(PRESSURE, np.array([pressure]), second)
    return deformation, law.mixed_energy(deformation.invariants(second), unknown, 0.7, JETS)


def _stress(law, F, pressure=PRESSED):
    deformation, energy = _evaluated(law, F, pressure, second=False)
    return deformation.stress(energy)[:, :, 0]


@laws
@states
def test_stress_is_the_derivative_of_the_energy(law, F):
    pressure = law.bulk_modulus * float(np.asarray(law.volume_strain(np.linalg.det(F), JETS)))
    expected = piola(law, F)
    assert _stress(law, F, pressure) == pytest.approx(expected, abs=1e-7 * np.abs(expected).max())


@laws
@states
def test_elasticity_is_the_derivative_of_the_stress(law, F):
    deformation, energy = _evaluated(law, F)
    found, step = deformation.elasticity(energy)[..., 0].transpose(1, 0, 2, 3), 1e-6
    for k, m in np.ndindex(3, 3):
        change = np.zeros((3, 3))
        change[k, m] = step
        difference = (_stress(law, F + change) - _stress(law, F - change)) / (2 * step)
        assert found[:, :, k, m] == pytest.approx(difference, abs=2e-8 * np.abs(found).max())


@laws
@states
def test_the_pressure_presses_on_the_volume(law, F):
    deformation, energy = _evaluated(law, F)
    found, step = deformation.stress_by_pressure(energy)[:, :, 0], 1e-5
    difference = (_stress(law, F, PRESSED + step) - _stress(law, F, PRESSED - step)) / (2 * step)
    assert found == pytest.approx(difference, abs=1e-8)


@laws
def test_at_the_reference_all_is_finite(law):
    """Some fibres set in there, and acosh would be infinitely steep."""
    deformation, energy = _evaluated(law, np.eye(3))
    assert np.isfinite(deformation.stress(energy)).all()
    assert np.isfinite(deformation.elasticity(energy)).all()


@laws
@states
def test_cauchy_stress_is_symmetric(law, F):
    deformation, energy = _evaluated(law, F)
    sigma = deformation.cauchy_stress(energy)[:, :, 0]
    assert sigma == pytest.approx(sigma.T, abs=1e-12 * np.abs(sigma).max())
