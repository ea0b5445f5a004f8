"""`myograph dataset` as people call it, and the example of docs/datasets.md."""

import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib", reason="plots need matplotlib")
pytest.importorskip("h5py", reason="exports need h5py")

from myograph.cli.dataset import app, pictures
from myograph.ensemble.store import reading
from myograph.ensemble.store.lock import locked
from myograph.ensemble.store.opening import open_muscle
from myograph.ensemble.store.reading import read_muscle
from myograph.ensemble.store.rows import Row, row_path, write_row
from myograph.errors import InputError
from tests.ensemble.filled import filled_store

DOCUMENT = Path(__file__).parents[2] / "docs" / "datasets.md"


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    return filled_store(tmp_path_factory.mktemp("verbs") / "store", preset="fail=500")


def called(capsys, *arguments):
    """What the verb prints."""
    capsys.readouterr()
    app([str(argument) for argument in arguments], standalone_mode=False)
    return capsys.readouterr().out


def test_info_counts_and_measures(store, capsys):
    told = json.loads(called(capsys, "info", store, "--json"))
    data = open_muscle(store, "biceps")
    done = int((data["state"] == "done").sum())
    assert (told["cases"], told["done"], told["failed"], told["missing"]) == (12, done, 12 - done, 0)
    assert told["muscles"]["biceps"]["nodes"] == 60
    reach = told["muscles"]["biceps"]["fields"]["von_mises"]
    assert reach["unit"] == "MPa"
    assert reach["largest"] == pytest.approx(float(data["von_mises"].max()))
    assert told["elbow_angle_deg"]["least"] == pytest.approx(float(np.degrees(data["elbow_angle"].min())))
    assert told["provenance"]["command"] == "a test"
    assert 0 < told["compression"] < 1.5
    words = called(capsys, "info", store)
    assert f"12 cases, {done} done" in words
    assert "triceps, 60 nodes" in words


def test_card_writes_and_prints_the_card_and_draws_its_figure(store, capsys):
    told = json.loads(called(capsys, "card", store, "--json"))
    assert Path(told["card"]).read_text() == called(capsys, "card", store)
    assert Path(told["figure"]).read_bytes().startswith(b"\x89PNG")


def test_card_says_that_there_is_no_figure_without_matplotlib_or_answers(tmp_path, capsys, monkeypatch):
    store = filled_store(tmp_path / "store", count=1)
    with monkeypatch.context() as without:
        without.setitem(sys.modules, "matplotlib", None)
        assert json.loads(called(capsys, "card", store, "--json"))["figure"] is None
    write_row(store, Row(0, "failed", reason="no"))
    app(["card", str(store)], standalone_mode=False)
    assert "no figure" in capsys.readouterr().err


@pytest.mark.parametrize("field", ["displacement", "von_mises"])
def test_plot_draws_a_field(store, tmp_path, capsys, field):
    out = tmp_path / "field.png"
    told = json.loads(called(capsys, "plot", store, "--muscle", "triceps", "--field", field, "--out", out, "--json"))
    assert told == {"out": str(out)}
    assert out.read_bytes().startswith(b"\x89PNG")


def test_states_are_those_of_least_and_largest_activation(store):
    cases = read_muscle(store, "biceps")
    low, high = pictures.painted_states(cases, "displacement").states
    own = cases.activation[:, 2]
    assert low.title.startswith(f"activation {own.min():.2g}")
    chosen = np.array([own.argmax()])
    np.testing.assert_array_equal(high.points, cases.values("position", chosen)[0])
    way = np.linalg.norm(high.points - cases.body.reference, axis=1)
    np.testing.assert_allclose(high.values, way, rtol=1e-6)


@pytest.mark.parametrize(("to", "muscle"), [("vtkhdf", ("--muscle", "biceps")), ("csv", ())])
def test_export_says_how_many_cases_there_are(store, tmp_path, capsys, to, muscle):
    told = json.loads(called(capsys, "export", store, "--to", to, *muscle, "--out", tmp_path / "out", "--json"))
    done = int((open_muscle(store, "biceps")["state"] == "done").sum())
    assert told == {"out": str(tmp_path / "out"), "cases": 12 if to == "csv" else done}


