"""The command line as people call it: exit codes, one clear line, no traceback, nothing half-written."""

import json
import os
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

pytest.importorskip("ngsolve", reason="the verbs need NGSolve")


def _myograph(*arguments, cwd=None):
    command = [sys.executable, "-m", "myograph", *arguments]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, check=False)


def _solve(**changes):
    options = {"muscle": "biceps", "activation": "0.5", "angle": "60", **changes}
    return _myograph(
        "solve", *(part for name, value in options.items() for part in (f"--{name.replace('_', '-')}", value))
    )


def test_solve_prints_one_json_object_and_writes_the_fields(tmp_path):
    done = _solve(out=str(tmp_path / "state.npz"))
    assert done.returncode == 0, done.stderr
    done = _myograph(
        "solve",
        "--muscle",
        "biceps",
        "--activation",
        "0.5",
        "--angle",
        "60",
        "--json",
        "--out",
        str(tmp_path / "state.npz"),
    )
    result = json.loads(done.stdout)
    assert result["muscle"] == "biceps"
    assert result["angle_deg"] == 60
    assert 8 < result["moment_nm"] < 18
    with np.load(tmp_path / "state.npz", allow_pickle=False) as fields:
        assert fields["position"].shape == (result["nodes"], 3)
        assert fields["cauchy_stress"].shape == (result["nodes"], 6)
        assert fields["von_mises"].max() == pytest.approx(result["von_mises_max_mpa"])


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"muscle": "bicep"}, "unknown muscle 'bicep': expected one of brachioradialis"),
        ({"activation": "1.5"}, "activation of biceps: expected a number in [0, 1], got 1.5"),
        ({"activation": "nan"}, "expected a number in [0, 1], got nan"),
        ({"activation": "much"}, "activation"),
        ({"angle": "170"}, "elbow angle: expected 10 to 150 degrees, got 170"),
        ({"angle": "nan"}, "elbow angle"),
        ({"preset": "huge"}, "unknown preset 'huge'"),
        ({"arm": "nowhere.toml"}, "nowhere.toml: expected a TOML file"),
        ({"wrong": "1"}, "--wrong"),
    ],
    ids=lambda value: next(iter(value.items()))[1] if isinstance(value, dict) else "",
)
def test_a_mistake_of_the_caller_is_one_line_and_exit_code_2(changes, words):
    done = _solve(**changes)
    assert done.returncode == 2
    assert words in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert done.stdout == ""


def test_an_unknown_key_of_an_arm_names_the_near_one(tmp_path):
    from importlib.resources import files

    text = (files("myograph.anatomy") / "left_arm.toml").read_text()
    (tmp_path / "arm.toml").write_text(text.replace("line_radius = 40.0", "line_radios = 40.0"))
    done = _solve(arm=str(tmp_path / "arm.toml"))
    assert done.returncode == 2
    assert "unknown key 'muscles.biceps.line_radios'; did you mean 'line_radius'?" in done.stderr


def test_a_method_that_fails_says_where_and_exits_with_3(tmp_path):
    """A muscle whose fibres are thousands of times too strong for its matrix."""
    from importlib.resources import files

    text = (files("myograph.anatomy") / "left_arm.toml").read_text()
    (tmp_path / "arm.toml").write_text(re.sub(r"passive_stress = [0-9.]+", "passive_stress = 5e5", text))
    done = _solve(arm=str(tmp_path / "arm.toml"))
    assert done.returncode == 3
    assert "biceps at activation 0.000" in done.stderr
    assert "residual over reaction" in done.stderr
    assert "Traceback" not in done.stderr


def test_an_arm_that_cannot_be_meshed_names_the_element(tmp_path):
    from importlib.resources import files

    text = (files("myograph.anatomy") / "left_arm.toml").read_text()
    (tmp_path / "arm.toml").write_text(text.replace("[0.50, 2396.0]", "[0.50, 2396000.0]"))
    done = _solve(arm=str(tmp_path / "arm.toml"))
    assert done.returncode == 2
    assert "mesh of biceps: element" in done.stderr


def test_arm_draws_and_describes(tmp_path):
    done = _myograph("arm", "--out", str(tmp_path / "arm.png"), "--preset", "tiny", "--json")
    result = json.loads(done.stdout)
    assert (tmp_path / "arm.png").read_bytes().startswith(b"\x89PNG")
    assert result["muscles"]["biceps"]["volume_cm3"] == pytest.approx(320, rel=0.05)
    assert set(result["muscles"]) == {"brachioradialis", "brachialis", "biceps", "anconeus", "triceps"}


@pytest.mark.parametrize("verb", ["arm", "demo"])
def test_a_place_that_cannot_be_written_is_refused(verb, tmp_path):
    (tmp_path / "file").write_text("in the way")
    done = _myograph(verb, "--preset", "tiny", "--out", str(tmp_path / "file" / "x"))
    assert done.returncode == 2
    assert "writ" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("verb", [(), ("demo",), ("arm",), ("solve",)])
def test_help_names_every_option(verb):
    done = _myograph(*verb, "--help")
    assert done.returncode == 0
    assert "--help" in done.stdout


def _hears_interrupts():
    """Shells let what they start in the background ignore interrupts; here they count."""
    os.setsid()
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def test_an_interrupt_leaves_no_broken_file(tmp_path):
    out = tmp_path / "demo"
    command = [sys.executable, "-m", "myograph", "demo", "--preset", "tiny", "--out", str(out)]
    run = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, preexec_fn=_hears_interrupts)
    for _ in range(600):
        if out.exists():
            break
        time.sleep(0.1)
    time.sleep(6)
    os.kill(run.pid, signal.SIGINT)
    _, said = run.communicate(timeout=30)
    assert run.returncode == 130
    assert "interrupted" in said
    assert "Traceback" not in said
    assert not [path for path in out.rglob("*") if path.name.startswith(".") and path.is_file()]
    assert not (out / "report.html").exists()
