"""`myograph optimise` and `myograph move` as people call them, on a limb of tabulated forces."""

import json
import subprocess
import sys
from dataclasses import dataclass

import numpy as np
import pytest

from tests.limb.test_force_limb import TOML, write_limb

MOVING = """
[dynamics]
radius_of_gyration = 110.0
damping_nms = 1.0
activation_time = 0.01
deactivation_time = 0.04
"""
ACTIVATIONS = "time,flexor,extensor\n0,0.2,0.1\n0.2,0.6,0.1\n0.4,0.6,0.1\n"


# One process runs many command lines, one after the other: starting Python takes longer than they do.
RUN = """
import contextlib, io, json, sys
from myograph.cli import main
results = []
for arguments in json.loads(sys.argv[1]):
    sys.argv = ["myograph", *arguments]
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            main()
        except SystemExit as left:
            code = left.code
    results.append([code, out.getvalue(), err.getvalue()])
print(json.dumps(results))
"""


@dataclass(frozen=True)
class Done:
    returncode: int
    stdout: str
    stderr: str


def _myograph(folder, *commands):
    command = [sys.executable, "-c", RUN, json.dumps([[str(part) for part in one] for one in commands])]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=folder)
    return [Done(*result) for result in json.loads(done.stdout)]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("limb")
    heavy = TOML.replace("hand = 280.0", "hand = 280.0\nforearm_mass = 1.5\ncentre_of_mass = 180.0")
    write_limb(folder, heavy + MOVING)
    (folder / "activations.csv").write_text(ACTIVATIONS)
    (folder / "violent.csv").write_text("time,flexor,extensor\n0,0.2,0.1\n0.05,1,0\n0.8,1,0\n")
    (folder / "bare.toml").write_text(TOML)
    return folder


LEAST = ("optimise", "--limb", "limb.toml", "--angle", "70", "--load", "40", "--json")
CHANGE = ("optimise", "--limb", "limb.toml", "--angle", "70", "--load", "40", "--no-gravity", "--from", "0.5,0.9")
MOVE = ("move", "activations.csv", "--limb", "limb.toml", "--load", "20", "--step", "0.02", "--json")
SLOW, FAST = (*MOVE, "--out", "slow"), (*MOVE, "--dynamic", "--out", "fast")
LEAVES = ("move", "violent.csv", "--limb", "limb.toml", "--dynamic", "--load", "-15", "--out", "left")
BARE = ("move", "activations.csv", "--limb", "bare.toml", "--dynamic")
HOLD = ("optimise", "--angle", "70", "--limb", "limb.toml")
STIR = ("move", "activations.csv", "--limb", "limb.toml")
MISTAKES = {
    ("optimise", "--angle", "70"): "expected either --tables FOLDER (made by 'myograph table build') or --limb",
    (*HOLD, "--tables", "t"): "got both",
    ("optimise", "--angle", "70", "--limb", "none.toml"): "none.toml: expected a TOML file",
    (*HOLD, "--load", "400"): "out of reach",
    (*HOLD, "--from", "a,b"): "--from: expected numbers",
    (*HOLD, "--from", "1"): "expected 2 activations",
    (*HOLD, "--arm", "a.toml"): "--arm together with --tables",
    ("optimise", "--angle", "70", "--tables", "none"): "none/brachioradialis.npz",
    ("move", "none.csv", "--limb", "limb.toml"): "none.csv: cannot be read",
    (*STIR, "--map", "flexor"): "--map: expected column=muscle",
    (*STIR, "--map", "flexor=biceps"): "unknown muscle 'biceps'",
    (*STIR, "--load", "900"): "at 0 s: activations (0.1, 0.2)",
    BARE: "two muscles: expected a table [dynamics] and a forearm's mass for --dynamic",
}


@pytest.fixture(scope="module")
def done(folder):
    """Command line -> what came of it, all in one folder."""
    commands = [LEAST, CHANGE, SLOW, FAST, LEAVES, *MISTAKES]
    return dict(zip(commands, _myograph(folder, *commands), strict=True))


def test_optimise_prints_one_json_object_whose_activations_balance(done):
    assert done[LEAST].returncode == 0, done[LEAST].stderr
    found = json.loads(done[LEAST].stdout)
    assert list(found) == [
        "limb", "angle_deg", "hand_load_n", "objective", "activations", "cost", "imbalance_nm", "stable",
        "degrees_per_tenth", "notes",
    ]  # fmt: skip
    assert found["objective"] == "least sum"
    assert found["activations"]["extensor"] == 0
    flexor, weight = found["activations"]["flexor"], 40 * 280 + 1.5 * 9.80665 * 180
    pull = (300 + 500 * flexor - 140) * 35 - 300 * (22 + 7 - 4.9) - weight * np.sin(np.radians(70))
    assert pull == pytest.approx(0, abs=1e-3)
    assert found["cost"] == pytest.approx(flexor)
    assert found["stable"] is True


def test_optimise_from_activations_before_changes_least_and_says_so(done):
    assert done[CHANGE].returncode == 0, done[CHANGE].stderr
    assert "two muscles at 70 degrees with 40 N in the hand" in done[CHANGE].stdout
    assert "change of activations" in done[CHANGE].stdout


@pytest.mark.parametrize(("command", "kind", "name"), [(SLOW, "quasi-static", "slow"), (FAST, "dynamic", "fast")])
def test_move_writes_the_series_and_draws_it(folder, done, command, kind, name):
    assert done[command].returncode == 0, done[command].stderr
    found = json.loads(done[command].stdout)
    assert found["kind"] == kind
    assert found["times"] == 21
    with (folder / name / "movement.csv").open() as file:
        header = file.readline().strip().split(",")
        numbers = np.loadtxt(file, delimiter=",")
    assert numbers[:, header.index("time_s")] == pytest.approx(np.arange(21) * 0.02)
    assert numbers[[0, -1], header.index("angle_deg")] == pytest.approx(
        [found["angle_deg"]["first"], found["angle_deg"]["last"]]
    )
    assert found["angle_deg"]["largest"] > found["angle_deg"]["first"] + 10
    assert [path.name for path in sorted((folder / name).iterdir())] == [
        "equilibria.png", "moments.png", "movement.csv", "movement.png",
    ]  # fmt: skip


@pytest.mark.parametrize("command", MISTAKES, ids=" ".join)
def test_a_mistake_is_one_line_and_exit_code_2(folder, done, command):
    assert done[command].returncode == 2, done[command].stdout
    assert MISTAKES[command] in done[command].stderr
    assert len(done[command].stderr.strip().splitlines()) == 1
    assert done[command].stdout == ""
    assert not (folder / "movement").exists()


def test_a_movement_out_of_its_range_exits_with_3_and_writes_nothing(folder, done):
    assert done[LEAVES].returncode == 3, done[LEAVES].stderr
    assert "the limb leaves its range at 0." in done[LEAVES].stderr
    assert not (folder / "left").exists()


def test_a_bench_without_tables_or_cases_says_what_is_missing(tmp_path):
    missing, none = _myograph(tmp_path, ["bench", "limb", "--tables", "nowhere"], ["bench", "limb", "--cases", "many"])
    assert missing.returncode == none.returncode == 2
    assert "nowhere" in missing.stderr
    assert "--cases': Input should be a valid integer" in none.stderr