def test_the_time_of_a_case_in_vtkhdf_is_its_number(store, tmp_path, capsys):
    import h5py

    called(capsys, "export", store, "--to", "vtkhdf", "--muscle", "biceps", "--out", tmp_path / "out")
    with h5py.File(tmp_path / "out") as file:
        times = file["VTKHDF/Steps/Values"][:]
    assert times.tolist() == np.flatnonzero(open_muscle(store, "biceps")["state"] == "done").tolist()


def test_a_case_that_is_answered_while_it_is_exported_does_not_shift_the_numbers(tmp_path, capsys, monkeypatch):
    import h5py

    store = filled_store(tmp_path / "store", count=4)
    row = row_path(store, 0).read_bytes()
    row_path(store, 0).unlink()
    told = reading.provenance

    def answered(path):
        row_path(store, 0).write_bytes(row)
        return told(path)

    monkeypatch.setattr(reading, "provenance", answered)
    called(capsys, "export", store, "--to", "vtkhdf", "--muscle", "biceps", "--out", tmp_path / "out")
    with h5py.File(tmp_path / "out") as file:
        assert file["VTKHDF/Steps/Values"][:].tolist() == [1, 2, 3]


def test_plaid_goes_into_a_folder(tmp_path, capsys):
    pytest.importorskip("plaid", reason="PLAID is written by pyplaid")
    store = filled_store(tmp_path / "store", count=2)
    called(capsys, "export", store, "--to", "plaid", "--muscle", "biceps", "--out", tmp_path / "plaid")
    assert (tmp_path / "plaid" / "infos.yaml").is_file()


MISTAKES = [
    (("info", "nowhere"), "expected the store of an ensemble, found none"),
    (("card", "nowhere"), "expected the store of an ensemble, found none"),
    (("plot", "STORE", "--muscle", "bicep", "--out", "x.png"), "expected one of biceps, triceps, got 'bicep'"),
    (
        ("plot", "STORE", "--muscle", "biceps", "--field", "stress", "--out", "x.png"),
        "expected one of the scalar fields",
    ),
    (("plot", "STORE", "--muscle", "biceps", "--out", "STORE"), "found something else"),
    (("export", "STORE", "--to", "csv", "--muscle", "biceps", "--out", "x"), "--to csv: expected no --muscle"),
    (("export", "STORE", "--to", "vtkhdf", "--out", "x"), "--to vtkhdf: expected a --muscle, got none"),
    (("export", "STORE", "--to", "vtkhdf", "--muscle", "anconeus", "--out", "x"), "expected one of biceps, triceps"),
    (("import", "nowhere.toml", "--out", "x"), "nowhere.toml: expected a TOML file, found none there"),
]


@pytest.mark.parametrize(("arguments", "words"), MISTAKES, ids=[" ".join(arguments) for arguments, _ in MISTAKES])
def test_a_mistake_is_an_input_error_and_nothing_is_written(store, tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError) as refused:
        app([str(store) if one == "STORE" else one for one in arguments], standalone_mode=False)
    assert words in str(refused.value)
    assert not list(tmp_path.iterdir())


def test_a_card_is_not_written_while_somebody_works_on_the_store(store):
    with locked(store, 0), pytest.raises(InputError, match="is at work on it"):
        app(["card", str(store)], standalone_mode=False)


def test_a_card_without_room_is_one_line(store, monkeypatch):
    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(sys.modules["myograph.cli.dataset.card"], "write_card", full)
    with pytest.raises(InputError, match="No space left on device"):
        app(["card", str(store)], standalone_mode=False)


def test_the_example_of_the_document_works_as_it_is_printed(tmp_path, monkeypatch, capsys):
    blocks = re.findall(r"```(\w+)\n(.*?)```", DOCUMENT.read_text().split("### Example")[1], re.DOTALL)
    (_, table), (_, mapping), (_, make), (_, read) = blocks
    monkeypatch.chdir(tmp_path)
    Path("cases.csv").write_text(table)
    Path("mapping.toml").write_text(mapping)
    exec(make, {})
    assert json.loads(called(capsys, "import", "mapping.toml", "--out", "store", "--json"))["cases"] == 2
    exec(read, {})
    assert float(capsys.readouterr().out) == pytest.approx(0.3)
    assert "imported as 'tetrahedron'" in called(capsys, "card", "store")
