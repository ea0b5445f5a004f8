"""The comparison with FElupe: its second writing of our law, its problem file, and what it says where FElupe is absent.

The comparison itself runs where MYOGRAPH_FELUPE_PYTHON names the Python of an environment with FElupe and tensortrax.
"""

import importlib.util
import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import erf

pytest.importorskip("ngsolve", reason="our side needs NGSolve")

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES
from myograph.materials.functions import NUMPY
from myograph.materials.invariants import invariants
from myograph.mechanics.law import MuscleLaw, Place

ROOT = Path(__file__).parents[2]
FELUPE = os.environ.get("MYOGRAPH_FELUPE_PYTHON")
ARRAYS = SimpleNamespace(sqrt=np.sqrt, log=np.log, erf=erf, choose=np.where)


def _load(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / "benchmarks" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _script(name, *arguments):
    command = [sys.executable, ROOT / "benchmarks" / f"{name}.py", *arguments]
    return subprocess.run(command, capture_output=True, text=True)


@pytest.fixture(scope="module")
def problem(tmp_path_factory):
    path = tmp_path_factory.mktemp("fe") / "problem.npz"
    done = _script("fe_ours", path, "--write", "--preset", "tiny")
    assert done.returncode == 0, done.stderr
    return path


def _our_energy(muscle, F, values):
    fraction, area, ramp, activation = values
    at = invariants(F, np.array([0.6, 0.0, 0.8]))
    return float(MuscleLaw(muscle, activation, ramp, NUMPY).energy(at, 0.0, Place(fraction, area)))


@pytest.mark.parametrize("name", MUSCLES)
@pytest.mark.parametrize("stretch", [0.8, 1.001, 1.2])
def test_felupe_gets_the_same_energy_that_we_solve(name, stretch):
    muscle, law = built_in_arm().muscles[name], _load("fe_felupe_law")
    parts = {part: getattr(muscle, part).model_dump() for part in ("tissue", "belly", "tendon")}
    F = stretch * np.array([[1.06, 0.05, -0.02], [0.03, 0.93, 0.07], [-0.04, 0.02, 1.04]])
    fibre = np.array([0.6, 0.0, 0.8]).reshape(1, 1, 3)
    for fraction, area, ramp, activation in ((0.7, 900.0, 1.0, 0.4), (0.2, 40.0, 0.3, 1.0), (1.0, 2000.0, 0.0, 0.0)):
        place = {"fibre": fibre, "fraction": np.full((1, 1), fraction), "area": np.full((1, 1), area)}
        site = law.sites(place, parts["tissue"], ramp, activation)[:, 0, 0]
        theirs = law.energy(F.T @ F, site, parts, ARRAYS)
        ours = _our_energy(muscle, F, (fraction, area, ramp, activation))
        assert theirs == pytest.approx(ours, rel=1e-12)


def test_the_problem_file_holds_plain_arrays_of_a_whole_muscle(problem):
    with np.load(problem, allow_pickle=False) as file:
        data = dict(file)
    cells, places = len(data["cells"]), len(data["places"])
    assert data["fibre"].shape == (cells, places, 3)
    assert np.linalg.norm(data["fibre"], axis=2) == pytest.approx(1.0, abs=1e-12)
    assert data["fraction"].min() >= 0
    assert data["fraction"].max() <= 1
    assert data["area"].shape == (cells, places)
    assert data["area"].min() > 0
    assert set(json.loads(str(data["law"]))) == {"tissue", "belly", "tendon"}
    assert not data["moved"][:-1].any()
    assert data["moved"][-1].any()
    assert data["loads"][-1].tolist() == pytest.approx([1.0, 0.5, np.radians(5.0)])


def test_our_side_solves_the_problem_and_accounts_for_its_time(problem, tmp_path):
    done = _script("fe_ours", problem, "--solve", tmp_path / "ours.npz")
    assert done.returncode == 0, done.stderr
    cost = json.loads(done.stdout)
    phases = np.array([cost["matrix"], cost["linear"], cost["rest"]])
    assert phases.sum(axis=0) == pytest.approx(cost["walk"])
    assert phases.min() > 0
    with np.load(problem) as file, np.load(tmp_path / "ours.npz") as answer:
        displacement = answer["positions"] - file["points"]
        assert displacement[file["insertion"]] == pytest.approx(file["moved"][-1], abs=1e-9)
        assert np.abs(displacement[file["origin"]]).max() == 0
        assert answer["moment"] > 0


@pytest.mark.parametrize("arguments", [(), ("--felupe-python", "/no/such/python"), ("--felupe-python", sys.executable)])
def test_without_felupe_it_says_what_to_do(arguments):
    done = _script("fe", *arguments)
    assert done.returncode == 2
    assert "--make-felupe" in done.stderr.splitlines()[-1]


def test_an_unknown_muscle_is_the_callers_mistake(tmp_path):
    done = _script("fe_ours", tmp_path / "problem.npz", "--write", "--muscle", "bicep")
    assert done.returncode == 2
    assert "biceps" in done.stderr


@pytest.mark.parametrize(("shift", "agrees"), [(0.005, True), (0.02, False)])
def test_answers_agree_within_one_per_cent_or_the_times_mean_nothing(shift, agrees, tmp_path):
    rest, moved = np.zeros((4, 3)), np.ones((4, 3))
    np.savez(tmp_path / "ours.npz", positions=moved, moment=100.0)
    np.savez(tmp_path / "place.npz", positions=moved * (1 + shift), moment=100.0)
    np.savez(tmp_path / "moment.npz", positions=moved, moment=100.0 * (1 + shift))
    difference = _load("fe").difference
    for theirs in ("place", "moment"):
        assert difference(tmp_path / "ours.npz", tmp_path / f"{theirs}.npz", rest)["agrees"] is agrees


def test_nothing_that_is_installed_knows_felupe():
    assert not [path for path in (ROOT / "src").rglob("*.py") if "felupe" in path.read_text(encoding="utf-8").lower()]


@pytest.mark.skipif(not FELUPE, reason="MYOGRAPH_FELUPE_PYTHON names no environment with FElupe")
def test_felupe_gives_our_answer():
    options = ("--preset", "tiny", "--repeats", "1", "--variants", "tensortrax+scipy", "--json")
    done = _script("fe", "--felupe-python", FELUPE, *options)
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)["answers"]["tensortrax+scipy"]
    assert max(answer["displacement"], answer["moment"]) < 1e-8
