"""Where the tables of a store lie is no part of it: they may move, alone or with it."""

import json
import shutil

import pytest

from myograph.ensemble.design import DesignSpec, make_design
from myograph.ensemble.store.checking import store_checksum
from myograph.ensemble.store.checksum import checksum
from myograph.ensemble.store.making import make_store, plan_store
from myograph.ensemble.store.plan import PLAN, read_plan
from myograph.ensemble.store.provenance import PROVENANCE, provenance
from myograph.ensemble.store.tables import note_tables, noted_tables, simulator_of
from myograph.errors import InputError
from myograph.limb.tables.spec import TableSpec
from tests.ensemble.tabulated import save_tables, spec


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    return save_tables(tmp_path_factory.mktemp("saved"))


def made(store, tables):
    plan, bodies = plan_store(make_design([DesignSpec()]), spec(tables), ["biceps"])
    make_store(store, plan, bodies, {"command": "test"})
    return store


def found(store, asked=None):
    return simulator_of(store, read_plan(store), asked).tables


def test_the_bytes_of_a_store_do_not_depend_on_where_its_tables_lie(saved, tmp_path):
    shutil.copytree(saved, tmp_path / "tables")
    one, two = made(tmp_path / "one", saved), made(tmp_path / "two", tmp_path / "tables")
    assert (one / PLAN).read_bytes() == (two / PLAN).read_bytes()
    assert store_checksum(one) == store_checksum(two)
    assert (found(one), found(two)) == (str(saved), str(tmp_path / "tables"))


def test_tables_beside_the_store_may_move_together_with_it(saved, tmp_path):
    shutil.copytree(saved, tmp_path / "here" / "tables")
    made(tmp_path / "here" / "store", tmp_path / "here" / "tables")
    (tmp_path / "here").rename(tmp_path / "there")
    assert found(tmp_path / "there" / "store") == str(tmp_path / "there" / "tables")


def test_tables_that_moved_alone_are_asked_for_and_then_remembered(saved, tmp_path):
    shutil.copytree(saved, tmp_path / "old" / "tables")
    store = made(tmp_path / "store", tmp_path / "old" / "tables")
    (tmp_path / "old" / "tables").rename(tmp_path / "new")
    with pytest.raises(InputError, match=r"expected the tables it was made with, found none at .*old.*--tables"):
        found(store)
    assert found(store, tmp_path / "new") == str(tmp_path / "new")
    note_tables(store, found(store, tmp_path / "new"))
    assert found(store) == str(tmp_path / "new")
    assert provenance(store) == {"command": "test", "tables": "../new"}


def test_tables_that_say_something_else_are_refused(saved, tmp_path):
    store = made(tmp_path / "store", saved)
    others = save_tables(tmp_path / "others", TableSpec.regular(1))
    with pytest.raises(InputError, match=r"expected the tables that .*store was made with, got others"):
        found(store, others)


def test_a_store_that_lost_its_note_says_so(saved, tmp_path):
    store = made(tmp_path / "store", saved)
    (store / PROVENANCE).unlink()
    with pytest.raises(InputError, match="expected the tables it was made with, found none; say where with --tables"):
        found(store)
    assert found(store, saved) == str(saved)


def test_a_plan_that_names_the_folder_itself_is_understood(saved, tmp_path):
    store = made(tmp_path / "store", saved)
    (store / PROVENANCE).unlink()
    body = json.loads((store / PLAN).read_bytes())
    del body["checksum"]
    body["simulator"]["tables"] = str(saved)
    text = json.dumps(body, ensure_ascii=False).encode()
    (store / PLAN).write_text(json.dumps({**body, "checksum": checksum(text)}, ensure_ascii=False))
    assert noted_tables(store, read_plan(store)) == saved


def test_a_simulator_without_tables_needs_none(make):
    store = make()
    assert found(store) is None
