"""All methods side by side."""

import json
import sys

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

from myograph.cli.bench_learn import learn
from myograph.errors import InputError, MissingPackageError
from myograph.learning.bent_rod import LENGTH, bent_rod
from myograph.learning.comparison import ROWS, compare
from myograph.learning.learners import LEARNERS

app = typer.Typer()
app.command()(learn)
FEW = ["do_nothing", "affine", "gen_thesis"]


def test_every_method_has_a_row_and_the_reference_of_speed_too():
    assert set(ROWS) == {*LEARNERS, "gen_thesis_pyg"}


def test_the_rod_keeps_its_length_along_the_axis():
    """Nodes on the axis (x = y = 0) lie on an arc of the rod's length."""
    rod = bent_rod(sections=200, across=3)
    axis = np.flatnonzero(np.abs(rod.body.reference[:, :2]).max(axis=1) < 1e-9)
    positions = rod.values("position", np.arange(len(rod)))[:, axis]
    lengths = np.linalg.norm(np.diff(positions, axis=1), axis=-1).sum(axis=1)
    np.testing.assert_allclose(lengths, LENGTH, rtol=1e-4)


def test_rows_say_size_times_and_error():
    rows = compare(bent_rod(sections=10), 3, FEW).rows
    assert list(rows) == FEW
    assert rows["gen_thesis"].parameters > 5860 > rows["affine"].parameters == 0
    assert all(row.train_s >= 0 and row.predict_ms > 0 for row in rows.values())
    assert 0 < rows["affine"].mean_mm < rows["do_nothing"].mean_mm


def test_json_is_one_object_of_rows():
    done = CliRunner().invoke(app, ["--json", "--steps", "1", "--method", "affine"])
    assert done.exit_code == 0, done.output
    told = json.loads(done.stdout)
    assert list(told) == ["affine"]
    assert list(told["affine"]) == ["parameters", "stored", "train_s", "predict_ms", "mean_mm"]


def test_people_read_a_table():
    lines = CliRunner().invoke(app, ["--method", "affine", "--method", "do_nothing"]).stdout.splitlines()
    assert lines[0].split() == ["parameters", "stored", "train_s", "predict_ms", "mean_mm"]
    assert [line.split()[0] for line in lines[1:3]] == ["affine", "do_nothing"]


def test_without_pytorch_geometric_its_row_is_left_out(monkeypatch):
    for name in [name for name in sys.modules if name.startswith("torch_geometric")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "torch_geometric", None)
    found = compare(bent_rod(sections=10), 1, ["gen_thesis_pyg"])
    assert found.rows == {}
    assert "torch-geometric" in found.left_out["gen_thesis_pyg"]


def test_an_unknown_method_is_a_mistake():
    with pytest.raises(InputError, match="unknown method 'gne'"):
        compare(bent_rod(sections=10), 1, ["gne"])


def test_without_torch_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "myograph.learning.comparison", None)
    done = CliRunner().invoke(app, [])
    assert isinstance(done.exception, MissingPackageError)


def test_a_missing_store_is_a_mistake(tmp_path):
    done = CliRunner().invoke(app, ["--data", str(tmp_path / "nowhere")])
    assert isinstance(done.exception, InputError)
