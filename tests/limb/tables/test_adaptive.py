"""Tables that grow where they are worst, until states that they do not hold are met."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.limb.tables.adaptive import built
from myograph.limb.tables.spec import TableSpec, box
from tests.limb.conftest import FormulaStates, smooth

KINK = 2.0


def kinked(reference, angle, activation):
    """The muscle touches a bone at an angle of 2 and is pushed aside from there on; the moment as well."""
    moment, fields = smooth("biceps")(reference, angle, activation)
    push = 2 * abs(angle - KINK)
    return moment + 1e3 * push, {**fields, "position": fields["position"] + np.array([push, 0.0, 0.0])}


def test_points_gather_at_a_kink_and_the_tolerances_are_met():
    spec = TableSpec(tolerance_mm=0.001, tolerance_nm=1.0, most_states=200)
    states = FormulaStates(built_in_arm(), "biceps", kinked)
    table = built(states, spec)
    assert table.met
    assert table.held_out.summary()["mean_mm"] <= 0.001
    assert table.held_out.summary()["moment_mean_nm"] <= 1.0
    levels = table.grid.levels[:, 0]
    finest = table.points[levels == levels.max(), 0]
    width = float(np.ptp(table.points[:, 0]))
    assert levels.max() >= 6
    assert np.abs(finest - KINK).max() < width / 16


def test_refined_is_better_than_regular_with_no_more_states():
    spec = TableSpec(tolerance_mm=1e-4, tolerance_nm=1e-4, most_states=49)
    refined = built(FormulaStates(built_in_arm(), "biceps", kinked), spec)
    regular = built(FormulaStates(built_in_arm(), "biceps", kinked), TableSpec(3, 1e-4, 1e-4, most_states=49))
    assert refined.size <= regular.size == 49
    assert refined.held_out.mean_mm.mean() < 0.7 * regular.held_out.mean_mm.mean()


def test_a_table_that_may_not_grow_enough_says_that_it_is_not_met():
    table = built(FormulaStates(built_in_arm(), "biceps", kinked), TableSpec(tolerance_mm=1e-6, most_states=40))
    assert table.met is False
    assert 30 <= table.size <= 40


def test_a_smooth_muscle_stays_on_the_first_grid():
    states = FormulaStates(built_in_arm(), "biceps")
    table = built(states, TableSpec())
    assert (table.size, table.met) == (21, True)
    assert len(states.asked) == 31


def test_no_state_is_asked_twice_and_no_held_out_state_is_in_the_grid():
    states = FormulaStates(built_in_arm(), "biceps", kinked)
    table = built(states, TableSpec(tolerance_mm=0.05))
    assert len({tuple(point) for point in states.asked}) == len(states.asked) == table.size + 10
    distances = np.abs(table.held_out.points[:, None] - table.points).max(axis=2)
    assert distances.min() > 1e-3


def test_without_held_out_states_the_grid_grows_to_its_size_and_nobody_knows_its_error():
    states = FormulaStates(built_in_arm(), "biceps", kinked)
    table = built(states, TableSpec(most_states=50, held_out=0))
    assert table.met is None
    assert table.held_out.summary()["mean_mm"] is None
    assert 45 <= table.size == len(states.asked) <= 50


def test_held_out_errors_are_distances_and_differences_of_moments():
    """A table of a muscle that is elsewhere at the held-out points only."""
    spec = TableSpec(most_states=21)
    states = FormulaStates(built_in_arm(), "biceps")
    held_out = {tuple(point) for point in spec.held_out_points(box(states.arm)).tolist()}

    def elsewhere(reference, angle, activation):
        moment, fields = smooth("biceps")(reference, angle, activation)
        if (angle, activation) not in held_out:
            return moment, fields
        shift = np.zeros_like(reference)
        shift[0] = (0.3, 0.0, 0.4)
        return moment + 250.0, {**fields, "position": fields["position"] + shift}

    states.formula = elsewhere
    summary = built(states, spec).held_out.summary()
    assert summary["max_mm"] == pytest.approx(0.5, abs=2e-3)
    assert summary["mean_mm"] == pytest.approx(0.5 / 12, abs=2e-3)
    assert summary["moment_mean_nm"] == pytest.approx(0.25, abs=1e-6)


def test_a_held_out_state_that_fails_leaves_the_tolerance_unmet_and_the_reason_in_the_table():
    spec = TableSpec(most_states=21)
    arm = built_in_arm()
    first = spec.held_out_points(box(arm))[0].tolist()
    table = built(FormulaStates(arm, "biceps", fails=lambda *point: list(point) == first), spec)
    assert table.met is False
    assert table.failures == 0
    assert table.held_out.failures[0] == "an element turned inside out"
    assert np.isfinite(table.held_out.summary()["mean_mm"])


def test_a_failed_state_ends_the_growth():
    states = FormulaStates(built_in_arm(), "biceps", kinked, fails=lambda angle, a: angle > 2.4 and a == 1.0)
    table = built(states, TableSpec(tolerance_mm=1e-6))
    assert (table.size, table.failures) == (21, 1)
    assert table.met is False
