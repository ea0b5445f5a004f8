"""Checks of the published limb: there with its samples, otherwise skipped and said so."""

import os
from dataclasses import replace
from pathlib import Path

import pytest

pytest.importorskip("ngsolve", reason="verification needs NGSolve")

from myograph.errors import InputError
from myograph.verification import limb
from myograph.verification.check import run_check
from myograph.verification.table import CHECKS, select, skipped

DATA = Path(os.environ.get("MYOGRAPH_REFERENCE_DATA", Path(__file__).parents[3] / "shared" / "data"))

reference = [
    pytest.mark.reference,
    pytest.mark.skipif(not (DATA / limb.SAMPLES).exists(), reason="the reference data are not here"),
]


def _reference(test):
    for mark in reference:
        test = mark(test)
    return test


@_reference
def test_every_check_of_the_published_limb_passes():
    found = [run_check(check) for check in limb.checks(DATA)]
    assert [result.check.name for result in found if not result.passed] == []
    assert len(found) == 9
    by_name = {result.check.name: result for result in found}
    for name, (_, _, _, known) in limb._ANGLES.items():
        assert by_name[f"limb.{name}"].value == pytest.approx(known, abs=0.5)
    assert by_name["limb.least"].value == pytest.approx(0.667, abs=0.01)
    assert [check.name for check in select([], DATA)] == [*(c.name for c in CHECKS), *by_name]
    assert skipped([], DATA) == {}


@_reference
@pytest.mark.parametrize(("muscle", "lever"), [("biceps", 1.05), ("triceps", 0.95)])
def test_other_lever_arms_do_not_pass(muscle, lever):
    spec = limb.TWO_MUSCLES
    column = spec.muscles[muscle]
    changed = column.model_copy(update={"lever_mm": tuple(lever * one for one in column.lever_mm)})
    other = spec.model_copy(update={"muscles": {**spec.muscles, muscle: changed}})
    passed = {result.check.name for result in map(run_check, limb.checks(DATA, other)) if result.passed}
    assert len(passed) <= 4
    assert "limb.rest_unloaded" not in passed


@_reference
def test_a_load_that_something_holds_is_no_absence_of_equilibria():
    check = next(check for check in limb.checks(DATA) if check.name == "limb.none")
    two = limb.limb_from_forces(limb.TWO_MUSCLES, DATA, gravity=False)
    assert not run_check(replace(check, value=lambda: limb._count(two, 22.0))).passed


def test_without_the_samples_the_checks_are_skipped_with_what_to_do(tmp_path):
    assert limb.checks(None) == limb.checks(tmp_path) == ()
    assert select([], tmp_path) == CHECKS
    assert list(skipped([], tmp_path)) == ["limb"]
    assert "MYOGRAPH_REFERENCE_DATA" in skipped([])["limb"]
    assert skipped(["patch"]) == {}
    with pytest.raises(InputError, match=r"check 'limb.rest' has no data: .* --data or MYOGRAPH_REFERENCE_DATA"):
        select(["limb.rest"])
