"""The arm by finite elements at its equilibrium."""

import shutil

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES, Case
from myograph.errors import InputError
from myograph.units import radians

pytest.importorskip("ngsolve", reason="the mechanics need NGSolve")
from myograph.limb.direct_arm import ACCURACY, DirectArm, stable_root
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.tabulate import tabulate_muscle
from myograph.limb.tables.unknowns import interpolated_unknowns


@pytest.mark.parametrize("start", [-2.0, 0.1, 1.1, 2.9, 7.0])
def test_the_root_is_the_one_to_which_the_moment_turns(start):
    """sin has its stable roots, where it falls, at odd multiples of π."""
    assert stable_root(np.sin, start, 0.05, 6.0) == pytest.approx(np.pi, abs=ACCURACY)


def test_a_start_on_a_root_stays():
    assert stable_root(lambda angle: 1.0 - angle, 1.0, 0.0, 2.0) == 1.0


@pytest.mark.parametrize(("sign", "end"), [(1.0, 100), (-1.0, 10)])
def test_a_moment_without_root_says_how_large_it_is_at_the_end(sign, end):
    with pytest.raises(
        InputError, match=rf"from 10 to 100 degrees, got a net moment of {sign * 2:.2f} N·m at {end} deg"
    ):
        stable_root(lambda _: sign * 2000.0, 1.0, radians(10), radians(100))


@pytest.fixture(scope="module")
def arm():
    return DirectArm(built_in_arm(), "tiny")


def test_all_moments_cancel_at_the_answer(arm):
    """To what the accuracy of the angle costs: the stops alone change by 0.01 N·m in it."""
    case = Case((0.1, 0.2, 0.3, 0.1, 0.1), hand_load=10.0)
    solution = arm(case)
    slope = (
        arm.net_moment(case, solution.elbow_angle + 0.01) - arm.net_moment(case, solution.elbow_angle - 0.01)
    ) / 0.02
    assert abs(arm.net_moment(case, solution.elbow_angle)) < 2 * ACCURACY * abs(slope)
    assert slope < 0
    assert solution.origin == "direct"
    assert set(solution.fields["biceps"]) >= {"position", "cauchy_stress", "pressure", "fibre_stretch"}
    assert sum(solution.moments.values()) == pytest.approx(
        -float(arm._outside(np.array([solution.elbow_angle]), 10.0)[0]), abs=2 * ACCURACY * abs(slope)
    )


@pytest.mark.exhaustive
def test_a_guess_does_not_change_the_answer(arm):
    case = Case((0.1, 0.2, 0.3, 0.1, 0.1), hand_load=10.0)
    guessing = DirectArm(built_in_arm(), "tiny", guess=lambda _: radians(75))
    assert guessing(case).elbow_angle == pytest.approx(arm(case).elbow_angle, abs=2 * ACCURACY)


def test_a_prescribed_angle_is_kept(arm):
    solution = arm(Case((0.0,) * 5, elbow_angle=radians(80)))
    assert solution.elbow_angle == radians(80)


def test_a_load_that_no_muscle_holds_is_refused(arm):
    with pytest.raises(InputError, match="5000 N in the hand: expected an angle at rest from 10 to 150"):
        arm(Case((0.0,) * 5, hand_load=5000.0))


def test_who_forgets_answers_the_same_bits_again(arm):
    """And what was solved in between leaves no trace."""
    case, other = Case((0.2,) * 5, elbow_angle=radians(70)), Case((0.6,) * 5, elbow_angle=radians(75))
    arm.forget()
    first = arm(case).fields["biceps"]["position"]
    arm(other)
    arm.forget()
    assert np.array_equal(arm(case).fields["biceps"]["position"], first)


@pytest.fixture(scope="module")
def tabulated(tmp_path_factory):
    """A folder with states of the biceps, and its table."""
    folder = tmp_path_factory.mktemp("tables")
    return folder, tabulate_muscle(built_in_arm(), "biceps", "tiny", TableSpec.regular(2), lambda _: None, folder)


def test_states_kept_beside_tables_spare_the_way_and_not_the_truth(arm, tabulated):
    folder, table = tabulated
    starts = interpolated_unknowns(folder, built_in_arm(), {"biceps": table}, "tiny")
    case = Case((0.15, 0.25, 0.3, 0.1, 0.1), elbow_angle=radians(75))
    arm.forget()
    beside, expected = DirectArm(built_in_arm(), "tiny", starts=starts), arm(case)
    found = beside(case)
    assert not beside._muscles["biceps"]._rest
    assert arm._muscles["biceps"]._rest
    for name in MUSCLES:
        assert found.fields[name]["position"] == pytest.approx(expected.fields[name]["position"], abs=1e-4)


def test_only_states_of_the_same_preset_that_are_all_there_are_starts(tabulated, tmp_path):
    folder, table = tabulated
    shutil.copytree(folder, tmp_path / "copy")
    next((tmp_path / "copy" / "states" / "biceps").iterdir()).unlink()
    arm, tables = built_in_arm(), {"biceps": table}
    assert set(interpolated_unknowns(folder, arm, tables, "tiny")) == {"biceps"}
    assert not interpolated_unknowns(tmp_path / "copy", arm, tables, "tiny")
    assert not interpolated_unknowns(folder, arm, tables, "quick")
