"""A muscle read from its store: the same numbers, in little memory, and nothing damaged."""

import pickle
import tracemalloc

import numpy as np
import pytest

from myograph.ensemble.node_fields import NODE_FIELDS
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.simulators import make_simulator
from myograph.ensemble.store.chunks import chunk_path
from myograph.ensemble.store.opening import open_muscle
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.reading import read_muscle
from myograph.ensemble.store.rows import row_path
from myograph.ensemble.store.writing import write_failure, write_solution
from myograph.errors import InputError, NotConvergedError
from tests.ensemble import synthetic


def filled(store, but=()):
    """Answer all cases in this process."""
    plan = read_plan(store)
    simulator = make_simulator(plan.simulator)
    for number, case in enumerate(plan.design.cases):
        if number not in but:
            write_solution(store, plan, number, simulator(case))
    return store


def test_cases_are_those_that_xarray_reads(make):
    store = filled(make(count=6))
    cases, dataset = read_muscle(store, "biceps"), open_muscle(store, "biceps")
    for name in ("activation", "hand_load", "elbow_angle"):
        np.testing.assert_array_equal(getattr(cases, name), dataset[name].values)
    for name in NODE_FIELDS:
        np.testing.assert_array_equal(cases.values(name, np.array([3, 0, 3])), dataset[name].values[[3, 0, 3]])
    np.testing.assert_array_equal(cases.body.reference, dataset["reference_position"].values)
    np.testing.assert_array_equal(cases.body.skin, dataset["surface_quads"].values)
    assert cases.design == tuple(dataset["design"].values)
    assert cases.attributes["command"] == "test"
    assert len(cases.attributes["arm_checksum"]) == 64


def test_only_answered_cases_are_there(make):
    store = filled(make(count=6), but=(1, 4))
    write_failure(store, read_plan(store), 4, NotConvergedError("no way"))
    row_path(store, 5).write_bytes(b"{}")
    cases, dataset = read_muscle(store, "biceps"), open_muscle(store, "biceps")
    assert len(cases) == 3
    np.testing.assert_array_equal(cases.values("position", np.arange(3)), dataset["position"].values[[0, 2, 3]])
    np.testing.assert_array_equal(cases.activation, dataset["activation"].values[[0, 2, 3]])


def test_no_case_is_no_array(make):
    cases = read_muscle(filled(make(count=2)), "biceps")
    assert cases.values("cauchy_stress", np.array([], dtype=np.int64)).shape == (0, synthetic.NODES, 6)


def test_a_store_without_the_muscle_or_without_answers_is_an_input_error(make, tmp_path):
    store = make(count=3)
    with pytest.raises(InputError, match="expected one of biceps, got 'triceps'"):
        read_muscle(store, "triceps")
    with pytest.raises(InputError, match="expected answered cases, found none; run it"):
        read_muscle(store, "biceps")
    with pytest.raises(InputError, match="found none"):
        read_muscle(tmp_path / "nowhere", "biceps")


def test_a_damaged_or_lost_array_is_named_when_it_is_read(make):
    store = filled(make(count=3))
    cases = read_muscle(store, "biceps")
    path = chunk_path(store, "biceps", "position", 1)
    data = bytearray(path.read_bytes())
    data[-5] ^= 1
    path.write_bytes(data)
    cases.values("position", np.array([0, 2]))
    with pytest.raises(InputError, match=r"case 1, biceps/position: not the bytes that were written; .*--repair"):
        cases.values("position", np.array([0, 1]))
    path.unlink()
    with pytest.raises(InputError, match="case 1, biceps/position: No such file"):
        cases.values("position", np.array([1]))


def test_a_damaged_body_is_named(make):
    store = filled(make(count=2))
    path = store / "biceps" / "reference_position" / "zarr.json"
    path.write_text(path.read_text() + " ")
    with pytest.raises(InputError, match=r"biceps/reference_position/zarr\.json: not the bytes.*--repair"):
        read_muscle(store, "biceps")
    path.unlink()
    with pytest.raises(InputError, match=r"biceps/reference_position/zarr\.json: No such file"):
        read_muscle(store, "biceps")


def test_the_checksum_follows_what_is_asked_and_what_is_answered(make):
    first = read_muscle(filled(make("a", count=4)), "biceps").checksum
    assert read_muscle(filled(make("b", count=4)), "biceps").checksum == first
    others = [filled(make("c", count=4, seed=1)), filled(make("d", count=4), but=(2,))]
    assert len({first, *(read_muscle(store, "biceps").checksum for store in others)}) == 3


def test_a_second_reading_of_a_case_reads_no_file(make):
    store = filled(make(count=3))
    cases = read_muscle(store, "biceps")
    before = cases.values("position", np.array([1]))
    chunk_path(store, "biceps", "position", 1).unlink()
    np.testing.assert_array_equal(cases.values("position", np.array([1])), before)


def test_what_travels_to_another_process_is_not_what_is_kept(make):
    store = filled(make(count=10))
    cases = read_muscle(store, "biceps")
    small = len(pickle.dumps(cases))
    values = cases.values("cauchy_stress", np.arange(10))
    assert len(pickle.dumps(cases)) == small < values.nbytes
    there = pickle.loads(pickle.dumps(cases))
    np.testing.assert_array_equal(there.values("cauchy_stress", np.arange(10)), values)


def test_all_batches_of_a_store_larger_than_the_limit_pass_through_little_memory(make):
    """80 cases of 60 nodes and 12 numbers are 230 kB; a fifth of it is kept, beside a batch of ten pairs or two."""
    store = filled(make(count=80))
    limit, batch = 46_080, 10 * 60 * 2 * (12 + 12) * 4
    cases = read_muscle(store, "biceps", kept_bytes=limit)
    sampler = PairSampler(cases, random_sensors(cases.nodes), "material", cases.fields, cases.fields)
    pairs = np.stack([np.arange(80), np.arange(80)[::-1]], axis=1)
    for seen in sampler.batches(pairs[:20], 10):
        assert seen.question.size == 10
    tracemalloc.start()
    before = tracemalloc.get_traced_memory()[0]
    for seen in sampler.batches(pairs, 10):
        assert np.isfinite(seen.truth["position"]).all()
    kept, peak = (size - before for size in tracemalloc.get_traced_memory())
    tracemalloc.stop()
    assert kept < limit + batch
    assert peak < limit + 4 * batch
