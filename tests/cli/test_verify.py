"""`myograph verify` as people call it."""

import json
import subprocess
import sys

import pytest

pytest.importorskip("ngsolve", reason="verification needs NGSolve")


def _verify(*arguments):
    command = [sys.executable, "-m", "myograph", "verify", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_the_json_is_the_checks_and_nothing_else():
    done = _verify("--json", "--only", "febio", "--only", "patch.hexahedra")
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    assert list(result) == ["checks", "skipped"]
    assert result["skipped"] == []
    names = [check["name"] for check in result["checks"]]
    assert names == ["febio.ma20", "febio.ma24", "febio.ma25", "febio.mu03", "febio.mu03_stress", "patch.hexahedra"]
    for check in result["checks"]:
        assert list(check) == ["name", "value", "reference", "relative_error", "tolerance", "passed"]
        assert check["passed"] is True
        assert 0 <= check["relative_error"] <= check["tolerance"]


def test_the_table_shows_value_reference_error_and_verdict_in_eighty_columns():
    done = _verify("--only", "closed_form.uniaxial")
    assert done.returncode == 0, done.stderr
    row = next(line for line in done.stdout.splitlines() if "closed_form.uniaxial" in line)
    assert row.split()[:3] == ["closed_form.uniaxial", "2.54982", "2.54982"]
    assert row.split()[-1] == "yes"
    assert "1 of 1 passed" in done.stdout
    assert "…" not in done.stdout


def _verify_changed(change, *arguments):
    """The verb in a process of its own, with a first check that is changed and no others."""
    script = f"""
import dataclasses, sys
import myograph.verification.table as table
from myograph.cli import main
from myograph.errors import NotConvergedError
def fails():
    raise NotConvergedError("no convergence in 20 corrections")
table.CHECKS = (dataclasses.replace(table.CHECKS[0], {change}),)
sys.argv = ["myograph", "verify", *{arguments!r}]
main()
"""
    return subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)


def test_a_value_outside_its_tolerance_is_named_and_exits_with_3():
    done = _verify_changed("reference=0.5")
    assert done.returncode == 3
    assert "0 of 1 passed" in done.stdout
    assert "NO" in done.stdout
    assert "norm of free displacements [mm] is 0.493408719, FEBio test suite has 0.5: off by 1.3e-02" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_method_that_fails_is_null_in_json_and_exits_with_3():
    done = _verify_changed("value=fails", "--json")
    assert done.returncode == 3
    (check,) = json.loads(done.stdout)["checks"]
    assert check["value"] is None
    assert check["relative_error"] is None
    assert check["passed"] is False
    assert "febio.ma20: no convergence in 20 corrections" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--only", "febio.ma21"), "unknown check 'febio.ma21': did you mean"),
        (("--only", "everything"), "unknown check 'everything'"),
        (("--wrong",), "--wrong"),
    ],
)
def test_a_mistake_of_the_caller_is_one_line_and_exit_code_2(arguments, words):
    done = _verify(*arguments)
    assert done.returncode == 2
    assert words in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert done.stdout == ""


def test_without_ngsolve_it_says_what_to_install():
    script = """
import sys
from myograph.cli import main
sys.modules["ngsolve"] = None
sys.argv = ["myograph", "verify"]
main()
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "verifying needs the package 'ngsolve': install it with  pip install 'myograph[simulate]'" in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


def test_help_names_every_option():
    done = _verify("--help")
    assert done.returncode == 0
    assert "--only" in done.stdout
    assert "--json" in done.stdout
