"""Damage is found, named and repaired."""

import os
import shutil
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
import zarr

from myograph.ensemble.simulators import make_bodies
from myograph.ensemble.store import summary
from myograph.ensemble.store.aside import ASIDE
from myograph.ensemble.store.checking import check_store, store_checksum
from myograph.ensemble.store.checksum import checksum
from myograph.ensemble.store.chunks import chunk_path, encode
from myograph.ensemble.store.opening import open_muscle
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.repairing import forget_case, forget_damage
from myograph.ensemble.store.rows import Row, read_row, row_path, state_of, write_row
from myograph.ensemble.store.summary import write_summary
from myograph.ensemble.store.writing import write_failure
from myograph.errors import NotConvergedError
from tests.ensemble.store.test_store import filled


@pytest.fixture
def store(make):
    store = make(count=12)
    filled(store)
    write_summary(store, read_plan(store))
    return store


def problems(store):
    return {(one.case, one.what) for one in check_store(store, read_plan(store))}


def flip(path, place):
    data = bytearray(path.read_bytes())
    data[place] ^= 0x10
    path.write_bytes(bytes(data))


def test_a_sound_store_has_no_problems(store):
    assert problems(store) == set()


@pytest.mark.parametrize("seed", range(5))
def test_any_flipped_bit_of_any_file_is_found(store, seed):
    """Of rows, arrays, their descriptions and reference bodies."""
    draw = np.random.default_rng(seed)
    apart = (store, *(store / "cases").rglob("*"), store / "cases")
    files = sorted(path for path in store.rglob("*") if path.is_file() and path.parent not in apart)
    for path in draw.choice(np.array(files, dtype=object), 12, replace=False):
        whole = path.read_bytes()
        flip(path, int(draw.integers(len(whole))))
        assert len(problems(store)) == 1, path
        path.write_bytes(whole)
    assert problems(store) == set()


def test_half_written_missing_and_empty_chunks_are_named(store):
    path = chunk_path(store, "biceps", "position", 4)
    path.write_bytes(path.read_bytes()[:100])
    chunk_path(store, "biceps", "pressure", 7).unlink()
    chunk_path(store, "biceps", "von_mises", 9).write_bytes(b"")
    assert problems(store) == {
        (4, "biceps/position: its 100 bytes are not those that were written"),
        (7, "biceps/pressure: its array is missing"),
        (9, "biceps/von_mises: its 0 bytes are not those that were written"),
    }


def test_a_case_without_row_is_a_problem_and_a_failed_one_is_none(store):
    forget_case(store, read_plan(store), 3)
    write_failure(store, read_plan(store), 5, NotConvergedError("no way"))
    assert problems(store) == {(3, "has not been computed yet")}


def test_arrays_of_a_case_that_failed_or_has_no_row_are_a_problem_and_go_with_a_repair(store):
    plan = read_plan(store)
    row_path(store, 3).unlink()
    write_row(store, Row(5, "failed", reason="no way"))
    arrays = "has arrays without an answer: " + ", ".join(f"biceps/{field}" for field in plan.fields)
    assert problems(store) == {(3, f"has not been computed yet, {arrays}"), (5, arrays)}
    forget_damage(store, plan, list(check_store(store, plan)), {})
    assert problems(store) == {(3, "has not been computed yet")}
    assert read_row(store, 5).reason == "no way"
    assert np.isnan(open_muscle(store, "biceps")["position"].values[[3, 5]]).all()


def test_a_failed_row_takes_the_place_of_all_arrays(store):
    write_failure(store, read_plan(store), 5, NotConvergedError("no way"))
    assert not list((store / "biceps").rglob("c.5.*"))
    assert np.isnan(open_muscle(store, "biceps")["pressure"].values[5]).all()


@pytest.mark.parametrize("name", ["activation", "elbow_angle", "hand_load", "moment", "state", "design"])
def test_a_changed_number_of_the_group_of_all_cases_is_a_problem_that_a_new_summary_mends(store, name):
    zarr.open_group(store / "cases", mode="r+")[name][3] = 7
    [problem] = check_store(store, read_plan(store))
    assert (problem.case, problem.summed_up) == (None, True)
    assert problem.what == "cases: does not say what the rows of the cases say"
    write_summary(store, read_plan(store))
    assert problems(store) == set()


@pytest.mark.parametrize("name", ["activation/c/0/0", "elbow_angle/c/0", "moment/zarr.json"])
def test_a_damaged_file_of_the_group_of_all_cases_is_a_problem(store, name):
    path = store / "cases" / name
    flip(path, len(path.read_bytes()) // 2)
    [(case, what)] = problems(store)
    assert case is None
    assert what.startswith("cases: ")


def test_a_lost_group_of_all_cases_is_a_problem_and_one_that_is_not_due_yet_is_none(store):
    shutil.rmtree(store / "cases")
    assert {case for case, _ in problems(store)} == {None}
    forget_case(store, read_plan(store), 3)
    assert problems(store) == {(3, "has not been computed yet")}


def test_a_group_that_cannot_take_its_place_leaves_no_more_than_the_old_one(store, monkeypatch):
    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(xr.Dataset, "to_zarr", full)
    with pytest.raises(OSError, match="No space"):
        write_summary(store, read_plan(store))
    assert problems(store) == set()
    assert list((store / ASIDE).iterdir()) == []


def test_the_old_group_is_whole_and_aside_when_the_new_one_takes_its_place(store, monkeypatch):
    seen, rename = [], os.replace

    def spied(old, new):
        if new == store / "cases":
            seen.extend((path / "state" / "c" / "0").exists() for path in (store / ASIDE).iterdir())
        rename(old, new)

    monkeypatch.setattr(summary.os, "replace", spied)
    write_summary(store, read_plan(store))
    assert seen == [True, True]
    assert list((store / ASIDE).iterdir()) == []


def test_an_array_that_its_row_vouches_for_must_still_be_finite_and_of_the_right_shape(store):
    row = read_row(store, 2)
    wrong = encode("pressure", np.ones(50), 50)
    chunk_path(store, "biceps", "pressure", 2).write_bytes(wrong)

    write_row(
        store, Row(2, "done", row.elbow_angle, row.moments, chunks=row.chunks | {"biceps/pressure": checksum(wrong)})
    )
    [(case, what)] = problems(store)
    assert case == 2
    assert "not a readable chunk" in what


def test_a_row_without_all_arrays_is_a_problem(store):
    write_row(store, replace(read_row(store, 2), chunks={}))
    assert problems(store) == {(2, "its row does not fit this store")}


def test_a_mesh_with_corners_that_do_not_exist_is_a_problem(store):
    zarr.open_group(store / "biceps", mode="r+")["surface_quads"][0, 0] = 999
    [(case, what)] = problems(store)
    assert case is None
    assert what.startswith("biceps/surface_quads/c/0/0: its bytes are not")


def test_repair_forgets_damaged_cases_and_restores_what_all_share(store):
    before = store_checksum(store)
    flip(chunk_path(store, "biceps", "position", 4), 50)
    shutil.rmtree(store / "biceps" / "reference_position")
    flip(store / "biceps" / "pressure" / "zarr.json", 3)
    plan = read_plan(store)
    found = list(check_store(store, plan))
    assert {one.case for one in found} == {None, 4}
    forget_damage(store, plan, found, make_bodies(plan.simulator))
    assert state_of(store, 4) is None
    assert problems(store) == {(4, "has not been computed yet")}
    filled(store)
    assert store_checksum(store) == before
