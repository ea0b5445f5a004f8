"""Tables of muscles: on disk, and made from finite elements."""

from dataclasses import replace

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError, NotConvergedError
from myograph.limb.table import Grid, load_table, regular_grid, save_table, table_key
from tests.limb.conftest import formula_table


def test_a_table_comes_back_as_it_was_written(tmp_path):
    table = formula_table(built_in_arm(), "biceps")
    save_table(table, tmp_path / "biceps.npz")
    back = load_table(tmp_path / "biceps.npz", table.key)
    assert back.grid == table.grid
    assert np.array_equal(back.moments, table.moments)
    assert all(np.array_equal(back.fields[name], table.fields[name]) for name in table.fields)
    assert [path.name for path in tmp_path.iterdir()] == ["biceps.npz"]


def test_a_table_of_another_arm_is_refused(tmp_path):
    table = formula_table(built_in_arm(), "biceps")
    save_table(table, tmp_path / "biceps.npz")
    with pytest.raises(InputError, match="made for another arm"):
        load_table(tmp_path / "biceps.npz", "0" * 64)


@pytest.mark.parametrize("keep", [0, 10, 2000])
def test_a_truncated_table_is_refused(tmp_path, keep):
    table = formula_table(built_in_arm(), "biceps")
    path = tmp_path / "biceps.npz"
    save_table(table, path)
    path.write_bytes(path.read_bytes()[:keep])
    with pytest.raises(InputError, match="not a readable muscle table"):
        load_table(path, table.key)


def test_a_missing_table_is_refused(tmp_path):
    with pytest.raises(InputError, match="not a readable muscle table"):
        load_table(tmp_path / "none.npz", "")


def test_the_key_follows_arm_muscle_preset_and_grid():
    arm = built_in_arm()
    grid = regular_grid(arm, 9, 5)
    keys = {
        table_key(arm, "biceps", "tiny", grid),
        table_key(arm, "triceps", "tiny", grid),
        table_key(arm, "biceps", "quick", grid),
        table_key(arm, "biceps", "tiny", regular_grid(arm, 9, 4)),
        table_key(arm.model_copy(update={"name": "other"}), "biceps", "tiny", grid),
    }
    assert len(keys) == 5


def test_tabulated_finite_elements_meet_a_solve_between_the_grid_points(tmp_path):
    pytest.importorskip("ngsolve", reason="the mechanics need NGSolve")
    from myograph.limb.tabulate import tabulate_muscle
    from myograph.mechanics.muscle import FiniteElementMuscle

    arm = built_in_arm()
    low, high = np.radians([50.0, 75.0])
    grid = Grid(tuple(np.linspace(low, high, 4).tolist()), (0.0, 0.25, 0.5, 0.75, 1.0))
    seen = []
    table = tabulate_muscle(arm, "biceps", "tiny", grid, seen.append)
    angle, activation = np.radians(57.0), 0.6
    truth = FiniteElementMuscle(arm, "biceps", "tiny").solve(activation, angle)
    error = np.linalg.norm(table.at(angle, activation)["position"] - truth.fields["position"], axis=1)
    assert seen == ["biceps"] * grid.size
    assert error.mean() < 0.05
    assert error.max() < 0.5
    assert table.moment(np.array([angle]), activation)[0] == pytest.approx(truth.moment, rel=2e-3)


def test_a_failed_state_is_kept_with_its_reason_and_the_table_does_not_pretend(tmp_path):
    table = formula_table(built_in_arm(), "biceps")
    reasons = table.record.failures.astype("U40")
    reasons[2, 1] = "an element turned inside out"
    failed = replace(table, record=replace(table.record, failures=reasons))
    save_table(failed, tmp_path / "biceps.npz")
    back = load_table(tmp_path / "biceps.npz", table.key)
    assert back.record.failures[2, 1] == "an element turned inside out"
    with pytest.raises(NotConvergedError, match="biceps: 1 of 24 states failed; the first: an element"):
        back.moment(np.array([1.0]), 0.5)
