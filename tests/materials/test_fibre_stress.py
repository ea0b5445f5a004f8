"""Stress of the fibres, dψ/dl, against the formulas in print."""

import numpy as np
import pytest

from myograph.materials.functions import NUMPY
from myograph.materials.invariants import invariants
from tests.materials.cases import EXAMPLES, FAR, FIBRE, TRANS_ISO, along_fibre, slope

STRETCH = np.array([0.55, 0.83, 0.97, 1.01, 1.023, 1.17, 1.33, 1.52, 1.71])


@pytest.mark.parametrize("name", ["blemker muscle", "blemker_tendon tendon", "trans_iso_mooney_rivlin"])
def test_an_isochoric_fibre_does_not_feel_a_change_of_volume_and_one_of_its_own_stretch_does(name):
    """The energy at s F is that at F, or that of the stretch s l."""
    at, swollen = (invariants(s * FAR, FIBRE) for s in (1.0, 1.05))
    longer = along_fibre(np.array(1.05 * np.sqrt(at.I4)))
    isochoric = EXAMPLES[name]
    own = isochoric.model_copy(update={"isochoric_fibre": False})
    assert isochoric.passive_fibre(swollen, NUMPY) == pytest.approx(isochoric.passive_fibre(at, NUMPY), rel=1e-10)
    assert own.passive_fibre(swollen, NUMPY) == pytest.approx(own.passive_fibre(longer, NUMPY), rel=1e-10)
    assert own.passive_fibre(swollen, NUMPY) > own.passive_fibre(at, NUMPY)


def test_gauss_pulls_with_a_power_at_rest_and_a_bell_when_active():
    for exponent in (1.0, 1.273, 1.9):
        law = EXAMPLES["gauss"].model_copy(update={"passive_exponent": exponent})
        strain = STRETCH - 1
        passive = law.passive_stress * (0.5 * (strain + np.hypot(strain, law.toe))) ** exponent
        assert slope(law.passive_fibre, STRETCH) == pytest.approx(passive, rel=1e-7, abs=1e-9)
    bent = law.model_copy(update={"knee_strain": 0.2, "knee_drop": 0.3})
    over = strain - bent.knee_strain
    loss = law.passive_stress * bent.knee_drop * 0.5 * (over + np.hypot(over, law.toe))
    assert slope(bent.passive_fibre, STRETCH) == pytest.approx(passive - loss, rel=1e-7, abs=1e-9)
    x = STRETCH / law.optimal_stretch - 1
    width = np.where(x > 0, law.width_descending, law.width_ascending)
    assert slope(law.active, STRETCH) == pytest.approx(
        law.peak_stress * np.exp(-((x / width) ** 2)), rel=1e-7, abs=1e-9
    )


def test_the_tendon_is_slack_then_quadratic_then_linear():
    law = EXAMPLES["toe_tendon"]
    strain = np.array([-0.02, 0.5, 2.0]) * law.toe
    expected = law.modulus * law.toe * np.array([0.0, 1 / 8, 3 / 2])
    assert slope(law.passive_fibre, 1 + strain, 1e-6) == pytest.approx(expected, rel=1e-7, abs=1e-7)


@pytest.mark.parametrize("name", ["roehrle muscle", "roehrle tendon"])
def test_roehrle_pulls_with_its_second_piola_stress_times_the_stretch(name):
    law = EXAMPLES[name]
    S_passive = np.where(STRETCH > 1, law.c3 / STRETCH**2 * (STRETCH**law.c4 - 1), 0.0)
    x = STRETCH / law.l_opt - 1
    f = np.exp(-np.where(x > 0, np.abs(x / 0.15) ** 4, np.abs(x / 0.25) ** 3))
    S_active = law.sigma_max / STRETCH**2 * f
    assert slope(law.passive_fibre, STRETCH) == pytest.approx(S_passive * STRETCH, rel=1e-7, abs=1e-9)
    assert slope(law.active, STRETCH) == pytest.approx(S_active * STRETCH, rel=1e-7, abs=1e-9)


def test_heidlauf_and_roehrle_pull_with_a_power_and_a_parabola():
    law = EXAMPLES["heidlauf_roehrle muscle"]
    passive = law.b / STRETCH * (STRETCH**law.d - 1)
    x = STRETCH / law.l_opt
    S_active = np.where(np.abs(x - 1) < 0.4, (-25 / 4 * x**2 + 25 / 2 * x - 5.25) * law.p_max / STRETCH, 0.0)
    assert slope(law.passive_fibre, STRETCH) == pytest.approx(passive, rel=1e-6, abs=1e-9)
    assert slope(law.active, STRETCH) == pytest.approx(S_active * STRETCH, rel=1e-7, abs=1e-9)


