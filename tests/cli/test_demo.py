"""The main job, end to end, in its smallest size."""

import json
import subprocess
import sys
from importlib.util import find_spec

import pytest

from myograph.anatomy.load import built_in_arm
from myograph.cli.demo import run_demo
from myograph.cli.progress import Steps
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import MissingPackageError


@pytest.mark.exhaustive
@pytest.mark.skipif(not (find_spec("ngsolve") and find_spec("torch")), reason="the demo needs NGSolve and torch")
def test_the_demo_simulates_learns_and_reports(tmp_path):
    command = [sys.executable, "-m", "myograph", "demo", "--preset", "tiny", "--out", str(tmp_path / "demo"), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    assert set(result) == {"preset", "seconds", "nodes", "cases", "methods", "report"}
    assert set(result["seconds"]) == {"simulate", "train", "total"}
    assert set(result["methods"]) == {"do_nothing", "affine", "thin_plate_spline", "gen_8", "gen_343"}
    for row in result["methods"].values():
        assert set(row) == {"thesis", "strict", "off_grid"}
        for errors in row.values():
            assert 0 < errors["mean_mm"] <= errors["rmse_mm"] <= errors["max_mm"]
            assert errors["mean_mm"] <= errors["p95_mm"] <= errors["max_mm"]
    strict = {method: row["strict"]["mean_mm"] for method, row in result["methods"].items()}
    assert min(strict["gen_8"], strict["gen_343"]) * 3 < strict["do_nothing"]
    page = (tmp_path / "demo" / "report.html").read_text()
    assert page.count("data:image/png;base64,") >= 8
    assert "://" not in page.replace("http://www.w3.org", "")
    assert {path.name for path in (tmp_path / "demo").iterdir()} == {
        "ensemble", "models", "report.html", "tables", "training",
    }  # fmt: skip
    networks = ["gen_343-strict", "gen_343-thesis", "gen_8-strict", "gen_8-thesis"]
    assert sorted(path.name for path in (tmp_path / "demo" / "models").iterdir()) == networks
    assert len(read_muscle(tmp_path / "demo" / "ensemble", "biceps")) == result["cases"]


@pytest.mark.parametrize("missing", ["ngsolve", "torch", "tensorboard", "onnxscript", "matplotlib"])
def test_a_missing_package_is_named_before_anything_is_computed(missing, tmp_path, monkeypatch):
    monkeypatch.setattr("myograph.cli.demo.verb.find_spec", lambda name: None if name == missing else object())
    with pytest.raises(MissingPackageError, match=f"the demo needs the package '{missing}'.*myograph\\[all\\]"):
        run_demo(built_in_arm(), "tiny", tmp_path / "demo", Steps())
    assert not (tmp_path / "demo").exists()
