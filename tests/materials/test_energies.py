"""What every law must satisfy, whatever its formula."""

import numpy as np
import pytest

from myograph.materials.functions import NUMPY
from myograph.materials.invariants import invariants
from tests.materials.cases import EXAMPLES, FIBRE, STATES, STRETCHED, along_fibre, energy, piola, slope

laws = pytest.mark.parametrize("law", EXAMPLES.values(), ids=EXAMPLES.keys())
states = pytest.mark.parametrize("F", STATES.values(), ids=STATES.keys())


def _rotation():
    Q, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    return Q * np.linalg.det(Q)


@laws
@states
def test_a_rotation_of_the_body_only_rotates_the_stress(law, F):
    """W(Q F) = W(F), P(Q F) = Q P(F)."""
    Q = _rotation()
    P = piola(law, F)
    assert energy(law, Q @ F) == pytest.approx(energy(law, F), rel=1e-11, abs=1e-13)
    assert piola(law, Q @ F) == pytest.approx(Q @ P, abs=1e-7 * np.abs(P).max())


@laws
@states
def test_a_rotation_of_the_tissue_with_its_fibre_changes_no_energy(law, F):
    """Transverse isotropy: W(F Qᵀ, Q a0) = W(F, a0)."""
    Q = _rotation()
    assert energy(law, F @ Q.T, fibre=Q @ FIBRE) == pytest.approx(energy(law, F), rel=1e-11, abs=1e-13)


@laws
def test_the_sign_of_the_fibre_has_no_meaning(law):
    assert energy(law, STRETCHED, fibre=-FIBRE) == pytest.approx(energy(law, STRETCHED), rel=1e-14)


@laws
def test_cauchy_stress_is_symmetric(law):
    tau = piola(law, STRETCHED) @ STRETCHED.T
    assert tau == pytest.approx(tau.T, abs=1e-7 * np.abs(tau).max())


@pytest.mark.parametrize("name", sorted(EXAMPLES.keys() - {"gauss"}))
def test_the_reference_is_free_of_stress_without_activation(name):
    """At p = 0; one-sided differences of laws whose fibre sets in at l = 1 vanish with the step."""
    law, step = EXAMPLES[name], 1e-7
    stiffness = 300.0
    for i, j in np.ndindex(3, 3):
        change = np.zeros((3, 3))
        change[i, j] = step
        for sign in (1, -1):
            work = energy(law, np.eye(3) + sign * change, activation=0.0) - energy(law, np.eye(3), activation=0.0)
            assert abs(work / step) < (stiffness + law.bulk_modulus) * step


def test_the_built_in_belly_is_all_but_slack_at_the_length_where_it_should_be():
    """passive_stress (toe / 2)^n is the price of its smoothness."""
    belly = EXAMPLES["gauss"]
    here = slope(belly.passive_fibre, np.array([1.0]))[0]
    assert here == pytest.approx(belly.passive_stress * (belly.toe / 2) ** belly.passive_exponent, rel=1e-7)
    assert here < 0.02 * belly.passive_stress


@laws
def test_the_energy_is_linear_in_the_activation(law):
    at = invariants(STRETCHED, FIBRE)
    rest, half, full = (float(law.energy(at, a, NUMPY)) for a in (0.0, 0.5, 1.0))
    assert half == pytest.approx(0.5 * (rest + full), rel=1e-13, abs=1e-15)
    assert full - rest == pytest.approx(float(law.active(at, NUMPY)), rel=1e-9, abs=1e-12)


@laws
def test_the_mixed_energy_is_stationary_over_the_pressure_at_that_of_the_law(law):
    """dW/dp = 0 at p = K θ(J), and W there is the energy without an unknown pressure."""
    at = invariants(STRETCHED, FIBRE)
    pressure = law.bulk_modulus * law.volume_strain(at.J, NUMPY)
    values = [float(law.mixed_energy(at, pressure + d, 0.7, NUMPY)) for d in (-1e-3, 0.0, 1e-3)]
    assert values[1] == pytest.approx(float(law.energy(at, 0.7, NUMPY)), rel=1e-12)
    assert values[2] - values[0] == pytest.approx(0.0, abs=1e-13)
    assert values[1] > values[0]


@laws
def test_energies_are_finite_and_their_slopes_continuous_from_half_to_twice_the_length(law):
    """No jump of the fibre's stress anywhere: over a step of 1e-4 it moves by at most its largest slope."""
    stretch = np.linspace(0.5, 1.5, 10001)
    for part in (law.matrix, law.passive_fibre, law.active):
        values = np.broadcast_to(part(along_fibre(stretch), NUMPY), stretch.shape)
        stress = np.gradient(values, stretch)
        jumps = np.abs(np.diff(stress[1:-1]))
        assert np.isfinite(values).all()
        assert jumps.max() <= 25 * max(np.percentile(jumps, 99), 1e-9)


@laws
def test_the_law_is_evaluated_on_whole_arrays_at_once(law):
    F = np.stack(list(STATES.values()))
    together = law.energy(invariants(F, np.tile(FIBRE, (3, 1))), 0.7, NUMPY)
    assert together == pytest.approx(np.array([energy(law, each) for each in F]), rel=1e-12)
