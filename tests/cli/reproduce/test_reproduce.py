"""The verb, end to end: a section from a store; from nothing; killed and gone on with."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

from myograph.anatomy.load import built_in_arm
from myograph.cli.progress import Steps
from myograph.cli.reproduce import run_reproduction
from myograph.cli.reproduce import runner as running
from myograph.cli.reproduce.data import Data, Places
from myograph.cli.reproduce.experiment import Experiment, corners, taught_twice
from myograph.cli.reproduce.registry import EXPERIMENTS
from myograph.ensemble.design import DesignSpec
from myograph.errors import InputError, MissingPackageError
from myograph.evaluation.experiments.chapter import SECTIONS
from tests.cli.reproduce.conftest import stored


def command(out, *more):
    return [sys.executable, "-m", "myograph", "reproduce", "--preset", "tiny", "--out", str(out), "--json", *more]


def test_every_section_is_told_of_in_the_report():
    assert list(EXPERIMENTS) == list(SECTIONS)


def test_a_section_is_made_from_a_store_and_the_second_run_makes_nothing(store, tmp_path, monkeypatch, here):
    places = Places(tmp_path / "out", store)
    result = run_reproduction(built_in_arm(), "tiny", ["meshes"], places, Steps())
    rows = result["sections"]["meshes"]["rows"]
    assert {row["protocol"] for row in rows} == {"thesis", "strict", "off_grid"}
    assert [row["name"] for row in rows[::3]] == [
        "8 nodes, right", "27 nodes, right", "8 nodes, legacy_sign", "27 nodes, legacy_sign",
    ]  # fmt: skip
    assert all(0 < row["mean_mm"] <= row["max_mm"] for row in rows)
    page = (tmp_path / "out" / "report.html").read_text()
    assert page.count("data:image/png;base64,") == 1
    assert json.loads((tmp_path / "out" / "results.json").read_text())["sections"]["meshes"]["rows"] == rows
    monkeypatch.setattr(running, "side_by_side", lambda *_: pytest.fail("a trial was made again"))
    again = run_reproduction(built_in_arm(), "tiny", ["meshes"], places, Steps())
    assert again["sections"] == result["sections"]


def test_a_row_that_was_left_out_is_made_when_its_package_is_there(store, tmp_path, monkeypatch, here):
    def missing(*_):
        raise MissingPackageError("torch-geometric", "train", "the processor 'GCNConv'")

    affine = Experiment(lambda data, size: taught_twice("affine", "affine", corners(data), size), lambda outcome: ())
    monkeypatch.setitem(EXPERIMENTS, "meshes", affine)
    asked = (built_in_arm(), "tiny", ["meshes"], Places(tmp_path / "out", store), Steps())
    with monkeypatch.context() as without:
        without.setattr("myograph.cli.reproduce.trying.run_trial", missing)
        (row,) = run_reproduction(*asked)["sections"]["meshes"]["rows"]
    assert "torch-geometric" in row["left_out"]
    rows = run_reproduction(*asked)["sections"]["meshes"]["rows"]
    assert [row["protocol"] for row in rows] == ["thesis", "strict", "off_grid"]


def test_cases_of_another_arm_are_refused_and_the_option_named(store, tmp_path):
    other = built_in_arm().model_copy(update={"name": "another arm"})
    with pytest.raises(
        InputError, match=r"expected cases of the arm \w{16}, got those of \w{16}; name their arm by --arm"
    ):
        run_reproduction(other, "tiny", ["meshes"], Places(tmp_path / "out", store), Steps())


@pytest.fixture
def made_with(monkeypatch):
    """Makes the versions of all packages what is said."""

    def say(version):
        monkeypatch.setattr("myograph.cli.reproduce.verb.version", lambda package: version)

    return say


def test_a_section_that_other_versions_made_says_so_and_every_section_how_to_make_it_again(
    store, tmp_path, monkeypatch, here, made_with
):
    affine = Experiment(lambda data, size: taught_twice("affine", "affine", corners(data), size), lambda outcome: ())
    for name in ("meshes", "sensors"):
        monkeypatch.setitem(EXPERIMENTS, name, affine)
    monkeypatch.setattr("os.getloadavg", lambda: (1.0, 1.0, 1.0))
    monkeypatch.setattr(sys, "argv", ["a notebook"])
    beside = store.with_name("my store")
    beside.exists() or beside.symlink_to(store)
    places = Places(tmp_path / "out", beside, arm=tmp_path / "my arm.toml")
    made_with("1.0")
    run_reproduction(built_in_arm(), "tiny", ["meshes"], places, Steps())
    made_with("2.0")
    run_reproduction(built_in_arm(), "tiny", ["meshes", "sensors"], places, Steps())
    told = json.loads((tmp_path / "out" / "results.json").read_text())
    given = "--preset tiny --store 'my store' --arm 'my arm.toml'"
    assert told["provenance"]["last command"] == f"myograph reproduce --section meshes --section sensors {given}"
    assert told["provenance"]["versions"].startswith("myograph 2.0, ")
    own = {name: made["provenance"] for name, made in told["sections"].items()}
    assert own["meshes"]["versions"].startswith("myograph 1.0, ")
    assert set(own["sensors"]) == {"command", "seeds", "data", "time taken"}
    assert own["sensors"]["time taken"].endswith("s, 2 trials made before")
    assert own["sensors"]["command"] == f"myograph reproduce --section sensors {given}"
    page = (tmp_path / "out" / "report.html").read_text()
    assert page.count("numpy 1.0") == page.count("numpy 2.0") == 1


def test_a_store_without_a_design_is_refused_before_anything_is_made(tmp_path, monkeypatch):
    monkeypatch.setattr(Data, "from_tables", lambda *_: pytest.fail("cases were simulated"))
    monkeypatch.setattr(running, "side_by_side", lambda *_: pytest.fail("a trial was made"))
    path = stored(tmp_path / "corners", [DesignSpec(), DesignSpec(method="latin_hypercube", count=8)])
    wanted = "corners: expected cases of the designs factorial, support and off_grid, got none of support; simulate"
    with pytest.raises(InputError, match=wanted):
        run_reproduction(built_in_arm(), "tiny", ["steps", "edge"], Places(tmp_path / "out", path), Steps())


def test_an_unknown_section_is_named_before_anything_is_made(tmp_path):
    with pytest.raises(InputError, match=r"section '6\.2\.9': expected one of 6\.2\.1, 6\.2\.2"):
        run_reproduction(built_in_arm(), "tiny", ["6.2.9"], Places(tmp_path / "out"), Steps())
    assert not (tmp_path / "out").exists()


def test_an_unknown_preset_is_refused(tmp_path):
    with pytest.raises(InputError, match="unknown preset 'huge'"):
        run_reproduction(built_in_arm(), "huge", [], Places(tmp_path / "out"), Steps())


@pytest.mark.parametrize(
    ("designs", "wanted"),
    [
        (
            [DesignSpec(method="factorial", step=0.5)],
            "expected activations 0 and 1 in the design factorial, got 211 cases",
        ),
        ([DesignSpec()], "expected 8 cases of the design support at least, got 3"),
    ],
    ids=["halves", "few"],
)
def test_a_store_of_another_design_of_that_name_is_refused(designs, wanted, tmp_path):
    more = [DesignSpec(method="tenths", count=3, label="support"), DesignSpec(method="latin_hypercube", count=8)]
    path = stored(tmp_path / "store", [*designs, *more])
    with pytest.raises(InputError, match=wanted):
        run_reproduction(built_in_arm(), "tiny", ["edge"], Places(tmp_path / "out", path), Steps())


@pytest.mark.parametrize("missing", ["torch", "lightning_fabric", "sklearn", "matplotlib", "ngsolve"])
def test_a_missing_package_is_named_before_anything_is_made(missing, tmp_path, monkeypatch):
    found = "myograph.cli.reproduce.verb.find_spec"
    monkeypatch.setattr(found, lambda name: None if name == missing else object())
    with pytest.raises(MissingPackageError, match=f"needs the package '{missing}'"):
        run_reproduction(built_in_arm(), "tiny", [], Places(tmp_path / "out"), Steps())
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("section", "store", "tables", "needed"),
    [
        ("meshes", True, False, False),
        ("meshes", False, True, False),
        ("steps", True, False, True),
        ("steps", True, True, False),
        ("direct", True, True, True),
    ],
)
def test_a_solver_is_asked_for_where_cases_are_solved(section, store, tables, needed, tmp_path, monkeypatch):
    def found_all(_):
        raise RuntimeError

    found = "myograph.cli.reproduce.verb.find_spec"
    monkeypatch.setattr(found, lambda name: None if name == "ngsolve" else object())
    monkeypatch.setattr("myograph.cli.reproduce.shelf.Shelf.prepare", found_all)
    places = Places(tmp_path / "out", tmp_path if store else None, tmp_path if tables else None)
    with pytest.raises(MissingPackageError if needed else RuntimeError):
        run_reproduction(built_in_arm(), "tiny", [section], places, Steps())


def test_a_store_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(InputError, match="expected a folder, found none"):
        run_reproduction(built_in_arm(), "tiny", [], Places(tmp_path / "out", tmp_path / "nowhere"), Steps())


@pytest.mark.exhaustive
def test_a_killed_run_goes_on_where_it_was(store, tmp_path):
    out = tmp_path / "out"
    asked = command(out, "--section", "sensors", "--store", str(store))
    run = subprocess.Popen(asked, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    started = time.monotonic()
    while len(list((out / "cache").glob("*.npz"))) < 3:
        assert run.poll() is None
        assert time.monotonic() - started < 120
        time.sleep(0.05)
    os.kill(run.pid, signal.SIGKILL)
    run.wait()
    before = {path.name: path.stat().st_mtime_ns for path in (out / "cache").glob("*.npz")}
    assert not (out / "report.html").exists()
    done = subprocess.run(asked, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    after = {path.name: path.stat().st_mtime_ns for path in (out / "cache").glob("*.npz")}
    assert before.items() <= after.items()
    assert len(after) > len(before)
    assert (out / "report.html").exists()
    assert not list(out.rglob(".*"))


@pytest.mark.exhaustive
@pytest.mark.parametrize("section", list(EXPERIMENTS))
def test_a_section_is_made_from_nothing(section, tmp_path_factory):
    out = tmp_path_factory.getbasetemp() / "from-nothing"
    done = subprocess.run(command(out, "--section", section), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    assert set(result) == {"sections", "report"}
    assert set(result["sections"]) == {section}
    assert set(result["sections"][section]) == {"rows", "seconds"}
    assert {row["protocol"] for row in result["sections"][section]["rows"]} == {"thesis", "strict", "off_grid"}
    assert SECTIONS[section].heading in (out / "report.html").read_text()
