"""A store: what it is made of, what is read back, what is refused."""

import errno
import json
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
import zarr

from myograph.case import MUSCLES
from myograph.ensemble.node_fields import NODE_FIELDS
from myograph.ensemble.pairs.sampler import random_sensors
from myograph.ensemble.simulators import make_simulator
from myograph.ensemble.store import aside
from myograph.ensemble.store.chunks import chunk_path, decode, encode
from myograph.ensemble.store.lock import RUNNER, is_locked, locked
from myograph.ensemble.store.opening import open_cases, open_muscle, reasons
from myograph.ensemble.store.plan import PLAN, read_plan
from myograph.ensemble.store.rows import Row, read_row, row_path, write_row
from myograph.ensemble.store.summary import write_summary
from myograph.ensemble.store.writing import write_solution
from myograph.errors import InputError
from tests.ensemble import synthetic


def filled(store, but=()):
    """Answer all cases in this process."""
    plan = read_plan(store)
    simulator = make_simulator(plan.simulator)
    for number, case in enumerate(plan.design.cases):
        if number not in but:
            write_solution(store, plan, number, simulator(case))
    return plan, simulator


def test_fields_come_back_within_the_rounding_of_single_precision(make):
    store = make(muscles=("biceps", "triceps"))
    plan, simulator = filled(store)
    for muscle in plan.muscles:
        dataset = open_muscle(store, muscle)
        for name in NODE_FIELDS:
            expected = np.stack([simulator(case).fields[muscle][name] for case in plan.design.cases])
            np.testing.assert_allclose(dataset[name].values, expected, rtol=2**-24, atol=1e-40)


def test_angles_and_moments_come_back_exactly(make):
    store = make()
    plan, simulator = filled(store)
    dataset = open_muscle(store, "biceps")
    solutions = [simulator(case) for case in plan.design.cases]
    assert dataset["elbow_angle"].values.tolist() == [s.elbow_angle for s in solutions]
    assert dataset["moment"].values.tolist() == [[s.moments[name] for name in MUSCLES] for s in solutions]
    assert dataset["activation"].values.tolist() == [list(case.activations) for case in plan.design.cases]


def test_a_dataset_says_its_units_its_muscle_and_where_it_comes_from(make):
    store = make()
    filled(store)
    dataset = open_muscle(store, "biceps")
    assert (dataset["position"].attrs["units"], dataset["cauchy_stress"].attrs["units"]) == ("mm", "MPa")
    assert dataset["cauchy_stress"].dims == ("cases", "nodes", "voigt")
    assert dataset.attrs["muscle"] == "biceps"
    assert dataset.attrs["command"] == "test"
    assert len(dataset.attrs["arm_checksum"]) == 64
    assert dataset["connectivity"].shape == (1, 27)


@pytest.mark.parametrize(("nodes", "expected"), [(60, 9), (8, 7)])
def test_the_stored_sensors_are_those_that_pairs_draw(make, nodes, expected):
    store = make(preset=f"nodes={nodes}")
    stored = open_muscle(store, "biceps")["sensor_nodes"].values
    np.testing.assert_array_equal(stored, random_sensors(nodes, expected))


def test_a_missing_case_is_nan_and_called_missing(make):
    store = make(count=5)
    filled(store, but=(3,))
    dataset = open_muscle(store, "biceps")
    assert dataset["state"].values.tolist() == ["done", "done", "done", "missing", "done"]
    assert np.isnan(dataset["position"].values).all(axis=(1, 2)).tolist() == [False, False, False, True, False]


def test_the_zarr_library_would_write_the_same_bytes_and_reads_ours(make):
    store = make(count=4)
    plan, _ = filled(store, but=(0,))
    array = zarr.open_group(store / "biceps", mode="r+")["position"]
    values = np.asarray(array[2])
    ours = chunk_path(store, "biceps", "position", 2).read_bytes()
    array[0] = values
    assert chunk_path(store, "biceps", "position", 0).read_bytes() == ours
    np.testing.assert_array_equal(decode("position", ours, plan.nodes["biceps"]), values)


def test_the_summary_is_readable_by_zarr_alone(make):
    store = make(count=6)
    plan, _ = filled(store, but=(5,))
    write_summary(store, plan)
    plain = xr.open_zarr(store, group="cases", consolidated=False)
    assert plain["state"].attrs["flag_meanings"] == "missing done failed"
    assert plain["state"].values.tolist() == [1, 1, 1, 1, 1, 0]
    np.testing.assert_array_equal(plain["elbow_angle"].values, open_cases(store)["elbow_angle"].values)


