"""`myograph ensemble check --repair`: under the lock, with room or one line, and no more than is needed."""

import json
import sys

import pytest
import zarr

pytest.importorskip("distributed", reason="repairs need Dask")

from myograph.cli.ensemble import app
from myograph.ensemble.store.checking import check_store, store_checksum
from myograph.ensemble.store.chunks import chunk_path
from myograph.ensemble.store.lock import is_locked, locked
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.summary import write_summary
from myograph.errors import InputError
from tests.ensemble.filled import filled_store


@pytest.fixture
def store(tmp_path):
    store = filled_store(tmp_path / "store", count=3, muscles=("biceps",))
    write_summary(store, read_plan(store))
    return store


@pytest.fixture
def verb():
    """The module, whose name the verb has taken."""
    return sys.modules["myograph.cli.ensemble.check"]


def repair(store):
    app(["check", str(store), "--repair", "--workers", "1", "--json"], standalone_mode=False)


def test_what_is_forgotten_was_found_while_nobody_else_worked(store, verb, monkeypatch):
    held = []

    def spied(*arguments):
        held.append(is_locked(store))
        return check_store(*arguments)

    monkeypatch.setattr(verb, "check_store", spied)
    chunk_path(store, "biceps", "position", 1).unlink()
    repair(store)
    assert held == [True, False]


def test_a_store_at_work_is_not_repaired_even_if_all_is_well(store):
    with locked(store, 0), pytest.raises(InputError, match="is at work on it"):
        repair(store)


def test_a_repair_without_room_is_one_line(store, verb, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(verb, "forget_damage", full)
    chunk_path(store, "biceps", "position", 1).unlink()
    with pytest.raises(InputError, match="No space left on device"):
        repair(store)


def test_the_group_of_all_cases_is_written_anew_without_any_simulator(store, verb, monkeypatch, capsys):
    """So it is for imported data, which nothing can compute again."""
    before = store_checksum(store)
    zarr.open_group(store / "cases", mode="r+")["elbow_angle"][1] = 0.1
    monkeypatch.setattr(verb, "make_bodies", lambda _: pytest.fail("a simulator was made"))
    repair(store)
    told = json.loads(capsys.readouterr().out)
    assert told == {
        "ok": True,
        "problems": [{"case": None, "what": "cases: does not say what the rows of the cases say"}],
    }
    assert store_checksum(store) == before
