"""Finished sections lie on a shelf: whole, of one preset, of one version."""

import json
from dataclasses import replace

import pytest

from myograph.cli.reproduce.shelf import Shelf
from myograph.cli.reproduce.sizes import SIZES
from myograph.errors import InputError
from myograph.evaluation import Figure
from myograph.evaluation.experiments.page import Made
from tests.evaluation.test_page import PNG

MADE = Made([{"name": "a", "protocol": "strict", "mean_mm": 1.5}], [Figure("A.", PNG, "a")], 2.0, {"seeds": "0"})


@pytest.fixture
def shelf(tmp_path):
    shelf = Shelf(tmp_path / "out", "tiny")
    shelf.prepare()
    return shelf


def test_a_section_is_got_as_it_was_put_while_its_key_is_the_same(shelf):
    shelf.put("6.2.2", "key", MADE)
    assert shelf.get("6.2.2", "key") == MADE
    assert shelf.get("6.2.2") == MADE
    assert shelf.get("6.2.2", "other") is None
    assert shelf.get("6.2.1") is None


def test_a_section_of_another_version_or_without_a_picture_is_none(shelf):
    shelf.put("6.2.2", "key", MADE)
    path = shelf.out / "sections" / "6.2.2" / "section.json"
    told = json.loads(path.read_text())
    path.write_text(json.dumps(told | {"version": [1, "0.0.1"]}))
    assert shelf.get("6.2.2") is None
    path.write_text(json.dumps(told))
    assert shelf.get("6.2.2") is not None
    (path.parent / "0.png").unlink()
    assert shelf.get("6.2.2") is None


def test_a_section_of_other_sizes_is_none(shelf, monkeypatch):
    shelf.put("6.2.2", "key", MADE)
    monkeypatch.setitem(SIZES, "tiny", replace(SIZES["tiny"], steps=61))
    assert shelf.get("6.2.2") is None
    assert shelf.all({}) == {}


def test_results_are_the_rows_of_all_finished_sections_in_the_order_of_the_chapter(shelf):
    shelf.put("meshes", "key", MADE)
    shelf.put("6.2.1", "key", MADE)
    shelf.write_results({"command": "x"})
    told = json.loads((shelf.out / "results.json").read_text())
    assert told["preset"] == "tiny"
    assert list(told["sections"]) == ["6.2.1", "meshes"]
    assert told["sections"]["meshes"] == {"rows": MADE.rows, "seconds": 2.0, "provenance": {"seeds": "0"}}


def test_of_a_section_only_what_differs_from_the_run_is_told(shelf):
    own = {"seeds": "0", "versions": "torch 2.1", "arm": "abc"}
    shelf.put("6.2.1", "key", replace(MADE, provenance=own))
    run = {"versions": "torch 2.2", "arm": "abc"}
    shelf.write_results(run)
    told = json.loads((shelf.out / "results.json").read_text())
    assert told["provenance"] == run
    assert told["sections"]["6.2.1"]["provenance"] == {"seeds": "0", "versions": "torch 2.1"}
    assert shelf.all(run)["6.2.1"].provenance == {"seeds": "0", "versions": "torch 2.1"}
    kept = shelf.get("6.2.1")
    assert kept is not None
    assert kept.provenance == own


def test_what_a_kill_left_is_swept_and_nothing_else(shelf):
    shelf.put("6.2.1", "key", MADE)
    shelf.write_results({})
    kept = {path.relative_to(shelf.out) for path in shelf.out.rglob("*")}
    for name in (".report.html-a1", ".results.json-a2", ".reproduce.json-a3"):
        (shelf.out / name).write_bytes(b"half")
    old = shelf.out / "sections" / ".6.2.1-a4" / "old"
    old.mkdir(parents=True)
    (old / "section.json").write_bytes(b"half")
    mine = {shelf.out / ".notes-1", shelf.out / "sections" / ".6.2.9-1"}
    for path in mine:
        path.write_text("mine")
    shelf.prepare()
    assert {path.relative_to(shelf.out) for path in shelf.out.rglob("*")} == kept | {
        path.relative_to(shelf.out) for path in mine
    }
    assert shelf.get("6.2.1") == MADE


def test_a_folder_of_another_preset_is_refused(shelf):
    with pytest.raises(
        InputError, match="expected a folder of preset 'quick', got one of 'tiny'; choose another --out"
    ):
        Shelf(shelf.out, "quick").prepare()


def test_a_folder_of_something_else_is_refused_and_left_alone(tmp_path):
    (tmp_path / "precious.txt").write_text("x")
    with pytest.raises(InputError, match="expected a new folder or one of 'myograph reproduce'"):
        Shelf(tmp_path, "tiny").prepare()
    assert [path.name for path in tmp_path.iterdir()] == ["precious.txt"]


def test_a_folder_that_is_a_file_is_refused(tmp_path):
    (tmp_path / "out").write_text("x")
    with pytest.raises(InputError, match="cannot be written"):
        Shelf(tmp_path / "out", "tiny").prepare()
