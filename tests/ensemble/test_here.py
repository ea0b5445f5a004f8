"""A small store computed in this process: as the runner would have it, and refused where it cannot be right."""

import errno

import numpy as np
import pytest

from myograph.ensemble import here
from myograph.ensemble.here import compute_here
from myograph.ensemble.simulators import make_simulator
from myograph.ensemble.spec import SimulatorSpec
from myograph.ensemble.store.checking import check_store, store_checksum
from myograph.ensemble.store.lock import locked
from myograph.ensemble.store.making import make_store
from myograph.ensemble.store.opening import reasons
from myograph.ensemble.store.plan import StorePlan, read_plan
from myograph.ensemble.store.reading import read_muscle
from myograph.ensemble.store.rows import row_path
from myograph.errors import InputError
from tests.ensemble import synthetic


@pytest.fixture
def table_store(make, tmp_path):
    """Function: a store whose plan says 'table', for which the synthetic simulator stands in; and that simulator."""

    def made(**options):
        plan = read_plan(make("synthetic", **options))
        simulator = make_simulator(plan.simulator)
        spec = SimulatorSpec("table", "tiny", plan.simulator.arm)
        planned = StorePlan(plan.design, spec, plan.described, plan.muscles, plan.nodes, {})
        make_store(tmp_path / "here", planned, simulator.bodies, {})
        return tmp_path / "here", simulator

    return made


def test_all_cases_get_their_rows_and_the_store_is_sound(table_store):
    store, simulator = table_store(count=5)
    ready = []
    compute_here(store, simulator, lambda: ready.append(1))
    assert len(ready) == 5
    assert list(check_store(store, read_plan(store))) == []
    assert (store / "cases").is_dir()


def test_what_has_a_row_is_not_computed_again(table_store):
    store, simulator = table_store(count=5)
    compute_here(store, simulator)
    whole = store_checksum(store)
    row_path(store, 3).unlink()
    ready = []
    compute_here(store, simulator, lambda: ready.append(1))
    assert len(ready) == 1
    assert store_checksum(store) == whole


def test_the_fields_are_the_simulators(table_store):
    store, simulator = table_store(count=4)
    compute_here(store, simulator)
    expected = [simulator(case).fields["biceps"]["position"] for case in read_plan(store).design.cases]
    found = read_muscle(store, "biceps").values("position", np.arange(4))
    np.testing.assert_array_equal(found, np.array(expected, dtype=np.float32))


def test_a_case_that_fails_is_a_row_with_its_reason(table_store):
    store, simulator = table_store(count=30)
    number = round(1000 * read_plan(store).design.cases[4].activations[0])
    simulator.options["fail"] = number
    compute_here(store, simulator)
    failed = reasons(store)
    assert 4 in failed
    assert set(failed.values()) == {"no way further"}
    assert len(failed) < 30


def test_a_simulator_that_remembers_a_store_at_work_and_a_full_disk_are_refused(make, table_store, monkeypatch):
    with pytest.raises(InputError, match=f"without memory, got '{synthetic.FACTORY}'; run it with"):
        compute_here(make(), make_simulator(synthetic.spec()))
    store, simulator = table_store(count=3)
    with locked(store, 0), pytest.raises(InputError, match="is at work on it"):
        compute_here(store, simulator)

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(here, "write_solution", full)
    with pytest.raises(InputError, match="No space left on device"):
        compute_here(store, simulator)
