"""The energy of muscle and tendon, point by point."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.materials.functions import NUMPY, positive
from myograph.materials.jets import JETS, Jet
from myograph.materials.stress import PRESSURE, Deformation
from myograph.mechanics.law import MuscleLaw, Place

MUSCLE = built_in_arm().muscles["biceps"]
AREA = 900.0


def _jet(F, law, place, pressure=0.03, fibre=(0.6, 0.0, 0.8)):
    """The energy and the deformation, at one point."""
    deformation = Deformation(F[:, :, None], np.array(fibre)[:, None])
    unknown = Jet.variable(PRESSURE, np.array([pressure]))
    return law.energy(deformation.invariants(), unknown, place), deformation


def _energy(F, activation=0.4, ramp=1.0, fraction=0.7, muscle=MUSCLE, along_x=False):
    law, place = MuscleLaw(muscle, activation, ramp, JETS), Place(np.array([fraction]), np.array([AREA]))
    energy, deformation = _jet(F, law, place, fibre=(1.0, 0.0, 0.0) if along_x else (0.6, 0.0, 0.8))
    return float(energy.value[0]), deformation.stress(energy)[:, :, 0]


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


def test_at_the_start_of_the_ramp_no_fibre_pulls():
    muscle = MUSCLE.model_copy(
        update={"belly": MUSCLE.belly.model_copy(update={"peak_stress": 9.0, "passive_stress": 9.0})}
    )
    F = _generic_deformation()
    assert _energy(F, ramp=0.0, muscle=muscle)[1] == pytest.approx(_energy(F, ramp=0.0)[1], abs=1e-15)
    assert np.abs(_energy(F, muscle=muscle)[1] - _energy(F)[1]).max() > 1e-3


def test_the_sign_of_the_fibre_has_no_meaning():
    law, place = MuscleLaw(MUSCLE, 1.0, 1.0, JETS), Place(np.array([0.5]), np.array([500.0]))
    energies = [
        float(_jet(_generic_deformation(), law, place, 0.0, fibre)[0].value[0])
        for fibre in ((0.0, 0.6, 0.8), (0.0, -0.6, -0.8))
    ]
    assert energies[0] == pytest.approx(energies[1], rel=1e-14)


def test_the_volume_term_pulls_with_the_pressure():
    """Without fibres' share in it, dW/dp = J - 1 - p/κ."""
    F, law = _generic_deformation(), MuscleLaw(MUSCLE, 0.0, 0.0, JETS)
    energy, _ = _jet(F, law, Place(np.array([0.5]), np.array([500.0])), 0.4, (1.0, 0.0, 0.0))
    expected = np.linalg.det(F) - 1 - 0.4 / MUSCLE.belly.bulk_modulus
    assert float(energy.first[PRESSURE][0]) == pytest.approx(expected, rel=1e-10)


def _changed(**tissue):
    return MUSCLE.model_copy(update={"tissue": MUSCLE.tissue.model_copy(update=tissue)})


def _along(stretch, **where):
    """Force along the fibre per reference area, dW/dl of a stretch l along x that keeps the volume [MPa]."""
    step, energies = 1e-5, []
    for x in (stretch - step, stretch + step):
        energies.append(_energy(np.diag([x, x**-0.5, x**-0.5]), along_x=True, **where)[0])
    low, high = energies
    return (high - low) / (2 * step)


def test_a_bundle_pulls_with_the_stress_of_its_law_times_the_cross_section_of_the_muscle():
    """dW/dl of the active part = ψ'(l0 l) pcsa / A, in a thick belly as in a thin one."""
    stretch, belly, tissue = 1.05, MUSCLE.belly, MUSCLE.tissue
    active = _along(stretch, activation=1.0, fraction=1.0) - _along(stretch, activation=0.0, fraction=1.0)
    x = tissue.prestretch * stretch / belly.optimal_stretch - 1
    width = belly.width_descending if x > 0 else belly.width_ascending
    expected = belly.peak_stress * np.exp(-((x / width) ** 2))
    assert active == pytest.approx(expected * tissue.pcsa / AREA, rel=1e-6)


def test_without_bundles_fibres_pull_with_the_stress_of_the_law():
    """One fibre's nominal stress, where bundles give it pcsa / A: dW/dl = l0 ψ'(l0 l)."""
    stretch, tissue = 1.05, MUSCLE.tissue
    muscles = [_changed(bundles=False), MUSCLE]
    loose, bundled = (
        _along(stretch, activation=1.0, fraction=1.0, muscle=m)
        - _along(stretch, activation=0.0, fraction=1.0, muscle=m)
        for m in muscles
    )
    assert loose / bundled == pytest.approx(tissue.prestretch * AREA / tissue.pcsa, rel=1e-6)


def test_the_tendon_pulls_with_its_modulus_times_its_own_area():
    strain, law = 2 * MUSCLE.tendon.toe, MUSCLE.tendon
    fibre = law.modulus * (strain - law.toe / 2) * MUSCLE.tissue.tendon_area / AREA
    stretch = 1 + strain
    matrix = 2 * law.c1 * (stretch - stretch**-2)
    assert _along(stretch, fraction=0.0) == pytest.approx(fibre + matrix, rel=1e-6)


def test_a_pre_stretched_matrix_pulls_in_the_reference_body_and_one_that_is_not_rests():
    """Mooney–Rivlin at l0: dW/dl = 2 s_m (c1 + c2 / l0) (l0² - 1 / l0)."""
    silent = {"passive_stress": 0.0, "peak_stress": 0.0}
    belly, l0 = MUSCLE.belly, MUSCLE.tissue.prestretch
    pulls = {}
    for prestretched in (True, False):
        muscle = _changed(prestretch_matrix=prestretched)
        muscle = muscle.model_copy(update={"belly": belly.model_copy(update=silent)})
        pulls[prestretched] = _along(1.0, fraction=1.0, muscle=muscle)
    over = MUSCLE.tissue.full_area / AREA - 1
    slim = 1 + 0.5 * (over + np.hypot(over, 0.1))
    assert pulls[True] == pytest.approx(2 * slim * (belly.c1 + belly.c2 / l0) * (l0**2 - 1 / l0), rel=1e-6)
    assert pulls[False] == pytest.approx(0, abs=1e-9)


def test_the_positive_part_is_smooth_and_never_zero():
    assert positive(-3.0, 0.1, NUMPY) > 0
    assert positive(3.0, 0.1, NUMPY) == pytest.approx(3.0, abs=1e-3)
