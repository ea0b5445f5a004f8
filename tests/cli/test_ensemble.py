"""`myograph ensemble` as people call it."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytest.importorskip("distributed", reason="the verbs need Dask")

from myograph.ensemble.store.checking import store_checksum
from myograph.ensemble.store.chunks import chunk_path
from myograph.ensemble.store.lock import is_locked, locked
from myograph.ensemble.store.opening import open_muscle
from tests.ensemble import synthetic

ROOT = Path(__file__).parents[2]
CALLS = """
import json, sys
from myograph.cli.app import app
told = []
for arguments in json.loads(sys.argv[1]):
    try:
        app(arguments, standalone_mode=False)
    except Exception as problem:
        told.append([getattr(problem, "exit_code", 1), str(problem)])
print(json.dumps(told))
"""
OWN = ("--simulator", synthetic.FACTORY, "--preset", "sleep=0.001")
MISTAKES = [
    (("run", "--design", "factorail", "--out", "x"), "design: method: "),
    (("run", "--design", "factorial", "--step", "0.3", "--out", "x"), "step: expected 1 over a whole number"),
    (("run", "--design", "sobol", "--out", "x"), "design 'sobol': expected 'count'"),
    (("run", "--load-n", "1:2:3", "--out", "x"), "hand_load_n: expected a number or LOW:HIGH, got '1:2:3'"),
    (("run", "none.toml", "--out", "x"), "none.toml: expected a TOML file, found none there"),
    (("run", "none.toml", "--design", "sobol", "--out", "x"), "got both"),
    (("run", "--simulator", "thing", "--out", "x"), "expected 'table', 'direct' or 'package.module:function'"),
    (("run", "--simulator", "no.such:thing", "--out", "x"), "cannot be imported"),
    (("run", "--simulator", "math:sqrt", "--out", "x"), "simulator 'math:sqrt': "),
    (("run", "--simulator", "table", "--preset", "huge", "--out", "x"), "unknown preset 'huge'"),
    (("run", *OWN, "--muscle", "bicep", "--out", "x"), "muscles: expected some of"),
    (("status", "none"), "none: expected the store of an ensemble, found none"),
    (("check", "none"), "none: expected the store of an ensemble, found none"),
    (("resume", "none"), "none: expected the store of an ensemble, found none"),
]


def ensemble(*arguments):
    command = [sys.executable, "-m", "myograph", "ensemble", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)


@pytest.fixture(scope="module")
def full(tmp_path_factory):
    """A store of the 32 corners, and what the command said."""
    store = tmp_path_factory.mktemp("full") / "store"
    done = ensemble("run", "--design", "factorial", "--step", "1.0", *OWN, "--out", store, "--json")
    assert done.returncode == 0, done.stderr
    return store, done


def test_a_run_ends_with_its_numbers_and_shows_the_dashboard(full):
    store, done = full
    result = json.loads(done.stdout)
    assert list(result) == ["cases", "done", "failed", "seconds", "store"]
    assert (result["cases"], result["done"], result["failed"], result["store"]) == (32, 32, 0, str(store))
    assert "dashboard: http://" in done.stderr
    assert open_muscle(store, "triceps")["position"].shape == (32, synthetic.NODES, 3)


def test_status_counts(full):
    result = json.loads(ensemble("status", full[0], "--json").stdout)
    expected = {
        "cases": 32,
        "done": 32,
        "failed": 0,
        "missing": 0,
        "running": False,
        "seconds_left": None,
        "failures": [],
    }
    assert result == expected


def test_damage_is_named_with_exit_code_3_and_repaired_to_the_same_bytes(full):
    store = full[0]
    before = store_checksum(store)
    assert json.loads(ensemble("check", store, "--json").stdout) == {"ok": True, "problems": []}
    path = chunk_path(store, "biceps", "position", 17)
    path.write_bytes(path.read_bytes()[:-1])
    done = ensemble("check", store, "--json")
    assert done.returncode == 3
    result = json.loads(done.stdout)
    assert result["ok"] is False
    [problem] = result["problems"]
    assert problem["case"] == 17
    assert problem["what"].startswith("biceps/position: its ")
    done = ensemble("check", store, "--repair", "--json")
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == {"ok": True, "problems": [problem]}
    assert store_checksum(store) == before


@pytest.mark.exhaustive
def test_an_interrupted_run_of_a_file_is_resumed(tmp_path):
    (tmp_path / "arm.toml").write_text(
        f'simulator = "{synthetic.FACTORY}"\npreset = "sleep=0.1 fail=1000"\nmuscles = ["biceps"]\n'
        '[[design]]\nmethod = "factorial"\nstep = 1.0\n'
        '[[design]]\nmethod = "tenths"\ncount = 60\nseed = 4\n[run]\nworkers = 2\n'
    )
    store = tmp_path / "store"
    command = [sys.executable, "-m", "myograph", "ensemble", "run", str(tmp_path / "arm.toml"), "--out", str(store)]
    running = subprocess.Popen(command, cwd=ROOT, stderr=subprocess.PIPE, text=True, start_new_session=True)
    while running.poll() is None and (not (store / "rows").is_dir() or not os.listdir(store / "rows")):
        time.sleep(0.02)
    assert is_locked(store)
    running.send_signal(signal.SIGINT)
    said = running.communicate(timeout=60)[1]
    assert running.returncode == 130, said
    now = json.loads(ensemble("status", store, "--json").stdout)
    assert now["running"] is False
    assert now["missing"] > 0
    done = ensemble("resume", store, "--json")
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    assert result["cases"] == result["done"] + result["failed"] == 92
    assert result["failed"] >= 16
    words = ensemble("status", store).stdout
    assert "0 missing; nobody at work" in words
    assert words.count("no way further") == result["failed"]


@pytest.fixture(scope="module")
def complaints(tmp_path_factory):
    """What becomes of all mistakes, in one process: exit code and message of each, and what they have written."""
    place = tmp_path_factory.mktemp("mistakes")
    command = [sys.executable, "-c", CALLS, json.dumps([["ensemble", *arguments] for arguments, _ in MISTAKES])]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=place, env=environment)
    return json.loads(done.stdout), list(place.iterdir())


@pytest.mark.parametrize("number", range(len(MISTAKES)), ids=[" ".join(arguments) for arguments, _ in MISTAKES])
def test_a_mistake_is_one_line_and_exit_code_2_and_nothing_is_written(complaints, number):
    told, written = complaints
    code, message = told[number]
    assert code == 2
    assert MISTAKES[number][1] in message
    assert len(message.splitlines()) == 1
    assert not written


def test_another_design_and_a_second_runner_are_refused(full):
    store = full[0]
    done = ensemble("run", "--design", "factorial", "--step", "0.5", *OWN, "--out", store)
    assert done.returncode == 2
    assert "holds another design (32 cases, asked for 243)" in done.stderr
    with locked(store, 0):
        done = ensemble("resume", store)
    assert done.returncode == 2
    assert "is at work on it" in done.stderr


def test_help_names_the_options():
    said = ensemble("run", "--help").stdout
    names = ("design", "step", "simulator", "preset", "out", "workers", "scheduler", "slurm", "time-limit", "json")
    assert all(f"--{name}" in said for name in names)
