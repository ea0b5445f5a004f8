"""Tables from finite elements: how good they are, and how they go on after an end that nobody wanted."""

import multiprocessing
import os
import shutil
import signal
import time

import numpy as np
import pytest

pytest.importorskip("ngsolve", reason="the mechanics need NGSolve")

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError
from myograph.limb.tables.solve import states_folder
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.table_file import table_path
from myograph.limb.tables.tabulate import tabulate, tabulate_muscle
from myograph.mechanics import muscle as muscle_module

SPEC = TableSpec(tolerance_mm=0.25, tolerance_nm=0.1, most_states=60, held_out=8)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tables")
    heard = []
    table = tabulate(built_in_arm(), "tiny", SPEC, folder, heard.append, ["biceps"])["biceps"]
    return folder, table, heard


@pytest.mark.exhaustive
def test_the_biceps_between_its_states_is_what_finite_elements_find_there(made):
    """Means over states that chance has chosen; the moment goes up to 28 N·m."""
    _, table, heard = made
    errors = table.held_out.summary()
    assert table.met
    assert errors["mean_mm"] < 0.25
    assert errors["max_mm"] < 4
    assert errors["moment_mean_nm"] < 0.1
    assert 21 < table.size <= 40
    assert heard == ["biceps"] * (table.size + 8)
    assert np.abs(table.record.volume_change).max() < 1e-3
    assert table.record.newton_steps.mean() < 6


def test_a_table_that_is_ready_is_taken_and_one_of_another_spec_uses_its_states(made, monkeypatch):
    folder, table, _ = made
    before = table_path(folder, "biceps").stat().st_mtime_ns
    heard = []
    again = tabulate(built_in_arm(), "tiny", SPEC, folder, heard.append, ["biceps"])["biceps"]
    assert table_path(folder, "biceps").stat().st_mtime_ns == before
    assert np.array_equal(again.moments, table.moments)
    assert len(heard) == SPEC.most

    monkeypatch.setattr(muscle_module, "reach", None)
    rougher = TableSpec(tolerance_mm=0.5, tolerance_nm=0.5, most_states=60, held_out=8)
    other = tabulate_muscle(built_in_arm(), "biceps", "tiny", rougher, lambda _: None, folder)
    assert other.size <= table.size
    assert other.key != table.key


def test_a_damaged_state_is_solved_anew_and_nothing_else(made, tmp_path, monkeypatch):
    folder, table, _ = made
    shutil.copytree(folder, tmp_path / "copy")
    victim = sorted(states_folder(tmp_path / "copy", "biceps").iterdir())[7]
    victim.write_bytes(victim.read_bytes()[:500])
    original, solved = muscle_module.reach, []

    def spy(problem, start, target, **most):
        solved.append(target)
        return original(problem, start, target, **most)

    monkeypatch.setattr(muscle_module, "reach", spy)
    again = tabulate_muscle(built_in_arm(), "biceps", "tiny", SPEC, lambda _: None, tmp_path / "copy")
    assert len(solved) <= 2
    assert again.moments == pytest.approx(table.moments, rel=1e-5)


def _build_slowly(folder, spec):
    """Solves fast, then lingers after every state, for somebody to kill it."""
    tabulate_muscle(built_in_arm(), "anconeus", "tiny", spec, lambda _: time.sleep(0.2), folder)


def test_a_killed_build_goes_on_where_it_was(tmp_path, monkeypatch):
    spec = TableSpec.regular(2)
    folder = states_folder(tmp_path, "anconeus")
    process = multiprocessing.get_context("spawn").Process(target=_build_slowly, args=(tmp_path, spec))
    process.start()
    for _ in range(600):
        if folder.exists() and len(list(folder.glob("[0-9]*.npz"))) >= 5:
            break
        time.sleep(0.05)
    os.kill(process.pid, signal.SIGKILL)
    process.join()
    kept = {path.name: path.stat().st_mtime_ns for path in folder.glob("[0-9]*.npz")}
    assert 5 <= len(kept) < 21
    assert not table_path(tmp_path, "anconeus").exists()
    original, solved = muscle_module.reach, []

    def spy(problem, start, target, **most):
        solved.append((round(target.flexion, 9), target.activation))
        return original(problem, start, target, **most)

    monkeypatch.setattr(muscle_module, "reach", spy)
    table = tabulate_muscle(built_in_arm(), "anconeus", "tiny", spec, lambda _: None, tmp_path)
    assert table.failures == 0
    assert {name: path.stat().st_mtime_ns for name in kept if (path := folder / name)} == kept
    assert len(list(folder.glob("[0-9]*.npz"))) == 21
    monkeypatch.undo()
    fresh = tabulate_muscle(built_in_arm(), "anconeus", "tiny", spec, lambda _: None)
    assert table.moments == pytest.approx(fresh.moments, rel=1e-5, abs=0.1)
    for name in ("position", "cauchy_stress"):
        assert np.abs(table.field(name, 1.0, 0.4) - fresh.field(name, 1.0, 0.4)).max() < 1e-2, name


def test_an_unknown_muscle_is_refused(tmp_path):
    with pytest.raises(InputError, match="unknown muscle 'bicep'"):
        tabulate(built_in_arm(), "tiny", SPEC, tmp_path, lambda _: None, ["bicep"])
