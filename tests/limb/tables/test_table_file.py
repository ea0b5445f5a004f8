"""Tables on disk: as they were, or refused."""

import json

import numpy as np
import pytest

from myograph.anatomy.load import arm_checksum, built_in_arm
from myograph.errors import InputError, NotConvergedError
from myograph.limb.tables.adaptive import built
from myograph.limb.tables.provenance import table_key
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.table_file import load_table, save_table
from tests.limb.conftest import FormulaStates, formula_table, with_tendon_area


@pytest.fixture
def table():
    return formula_table(built_in_arm(), "biceps")


@pytest.fixture
def path(table, tmp_path):
    save_table(table, tmp_path / "biceps.npz")
    return tmp_path / "biceps.npz"


def changed(path, **changes):
    """The file with other arrays; those of None are left out."""
    with np.load(path) as data:
        arrays = {name: data[name] for name in data.files} | changes
    np.savez(path, **{name: values for name, values in arrays.items() if values is not None})


def test_a_table_comes_back_as_it_was_written(table, path):
    back = load_table(path, table.key)
    assert back.spec == table.spec
    assert np.array_equal(back.points, table.points)
    here, there = table.at(1.0, 0.3), back.at(1.0, 0.3)
    assert all(np.array_equal(here[name], there[name]) for name in here)
    assert back.moment_gradient(1.0, 0.3) == table.moment_gradient(1.0, 0.3)
    assert back.provenance == table.provenance
    assert back.provenance["arm_checksum"] == arm_checksum(built_in_arm())
    assert back.provenance["cpu_seconds"] == "21.0"
    assert [one.name for one in path.parent.iterdir()] == ["biceps.npz"]


def test_held_out_errors_come_back(tmp_path):
    table = built(FormulaStates(built_in_arm(), "biceps"), TableSpec())
    save_table(table, tmp_path / "biceps.npz")
    back = load_table(tmp_path / "biceps.npz")
    assert back.met is True
    assert back.held_out.summary() == table.held_out.summary()


def test_failures_come_back_and_are_not_forgotten(tmp_path):
    states = FormulaStates(built_in_arm(), "biceps", fails=lambda angle, activation: activation == 1.0)
    save_table(built(states, TableSpec.regular(2)), tmp_path / "biceps.npz")
    with pytest.raises(NotConvergedError, match="5 of 21 states failed"):
        load_table(tmp_path / "biceps.npz").require_complete()


def test_a_table_of_another_arm_is_refused(path):
    with pytest.raises(InputError, match="made for another arm, preset, spec or version; delete it"):
        load_table(path, "0" * 64)


def test_a_table_of_another_format_is_refused(path):
    changed(path, format=np.array(2))
    with pytest.raises(InputError, match="expected format 3, got 2"):
        load_table(path)


@pytest.mark.parametrize("keep", [0, 10, 2000, -30])
def test_a_truncated_table_is_refused(path, keep):
    path.write_bytes(path.read_bytes()[:keep])
    with pytest.raises(InputError, match=r"not a readable muscle table .*delete it and build the table anew"):
        load_table(path)


def test_a_missing_table_is_refused(tmp_path):
    with pytest.raises(InputError, match="not a readable muscle table"):
        load_table(tmp_path / "none.npz")


@pytest.mark.parametrize(
    "changes",
    [
        {"moments": np.full(21, np.nan)},
        {"moments": np.zeros(20)},
        {"moments": None},
        {"position_vectors": np.zeros((3, 36))},
        {"position_mean": np.full(36, np.nan)},
        {"cauchy_stress_mean": np.zeros(36)},
        {"skin": np.array([[0, 1, 2, 12]])},
        {"levels": np.zeros((21, 2), dtype=np.int64)},
        {"upper": np.array([0.0, 1.0])},
        {"held_out_mean_mm": np.zeros(3)},
        {"record_newton_steps": np.zeros(3, dtype=np.int64)},
        {"spec": np.array("{")},
        {"spec": np.array('{"level": 2}')},
        {"provenance": np.array("7")},
        {"moments": np.array([None] * 21)},
    ],
    ids=lambda changes: next(iter(changes)),
)
def test_arrays_that_do_not_fit_are_refused(path, changes):
    changed(path, **changes)
    with pytest.raises(InputError, match="not a readable muscle table"):
        load_table(path)


def test_the_key_follows_arm_muscle_preset_and_spec():
    arm, spec = built_in_arm(), TableSpec()
    keys = {
        table_key(arm, "biceps", "tiny", spec),
        table_key(arm, "triceps", "tiny", spec),
        table_key(arm, "biceps", "quick", spec),
        table_key(arm, "biceps", "tiny", TableSpec(tolerance_mm=0.2)),
        table_key(with_tendon_area(arm, "biceps", 41.0), "biceps", "tiny", spec),
    }
    assert len(keys) == 5


def test_the_file_holds_no_objects(path):
    with np.load(path, allow_pickle=False) as data:
        assert json.loads(str(data["spec"]))["level"] == 2
        assert all(data[name].dtype != object for name in data.files)
