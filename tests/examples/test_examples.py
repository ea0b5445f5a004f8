"""Every example runs and gives the number it promises."""

import importlib.util
from pathlib import Path

import pytest

pytest.importorskip("ngsolve", reason="the examples need NGSolve")
EXAMPLES = Path(__file__).parents[2] / "examples"


def _load(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_moment_over_angle():
    moments = _load("moment_over_angle").moments()
    assert len(moments) == 6
    assert moments[60, 0.0] == pytest.approx(7.24, abs=0.05)
    assert moments[60, 0.5] == pytest.approx(14.16, abs=0.05)


def test_specimen():
    """At a stretch of 1.2, x = 1.2 / 1.07:  σ = l / L_ofl sigma_max (P1 (exp(P2 (x - 1)) - 1) + 1 - 4 (1 - x)²)."""
    assert _load("specimen").stresses(1.0)[3] == pytest.approx(0.3372, rel=5e-3)


def test_sparse_grid():
    evaluations, modes, error, error_slope = _load("sparse_grid").errors()
    assert (evaluations, modes) == (49, 4)
    assert error == pytest.approx(2.1e-3, rel=0.05)
    assert error_slope == pytest.approx(0.051, rel=0.05)


def test_every_example_has_a_test():
    assert {path.stem for path in EXAMPLES.glob("*.py")} == {
        "heat_in_houses",
        "moment_over_angle",
        "sparse_grid",
        "specimen",
    }