@pytest.mark.parametrize(
    ("number", "words"),
    [
        (0.1, "biceps: position: expected finite numbers, got 1 that are not"),
        (0.2, r"biceps: cauchy_stress: expected the shape \(60, 6\), got \(60, 3\)"),
        (0.3, "biceps: expected the field 'pressure', got none"),
        (0.4, "biceps: von_mises: expected finite numbers, got 60 that are not"),
    ],
)
def test_an_answer_that_is_incomplete_or_no_number_becomes_a_failed_row(make, number, words):
    store = make(count=200, kind=f"{synthetic.__name__}:make_faulty")
    plan = read_plan(store)
    case = next(k for k, case in enumerate(plan.design.cases) if case.activations[0] == number)
    simulator = make_simulator(plan.simulator)
    assert write_solution(store, plan, case, simulator(plan.design.cases[case])).state == "failed"
    [(failed, reason)] = reasons(store).items()
    assert failed == case
    assert re.search(words, reason)
    assert not chunk_path(store, "biceps", "position", case).exists()


def test_a_store_is_gone_on_with_only_by_the_same_question(make):
    store = make()
    assert make() == store
    for changes, words in [
        ({"count": 31}, "another design"),
        ({"seed": 1}, "another design"),
        ({"muscles": ("triceps",)}, "other muscles"),
        ({"preset": "nodes=61"}, "another simulator"),
    ]:
        with pytest.raises(InputError, match=words):
            make(**changes)


def test_a_folder_of_something_else_is_refused_and_left_alone(make, tmp_path):
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "file").write_text("mine")
    with pytest.raises(InputError, match="expected the store of an ensemble, found none"):
        make("other")
    assert [path.name for path in (tmp_path / "other").iterdir()] == ["file"]


def test_an_unknown_muscle_is_refused(make):
    with pytest.raises(InputError, match=r"muscles: expected some of brachioradialis.* got bicep"):
        make(muscles=("bicep",))
    with pytest.raises(InputError, match="expected one of biceps, got 'triceps'"):
        open_muscle(make(), "triceps")


@pytest.mark.parametrize("damage", [lambda t: t[:-40], lambda t: t.replace("0.5", "0.6", 1), lambda t: "[]"])
def test_a_damaged_plan_is_refused(make, damage):
    store = make()
    (store / PLAN).write_text(damage((store / PLAN).read_text()))
    with pytest.raises(InputError, match="damaged"):
        read_plan(store)


def test_a_plan_of_another_schema_is_refused(make):
    store = make()
    body = json.loads((store / PLAN).read_text())
    (store / PLAN).write_text(json.dumps({**body, "schema": 99}))
    with pytest.raises(InputError, match="expected schema 2, got 99"):
        read_plan(store)


def test_a_row_comes_back_as_it_was_and_a_changed_one_does_not(make):
    store = make()
    row = Row(3, "failed", reason="no way", residuals=(1.0, float("inf"), 1e-300), notes=("a", "b"))
    write_row(store, row)
    assert read_row(store, 3) == row
    assert read_row(store, 4) is None
    row_path(store, 4).write_bytes(row_path(store, 3).read_bytes())
    with pytest.raises(InputError, match="case 4: its row is damaged"):
        read_row(store, 4)
    row_path(store, 3).write_bytes(row_path(store, 3).read_bytes().replace(b"no way", b"no wax"))
    with pytest.raises(InputError, match="case 3: its row is damaged"):
        read_row(store, 3)


def test_a_second_one_cannot_have_the_store_until_the_first_is_gone(make):
    store = make()
    with locked(store, 0):
        assert is_locked(store)
        with pytest.raises(InputError, match=r"process \d+ on .* is at work on it"), locked(store, 0):
            pass
    assert not is_locked(store)
    with locked(store, 0):
        pass


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only Linux has a device that is always full")
def test_a_store_whose_lock_has_no_room_is_an_input_error(make):
    store = make()
    (store / RUNNER).symlink_to("/dev/full")
    with pytest.raises(InputError, match="store: cannot be written"), locked(store, 0):
        pass


def test_a_file_without_room_leaves_nothing(make, monkeypatch):
    store = make()

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(aside.os, "replace", full)
    with pytest.raises(OSError, match="No space"):
        write_row(store, Row(0, "failed"))
    assert list((store / aside.ASIDE).iterdir()) == []
    assert not row_path(store, 0).exists()


def test_single_precision_loses_less_than_a_ten_thousandth_of_a_millimetre():
    values = np.random.default_rng(0).uniform(-600, 600, (50, 3))
    assert np.abs(decode("position", encode("position", values, 50), 50) - values).max() < 1e-4


def test_bytes_that_are_no_chunk_are_refused():
    good = encode("pressure", np.ones(50), 50)
    with pytest.raises(InputError, match="not a readable chunk"):
        decode("pressure", good[:-3], 50)
    with pytest.raises(InputError, match="not a readable chunk"):
        decode("pressure", good, 49)
