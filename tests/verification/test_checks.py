"""The verification table: every check passes, and none passes with another law."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("ngsolve", reason="verification needs NGSolve")


from myograph.errors import InputError, NotConvergedError
from myograph.verification import closed_forms, cook, febio, land, orders, patch
from myograph.verification.check import CheckResult, run_check
from myograph.verification.table import CHECKS, select, verify

BY_NAME = {check.name: check for check in CHECKS}


@pytest.mark.parametrize("name", BY_NAME)
def test_every_check_passes(name):
    result = run_check(BY_NAME[name])
    assert result.passed, (result.value, result.check.reference, result.relative_error)


def test_names_are_unique_and_every_check_says_what_it_is_and_where_it_is_from():
    assert len(BY_NAME) == len(CHECKS) >= 19
    for check in CHECKS:
        assert check.what
        assert check.source
        assert 0 < check.tolerance <= 0.05


def _changed(law, **parameters):
    return law.model_copy(update=parameters)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("febio.ma20", lambda: febio.contracted(_changed(febio.ISOTROPIC, nu=0.301))),
        ("febio.ma24", lambda: febio.contracted(_changed(febio.FIBRE, active_stress=0.501))),
        ("febio.ma25", lambda: febio.contracted(_changed(febio.RUBBER, K=1001.0))),
        ("febio.mu03", lambda: febio.stretched(_changed(febio.BLEMKER, P1=0.0501)).free_norm),
        ("febio.mu03_stress", lambda: febio.stretched(_changed(febio.BLEMKER, P2=6.61)).mean_stress[0, 0]),
        ("closed_form.uniaxial", lambda: closed_forms.uniaxial(_changed(closed_forms.RUBBER, c2=0.501))),
        ("closed_form.equibiaxial", lambda: closed_forms.equibiaxial(_changed(closed_forms.RUBBER, c2=0.501))),
        ("closed_form.pure_shear", lambda: closed_forms.pure_shear(_changed(closed_forms.RUBBER, c2=0.501))),
        ("closed_form.active_block", lambda: closed_forms.active_block(_changed(closed_forms.MUSCLE, c1=0.501))),
        ("closed_form.thick_sphere", lambda: closed_forms.thick_sphere(_changed(closed_forms.SHELL, c2=0.51))),
        ("closed_form.thick_cylinder", lambda: closed_forms.thick_cylinder(_changed(closed_forms.SHELL, c2=0.51))),
        ("land.beam", lambda: land.end_position((10, 2, 1), _changed(land.HEART, bf=9.0))[2]),
    ],
)
def test_another_law_does_not_pass(name, value):
    assert not run_check(replace(BY_NAME[name], value=lambda: float(value()))).passed


def test_cooks_membrane_misses_its_reference_where_the_traction_loses_a_twentieth():
    traction = 0.95 * cook.TRACTION
    check = replace(BY_NAME["cook.membrane"], value=lambda: cook.extrapolated(traction=traction))
    assert not run_check(check).passed


def test_cooks_membrane_converges_from_below_and_its_limit_is_extrapolated():
    coarse, middle, fine = (cook.corner_displacement(cells) for cells in cook.REFINEMENT)
    assert coarse < middle < fine < cook.extrapolated() < 6.94
    assert fine == pytest.approx(6.925, abs=1e-3)


def test_lands_beam_ends_at_a_height_not_at_a_displacement_of_4_17():
    end = land.end_position((10, 2, 2))
    assert end == pytest.approx([9.176, 0.5, 4.169], abs=2e-3)
    assert end[2] - land.POINT[2] == pytest.approx(3.17, abs=0.01)


def test_the_closed_form_of_the_tube_keeps_its_volume_and_is_a_gradient():
    """F of the tube by differences of its displacement, and det F = 1."""
    points = np.random.default_rng(1).uniform(0.8, 1.05, (5, 3))
    _, F = orders.exact(points)
    assert np.linalg.det(F) == pytest.approx(1.0, abs=1e-12)
    step = 1e-6
    for k in range(3):
        ahead, behind = (orders.exact(points + sign * step * np.eye(3)[k])[0] for sign in (1, -1))
        assert F[:, :, k] == pytest.approx((ahead - behind) / (2 * step) + np.eye(3)[k], abs=1e-8)


def test_a_pressure_that_is_a_little_off_spoils_the_order(monkeypatch):
    monkeypatch.setattr(orders, "_INFLATED", 1.1003)
    orders.errors.cache_clear()
    try:
        assert not run_check(BY_NAME["orders.hexahedra_u"]).passed
    finally:
        orders.errors.cache_clear()


def test_a_contraction_that_varies_spoils_the_patch(monkeypatch):
    """A law whose stress depends on the place leaves the homogeneous state."""

    def uneven(self, at, f):
        return (1.0 + 1e-6 * np.arange(at.I4.value.size)) * (0.25 * (at.I4 - 1))

    monkeypatch.setattr(type(patch.LAW), "active", uneven)
    assert not run_check(BY_NAME["patch.hexahedra"]).passed


def test_a_method_that_fails_is_a_failed_check_with_its_reason():
    def fails():
        raise NotConvergedError("no convergence in 20 corrections")

    result = run_check(replace(BY_NAME["febio.ma20"], value=fails))
    assert not result.passed
    assert result.failure == "no convergence in 20 corrections"


def test_the_error_is_relative_to_a_reference_that_is_not_zero():
    check = replace(BY_NAME["febio.ma20"], reference=-2.0, tolerance=0.5)
    assert CheckResult(check, -1.0).relative_error == 0.5
    assert CheckResult(check, -1.0).passed
    assert not CheckResult(check, -0.99).passed
    assert CheckResult(replace(check, reference=0.0), -0.25).relative_error == 0.25


def test_checks_are_found_by_name_and_by_family():
    assert [check.name for check in select(["patch.tetrahedra", "cook"])] == ["cook.membrane", "patch.tetrahedra"]
    assert select([]) == CHECKS
    assert [result.check.name for result in verify(["closed_form.uniaxial"])] == ["closed_form.uniaxial"]


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("febio.ma21", "unknown check 'febio.ma21': did you mean 'febio.ma2"),
        ("xyz", "expected one of closed_form, cook"),
    ],
)
def test_an_unknown_check_names_the_near_one(name, words):
    with pytest.raises(InputError, match=words):
        select([name])
