"""`myograph table` as people call it."""

import json
import subprocess
import sys

import pytest

pytest.importorskip("ngsolve", reason="the verbs need NGSolve")

from myograph.anatomy.load import built_in_arm
from myograph.limb.tables.adaptive import built
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.table_file import save_table
from tests.limb.conftest import FormulaStates
from tests.limb.tables.test_adaptive import kinked


def _table(*arguments):
    command = [sys.executable, "-m", "myograph", "table", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.fixture
def folder(tmp_path):
    """Tables of two muscles: one good, one that may not grow."""
    arm = built_in_arm()
    save_table(built(FormulaStates(arm, "biceps"), TableSpec()), tmp_path / "biceps.npz")
    unmet = TableSpec(tolerance_mm=1e-9, tolerance_nm=1e-12, most_states=21)
    save_table(built(FormulaStates(arm, "triceps", kinked), unmet), tmp_path / "triceps.npz")
    return tmp_path


@pytest.fixture(scope="module")
def finite_elements(tmp_path_factory):
    return tmp_path_factory.mktemp("built")


@pytest.mark.exhaustive
def test_a_table_is_built_to_its_tolerance_and_its_errors_are_told(finite_elements):
    done = _table(
        "build", "--preset", "tiny", "--muscle", "anconeus", "--tolerance-mm", "0.5", "--tolerance-nm", "0.2",
        "--out", str(finite_elements / "tables"), "--json",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    row = json.loads(done.stdout)["tables"]["anconeus"]
    assert (row["failed"], row["met"], row["belongs_to_this_arm"]) == (0, True, True)
    assert 0 < row["held_out"]["mean_mm"] <= 0.5
    assert row["held_out"]["mean_mm"] <= row["held_out"]["max_mm"]
    assert 0 < row["held_out"]["moment_mean_nm"] <= min(0.2, row["held_out"]["moment_max_nm"])
    assert row["states"] >= 21
    assert row["cpu_minutes"] > 0
    told = json.loads(_table("info", str(finite_elements / "tables"), "--json").stdout)
    assert told["tables"]["anconeus"] == row


@pytest.mark.exhaustive
def test_tolerances_that_few_states_cannot_meet_are_no_failure_but_are_told(finite_elements):
    """With the states that the test before has solved, where it ran."""
    done = _table(
        "build", "--preset", "tiny", "--muscle", "anconeus", "--tolerance-mm", "1e-6", "--most-states", "21",
        "--out", str(finite_elements / "tables"),
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "anconeus: asked for 1e-06 mm and 0.05 N·m in the mean, got" in done.stdout
    assert "allow more with --most-states" in done.stdout


def test_info_tells_of_a_folder_and_of_one_table(folder):
    both = json.loads(_table("info", str(folder), "--json").stdout)["tables"]
    assert {name: (row["met"], row["states"]) for name, row in both.items()} == {
        "biceps": (True, 21), "triceps": (False, 21),
    }  # fmt: skip
    one = json.loads(_table("info", str(folder / "biceps.npz"), "--json").stdout)["tables"]
    assert one == {"biceps": both["biceps"]}
    words = _table("info", str(folder)).stdout
    assert "triceps: asked for" in words


def test_info_says_when_a_table_is_of_another_arm(folder, tmp_path):
    from importlib.resources import files

    text = (files("myograph.anatomy") / "left_arm.toml").read_text()
    (tmp_path / "arm.toml").write_text(text.replace("flattening = 1.3 ", "flattening = 1.2 "))
    done = _table("info", str(folder / "biceps.npz"), "--arm", str(tmp_path / "arm.toml"), "--json")
    assert json.loads(done.stdout)["tables"]["biceps"]["belongs_to_this_arm"] is False


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("build", "--preset", "huge"), "huge"),
        (("build", "--tolerance-mm", "-1"), "tolerance_mm: expected a positive number"),
        (("info", "."), "expected tables such as biceps.npz, got none"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_a_mistake_is_one_line_and_exit_code_2(arguments, words, tmp_path):
    command = [sys.executable, "-m", "myograph", "table", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 2
    assert words in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert done.stdout == ""


def test_help_names_the_options():
    done = _table("build", "--help")
    assert done.returncode == 0
    options = ("--preset", "--arm", "--out", "--tolerance-mm", "--tolerance-nm", "--most-states", "--muscle", "--json")
    assert all(option in done.stdout for option in options)