def test_blemker_pulls_with_an_exponential_and_three_parabolas():
    law = EXAMPLES["blemker muscle"]
    x, end = STRETCH / law.L_ofl, law.l_star / law.L_ofl
    growth = np.exp(law.P2 * (end - 1))
    line = growth - 1 + law.P2 * growth * (x - end)
    passive = law.P1 * np.where(x > 1, np.where(x > end, line, np.exp(law.P2 * (x - 1)) - 1), 0.0)
    outer = np.where(x < 1, 9 * (x - 0.4) ** 2, 9 * (x - 1.6) ** 2)
    active = np.where(np.abs(x - 1) <= 0.4, 1 - 4 * (1 - x) ** 2, np.where(np.abs(x - 1) < 0.6, outer, 0.0))
    scale = law.sigma_max / law.L_ofl
    assert {True, False} == set(x > end) == set(x > 1.4) == set(x < 0.6)
    assert slope(law.passive_fibre, STRETCH) == pytest.approx(scale * passive, rel=1e-7, abs=1e-9)
    assert slope(law.active, STRETCH) == pytest.approx(scale * active, rel=1e-7, abs=1e-9)


def test_the_tendon_of_blemker_stiffens_exponentially_then_is_straight():
    law = EXAMPLES["blemker_tendon tendon"]
    growth = np.exp(law.L2 * (law.l_star - 1))
    line = growth - 1 + law.L2 * growth * (STRETCH - law.l_star)
    curve = np.exp(np.minimum(law.L2 * (STRETCH - 1), 3.0)) - 1
    stress = law.L1 * np.where(STRETCH > 1, np.where(law.l_star < STRETCH, line, curve), 0.0)
    assert slope(law.passive_fibre, STRETCH) == pytest.approx(stress / STRETCH, rel=1e-6, abs=1e-8)


def test_transversely_isotropic_fibres_stiffen_exponentially_then_follow_their_line():
    law = TRANS_ISO
    last = law.C3 * (np.exp(law.C4 * (law.l_m - 1)) - 1)
    curve = law.C3 * (np.exp(np.minimum(law.C4 * (STRETCH - 1), 3.0)) - 1)
    stress = np.where(STRETCH > 1, np.where(law.l_m < STRETCH, last + law.C5 * (STRETCH - law.l_m), curve), 0.0)
    assert slope(law.passive_fibre, STRETCH) == pytest.approx(stress / STRETCH, rel=1e-7, abs=1e-8)
    assert slope(law.active, STRETCH) == pytest.approx(law.active_stress * STRETCH, rel=1e-7)


def test_guccione_in_invariants_is_guccione_in_strains():
    """Q from the components of E in a frame with the fibre first."""
    law = EXAMPLES["guccione active heart"]
    E = 0.5 * (FAR.T @ FAR - np.eye(3))
    across = E[1, 1] ** 2 + E[2, 2] ** 2 + 2 * E[1, 2] ** 2
    Q = law.bf * E[0, 0] ** 2 + law.bt * across + law.bfs * 2 * (E[0, 1] ** 2 + E[0, 2] ** 2)
    value = law.matrix(invariants(FAR, np.array([1.0, 0.0, 0.0])), NUMPY)
    assert float(value) == pytest.approx(0.5 * law.C * (np.exp(Q) - 1), rel=1e-12)


@pytest.mark.parametrize("name", ["roehrle muscle", "heidlauf_roehrle muscle", "guccione active heart"])
def test_the_active_conventions_differ_by_exactly_the_stretch(name):
    """nominal : second Piola : Cauchy = 1 : l : 1/l."""
    law = EXAMPLES[name]
    nominal, second, cauchy = (
        slope(law.model_copy(update={"convention": word}).active, STRETCH)
        for word in ("nominal", "second_piola", "cauchy")
    )
    assert np.abs(nominal).max() > 0.01
    assert second == pytest.approx(nominal * STRETCH, rel=1e-6, abs=1e-9)
    assert cauchy == pytest.approx(nominal / STRETCH, rel=1e-6, abs=1e-9)


def test_guccione_pulls_with_a_constant_second_piola_stress():
    law = EXAMPLES["guccione active heart"]
    assert slope(law.active, STRETCH) == pytest.approx(law.T_a * STRETCH, rel=1e-8)
